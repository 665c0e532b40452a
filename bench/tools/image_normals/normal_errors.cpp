#include "tools/image_normals/normal_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "shortshot/shortshot.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench {
namespace {

using shortshot::SurfaceNormal;

double degrees_between(const SurfaceNormal& a, const SurfaceNormal& b) {
  const double u[3] = {double{a.x}, double{a.y}, double{a.z}};
  const double v[3] = {double{b.x}, double{b.y}, double{b.z}};
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  const double cosine = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  return std::atan2(std::sqrt(x * x + y * y + z * z), std::fabs(cosine)) * 180.0 / std::acos(-1.0);
}

/// Of each pixel from the next edge as estimate_image_normals() has it, along rows, columns or diagonals.
std::vector<std::size_t> edge_distances(const shortshot::CloudView& image, float radius, float slope) {
  const auto width = static_cast<std::ptrdiff_t>(image.width), height = static_cast<std::ptrdiff_t>(image.height);
  const std::size_t far = image.width + image.height;
  std::vector<std::size_t> distance(image.size, far);
  std::vector<float> depth(image.size);
  for (std::size_t i = 0; i < image.size; ++i) {
    const float z = shortshot::point(image, i).z;
    depth[i] = std::isfinite(z) || i % image.width == 0 ? z : depth[i - 1];
  }
  const auto look = [&](std::size_t i, std::size_t other) {
    if (std::fabs(depth[i] - depth[other]) > std::max(radius, slope * depth[i])) distance[i] = distance[other] = 0;
  };
  for (std::size_t i = 0; i < image.size; ++i) {
    if (i % image.width > 0) look(i, i - 1);
    if (i >= image.width) look(i, i - image.width);
  }
  const auto lower = [&](std::size_t i, std::ptrdiff_t side) {  // by three neighbors above or below, and one beside
    const auto x = static_cast<std::ptrdiff_t>(i % image.width), y = static_cast<std::ptrdiff_t>(i / image.width);
    const std::ptrdiff_t near[4][2] = {{x + side, y}, {x - 1, y + side}, {x, y + side}, {x + 1, y + side}};
    for (const auto& [u, v] : near) {
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      distance[i] = std::min(distance[i], distance[static_cast<std::size_t>(v * width + u)] + 1);
    }
  };
  for (std::size_t i = 0; i < image.size; ++i) lower(i, -1);
  for (std::size_t i = image.size; i-- > 0;) lower(i, 1);
  return distance;
}

std::string quantiles(std::vector<double> errors) {
  if (errors.size() < 200) return "";
  const auto at = [&](double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(errors.size() - 1));
    std::nth_element(errors.begin(), errors.begin() + k, errors.end());
    return errors[static_cast<std::size_t>(k)];
  };
  char text[40];
  std::snprintf(text, sizeof text, "%.1f / %.1f", at(0.5), at(0.9));
  return text;
}

}  // namespace

void add_errors(const RgbdCloud& cloud, float radius, NormalErrors& errors) {
  const shortshot::CloudView image = view_of_cloud(cloud);
  std::vector<SurfaceNormal> exact, fast;
  require(shortshot::estimate_image_normals(image, radius, camera_of_cloud(cloud), fast));
  const shortshot::GridSearch search(image, radius);
  require(shortshot::estimate_normals(image, search, radius, camera_of_cloud(cloud), exact, 2));
  shortshot::detail::ImageGeometry geometry{};
  require(shortshot::detail::measure_image(image, radius, geometry));
  const std::vector<std::size_t> distance = edge_distances(image, radius, geometry.slope);
  for (std::size_t i = 0; i < image.size; ++i) {
    if (std::isnan(exact[i].x)) continue;
    ++errors.exact;
    if (std::isnan(fast[i].x)) {
      ++errors.missing;
      continue;
    }
    const double error = degrees_between(exact[i], fast[i]);
    errors.all.push_back(error);
    const auto range = [](const auto& ends, auto value) {
      return static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), value) - ends.begin());
    };
    errors.by_edge_distance[range(NormalErrors::pixels, distance[i])].push_back(error);
    const float depth = shortshot::point(image, i).z;
    const float half = std::max(1.0f, geometry.columns / depth - 0.5f);
    if (static_cast<float>(distance[i]) > half + 1.0f)
      errors.by_depth[range(NormalErrors::meters, depth)].push_back(error);
  }
}

std::string heading_of_errors() {
  return "| cloud | radius, mm | all | 0, 1 pixels from an edge | 2, 3 | 4 to 7 | 8 to 15 | farther | window without "
         "an "
         "edge, depth to 0.8 m | to 1.2 m | to 1.6 m | beyond | without a normal |\n"
         "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
}

std::string row_of_errors(const std::string& name, float radius, const NormalErrors& errors) {
  char text[40];
  std::snprintf(text, sizeof text, " | %.0f | ", double{1000.0f * radius});
  std::string row = "| " + name + text + quantiles(errors.all);
  for (const std::vector<double>& range : errors.by_edge_distance) row += " | " + quantiles(range);
  for (const std::vector<double>& range : errors.by_depth) row += " | " + quantiles(range);
  const auto share = [&] { return static_cast<double>(errors.missing) / static_cast<double>(errors.exact); };
  std::snprintf(text, sizeof text, " | %.1f %% |\n", errors.exact > 0 ? 100.0 * share() : 0.0);
  return row + text;
}

}  // namespace shortshot_bench
