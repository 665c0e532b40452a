// shortshot/axis.hpp: one axis of a part, a compile-time fact: its cells, and what lies beyond them.
#pragma once

#include <cstdint>

#include "config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// What lies beyond the last cell of an axis: nothing (radius, elevation, signal) or the first cell (azimuth).
enum class Beyond { nothing, first_cell };

/// What positions below zero mean, by as much as a cell: there are none, the rest of the first cell (logarithmic
/// shells), or no place on this axis at all (the azimuth of a point on the frame's z axis, by SHOT's convention).
enum class BelowZero { never, first_cell, nowhere };

/// One axis of a part: its number of cells, the distance of two neighbouring cells in the descriptor, and its ends.
/// Positions along it are fixed-point numbers of cells with `Bits` bits behind the point.
template <int Cells, int Stride, Beyond End, int Bits, BelowZero Below = BelowZero::never>
struct Axis {
  static constexpr int cells = Cells;
  static constexpr int stride = Stride;
  static constexpr Beyond end = End;
  static constexpr int bits = Bits;
  static constexpr float one = static_cast<float>(std::int32_t{1} << Bits);  ///< a whole cell
  static constexpr BelowZero below_zero = Below;
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
