// A naive oracle: neighbors, SHOT frame, CIELAB and descriptors written from their definitions, in double precision
// where the definitions do not say float. It shares no code with the library and is slow on purpose.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace oracle {

using Vec3f = std::array<float, 3>;
using Bytes3 = std::array<std::uint8_t, 3>;

struct Neighbor {
  std::size_t index;
  float d2;
  Vec3f v;  // point - key point
};

/// The ball, strictly: float d2 = (dx*dx + dy*dy) + dz*dz < radius_squared. By d2, ties by index.
inline std::vector<Neighbor> neighbors(const std::vector<float>& xyz, const Vec3f& center, float radius_squared) {
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3f v{xyz[3 * i] - center[0], xyz[3 * i + 1] - center[1], xyz[3 * i + 2] - center[2]};
    const float d2 = (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2];
    if (d2 < radius_squared) found.push_back({i, d2, v});
  }
  std::sort(found.begin(), found.end(),
            [](const Neighbor& a, const Neighbor& b) { return a.d2 != b.d2 ? a.d2 < b.d2 : a.index < b.index; });
  return found;
}

struct ShotFrame {
  bool exists = false;  // five neighbors besides the key point and its copies
  bool clear = false;   // no vote hangs on a rounding and no two principal axes are close
  Vec3f x{}, y{}, z{};
};

/// Of three axes that are given, three floats each.
inline ShotFrame given_frame(const float* x, const float* y, const float* z) {
  return {true, true, {x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}};
}

namespace detail {

/// Turns the axis as the vote says; false if neighbors in the axis' normal plane could turn the result.
inline bool vote(const std::vector<Eigen::Vector3d>& v, double radius, Eigen::Vector3d& axis) {
  const auto n = static_cast<long>(v.size());
  long plus = 0;
  long close = 0;
  for (const Eigen::Vector3d& each : v) {
    plus += each.dot(axis) >= 0.0 ? 1 : 0;
    close += std::abs(each.dot(axis)) < 1e-5 * radius ? 1 : 0;
  }
  bool keep = 2 * plus > n;
  if (2 * plus == n) {
    int middle = 0;
    for (long k = n / 2 - 2; k <= n / 2 + 2; ++k) middle += v[static_cast<std::size_t>(k)].dot(axis) > 0.0 ? 1 : 0;
    keep = middle >= 3;
  }
  if (!keep) axis = -axis;
  return close == 0 || std::labs(2 * plus - n) > 2 * close;
}

}  // namespace detail

/// SHOT's frame of sorted neighbors gathered with this radius.
inline ShotFrame shot_frame(const std::vector<Neighbor>& sorted, double radius) {
  std::vector<Eigen::Vector3d> v;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double weights = 0.0;
  for (const Neighbor& n : sorted) {
    const Eigen::Vector3d each(static_cast<double>(n.v[0]), static_cast<double>(n.v[1]), static_cast<double>(n.v[2]));
    if (each.isZero(0.0)) continue;
    const double weight = radius - std::sqrt(static_cast<double>(n.d2));
    v.push_back(each);
    scatter += weight * each * each.transpose();
    weights += weight;
  }
  ShotFrame frame;
  if (v.size() < 5) return frame;
  frame.exists = true;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter / weights);
  const Eigen::Vector3d values = solver.eigenvalues();
  Eigen::Vector3d x = solver.eigenvectors().col(2);
  Eigen::Vector3d z = solver.eigenvectors().col(0);
  const bool x_clear = detail::vote(v, radius, x);
  const bool z_clear = detail::vote(v, radius, z);
  // An axis turns by the matrix' relative rounding over the relative gap of its eigenvalues.
  const double gap = std::min(values[2] - values[1], values[1] - values[0]) / values[2];
  frame.clear = x_clear && z_clear && gap > 3e-3;
  for (int k = 0; k < 3; ++k) {
    frame.x[static_cast<std::size_t>(k)] = static_cast<float>(x[k]);
    frame.z[static_cast<std::size_t>(k)] = static_cast<float>(z[k]);
  }
  frame.y = {frame.z[1] * frame.x[2] - frame.z[2] * frame.x[1], frame.z[2] * frame.x[0] - frame.z[0] * frame.x[2],
             frame.z[0] * frame.x[1] - frame.z[1] * frame.x[0]};
  return frame;
}

enum class LabRule { published, pcl };

/// CIELAB by the published tables: 256 entries for sRGB, 4,000 for the root, both of float, the second truncated.
/// White has index 4,000, beyond the published table: defined here as f(1).
inline std::array<double, 3> lab(const Bytes3& rgb, LabRule rule) {
  const auto linear = [](std::uint8_t byte) {
    const float c = static_cast<float>(byte) / 255.0f;
    const auto base = static_cast<double>((c + 0.055f) / 1.055f);
    return c > 0.04045f ? static_cast<float>(std::pow(base, static_cast<double>(2.4f))) : c / 12.92f;
  };
  const auto root = [rule](float ratio) {
    const double t = static_cast<double>(static_cast<float>(static_cast<int>(ratio * 4000.0f)) / 4000.0f);
    const double slope = rule == LabRule::published ? 7.787 : 7.87;
    const double exponent = rule == LabRule::published ? 0.3333 : 1.0 / 3.0;
    return t > 0.008856 ? std::pow(t, exponent) : slope * t + 16.0 / 116.0;
  };
  const float r = linear(rgb[0]);
  const float g = linear(rgb[1]);
  const float b = linear(rgb[2]);
  const double fx = root((r * 0.412453f + g * 0.357580f + b * 0.180423f) / 0.95047f);
  const double fy = root(r * 0.212671f + g * 0.715160f + b * 0.072169f);
  const double fz = root((r * 0.019334f + g * 0.119193f + b * 0.950227f) / 1.08883f);
  const auto clamped = [](double value) { return std::max(-120.0, std::min(120.0, value)); };
  return {std::min(100.0, 116.0 * fy - 16.0), clamped(500.0 * (fx - fy)), clamped(200.0 * (fy - fz))};
}

inline double color_distance(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  const double chroma = (std::abs(p[1] - q[1]) / 120.0 + std::abs(p[2] - q[2]) / 120.0) / 2.0;
  return std::min(1.0, (std::abs(p[0] - q[0]) / 100.0 + chroma) / 3.0);
}

enum class Voting { published, additive, hard, multilinear };

struct Part {
  int radial, elevation, azimuth;
  int bins = 0;  // 0: no histogram and no color
};

struct Config {
  Voting voting = Voting::published;
  std::vector<Part> parts;
  LabRule lab_rule = LabRule::published;
  double log_ratio = 0.0;  // 0: linear shells; else the innermost one ends at this part of the radius
};

struct Description {
  std::vector<double> values;  // L2 norm 1, but for those of votes()
  double border = 1.0;         // smallest distance, in cells, of any neighbor from a place where the voting rule jumps
};

namespace detail {

struct AxisPosition {
  double raw;
  int cells;
  bool wraps;
  bool exact = false;  // the same number in any arithmetic: no rounding decides on which side of a border it lies
  int bin = 0;
  int partner = -1;  // -1: none
  double weight = 1.0;

  void split(Voting voting) {
    bin = std::max(0, std::min(cells - 1, static_cast<int>(raw)));
    if (voting == Voting::hard) return;
    const double f = voting == Voting::multilinear ? raw - bin : raw - std::trunc(raw);
    weight = f <= 0.5 ? f + 0.5 : 1.5 - f;
    partner = f <= 0.5 ? bin - 1 : bin + 1;
    if (wraps) partner = (partner + cells) % cells;
    if (partner < 0 || partner >= cells || partner == bin) partner = -1;
    if (voting == Voting::multilinear && partner == -1) weight = 1.0;
  }
  /// Additive votes jump where the cell or the partner changes, hard ones where the cell changes; linear ones nowhere.
  [[nodiscard]] double border(Voting voting) const {
    if (voting == Voting::multilinear || exact) return 1.0;
    const double period = voting == Voting::hard ? 1.0 : 0.5;
    return std::abs(raw - period * std::round(raw / period));
  }
};

inline void vote(const Part& part, Voting voting, const std::vector<AxisPosition>& axes, double* out) {
  const auto cell = [&](const std::vector<int>& bins) -> double& {
    const int grid_cell = bins[0] + part.radial * (bins[1] + part.elevation * bins[2]);
    return out[axes.size() == 4 ? bins[3] + part.bins * grid_cell : grid_cell];
  };
  std::vector<int> primary;
  for (const AxisPosition& axis : axes) primary.push_back(axis.bin);
  if (voting == Voting::hard) {
    cell(primary) += 1.0;
  } else if (voting == Voting::multilinear) {
    for (unsigned corner = 0; corner < (1u << axes.size()); ++corner) {
      std::vector<int> bins = primary;
      double weight = 1.0;
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const bool to_partner = (corner >> k & 1u) != 0;
        weight *= to_partner ? 1.0 - axes[k].weight : axes[k].weight;
        if (to_partner && axes[k].partner >= 0) bins[k] = axes[k].partner;
      }
      cell(bins) += weight;
    }
  } else {
    double sum = 0.0;
    for (const AxisPosition& axis : axes) sum += axis.weight;
    cell(primary) += sum;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      if (axes[k].partner < 0) continue;
      double weight = sum - axes[k].weight + (1.0 - axes[k].weight);
      if (k == 3 && voting == Voting::published) weight += 1.0 - 2.0 * axes[0].weight;  // the published quirk
      std::vector<int> bins = primary;
      bins[k] = axes[k].partner;
      cell(bins) += weight;
    }
  }
}

}  // namespace detail

/// Positions as they are.
struct AsTheyAre {
  double operator()(int, double raw) const { return raw; }
};

/// The sums of votes of sorted neighbors, not normalized. `adjust(axis, raw)` gives the position to take in place of
/// `raw`, in cells: part by part, neighbor by neighbor, axis by axis (0 to 3: radius, elevation, azimuth, bin).
template <class Adjust = AsTheyAre>
Description votes(const std::vector<Neighbor>& sorted, const std::vector<std::uint8_t>& rgb, const Bytes3& reference,
                  const ShotFrame& frame, float radius, const Config& config, Adjust adjust = {}) {
  Description result;
  for (const Part& part : config.parts) {
    const int size = part.radial * part.elevation * part.azimuth * std::max(1, part.bins);
    const std::size_t offset = result.values.size();
    result.values.resize(offset + static_cast<std::size_t>(size), 0.0);
    for (const Neighbor& n : sorted) {
      if (n.d2 <= 1e-15f) continue;  // the key point and its copies
      const auto along = [&n](const Vec3f& axis) {
        const float sum = (n.v[0] * axis[0] + n.v[2] * axis[2]) + (n.v[1] * axis[1] + 0.0f);  // never -0
        return static_cast<double>(sum);
      };
      const double x = along(frame.x);
      const double y = along(frame.y);
      const double z = along(frame.z);
      const double r = std::sqrt(x * x + y * y + z * z);
      const double u = r / static_cast<double>(radius);
      const double pi = std::acos(-1.0);
      const double m = config.log_ratio;
      const auto rounded = [](double raw) { return static_cast<double>(static_cast<float>(raw)); };
      const double shell =
          m > 0.0 ? (part.radial - 1) * (std::log(u) - std::log(m)) / -std::log(m) + 1.0 : part.radial * u;
      std::vector<detail::AxisPosition> axes{
          {rounded(shell), part.radial, false, m > 0.0 && part.radial == 1},
          {rounded(part.elevation * std::acos(std::max(-1.0, std::min(1.0, z / r))) / pi), part.elevation, false},
          {rounded(part.azimuth * (std::atan2(y, x) + pi) / (2.0 * pi)), part.azimuth, true}};
      if (part.bins > 0) {
        const Bytes3 own{rgb[3 * n.index], rgb[3 * n.index + 1], rgb[3 * n.index + 2]};
        const double distance = color_distance(lab(own, config.lab_rule), lab(reference, config.lab_rule));
        axes.push_back({rounded(part.bins * distance), part.bins, false, distance == 0.0});
      }
      for (std::size_t k = 0; k < axes.size(); ++k) {
        detail::AxisPosition& axis = axes[k];
        axis.raw = adjust(static_cast<int>(k), axis.raw);
        axis.split(config.voting);
        result.border = std::min(result.border, axis.border(config.voting));
      }
      detail::vote(part, config.voting, axes, result.values.data() + offset);
    }
  }
  return result;
}

inline double squared_norm(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// The descriptor of sorted neighbors. `rgb` may be empty if no part has bins.
inline Description describe(const std::vector<Neighbor>& sorted, const std::vector<std::uint8_t>& rgb,
                            const Bytes3& reference, const ShotFrame& frame, float radius, const Config& config) {
  Description result = votes(sorted, rgb, reference, frame, radius, config);
  const double norm = std::sqrt(squared_norm(result.values));
  for (double& value : result.values) value /= norm;
  return result;
}

}  // namespace oracle
