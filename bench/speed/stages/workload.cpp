#include "speed/stages/workload.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "shortshot/batch/estimate_normals.hpp"
#include "shortshot/batch/grid_search.hpp"
#include "shortshot/batch/keypoints.hpp"
#include "shortshot/kernel/describe.hpp"
#include "shortshot/status.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench {
namespace {

using shortshot::Status;

/// How many neighbors there are: a search says so also if there is no room for them.
std::uint32_t count_neighbors(const shortshot::GridSearch& search, const shortshot::Point& center, float radius) {
  shortshot::Neighborhood none{};
  const Status status = search.gather(center, radius, none);
  if (status != Status::too_many_neighbors) require(status);
  return none.found;
}

/// Adds the key point unless it has no frame or, for want of normals around it, no SHOT.
void choose(const shortshot::GridSearch& search, const shortshot::KeyPoint& key, std::uint32_t count,
            Workload& workload) {
  NeighborhoodMemory memory(count);
  shortshot::Neighborhood neighborhood = memory.empty();
  require(search.gather(key.position, workload.radius, neighborhood));
  shortshot::Frame frame;
  if (shortshot::estimate_frame(neighborhood, workload.radius, frame) != Status::ok) return;
  float shot[shortshot::Shot352::size];
  const Status described = shortshot::describe<shortshot::Shot352>(
      neighborhood, shortshot::CloudNormals{workload.view()}, frame, workload.radius, shot);
  if (described != Status::ok) return;
  workload.chosen_neighbors += count;
  workload.most_neighbors = std::max(workload.most_neighbors, count);
  workload.chosen.push_back({key, std::move(memory), neighborhood, frame});
}

void add_normals(Workload& workload) {
  const shortshot::CloudView view = view_of_cloud(workload.cloud);
  const shortshot::GridSearch search(view, workload.normal_radius);
  require(shortshot::estimate_normals(view, search, workload.normal_radius, camera_of_cloud(workload.cloud),
                                      workload.normals));
  shortshot::extend::for_each_valid(view, [&](std::size_t, const shortshot::Point& p) {
    workload.normal_neighbors += count_neighbors(search, p, workload.normal_radius);
  });
}

}  // namespace

NeighborhoodMemory::NeighborhoodMemory(std::uint32_t capacity)
    : floats_(new float[4 * std::size_t{capacity}]), index_(new std::uint32_t[capacity]), capacity_(capacity) {}

shortshot::Neighborhood NeighborhoodMemory::empty() const {
  float* const p = floats_.get();
  const std::size_t n = capacity_;
  return {p, p + n, p + 2 * n, p + 3 * n, index_.get(), capacity_, 0, 0, {}};
}

shortshot::CloudView Workload::view() const { return shortshot::with_normals(view_of_cloud(cloud), normals.data()); }

Workload make_workload(RgbdCloud cloud, const WorkloadOptions& options) {
  Workload workload;
  workload.cloud = std::move(cloud);
  workload.radius = options.radius;
  workload.leaf = options.leaf;
  workload.frame_leaf = 0.5f * options.leaf;
  workload.normal_radius = 0.25f * options.radius;
  add_normals(workload);
  const shortshot::CloudView view = workload.view();
  require(shortshot::sample_uniform(view, options.leaf, workload.sampled));
  const shortshot::GridSearch search(view, options.radius);
  require(search.status());
  const std::size_t step = (workload.sampled.size() + options.keypoints - 1) / options.keypoints;
  for (std::size_t i = 0; i < workload.sampled.size(); ++i) {
    const shortshot::KeyPoint key = shortshot::keypoint(view, workload.sampled[i]);
    const std::uint32_t count = count_neighbors(search, key.position, options.radius);
    workload.sampled_neighbors += count;
    if (i % step == 0) choose(search, key, count, workload);
  }
  if (workload.chosen.empty())
    throw std::runtime_error("no key point has a frame and normals: is the radius in the cloud's unit?");
  return workload;
}

}  // namespace shortshot_bench
