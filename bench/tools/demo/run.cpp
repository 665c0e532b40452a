#include "tools/demo/run.hpp"

#include <cstdio>
#include <cstring>
#include <nanoflann.hpp>
#include <stdexcept>

#include "shortshot/search/nanoflann.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/demo/sampled_brute.hpp"
#include "tools/demo/slow_stage.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench {
namespace {

using shortshot::Status;

void require(Status status, const std::string& hint = {}) {
  if (status != Status::ok) throw std::runtime_error(std::string(shortshot::message(status)) + hint);
}

/// Builds the search that was chosen over the cloud, which serves this radius best, and calls work(search).
template <class Work>
void with_search(const shortshot::CloudView& view, const DemoOptions& options, float radius, const Work& work) {
  const std::string& name = options.search;
  if (name == "nanoflann") {
    work(shortshot::NanoflannSearch(view));
  } else if (name == "organized") {
    shortshot::OrganizedSearch search;
    require(search.build(view), " (--search grid works for any cloud)");
    work(search);
  } else if (name == "brute" && options.brute_share > 1) {
    work(SampledBruteSearch(view, radius, options.brute_share));
  } else if (name == "brute") {
    work(shortshot::BruteSearch{view});
  } else {
    const shortshot::GridSearch search(view, radius);
    require(search.status());
    work(search);
  }
}

void estimate_normals(const RgbdCloud& cloud, const DemoOptions& options, DemoResult& result) {
  const shortshot::CloudView view = view_of_cloud(cloud);
  const float radius = normal_radius(options);
  const SlowStage stage("normals of " + std::to_string(cloud.size()) + " points");
  const Stopwatch stopwatch;
  with_search(view, options, radius, [&](const auto& search) {
    require(shortshot::estimate_normals(view, search, radius, camera_of_cloud(cloud), result.normals, options.threads));
  });
  result.normals_ms = stopwatch.elapsed_ms();
}

std::vector<shortshot::SurfaceNormal> normals_of(const RgbdCloud& cloud) {
  std::vector<shortshot::SurfaceNormal> normals(cloud.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    normals[i] = {cloud.normals[3 * i], cloud.normals[3 * i + 1], cloud.normals[3 * i + 2]};
  }
  return normals;
}

template <class Part>
std::string layout_of(const char* name) {
  using Grid = typename Part::Grid;
  const std::string elevation = std::to_string(Grid::elevation) + " elevation";
  const std::string radial = std::to_string(Grid::radial) + " radial";
  constexpr bool elevation_faster = Part::index(0, 1, 0) < Part::index(1, 0, 0);
  return std::string(name) + ": " + std::to_string(Grid::azimuth) + " azimuth x " +
         (elevation_faster ? radial + " x " + elevation : elevation + " x " + radial) + " cells x " +
         std::to_string(Part::values) + " bins, the last index fastest";
}

template <class Part>
constexpr const char* name_of() {
  if constexpr (Part::weight_cells > 0) {
    return "mean color";
  } else {
    return Part::Signal::name;
  }
}

template <class Voting, class... Parts>
std::vector<std::string> layout_of(shortshot::Descriptor<Voting, Parts...>) {
  return {layout_of<Parts>(name_of<Parts>())...};
}

/// What to say behind a refusal of the whole cloud.
template <class D>
const char* way_out(const RgbdCloud& cloud) {
  const bool lacks = (D::needs_colors && !cloud.has_colors()) || (D::needs_intensities && !cloud.has_intensities());
  return lacks ? " (--descriptor ssh96 needs none)" : "";
}

template <class D>
DemoResult describe(const RgbdCloud& cloud, const DemoOptions& options) {
  shortshot::CloudView view = view_of_cloud(cloud);
  DemoResult result;
  result.size = static_cast<std::size_t>(D::size);
  result.layout = layout_of(D{});
  const Stopwatch sampling;
  require(shortshot::sample_uniform(view, options.leaf, result.keypoints));
  result.sample_ms = sampling.elapsed_ms();
  if (D::needs_normals) {
    result.normals_of_file = cloud.has_normals() && !options.normal_radius;
    if (result.normals_of_file) {
      result.normals = normals_of(cloud);
    } else {
      estimate_normals(cloud, options, result);
    }
    view = shortshot::with_normals(view, result.normals.data());
  }

  shortshot::Support support = options.radius;
  if (options.towards_camera || D::wants_viewpoint) support.viewpoint = camera_of_cloud(cloud);
  shortshot::Features<D> features;
  const Stopwatch indexing;
  with_search(view, options, options.radius, [&](const auto& search) {
    result.index_ms = indexing.elapsed_ms();
    const SlowStage stage("describing " + std::to_string(result.keypoints.size()) + " key points");
    const Stopwatch describing;
    require(shortshot::extract<D>(view, search, result.keypoints, support, features, options.threads),
            way_out<D>(cloud));
    result.describe_ms = describing.elapsed_ms();
  });
  result.values = std::move(features.values);
  result.status = std::move(features.status);
  result.neighbors = std::move(features.neighbors);
  return result;
}

template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

bool same_bits(const DemoResult& a, const DemoResult& b) {
  return a.neighbors == b.neighbors && a.status == b.status && same_bits(a.normals, b.normals) &&
         same_bits(a.values, b.values);
}

/// Neighborhoods that a run looks at: of key points, and of all points where there are normals.
std::size_t queries_of(const RgbdCloud& cloud, const DemoOptions& options) {
  std::vector<std::uint32_t> keypoints;
  require(shortshot::sample_uniform(view_of_cloud(cloud), options.leaf, keypoints));
  const bool needs_normals = options.descriptor.find("shot") != std::string::npos;
  return keypoints.size() + (needs_normals ? cloud.size() : 0);
}

}  // namespace

float normal_radius(const DemoOptions& options) { return options.normal_radius.value_or(0.25f * options.radius); }

DemoResult run_demo(const RgbdCloud& cloud, const DemoOptions& options) {
  if (options.descriptor == "ssh32") return describe<shortshot::Ssh32>(cloud, options);
  if (options.descriptor == "ssh96") return describe<shortshot::Ssh96>(cloud, options);
  if (options.descriptor == "scsh696") return describe<shortshot::Scsh696>(cloud, options);
  if (options.descriptor == "intensity336") return describe<shortshot::IntensityShape336>(cloud, options);
  if (options.descriptor == "shapecolor95") return describe<shortshot::ShapeColor95>(cloud, options);
  if (options.descriptor == "shapecolor32") return describe<shortshot::ShapeColor32>(cloud, options);
  if (options.descriptor == "roomcolor95") return describe<shortshot::RoomColor95>(cloud, options);
  if (options.descriptor == "heightshape96") return describe<shortshot::HeightShape96>(cloud, options);
  if (options.descriptor == "colorrings27") return describe<shortshot::ColorRings27>(cloud, options);
  if (options.descriptor == "shot352") return describe<shortshot::Shot352>(cloud, options);
  if (options.descriptor == "cshot1344") return describe<shortshot::Cshot1344>(cloud, options);
  return describe<shortshot::Scsh336>(cloud, options);
}

bool check_searches(const RgbdCloud& cloud, const DemoOptions& options) {
  DemoOptions variant = options;
  variant.search = "brute";
  variant.brute_share = brute_share(cloud.size(), queries_of(cloud, options));
  if (variant.brute_share > 1) {
    std::printf("  check               brute force is asked for one neighborhood in %zu: the cloud is large\n",
                variant.brute_share);
  }
  const DemoResult reference = run_demo(cloud, variant);
  bool all_same = true;
  const auto compare = [&](const char* search, unsigned threads) {
    variant.search = search;
    variant.threads = threads;
    const bool same = same_bits(reference, run_demo(cloud, variant));
    std::printf("  check               %-9s %u thread%s: %s\n", search, threads, threads == 1 ? "" : "s",
                same ? "the same bits as brute force" : "DIFFERENT from brute force");
    all_same = all_same && same;
  };
  for (const unsigned threads : {1u, 2u, 3u}) compare("grid", threads);
  compare("nanoflann", 2);
  shortshot::OrganizedSearch organized;
  const Status status = organized.build(view_of_cloud(cloud));
  if (status == Status::ok) {
    compare("organized", 2);
  } else {
    std::printf("  check               organized not applicable: %s\n", shortshot::message(status));
  }
  return all_same;
}

}  // namespace shortshot_bench
