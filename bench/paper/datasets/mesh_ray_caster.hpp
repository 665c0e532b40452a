// Where rays meet a mesh.
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "paper/datasets/mesh.hpp"

namespace shortshot_bench::datasets {

struct RayHit {
  double distance;         // in lengths of the ray's direction
  Eigen::Vector3d normal;  // of the triangle, length 1, on either side
  Eigen::Vector2d uv;      // texture coordinates
};

class MeshRayCaster {
 public:
  /// Throws std::runtime_error when Embree cannot start.
  explicit MeshRayCaster(TexturedMesh mesh);

  const TexturedMesh& mesh() const { return mesh_; }

  /// The nearest hit, front or back; thread-safe. Embree finds the triangle in single precision; where the ray meets it
  /// is computed here, in double precision.
  std::optional<RayHit> nearest_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

 private:
  RayHit hit_on(const MeshTriangle& triangle, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  TexturedMesh mesh_;
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
};

}  // namespace shortshot_bench::datasets
