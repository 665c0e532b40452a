#include "paper/datasets/virtual_views.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "paper/datasets/mesh.hpp"
#include "paper/datasets/mesh_ray_caster.hpp"
#include "paper/datasets/virtual_view_renderer.hpp"
#include "tools/io/input_error.hpp"
#include "tools/labels/csv_table.hpp"
#include "tools/labels/dataset_files.hpp"

namespace shortshot_bench::datasets {
namespace {

constexpr int azimuths = 12;

void check(const VirtualViewOptions& options) {
  const bool is_range = options.nearest_m > 0.0 && options.nearest_m <= options.farthest_m;
  if (!is_range || !std::isfinite(options.farthest_m) || !std::isfinite(options.azimuth_jitter_deg)) {
    throw std::invalid_argument("the camera's distances must be positive, the nearest first, and all finite");
  }
  if (!(options.largest_hidden_share >= 0.0 && options.largest_hidden_share < 1.0)) {
    throw std::invalid_argument("the largest hidden share must be from 0 to below 1");
  }
}

MeshRayCaster read_object(const std::string& path, const VirtualViewOptions& options) {
  TexturedMesh mesh = read_textured_mesh(path);
  for (Eigen::Vector3f& v : mesh.vertices) {
    if (options.up == 'x') v = Eigen::Vector3f(v.y(), v.z(), v.x());
    if (options.up == 'y') v = Eigen::Vector3f(v.z(), v.x(), v.y());
    v *= static_cast<float>(options.scale);
  }
  MeshRayCaster object(std::move(mesh));
  const double diagonal_m = bounding_box(object.mesh()).diagonal().norm();
  if (diagonal_m < options.nearest_m) return object;
  throw InputError::about(path, "expected an object smaller than the camera's distance in meters, found one of " +
                                    std::to_string(diagonal_m));
}

void add_views(const std::string& object, const std::string& object_class, std::vector<VirtualView>& views) {
  for (const int elevation_deg : {30, 60}) {
    for (int azimuth = 0; azimuth < azimuths; azimuth += 2) {
      views.push_back({object, object_class, elevation_deg, azimuth, true});
    }
  }
  for (int azimuth = 0; azimuth < azimuths; ++azimuth) {
    views.push_back({object, object_class, 45, azimuth, false});
  }
}

// Engines seeded with numbers one apart are unrelated; the factor keeps the numbers of two small seeds apart.
Random random_of(std::uint32_t seed, std::size_t view) {
  return Random(seed * 0x9e3779b9u + static_cast<std::uint32_t>(view));
}

}  // namespace

bool holds_meshes(const std::string& directory) {
  const std::vector<std::string> folders = folders_in(directory);
  return is_file(directory + "/classes.csv") &&
         std::any_of(folders.begin(), folders.end(), [](const auto& f) { return is_file(f + "/textured.obj"); });
}

VirtualViewSet open_virtual_views(const std::string& directory, const VirtualViewOptions& options) {
  check(options);
  VirtualViewSet set;
  std::vector<MeshRayCaster> objects;
  for (const auto& row : read_csv<2>(directory + "/classes.csv", {"object", "object_class"})) {
    const auto& [object, object_class] = row.cells;
    objects.push_back(read_object(directory + "/" + object + "/textured.obj", options));
    add_views(object, object_class, set.views);
  }
  const auto shared_objects = std::make_shared<const std::vector<MeshRayCaster>>(std::move(objects));
  const std::size_t views_per_object = set.views.size() / shared_objects->size();
  set.load = [shared_objects, views_per_object, views = set.views, options](std::size_t i) {
    const MeshRayCaster& object = shared_objects->at(i / views_per_object);
    return render_view(object, views.at(i), options, random_of(options.seed, i));
  };
  return set;
}

}  // namespace shortshot_bench::datasets
