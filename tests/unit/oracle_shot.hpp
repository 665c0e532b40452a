// A naive oracle of SHOT and CSHOT, written from their published definition alone, in double precision where that does
// not say float. Grids other than the published 2 x 2 x 8 cells follow the same rules. It shares no code with the
// library and is slow on purpose.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "oracle.hpp"

namespace oracle {

struct ShotPart {
  int radial, elevation, azimuth;
  int bins;             // as PCL counts them: a cell has one bin more
  bool colors = false;  // the signal is the color distance; else the cosine between normal and z
};

struct ShotConfig {
  std::vector<ShotPart> parts;
  bool wrap = false;       // PCL's modulus: what lies above the center of the last bin but one votes for bin 0
  bool pcl_white = false;  // PCL reads white beyond the end of its table
  double log_ratio = 0.0;  // as in Config; what is closer than the innermost shell's lower end counts as lying there
};

struct ShotDescription {
  bool exists = false;         // five neighbors, the key point and its copies among them, and one with a normal
  std::vector<double> values;  // L2 norm 1
  double border = 1.0;         // smallest distance, in cells, of any neighbor from a place where its votes jump
};

/// How SHOT shares a point among the cells along one axis: 1 - |q| for its own, |q| for the nearer neighboring one.
struct ShotShare {
  int cell = 0;
  int partner = -1;  // -1: none
  double q = 0.0;    // distance from the middle of the cell, in cells
  double border = 1.0;

  [[nodiscard]] double own() const { return 1.0 - std::abs(q); }
};

namespace detail {

/// A position in cells. Each cell ends with its upper border. One cell alone has no neighbor, around a circle either.
inline ShotShare shot_share(double raw, int cells, bool wraps) {
  const double nearest = std::round(raw);
  if (std::abs(raw - nearest) < 1e-12) raw = nearest;  // angles in double miss exact borders by a few ulps
  int cell = static_cast<int>(std::ceil(raw)) - 1;
  if (!wraps) cell = std::max(0, std::min(cells - 1, cell));
  ShotShare share;
  share.q = std::max(-0.5, std::min(0.5, raw - cell - 0.5));
  share.partner = share.q > 0.0 ? cell + 1 : cell - 1;
  if (wraps) share.partner = (share.partner + 2 * cells) % cells;
  if (share.partner >= cells || cells == 1) share.partner = -1;
  share.cell = (cell + cells) % cells;
  if (wraps || (nearest > 0.0 && nearest < cells)) share.border = std::abs(raw - nearest);
  return share;
}

/// A value in bins whose centers are 0, 1, ... bins. It jumps half-way between them.
inline ShotShare shot_bin(double value, int bins, bool wrap) {
  ShotShare share;
  share.cell = static_cast<int>(std::floor(value + 0.5));
  share.q = value - share.cell;
  share.border = 0.5 - std::abs(share.q);
  if (share.q == 0.0) return share;
  share.partner = share.q > 0.0 ? share.cell + 1 : share.cell - 1;
  if (wrap) share.partner = (share.partner + bins) % bins;
  return share;
}

inline std::array<double, 3> shot_lab(const Bytes3& rgb, const ShotConfig& config) {
  if (config.pcl_white && rgb == Bytes3{255, 255, 255}) return {-16.0, 120.0, -120.0};
  return lab(rgb, LabRule::pcl);
}

/// The float dot products of the definition, in its order.
inline double shot_dot(const Vec3f& a, const Vec3f& b) {
  const double dot = static_cast<double>((a[0] * b[0] + a[2] * b[2]) + a[1] * b[1]);
  return std::abs(dot) < 1e-30 ? 0.0 : dot;
}

/// Radius, elevation (upwards from -z) and azimuth of a neighbor in a part.
struct ShotPlace {
  ShotShare axes[3];

  template <class Adjust>
  ShotPlace(const Neighbor& n, const ShotFrame& frame, double radius, const ShotPart& part, double log_ratio,
            Adjust& adjust) {
    const double pi = std::acos(-1.0);
    const double x = shot_dot(n.v, frame.x);
    const double y = shot_dot(n.v, frame.y);
    const double distance = std::sqrt(static_cast<double>(n.d2));
    const double angle = std::acos(std::max(-1.0, std::min(1.0, shot_dot(n.v, frame.z) / distance)));
    const double log_shell = (part.radial - 1) * (1.0 - std::log(distance / radius) / std::log(log_ratio)) + 1.0;
    const double shell = log_ratio > 0.0 ? std::max(0.0, log_shell) : part.radial * distance / radius;
    axes[0] = shot_share(adjust(0, shell), part.radial, false);
    axes[1] = shot_share(adjust(1, part.elevation * (pi - angle) / pi), part.elevation, false);
    axes[2] = shot_share(adjust(2, part.azimuth * (std::atan2(y, x) + pi) / (2.0 * pi)), part.azimuth, true);
    if (x == 0.0 && y == 0.0) {  // the first sector, and no vote for it or its neighbors
      axes[2] = {};
      axes[2].q = 1.0;
    }
  }
};

/// The additive votes of one neighbor: what is its own adds up in one bin of one cell, each partner gets |q| alone.
inline void shot_vote(const ShotPart& part, const ShotPlace& place, const ShotShare& bin, double* out) {
  const auto value = [&](int r, int e, int a, int b) -> double& {
    return out[b + (part.bins + 1) * (e + part.elevation * (r + part.radial * a))];
  };
  const ShotShare& r = place.axes[0];
  const ShotShare& e = place.axes[1];
  const ShotShare& a = place.axes[2];
  value(r.cell, e.cell, a.cell, bin.cell) += r.own() + e.own() + a.own() + bin.own();
  if (r.partner >= 0) value(r.partner, e.cell, a.cell, bin.cell) += std::abs(r.q);
  if (e.partner >= 0) value(r.cell, e.partner, a.cell, bin.cell) += std::abs(e.q);
  if (a.partner >= 0) value(r.cell, e.cell, a.partner, bin.cell) += std::abs(a.q);
  if (bin.partner >= 0) value(r.cell, e.cell, a.cell, bin.partner) += std::abs(bin.q);
}

}  // namespace detail

/// The sums of votes of sorted neighbors, not normalized; `adjust` as for votes().
template <class Adjust = AsTheyAre>
ShotDescription shot_votes(const std::vector<Neighbor>& sorted, const std::vector<float>& normals,
                           const std::vector<std::uint8_t>& rgb, const Bytes3& reference, const ShotFrame& frame,
                           double radius, const ShotConfig& config, Adjust adjust = {}) {
  ShotDescription result;
  for (const ShotPart& part : config.parts) {
    const std::size_t offset = result.values.size();
    const int size = part.radial * part.elevation * part.azimuth * (part.bins + 1);
    result.values.resize(offset + static_cast<std::size_t>(size), 0.0);
    for (const Neighbor& n : sorted) {
      const Vec3f normal{normals[3 * n.index], normals[3 * n.index + 1], normals[3 * n.index + 2]};
      if (!std::isfinite(normal[0]) || !std::isfinite(normal[1]) || !std::isfinite(normal[2])) continue;
      if (std::sqrt(static_cast<double>(n.d2)) < 1e-15) continue;  // the key point and its copies
      double signal = 0.0;
      if (part.colors) {
        const Bytes3 own{rgb[3 * n.index], rgb[3 * n.index + 1], rgb[3 * n.index + 2]};
        signal = color_distance(detail::shot_lab(own, config), detail::shot_lab(reference, config));
      } else {
        signal = (1.0 + std::max(-1.0, std::min(1.0, detail::shot_dot(normal, frame.z)))) / 2.0;
      }
      const detail::ShotPlace place(n, frame, radius, part, config.log_ratio, adjust);
      const ShotShare bin = detail::shot_bin(adjust(3, signal * part.bins), part.bins, config.wrap);
      detail::shot_vote(part, place, bin, result.values.data() + offset);
      for (const ShotShare& axis : place.axes) result.border = std::min(result.border, axis.border);
      result.border = std::min(result.border, bin.border);
    }
  }
  return result;
}

/// The descriptor of sorted neighbors. `normals` holds three floats for each point of the cloud, not finite where it
/// has none; `rgb` may be empty if no part has colors.
inline ShotDescription describe_shot(const std::vector<Neighbor>& sorted, const std::vector<float>& normals,
                                     const std::vector<std::uint8_t>& rgb, const Bytes3& reference,
                                     const ShotFrame& frame, double radius, const ShotConfig& config) {
  ShotDescription result = shot_votes(sorted, normals, rgb, reference, frame, radius, config);
  const double norm = std::sqrt(squared_norm(result.values));
  result.exists = sorted.size() >= 5 && norm > 0.0;
  for (double& value : result.values) value = result.exists ? value / norm : 0.0;
  return result;
}

}  // namespace oracle
