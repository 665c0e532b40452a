#include "speed/peers/task.hpp"

#include <numeric>
#include <stdexcept>
#include <utility>

#include "shortshot/shortshot.hpp"
#include "speed/spread_keypoints.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/valid_points.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench::peers {
Task make_task(const std::string& name, const RgbdCloud& cloud, float radius, float leaf) {
  if (!cloud.has_colors()) throw std::runtime_error("no colors, which half of the descriptors need");
  Task task;
  task.cloud = name;
  task.points = valid_points(cloud);
  task.image = cloud;
  task.radius = radius;
  task.leaf = leaf;
  const shortshot::CloudView view = view_of_cloud(task.points);
  require(shortshot::sample_uniform(view, leaf, task.sampled));
  task.keypoints = task.sampled;
  keep_spread(task.keypoints, max_keypoints);

  const shortshot::GridSearch search(view, radius);
  shortshot::Features<shortshot::Ssh32> features;
  require(shortshot::extract(view, search, task.keypoints, radius, features));
  const double neighbors = std::accumulate(features.neighbors.begin(), features.neighbors.end(), 0.0);
  task.mean_neighbors = neighbors / static_cast<double>(task.keypoints.size());
  return task;
}

}  // namespace shortshot_bench::peers
