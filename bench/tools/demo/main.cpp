// demo: what the library does with your clouds, or with one made up on the spot.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/status.hpp"
#include "tools/demo/diagnose.hpp"
#include "tools/demo/hints.hpp"
#include "tools/demo/options.hpp"
#include "tools/demo/run.hpp"
#include "tools/demo/slow_stage.hpp"
#include "tools/demo/text.hpp"
#include "tools/io/input_error.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/io/write_descriptor_pcd.hpp"
#include "tools/io/write_npy.hpp"
#include "tools/match/match.hpp"
#include "tools/match/pictures.hpp"
#include "tools/picture/marks.hpp"
#include "tools/scene/tabletop.hpp"

namespace {

using namespace shortshot_bench;

/// FNV-1a over the descriptors' bytes: two runs that print the same number computed the same bits.
std::uint64_t checksum(const std::vector<float>& values) {
  std::uint64_t hash = 14695981039346656037u;
  for (const float value : values) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211u;
  }
  return hash;
}

std::string channels_of(const RgbdCloud& cloud) {
  std::string channels = cloud.has_colors() ? "with color" : "";
  if (cloud.has_intensities()) channels += channels.empty() ? "with intensity" : " and intensity";
  if (cloud.has_normals()) channels += channels.empty() ? "with normals" : " and normals";
  return channels.empty() ? "without color" : channels;
}

void print_note(const std::string& note) { std::printf("  note                %s\n", note.c_str()); }

/// Before it is described: a refusal of the whole cloud is the better understood.
void print_cloud(const RgbdCloud& cloud, double read_ms) {
  std::printf("  points              %zu (%zu x %zu), %zu valid, %s, in %.1f ms\n", cloud.size(), cloud.width,
              cloud.height, valid_points_of(cloud), channels_of(cloud).c_str(), read_ms);
  for (const std::string& note : cloud.notes) print_note(note);
}

std::size_t with_normal(const std::vector<shortshot::SurfaceNormal>& normals) {
  return static_cast<std::size_t>(std::count_if(normals.begin(), normals.end(),
                                                [](const shortshot::SurfaceNormal& n) { return !std::isnan(n.x); }));
}

void print_result(const RgbdCloud& cloud, const DemoOptions& options, const DemoResult& result) {
  const std::size_t keypoints = result.keypoints.size();
  const double bytes = 4.0 * static_cast<double>(result.size);
  const double sum = std::accumulate(result.neighbors.begin(), result.neighbors.end(), 0.0);
  const auto [least, most] = std::minmax_element(result.neighbors.begin(), result.neighbors.end());
  std::printf("  key points          %zu, one per voxel of %g, in %.1f ms\n", keypoints,
              static_cast<double>(options.leaf), result.sample_ms);
  if (result.normals_of_file) {
    std::printf("  normals             %zu of the file; --normal-radius R estimates them\n",
                with_normal(result.normals));
  } else if (!result.normals.empty()) {
    std::printf("  normals             %zu points within %g, in %.1f ms\n", with_normal(result.normals),
                static_cast<double>(normal_radius(options)), result.normals_ms);
  }
  std::printf("  index               %s, in %.1f ms\n", options.search.c_str(), result.index_ms);
  std::printf("  neighbors          %.0f per key point within %g (%u to %u)\n", sum / static_cast<double>(keypoints),
              static_cast<double>(options.radius), *least, *most);
  std::printf("  describe            %s, %u thread%s, in %.1f ms: %.1f us per key point\n", options.descriptor.c_str(),
              options.threads, options.threads == 1 ? "" : "s", result.describe_ms,
              1e3 * result.describe_ms / static_cast<double>(keypoints));
  std::printf("  size                %zu floats, %.0f bytes per descriptor, %.1f KB in all\n", result.size, bytes,
              bytes * static_cast<double>(keypoints) / 1024.0);
  for (const std::string& part : result.layout) std::printf("  layout              %s\n", part.c_str());
  std::printf("  checksum            %016llx\n", static_cast<unsigned long long>(checksum(result.values)));
  for (int kind = 0; kind < shortshot::status_count; ++kind) {
    const auto status = static_cast<shortshot::Status>(kind);
    const auto rows = std::count(result.status.begin(), result.status.end(), status);
    if (rows > 0) std::printf("  status              %6ld  %s\n", static_cast<long>(rows), shortshot::message(status));
  }
  for (const std::string& hint : hints(cloud, options, result)) print_note(hint);
}

/// Rows are key points in ascending order of their index; those without a descriptor are zeros.
void write_result(const RgbdCloud& cloud, const DemoOptions& options, const DemoResult& result) {
  if (options.out.substr(options.out.size() - 4) == ".npy") {
    write_npy(options.out, result.values.data(), result.keypoints.size(), result.size);
  } else {
    std::vector<std::array<float, 3>> positions;
    for (const std::uint32_t i : result.keypoints) {
      positions.push_back({cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]});
    }
    std::vector<std::string> comments = {options.descriptor + ", radius " + std::to_string(options.radius) +
                                         ", L2 norm 1 (all zeros: not described); parts one after the other:"};
    if (result.normals_of_file) {
      comments.insert(comments.begin(), "normals of the cloud's file");
    } else if (!result.normals.empty()) {
      comments.insert(comments.begin(), "normals within " + std::to_string(normal_radius(options)));
    }
    if (cloud.is_shifted()) {
      comments.insert(comments.begin(), "x y z are from the origin " + std::to_string(cloud.origin[0]) + " " +
                                            std::to_string(cloud.origin[1]) + " " + std::to_string(cloud.origin[2]) +
                                            " of the cloud");
    }
    comments.insert(comments.end(), result.layout.begin(), result.layout.end());
    write_descriptor_pcd(options.out, positions, result.values.data(), result.size, comments);
  }
  std::printf("  written             %s: %zu rows of %zu floats\n", options.out.c_str(), result.keypoints.size(),
              result.size);
}

/// Lengths that nobody asked for, of a file's cloud.
void choose_lengths(const RgbdCloud& cloud, DemoOptions& options) {
  if (options.suggest_radius) {
    const shortshot::Suggestion suggested = shortshot::suggest(view_of_cloud(cloud), camera_of_cloud(cloud));
    if (suggested.status != shortshot::Status::ok) return;  // describing says it, too, and of what
    options.radius = suggested.radius;
    print_note(text("radius %g, suggested by points that lie %.2g apart (--radius R takes another)",
                    static_cast<double>(options.radius), static_cast<double>(suggested.spacing)));
  }
  if (options.suggest_leaf) options.leaf = shortshot::detail::in_two_digits(0.5f * options.radius);
}

/// Of the generated scene another view is found in it; of a file's cloud there is no other.
void draw(const RgbdCloud& cloud, const std::string& file, const DemoOptions& options, const DemoResult& result) {
  const SlowStage stage("matching and drawing");
  constexpr std::size_t width = 1600;
  if (file.empty()) {
    TabletopOptions turned;
    turned.turn = 0.25;
    const RgbdCloud other = make_tabletop(turned);
    MatchOptions how;
    how.radius = options.radius;
    how.leaf = options.leaf;
    how.threads = options.threads;
    const MatchResult match = match_clouds(cloud, other, how);
    draw_matches({"generated scene", cloud}, {"the same, turned", other}, match, width).write_png(options.picture);
    std::printf("  match               another view of the scene: %s\n", verdict_of(match).c_str());
  } else {
    picture::MarkedCloud marked;
    for (const std::uint32_t i : result.keypoints) {
      marked.dots.push_back({cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]});
    }
    marked.title = std::to_string(result.keypoints.size()) + " key points, each described within " +
                   text("%g", static_cast<double>(options.radius));
    marked.legend = marked.dots.size() > 800 ? "dots: some of the key points" : "dots: key points";
    draw_marked({name_of_input(file), cloud}, marked, width).write_png(options.picture);
  }
  std::printf("  picture             %s\n", options.picture.c_str());
}

RgbdCloud read(const std::string& file, const InputOptions& options) {
  const SlowStage stage("reading");
  return file.empty() ? make_tabletop() : read_input(file, options);
}

/// 0: described; 1: --check found a difference, or --diagnose something wrong; 2: bad input, said on stderr.
int demonstrate(const std::string& file, DemoOptions options) {
  const bool generated = file.empty();
  try {
    for (const std::string& output : {options.out, options.picture}) keep_input(file, output);
    const Stopwatch reading;
    const RgbdCloud cloud = read(file, options.input);
    const double read_ms = reading.elapsed_ms();
    std::printf("%s\n", generated ? "generated tabletop scene" : file.c_str());
    print_cloud(cloud, read_ms);
    std::fflush(stdout);  // before what stderr may say
    if (options.diagnose) return print_diagnosis(cloud, options) ? 0 : 1;
    choose_lengths(cloud, options);
    const DemoResult result = run_demo(cloud, options);
    print_result(cloud, options, result);
    if (!options.out.empty()) write_result(cloud, options, result);
    if (options.check && !check_searches(cloud, options)) return 1;
    if (!options.picture.empty()) draw(cloud, file, options, result);
    return 0;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", generated ? "generated tabletop scene" : file.c_str(), error.what());
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  DemoOptions options;
  int exit_code = 0;
  if (!parse_options(argc, argv, options, exit_code)) return exit_code;
  if (options.clouds.empty()) return demonstrate({}, options);
  for (const std::string& file : options.clouds) exit_code = std::max(exit_code, demonstrate(file, options));
  return exit_code;
}
