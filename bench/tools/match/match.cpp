#include "tools/match/match.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/match/described.hpp"

namespace shortshot_bench {
namespace {

using shortshot::CloudView;
using shortshot::Point;
using shortshot::PointPair;
using shortshot::Status;

/// Both clouds must be described with the same lengths: those of the coarser one.
void choose_lengths(const RgbdCloud& a, const RgbdCloud& b, const MatchOptions& options, MatchResult& out) {
  float suggested = 0.0f;
  for (const RgbdCloud* cloud : {&a, &b}) {
    const shortshot::Suggestion s = shortshot::suggest(view_of_cloud(*cloud), camera_of_cloud(*cloud));
    require(s.status);
    suggested = std::max(suggested, s.radius);
    out.spacing = std::max(out.spacing, s.spacing);
  }
  out.radius = options.radius > 0.0f ? options.radius : suggested;
  // Half the leaf that is suggested for describing: two key points of one place lie up to a leaf apart, and so does
  // what a pose can be made of.
  out.leaf = options.leaf > 0.0f ? options.leaf : 0.25f * out.radius;
  out.reach = out.leaf;
}

template <class D>
void find_pairs(const RgbdCloud& a, const RgbdCloud& b, const MatchOptions& options, MatchResult& out) {
  const shortshot::Features<D> of_a = described<D>(a, out.radius, out.leaf, options.threads);
  const shortshot::Features<D> of_b = described<D>(b, out.radius, out.leaf, options.threads);
  std::vector<std::uint32_t> place_in[2];  // of each row among those that were described
  std::vector<Point>* const points[2] = {&out.a, &out.b};
  const shortshot::Features<D>* const features[2] = {&of_a, &of_b};
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t row = 0; row < features[side]->size(); ++row) {
      place_in[side].push_back(static_cast<std::uint32_t>(points[side]->size()));
      if (features[side]->status[row] == Status::ok) points[side]->push_back(features[side]->keypoints[row].position);
    }
  }
  require(reciprocal_correspondences(rows_of(of_b), rows_of(of_a), out.rows, options.threads));
  for (shortshot::MatchedPair& pair : out.rows) {
    pair.source = place_in[1][pair.source];
    pair.target = place_in[0][pair.target];
  }
}

/// Standard deviations of the inliers along their principal axes.
void measure_extent(MatchResult& out) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
  const auto count = static_cast<float>(out.inliers.size());
  const auto eigen = [](const Point& p) { return Eigen::Vector3f(p.x, p.y, p.z); };
  for (const std::uint32_t i : out.inliers) mean += eigen(out.in_b(i)) / count;
  for (const std::uint32_t i : out.inliers) {
    const Eigen::Vector3f d = eigen(out.in_b(i)) - mean;
    scatter += d * d.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(scatter, Eigen::EigenvaluesOnly);
  for (int axis = 0; axis < 3; ++axis) out.extent[axis] = std::sqrt(std::max(0.0f, solver.eigenvalues()[2 - axis]));
}

/// Samples of three pairs, of which there may be fewer than tries.
std::size_t poses_tried(std::size_t pairs, std::uint32_t tries) {
  const auto n = static_cast<double>(pairs);
  return static_cast<std::size_t>(std::min(static_cast<double>(tries), n * (n - 1.0) * (n - 2.0) / 6.0));
}

void find_pose(const RgbdCloud& a, const RgbdCloud& b, const MatchOptions& options, MatchResult& out) {
  std::vector<PointPair> pairs;
  for (std::uint32_t i = 0; i < out.rows.size(); ++i) pairs.push_back({out.in_b(i), out.in_a(i)});
  shortshot::RansacOptions ransac;
  ransac.iterations = options.tries;
  ransac.inlier_distance = out.reach;
  const Status status = estimate_pose(pairs, ransac, out.pose, out.inliers);
  if (status == Status::too_few_pairs || status == Status::no_pose) return;
  require(status);
  measure_extent(out);
  std::vector<Point> sources;
  std::vector<float> distances;
  for (const shortshot::MatchedPair& row : out.rows) {
    sources.push_back(out.b[row.source]);
    distances.push_back(row.distance);
  }
  out.chance = chance_of(pairs, out.inliers, places_of(sources, distances, out.radius), out.pose, out.a, out.reach,
                         poses_tried(pairs.size(), options.tries));
  out.is_found = out.chance.log10_expected < std::log10(options.expected);
  if (!out.is_found) return;
  out.fit = refine(view_of_cloud(b), view_of_cloud(a), refine_options_of(out), out.pose);
}

}  // namespace

RefineOptions refine_options_of(const MatchResult& result) {
  RefineOptions how;
  how.plane_radius = std::max(0.25f * result.radius, 3.0f * result.spacing);
  how.reach = std::max(0.5f * result.reach, 2.0f * result.spacing);
  how.first_reach = 3.0f * result.reach;
  return how;
}

MatchResult match_clouds(const RgbdCloud& a, const RgbdCloud& b, const MatchOptions& options) {
  MatchResult out;
  choose_lengths(a, b, options, out);
  const bool has_colors = a.has_colors() && b.has_colors();
  out.descriptor = has_colors ? "shapecolor95" : "heightshape96";
  if (has_colors) {
    find_pairs<shortshot::ShapeColor95>(a, b, options, out);
  } else {
    find_pairs<shortshot::HeightShape96>(a, b, options, out);
  }
  find_pose(a, b, options, out);
  return out;
}

double degrees_between(const shortshot::Pose& a, const shortshot::Pose& b) {
  double trace = 0.0;  // of the one times the other's inverse
  for (std::size_t k = 0; k < 9; ++k) trace += static_cast<double>(a.rotation[k] * b.rotation[k]);
  return std::acos(std::min(1.0, std::max(-1.0, 0.5 * (trace - 1.0)))) * 57.29577951308232;
}

double degrees_of(const shortshot::Pose& pose) {
  return degrees_between(pose, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}});
}

RgbdCloud moved(const RgbdCloud& cloud, const shortshot::Pose& pose) {
  RgbdCloud out = cloud;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Point p = transform_point(pose, {cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]});
    out.xyz[3 * i] = p.x;
    out.xyz[3 * i + 1] = p.y;
    out.xyz[3 * i + 2] = p.z;
  }
  out.normals.clear();
  return out;
}

}  // namespace shortshot_bench
