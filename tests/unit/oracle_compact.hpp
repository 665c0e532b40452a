// A naive oracle of the compact descriptors: soft votes, means, roots and lengths as their formulas say, in double
// precision. It shares no code with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "oracle.hpp"

namespace oracle::compact {

/// Shares of a place `t` (in cells) among the cells of an axis: they sum up to 1.
inline std::vector<double> soft(double t, int cells, bool around = false) {
  std::vector<double> shares(static_cast<std::size_t>(cells), 0.0);
  const int cell = std::min(cells - 1, std::max(0, static_cast<int>(std::floor(t))));
  const double f = t - cell;
  const double own = f <= 0.5 ? f + 0.5 : 1.5 - f;
  int other = f <= 0.5 ? cell - 1 : cell + 1;
  if (around) other = (other + cells) % cells;
  if (other < 0 || other >= cells) other = cell;
  shares[static_cast<std::size_t>(cell)] += own;
  shares[static_cast<std::size_t>(other)] += 1.0 - own;
  return shares;
}

/// One neighbor in the frame: distance over R, height as depth below R / 2, turns from -x, and its color's differences
/// from the mean of all.
struct Seen {
  double u, e, a;
  std::array<double, 3> d;  // L, a, b
};

struct Grid {
  int radial, elevation, azimuth;
};

inline std::vector<double> in_cells(const Seen& p, const Grid& grid) {
  const auto u = soft(grid.radial * p.u, grid.radial);
  const auto e = soft(grid.elevation * p.e, grid.elevation);
  const auto a = soft(grid.azimuth * p.a, grid.azimuth, true);
  std::vector<double> shares;
  for (const double in_a : a) {
    for (const double in_e : e) {
      for (const double in_u : u) shares.push_back(in_u * in_e * in_a);
    }
  }
  return shares;
}

inline std::vector<Seen> seen(const std::vector<Neighbor>& all, const std::vector<std::uint8_t>& rgb,
                              const ShotFrame& frame, float radius) {
  std::array<double, 3> mean{};
  const auto color = [&](const Neighbor& n) {
    if (rgb.empty()) return std::array<double, 3>{};
    return lab({rgb[3 * n.index], rgb[3 * n.index + 1], rgb[3 * n.index + 2]}, LabRule::published);
  };
  for (const Neighbor& n : all) {
    for (std::size_t k = 0; k < 3; ++k) mean[k] += color(n)[k] / static_cast<double>(all.size());
  }
  std::vector<Seen> result;
  for (const Neighbor& n : all) {
    if (n.d2 == 0.0f) continue;
    const auto along = [&](const Vec3f& axis) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>(n.v[k]) * static_cast<double>(axis[k]);
      return sum;
    };
    const double r = static_cast<double>(radius);
    const double pi = std::acos(-1.0);
    Seen p{std::sqrt(static_cast<double>(n.d2)) / r, std::clamp(0.5 - along(frame.z) / r, 0.0, 0.99999),
           (std::atan2(along(frame.y), along(frame.x)) + pi) / (2.0 * pi), color(n)};
    for (std::size_t k = 0; k < 3; ++k) p.d[k] -= mean[k];
    result.push_back(p);
  }
  return result;
}

/// Roots of where the points are.
inline std::vector<double> heights(const std::vector<Seen>& points, const Grid& grid) {
  std::vector<double> sums(static_cast<std::size_t>(grid.radial * grid.elevation * grid.azimuth), 0.0);
  for (const Seen& p : points) {
    const auto shares = in_cells(p, grid);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += shares[i];
  }
  for (double& v : sums) v = std::sqrt(v / static_cast<double>(points.size()));
  return sums;
}

/// Signed roots of the means in cells of some values of each point, shrunk.
template <std::size_t Count, class Values>
std::vector<double> roots_of_means(const std::vector<Seen>& points, const Grid& grid, double floor, Values values_of) {
  const auto cells = static_cast<std::size_t>(grid.radial * grid.elevation * grid.azimuth);
  std::vector<double> votes(cells, 0.0), sums(Count * cells, 0.0);
  for (const Seen& p : points) {
    const auto shares = in_cells(p, grid);
    const std::array<double, Count> values = values_of(p);
    for (std::size_t i = 0; i < cells; ++i) {
      votes[i] += shares[i];
      for (std::size_t k = 0; k < Count; ++k) sums[Count * i + k] += shares[i] * values[k];
    }
  }
  double total = floor;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] /= votes[i / Count] + 0.3 * static_cast<double>(points.size()) / static_cast<double>(cells);
    total += std::abs(sums[i]);
  }
  for (double& m : sums) m = std::copysign(0.7 * (std::sqrt(std::abs(m) + 0.01) - 0.1) / std::sqrt(total), m);
  return sums;
}

inline std::vector<double> means(const std::vector<Seen>& points, const Grid& grid, double floor) {
  return roots_of_means<3>(points, grid, floor, [](const Seen& p) {
    return std::array<double, 3>{p.d[0] / 100.0, p.d[1] / 60.0, p.d[2] / 60.0};
  });
}

/// What lies above the mean and what lies below, apart.
inline std::vector<double> excesses(const std::vector<Seen>& points, const Grid& grid, double floor) {
  return roots_of_means<6>(points, grid, floor, [](const Seen& p) {
    const auto above = [](double d) { return std::max(0.0, d); };
    return std::array<double, 6>{above(p.d[0]) / 100.0, above(-p.d[0]) / 100.0, above(p.d[1]) / 60.0,
                                 above(-p.d[1]) / 60.0, above(p.d[2]) / 60.0,   above(-p.d[2]) / 60.0};
  });
}

/// Roots of histograms of one color difference in each ring, of length 0.866.
inline std::vector<double> colors(const std::vector<Seen>& points, int rings, std::size_t axis, int bins) {
  std::vector<double> sums(static_cast<std::size_t>(rings * bins), 0.0);
  for (const Seen& p : points) {
    const double value = std::clamp(0.5 + p.d[axis] / (axis == 0 ? 80.0 : 60.0), 0.0, 1.0);
    const auto in_ring = soft(rings * p.u, rings);
    const auto in_bin = soft(bins * value, bins);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += in_ring[i / static_cast<std::size_t>(bins)] * in_bin[i % static_cast<std::size_t>(bins)];
    }
  }
  for (double& v : sums) v = 0.866 * std::sqrt(v / static_cast<double>(points.size()));
  return sums;
}

/// Parts one after the other, to length 1.
inline std::vector<double> joined(const std::vector<std::vector<double>>& parts) {
  std::vector<double> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  const double length = std::sqrt(std::inner_product(all.begin(), all.end(), all.begin(), 0.0));
  for (double& v : all) v /= length;
  return all;
}

/// Colors in rings, along L, a and b.
inline std::vector<double> color_rings(const std::vector<Seen>& p, int rings, int bins) {
  std::vector<double> all;
  for (const std::size_t axis : {0u, 1u, 2u}) {
    const std::vector<double> one = colors(p, rings, axis, bins);
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

inline std::vector<double> shape_color95(const std::vector<Seen>& p) {
  return joined({heights(p, {2, 4, 8}), means(p, {3, 1, 8}, 1.0), color_rings(p, 3, 6)});
}
inline std::vector<double> shape_color32(const std::vector<Seen>& p) {
  return joined({means(p, {2, 1, 4}, 0.49), color_rings(p, 2, 4), heights(p, {1, 4, 4})});
}
inline std::vector<double> room_color95(const std::vector<Seen>& p) {
  return joined({heights(p, {2, 4, 8}), excesses(p, {2, 1, 8}, 1.0), color_rings(p, 2, 5)});
}
inline std::vector<double> height_shape96(const std::vector<Seen>& p) { return joined({heights(p, {3, 8, 8})}); }
inline std::vector<double> color_rings27(const std::vector<Seen>& p) { return joined({color_rings(p, 3, 6)}); }

/// A named descriptor, and what it takes to store it in four bits a value: steps in 1, and which values have signs.
struct Named {
  const char* name;
  std::vector<double> (*of)(const std::vector<Seen>&);
  std::size_t size;
  double scale;
  std::size_t signs_begin, signs_end;
};
inline constexpr Named named[] = {{"shape_color95", shape_color95, 190, 50.0, 64, 136},
                                  {"shape_color32", shape_color32, 64, 40.0, 0, 24},
                                  {"room_color95", room_color95, 190, 50.0, 0, 0},
                                  {"height_shape96", height_shape96, 192, 60.0, 0, 0},
                                  {"color_rings27", color_rings27, 54, 50.0, 0, 0}};

/// The nearest step, cut off at 0 and 15, or at -7 and 7 where values have signs (stored with 8 added); the first of
/// two values in the low half of a byte.
inline std::vector<std::uint8_t> nibbles(const Named& d, const std::vector<double>& values) {
  std::vector<std::uint8_t> bytes((values.size() + 1) / 2, std::uint8_t{0});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool has_sign = i >= d.signs_begin && i < d.signs_end;
    const auto steps = static_cast<int>(std::round(d.scale * values[i]));
    const int code = has_sign ? 8 + std::clamp(steps, -7, 7) : std::clamp(steps, 0, 15);
    bytes[i / 2] = static_cast<std::uint8_t>(bytes[i / 2] | code << (i % 2 == 0 ? 0 : 4));
  }
  return bytes;
}

/// The frame with its z axis on the side of a viewpoint.
inline ShotFrame turned_to(ShotFrame frame, const Vec3f& view) {
  const double towards = static_cast<double>(frame.z[0]) * static_cast<double>(view[0]) +
                         static_cast<double>(frame.z[1]) * static_cast<double>(view[1]) +
                         static_cast<double>(frame.z[2]) * static_cast<double>(view[2]);
  if (towards >= 0.0) return frame;
  for (std::size_t k = 0; k < 3; ++k) {
    frame.y[k] = -frame.y[k];
    frame.z[k] = -frame.z[k];
  }
  return frame;
}

}  // namespace oracle::compact
