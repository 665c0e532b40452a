// shortshot/descriptor/axis.hpp: one axis of a part: its cells, and what lies beyond them.
#ifndef SHORTSHOT_DESCRIPTOR_AXIS_HPP
#define SHORTSHOT_DESCRIPTOR_AXIS_HPP

#include <cstdint>

#include "../config.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// What lies beyond the last cell of an axis: nothing (radius, elevation, signal) or the first cell (azimuth).
enum class Beyond : std::uint8_t { nothing, first_cell };

/// A position on an axis counts cells from the axis' beginning. What is one below zero?
/// never: there is none. first_cell: a place in the first cell; logarithmic shells have no beginning, and the innermost
/// one holds whatever is closer. nowhere: no place on this axis; by SHOT's convention a point on the frame's z axis has
/// no azimuth.
enum class BelowZero : std::uint8_t { never, first_cell, nowhere };

/// One axis of a part: its number of cells, the distance of two neighboring cells in the descriptor, and its ends.
/// Positions along it are fixed-point numbers of cells with `bits` bits behind the point. A value and not a type: where
/// code is inlined for speed it is as constant, and where it shall be small all axes share one function.
struct Axis {
  std::int32_t cells;       ///< number of them, from 1 on
  std::int32_t stride;      ///< values from one cell to the next
  Beyond end;               ///< what lies beyond the last cell
  BelowZero below_zero;     ///< what a position below zero is
  std::int8_t bits;         ///< of a position behind the point
  bool reaches_end = true;  ///< may a position be the very end, the upper border of the last cell?

  /// A whole cell, and the whole axis.
  [[nodiscard, gnu::always_inline]] constexpr float one() const noexcept {
    return static_cast<float>(std::int32_t{1} << bits);
  }
  [[nodiscard, gnu::always_inline]] constexpr float length() const noexcept {
    return static_cast<float>(cells) * one();
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

#endif  // SHORTSHOT_DESCRIPTOR_AXIS_HPP
