// Private to the virtual views: one view of one object.
#pragma once

#include <Eigen/Geometry>

#include "paper/datasets/mesh_ray_caster.hpp"
#include "paper/datasets/virtual_views.hpp"
#include "tools/io/rgbd_cloud.hpp"
#include "tools/scene/random.hpp"

namespace shortshot_bench::datasets {

/// Of all vertices. The object's center is the middle of the box.
Eigen::AlignedBox3d bounding_box(const TexturedMesh& mesh);

/// The box must be smaller than the camera's least distance. Equal arguments give equal points.
RgbdCloud render_view(const MeshRayCaster& object, const VirtualView& view, const VirtualViewOptions& options,
                      Random random);

}  // namespace shortshot_bench::datasets
