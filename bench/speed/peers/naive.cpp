#include "speed/peers/naive.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <unordered_map>

#include "speed/peers/naive_color.hpp"

namespace shortshot_bench::peers {
namespace {

constexpr double pi = 3.14159265358979323846;

/// nanoflann's own RadiusResultSet; that one's type of pairs depends on nanoflann's version.
struct Found {
  using DistanceType = float;
  using IndexType = std::uint32_t;

  float radius_squared;
  Naive::Neighbors& neighbors;

  bool addPoint(float d2, std::uint32_t index) {
    if (d2 < radius_squared) neighbors.emplace_back(index, d2);
    return true;
  }
  float worstDist() const { return radius_squared; }
  std::size_t size() const { return neighbors.size(); }
  bool empty() const { return neighbors.empty(); }
  bool full() const { return true; }
  void sort() {}
};

float dot(const std::array<float, 3>& v, const float (&axis)[3]) {
  return (v[0] * axis[0] + v[2] * axis[2]) + v[1] * axis[1];
}

/// A member of the frame's neighborhood: v is the offset from the key point.
struct Member {
  Eigen::Vector3d v;
  float d2;
  std::uint32_t index;
};

/// Turns the axis towards the majority; a tie is decided by the five members in the middle of the order by distance.
void orient(std::vector<Member>& members, Eigen::Vector3d& axis) {
  const std::size_t n = members.size();
  std::size_t votes = 0;
  for (const Member& m : members) votes += m.v.dot(axis) >= 0.0 ? 1 : 0;
  bool keep = 2 * votes > n;
  if (2 * votes == n) {
    std::sort(members.begin(), members.end(),
              [](const Member& a, const Member& b) { return std::tie(a.d2, a.index) < std::tie(b.d2, b.index); });
    int middle = 0;
    for (std::size_t k = n / 2 - 2; k <= n / 2 + 2; ++k) middle += members[k].v.dot(axis) > 0.0 ? 1 : 0;
    keep = middle >= 3;
  }
  if (!keep) axis = -axis;
}

/// Where a neighbor lies along one axis of a grid: its cell, the nearer neighboring cell (-1: none), and its share in
/// the first.
struct Share {
  int cell;
  int partner;
  double weight;
};

Share share(double position, int cells, bool wraps) {
  const auto raw = static_cast<double>(static_cast<float>(position));  // as published
  Share s{std::max(0, std::min(cells - 1, static_cast<int>(raw))), -1, 1.0};
  const double fraction = raw - std::trunc(raw);
  s.weight = fraction <= 0.5 ? fraction + 0.5 : 1.5 - fraction;
  s.partner = fraction <= 0.5 ? s.cell - 1 : s.cell + 1;
  if (wraps) s.partner = (s.partner + cells) % cells;
  if (s.partner < 0 || s.partner >= cells || s.partner == s.cell) s.partner = -1;
  return s;
}

/// Adds one neighbor's votes to a part. `u`, `theta` and `phi` are its distance over the radius and its angles over
/// their ranges.
void vote(const NaivePart& part, double u, double theta, double phi, double color_distance, double* out) {
  const Share r = share(part.radial * u, part.radial, false);
  const Share e = share(part.elevation * theta, part.elevation, false);
  const Share a = share(part.azimuth * phi, part.azimuth, true);
  const bool colored = part.bins > 0;
  const Share c = colored ? share(part.bins * color_distance, part.bins, false) : Share{0, -1, 0.0};
  const auto value = [&](int radial, int elevation, int azimuth, int bin) -> double& {
    const int cell = radial + part.radial * (elevation + part.elevation * azimuth);
    return out[colored ? bin + part.bins * cell : cell];
  };
  const double sum = r.weight + e.weight + a.weight + c.weight;
  const auto swapped = [](const Share& s) { return 1.0 - 2.0 * s.weight; };
  value(r.cell, e.cell, a.cell, c.cell) += sum;
  if (r.partner >= 0) value(r.partner, e.cell, a.cell, c.cell) += sum + swapped(r);
  if (e.partner >= 0) value(r.cell, e.partner, a.cell, c.cell) += sum + swapped(e);
  if (a.partner >= 0) value(r.cell, e.cell, a.partner, c.cell) += sum + swapped(a);
  if (c.partner >= 0) value(r.cell, e.cell, a.cell, c.partner) += sum + swapped(c) + swapped(r);  // the published quirk
}

}  // namespace

struct Naive::Tree {
  struct Points {
    const std::vector<float>& xyz;
    std::size_t kdtree_get_point_count() const { return xyz.size() / 3; }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const { return xyz[3 * i + axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Distance = nanoflann::L2_Simple_Adaptor<float, Points, float, std::uint32_t>;

  Points points;
  nanoflann::KDTreeSingleIndexAdaptor<Distance, Points, 3, std::uint32_t> index;

  explicit Tree(const std::vector<float>& xyz)
      : points{xyz}, index(3, points, {10, nanoflann::KDTreeSingleIndexAdaptorFlags::SkipInitialBuildIndex}) {
    index.buildIndex();
  }
};

Naive::Naive(const Task& task) : task_(task) {}
Naive::~Naive() = default;

std::vector<std::uint32_t> Naive::sample() const {
  using Cell = std::array<long, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      return static_cast<std::size_t>(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
    }
  };
  struct Nearest {
    double d2 = std::numeric_limits<double>::infinity();
    std::uint32_t index = 0;
  };
  const auto leaf = static_cast<double>(task_.leaf);
  std::unordered_map<Cell, Nearest, Hash> voxels;
  for (std::uint32_t i = 0; i < task_.points.size(); ++i) {
    Cell cell{};
    double d2 = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = static_cast<double>(task_.points.xyz[3 * i + axis]) / leaf;
      cell[axis] = std::lround(std::floor(place));
      const double from_center = place - std::floor(place) - 0.5;
      d2 += from_center * from_center;
    }
    Nearest& nearest = voxels[cell];
    if (d2 < nearest.d2) nearest = {d2, i};
  }
  std::vector<std::uint32_t> keypoints;
  for (const auto& [cell, nearest] : voxels) keypoints.push_back(nearest.index);
  std::sort(keypoints.begin(), keypoints.end());
  return keypoints;
}

void Naive::build_tree() {
  tree_.reset();
  tree_ = std::make_unique<Tree>(task_.points.xyz);
}

void Naive::convert_colors() {
  lab_.resize(task_.points.size());
  for (std::size_t i = 0; i < lab_.size(); ++i) lab_[i] = naive_lab(task_.points.rgb.data() + 3 * i);
}

void Naive::release() {
  tree_.reset();
  lab_ = std::vector<std::array<double, 3>>();  // {} would keep its memory
}

std::array<float, 3> Naive::offset(std::uint32_t keypoint, std::uint32_t neighbor) const {
  const float* p = task_.points.xyz.data() + 3 * static_cast<std::size_t>(neighbor);
  const float* center = task_.points.xyz.data() + 3 * static_cast<std::size_t>(keypoint);
  return {p[0] - center[0], p[1] - center[1], p[2] - center[2]};
}

void Naive::find_neighbors(std::uint32_t keypoint, Neighbors& neighbors) const {
  neighbors.clear();
  Found found{task_.radius * task_.radius, neighbors};
  tree_->index.findNeighbors(found, task_.points.xyz.data() + 3 * static_cast<std::size_t>(keypoint), {});
}

bool Naive::estimate_frame(std::uint32_t keypoint, const Neighbors& neighbors, shortshot::Frame& frame) const {
  std::vector<Member> members;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double weights = 0.0;
  for (const auto& [index, d2] : neighbors) {
    const std::array<float, 3> v = offset(keypoint, index);
    const Member member{{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}, d2, index};
    if (member.v.isZero(0.0)) continue;
    const double weight = static_cast<double>(task_.radius) - std::sqrt(static_cast<double>(d2));
    scatter += weight * member.v * member.v.transpose();
    weights += weight;
    members.push_back(member);
  }
  if (members.size() < 5) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter / weights);
  Eigen::Vector3d x = solver.eigenvectors().col(2);
  Eigen::Vector3d z = solver.eigenvectors().col(0);
  orient(members, x);
  orient(members, z);
  Eigen::Map<Eigen::Vector3f> frame_x(frame.x), frame_y(frame.y), frame_z(frame.z);
  frame_x = x.cast<float>();
  frame_z = z.cast<float>();
  frame_y = frame_z.cross(frame_x);
  return true;
}

void Naive::describe(std::uint32_t keypoint, const Neighbors& neighbors, const shortshot::Frame& frame,
                     const std::vector<NaivePart>& parts, std::vector<double>& descriptor) const {
  std::size_t size = 0;
  bool colored = false;
  for (const NaivePart& part : parts) {
    size += part.size();
    colored = colored || part.bins > 0;
  }
  descriptor.assign(size, 0.0);
  for (const auto& [index, d2] : neighbors) {
    if (d2 <= 1e-15f) continue;  // the key point and its copies
    const std::array<float, 3> v = offset(keypoint, index);
    const auto x = static_cast<double>(dot(v, frame.x));
    const auto y = static_cast<double>(dot(v, frame.y));
    const auto z = static_cast<double>(dot(v, frame.z));
    const double r = std::sqrt(x * x + y * y + z * z);
    const double theta = std::acos(std::max(-1.0, std::min(1.0, z / r))) / pi;
    const double phi = (std::atan2(y, x) + pi) / (2.0 * pi);
    const double distance = colored ? naive_color_distance(lab_[index], lab_[keypoint]) : 0.0;
    double* out = descriptor.data();
    for (const NaivePart& part : parts) {
      vote(part, r / static_cast<double>(task_.radius), theta, phi, distance, out);
      out += part.size();
    }
  }
  double squared_norm = 0.0;
  for (const double value : descriptor) squared_norm += value * value;
  for (double& value : descriptor) value /= std::sqrt(squared_norm);
}

}  // namespace shortshot_bench::peers
