// shortshot/kernel/chunk.hpp: the neighbors that go through the kernel together.
#ifndef SHORTSHOT_KERNEL_CHUNK_HPP
#define SHORTSHOT_KERNEL_CHUNK_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "../descriptor/signals.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A chunk of neighbors in the frame's spherical coordinates, with the values of a descriptor's Signals (a SignalList).
/// Only those that are described: passes need no masks.
template <class Signals, std::uint32_t Room>
struct Chunk {
  static_assert(Room >= simd::lanes && Room <= 1024 && Room % simd::lanes == 0,
                "ChunkSize supports multiples of simd::lanes up to 1024: registers do not reach beyond its end");
  static constexpr std::uint32_t room = Room;
  /// Passes go through a register at a time, or two where the room is for that.
  static constexpr std::uint32_t step =
      Room % (2 * simd::lanes) == 0 && simd::lanes > 1 ? 2 * simd::lanes : simd::lanes;
  static constexpr int rows_of_place = 3;
  static constexpr int signals = Signals::size;
  std::uint32_t size;
  std::uint32_t index[Room];                           ///< in the cloud
  float rows[(rows_of_place + Signals::size) * Room];  // one array, so that one register holds the place in all

  /// From neighbor `i` on, all 0..1: row 0, the distance over the radius; 1, the angle from +z over pi; 2, the angle
  /// from -x, counter-clockwise, in turns, or below 0 where a convention gives none; then a row for each signal.
  [[nodiscard]] const float* row(int k, std::uint32_t i) const noexcept {
    return rows + i + static_cast<std::size_t>(k) * Room;
  }
  template <class Signal>
  static constexpr int row_of = rows_of_place + place_in<Signal>(Signals{});
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_CHUNK_HPP
