#include "paper/datasets/mesh_ray_caster.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace shortshot_bench::datasets {
namespace {

// Wider instructions would save little time, but change, by their fused operations, which triangle is hit
// by rays along an edge.
constexpr const char* same_everywhere = "isa=sse2";

void throw_if_failed(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw std::runtime_error(std::string("Embree cannot ") + what + ", error " + std::to_string(error));
  }
}

}  // namespace

MeshRayCaster::MeshRayCaster(TexturedMesh mesh)
    : mesh_(std::move(mesh)),
      device_(rtcNewDevice(same_everywhere), &rtcReleaseDevice),
      scene_(nullptr, &rtcReleaseScene) {
  throw_if_failed(device_.get(), "start");
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips through between two triangles
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);  // the scene keeps it
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh_.vertices.size()));
  auto* const corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh_.triangles.size()));
  throw_if_failed(device_.get(), "take the mesh");
  for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      vertices[3 * i + axis] = mesh_.vertices[i][static_cast<Eigen::Index>(axis)];
    }
  }
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) corners[3 * i + corner] = mesh_.triangles[i].vertices[corner];
  }
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene_.get());
  throw_if_failed(device_.get(), "build the search tree of the mesh");
}

std::optional<RayHit> MeshRayCaster::nearest_hit(const Eigen::Vector3d& origin,
                                                 const Eigen::Vector3d& direction) const {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x());
  query.ray.org_y = static_cast<float>(origin.y());
  query.ray.org_z = static_cast<float>(origin.z());
  query.ray.dir_x = static_cast<float>(direction.x());
  query.ray.dir_y = static_cast<float>(direction.y());
  query.ray.dir_z = static_cast<float>(direction.z());
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const RayHit hit = hit_on(mesh_.triangles[query.hit.primID], origin, direction);
  return std::isfinite(hit.distance) ? std::optional<RayHit>(hit) : std::nullopt;
}

RayHit MeshRayCaster::hit_on(const MeshTriangle& triangle, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction) const {
  const auto corner = [&](std::size_t i) -> Eigen::Vector3d {
    return mesh_.vertices[triangle.vertices[i]].cast<double>();
  };
  const Eigen::Vector3d a = corner(0);
  const Eigen::Vector3d ab = corner(1) - a;
  const Eigen::Vector3d ac = corner(2) - a;
  const Eigen::Vector3d normal = ab.cross(ac);  // of twice the triangle's area in length
  const double distance = normal.dot(a - origin) / normal.dot(direction);
  const Eigen::Vector3d ap = origin + distance * direction - a;
  const double weight_b = ap.cross(ac).dot(normal) / normal.squaredNorm();
  const double weight_c = ab.cross(ap).dot(normal) / normal.squaredNorm();
  const Eigen::Vector2d uv = (1.0 - weight_b - weight_c) * triangle.uvs[0].cast<double>() +
                             weight_b * triangle.uvs[1].cast<double>() + weight_c * triangle.uvs[2].cast<double>();
  return {distance, normal.normalized(), uv};
}

}  // namespace shortshot_bench::datasets
