#include "demo/run.hpp"

#include <cstdio>
#include <cstring>
#include <nanoflann.hpp>
#include <stdexcept>

#include "shortshot/search/nanoflann.hpp"
#include "shortshot/shortshot.hpp"

namespace shortshot_bench {
namespace {

using shortshot::Status;

void require(Status status, const std::string& hint = {}) {
  if (status != Status::ok) throw std::runtime_error(std::string(shortshot::message(status)) + hint);
}

/// Calls work(search) with the search of that name over the cloud, built within `index_ms`.
template <class Work>
void with_search(const shortshot::CloudView& view, const DemoOptions& options, double& index_ms, const Work& work) {
  const Stopwatch stopwatch;
  if (options.search == "nanoflann") {
    const shortshot::NanoflannSearch search(view);
    index_ms = stopwatch.elapsed_ms();
    work(search);
  } else if (options.search == "organized") {
    shortshot::OrganizedSearch search;
    require(search.build(view), " (--search grid works for any cloud)");
    index_ms = stopwatch.elapsed_ms();
    work(search);
  } else if (options.search == "brute") {
    work(shortshot::BruteSearch{view});
  } else {
    const shortshot::GridSearch search(view, options.radius);
    require(search.status());
    index_ms = stopwatch.elapsed_ms();
    work(search);
  }
}

template <class Part>
std::string layout_of(const char* name) {
  using Grid = typename Part::Grid;
  return std::string(name) + ": " + std::to_string(Grid::azimuth) + " azimuth x " + std::to_string(Grid::elevation) +
         " elevation x " + std::to_string(Grid::radial) + " radial cells x " + std::to_string(Part::Signal::bins) +
         " bins, the last index fastest";
}

template <class Voting, class... Parts>
std::vector<std::string> layout_of(shortshot::Descriptor<Voting, Parts...>) {
  return {layout_of<Parts>(Parts::Signal::needs_colors ? "colour distance" : "occupancy")...};
}

template <class D>
DemoResult describe(const RgbdCloud& cloud, const DemoOptions& options) {
  const shortshot::CloudView view = view_of_cloud(cloud);
  DemoResult result;
  result.size = static_cast<std::size_t>(D::size);
  result.layout = layout_of(D{});
  const Stopwatch sampling;
  require(shortshot::sample_uniform(view, options.leaf, result.keypoints));
  result.sample_ms = sampling.elapsed_ms();

  shortshot::Support support = options.radius;
  const shortshot::Point camera{cloud.viewpoint[0], cloud.viewpoint[1], cloud.viewpoint[2]};
  if (options.towards_camera) support.viewpoint = &camera;
  shortshot::Features<D> features;
  with_search(view, options, result.index_ms, [&](const auto& search) {
    const Stopwatch describing;
    const char* hint = D::needs_colors && !cloud.has_colors() ? " (--descriptor ssh96 needs none)" : "";
    require(shortshot::extract<D>(view, search, result.keypoints, support, features, options.threads), hint);
    result.describe_ms = describing.elapsed_ms();
  });
  result.values = std::move(features.values);
  result.status = std::move(features.status);
  result.neighbors = std::move(features.neighbors);
  return result;
}

bool same_bits(const DemoResult& a, const DemoResult& b) {
  return a.neighbors == b.neighbors && a.status == b.status && a.values.size() == b.values.size() &&
         std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(float)) == 0;
}

}  // namespace

shortshot::CloudView view_of_cloud(const RgbdCloud& cloud) {
  const shortshot::CloudView view = cloud.has_colors()
                                        ? shortshot::view_xyz_rgb(cloud.xyz.data(), cloud.rgb.data(), cloud.size())
                                        : shortshot::view_xyz(cloud.xyz.data(), cloud.size());
  return shortshot::organized(view, cloud.width, cloud.height);
}

DemoResult run_demo(const RgbdCloud& cloud, const DemoOptions& options) {
  if (options.descriptor == "ssh32") return describe<shortshot::Ssh32>(cloud, options);
  if (options.descriptor == "ssh96") return describe<shortshot::Ssh96>(cloud, options);
  if (options.descriptor == "scsh696") return describe<shortshot::Scsh696>(cloud, options);
  return describe<shortshot::Scsh336>(cloud, options);
}

bool check_searches(const RgbdCloud& cloud, const DemoOptions& options) {
  DemoOptions variant = options;
  variant.search = "brute";
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
