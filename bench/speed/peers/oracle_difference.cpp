#include "speed/peers/oracle_difference.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shortshot/shortshot.hpp"
#include "tools/golden/neighbors.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "unit/oracle.hpp"

namespace shortshot_bench::peers {
namespace {

constexpr double clear_border = 1e-5;

oracle::Config config_of(OracleDescriptors::Kind kind) {
  if (kind == OracleDescriptors::Kind::ssh32) return {oracle::Voting::published, {{2, 2, 8}}};
  return {oracle::Voting::published, {{3, 4, 8}, {2, 2, 4, 15}}};
}

}  // namespace

OracleDescriptors::OracleDescriptors(const Task& task, Kind kind) : expected_(task.keypoints.size()) {
  const shortshot::CloudView view = view_of_cloud(task.points);
  const shortshot::GridSearch search(view, task.radius);
  golden::Neighbors neighbors;
  for (std::size_t row = 0; row < expected_.size(); ++row) {
    const std::uint32_t key = task.keypoints[row];
    const shortshot::Point p = shortshot::point(view, key);
    shortshot::Frame frame;
    const shortshot::Neighborhood& n = neighbors.gather(search, p, task.radius);
    if (shortshot::estimate_frame(n, task.radius, frame) != shortshot::Status::ok) continue;
    const shortshot::Rgb color = shortshot::color(view, key);
    oracle::Description description = oracle::describe(
        oracle::neighbors(task.points.xyz, {p.x, p.y, p.z}, task.radius * task.radius), task.points.rgb,
        {color.r, color.g, color.b}, oracle::given_frame(frame.x, frame.y, frame.z), task.radius, config_of(kind));
    if (description.border > clear_border) expected_[row] = std::move(description.values);
  }
}

std::size_t OracleDescriptors::clear_keypoints() const {
  return static_cast<std::size_t>(
      std::count_if(expected_.begin(), expected_.end(), [](const auto& values) { return !values.empty(); }));
}

double OracleDescriptors::largest_difference(const float* rows) const {
  std::size_t size = 0;
  for (const std::vector<double>& values : expected_) size = std::max(size, values.size());
  double largest = 0.0;
  for (std::size_t row = 0; row < expected_.size(); ++row) {
    for (std::size_t i = 0; i < expected_[row].size(); ++i) {
      largest = std::max(largest, std::abs(static_cast<double>(rows[row * size + i]) - expected_[row][i]));
    }
  }
  return largest;
}

}  // namespace shortshot_bench::peers
