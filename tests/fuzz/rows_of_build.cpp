// ROWS is the function's name, which says what flags this is compiled with.
#include "rows_of_build.hpp"

#include <shortshot/batch/estimate_image_normals.hpp>
#include <shortshot/batch/estimate_normals.hpp>
#include <shortshot/descriptor/compact.hpp>
#include <shortshot/kernel.hpp>

namespace {

namespace ss = shortshot;

template <class Value>
void append(std::vector<std::uint8_t>& rows, const Value* values, std::size_t count) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(values);
  rows.insert(rows.end(), bytes, bytes + count * sizeof *values);
}

ss::Workspace<256> workspace;

template <class D>
void append_row(std::vector<std::uint8_t>& rows, const ss::CloudView& cloud, std::size_t key, float radius) {
  static float row[D::size];
  const ss::Status status =
      ss::describe_at<D>(cloud, ss::BruteSearch(cloud), ss::keypoint(cloud, key), radius, workspace, row);
  append(rows, &status, 1);
  append(rows, row, std::size_t{D::size});
  float norm = 0.0f;
  for (const float value : row) norm += value * value;
  fuzz::require(status == ss::Status::ok ? std::abs(norm - 1.0f) < 1e-3f : norm == 0.0f,
                "ok and length 1, or not and zeros");
}

/// Unit vectors, or NaN.
void append_normals(std::vector<std::uint8_t>& rows, ss::Status status, const std::vector<ss::SurfaceNormal>& normals) {
  append(rows, &status, 1);
  append(rows, normals.data(), normals.size());
  for (const ss::SurfaceNormal& n : normals) {
    const float squared = n.x * n.x + n.y * n.y + n.z * n.z;
    const bool none = n.x != n.x && n.y != n.y && n.z != n.z;
    fuzz::require(none || std::abs(squared - 1.0f) < 1e-4f, "a unit vector, or NaN");
  }
}

}  // namespace

void fuzz::ROWS(const MadeCloud& made, std::size_t key, std::vector<std::uint8_t>& rows) {
  ss::CloudView cloud =
      ss::organized(ss::view_xyz_rgb(made.xyz.data(), made.rgb.data(), made.size()), made.width, made.height);
  const ss::BruteSearch search(cloud);
  std::vector<ss::SurfaceNormal> normals;
  ss::Status status = ss::estimate_normals(cloud, search, made.radius, {}, normals);
  append_normals(rows, status, normals);
  status = ss::estimate_image_normals(cloud, made.radius, {}, normals);
  append_normals(rows, status, normals);

  ss::Neighborhood n = ss::neighborhood_in(workspace);
  status = search.gather(ss::point(cloud, key), made.radius, n);
  append(rows, &status, 1);
  ss::Frame frame{};
  ss::FrameConfidence confidence{};
  status = ss::estimate_frame(n, made.radius, frame, confidence);
  append(rows, &status, 1);
  append(rows, &frame, 1);
  append(rows, &confidence, 1);
  ss::SurfaceNormal normal{};
  status = ss::estimate_normal(n, made.radius, normal);
  append(rows, &status, 1);
  append(rows, &normal, 1);

  append_row<ss::Scsh336>(rows, cloud, key, made.radius);
  append_row<ss::ShapeColor95>(rows, cloud, key, made.radius);
  if (!normals.empty()) append_row<ss::Shot352>(rows, ss::with_normals(cloud, normals.data()), key, made.radius);
  // Whatever coordinates are: no normals, and strange intensities.
  cloud.normals = cloud.points;
  append_row<ss::Shot352>(rows, cloud, key, made.radius);
  cloud = ss::with_intensities(cloud, made.xyz.data(), 3 * sizeof(float));
  append_row<ss::IntensityShape336>(rows, cloud, key, made.radius);
}
