// shortshot/kernel/soft_shares.hpp: how points are shared among the cells around them where votes are soft. A point
// lies between the middles of two cells on each axis, and votes for both.
#ifndef SHORTSHOT_KERNEL_SOFT_SHARES_HPP
#define SHORTSHOT_KERNEL_SOFT_SHARES_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "soft_layout.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Along one axis: the lower of the two cells, and the share of the upper one.
struct Between {
  simd::I32 lower;
  simd::F32 upper;
};

[[nodiscard]] SHORTSHOT_INLINE Between between(simd::F32 coordinate, const SoftAxis& axis) noexcept {
  using simd::all;
  const auto cells = static_cast<float>(axis.cells);
  const simd::F32 place = coordinate * all(cells) - all(0.5f);
  const simd::F32 from_first = axis.is_around() ? place + keep(place < all(0.0f), all(cells))
                                                : simd::max(simd::min(place, all(cells - 1.0f)), all(0.0f));
  const simd::I32 lower = simd::small_min(truncate_to_int(from_first), simd::all_int(axis.lowers() - 1));
  return {lower, from_first - to_float(lower)};
}

/// Where in its histogram a measured value lies; between() cuts off what lies beyond.
template <class Signal>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 soft_place(simd::F32 measured) noexcept {
  if constexpr (Signal::is_signed) return Signal::place(measured);
  return measured;
}

/// Where the points of a register lie on all axes of a descriptor.
template <class D>
struct SoftPoints {
  static constexpr auto places = soft_places(D{});
  simd::F32 unit;  ///< what a point counts for
  simd::F32 coordinates[static_cast<std::size_t>(3 + D::parts)];
  Between between[static_cast<std::size_t>(places.count)];

  template <class... Parts, class Chunk>
  SHORTSHOT_INLINE void locate(Descriptor<typename D::Voting, Parts...>, const Chunk& chunk, std::uint32_t i) noexcept {
    unroll<3>([&](auto k) { coordinates[k] = simd::load(chunk.row(k, i)); });
    int part = 3;
    (locate_signal<Parts>(chunk, i, coordinates[part++]), ...);
    unroll<places.count>([&](auto k) {
      constexpr SoftAxis axis = places.axes[k];
      between[k] = detail::between(coordinates[axis.row], axis);
    });
  }

 private:
  template <class Part, class Chunk>
  SHORTSHOT_INLINE static void locate_signal(const Chunk& chunk, std::uint32_t i, simd::F32& place) noexcept {
    if constexpr (Part::weight_cells == 0) {
      using Signal = typename Part::Signal;
      if constexpr (Part::has_histogram) {
        place = soft_place<Signal>(simd::load(chunk.row(Chunk::template row_of<Signal>, i)));
      }
    }
  }
};

/// The values of signals for a register's neighbors.
template <class Chunk, class... Signals>
SHORTSHOT_INLINE void values_of(SignalList<Signals...>, const Chunk& chunk, std::uint32_t i,
                                simd::F32* values) noexcept {
  ((*values++ = Signals::value(simd::load(chunk.row(Chunk::template row_of<Signals>, i)))), ...);
}

/// How the points of a register are shared among the cells around them, for part `I` of a descriptor.
template <class D, std::size_t I, class Part>
struct SoftShares {
  static constexpr SoftLayout layout = soft_layout<Part>;
  static constexpr int count = 1 << layout.count;
  static constexpr int numbers = Part::weight_cells > 0 ? Part::values + 1 : 0;  ///< of a mean's cell: votes, sums
  simd::F32 weight[static_cast<std::size_t>(count)];
  simd::F32 measured[static_cast<std::size_t>(numbers == 0 ? 1 : Part::values)];

  /// The axis that bit `n` of a weight's place stands for; those within quads are the last ones.
  static constexpr int axis_of(int n) noexcept { return (n + layout.within) % layout.count; }
  template <int Axis>
  [[nodiscard]] SHORTSHOT_INLINE static const Between& between(const SoftPoints<D>& points) noexcept {
    return points.between[SoftPoints<D>::places.find(layout.axes[Axis].of_part(static_cast<int>(I)))];
  }

  /// Each axis parts all weights in two.
  template <class Chunk>
  SHORTSHOT_INLINE void share(const SoftPoints<D>& points, const Chunk& chunk, std::uint32_t i) noexcept {
    weight[0] = points.unit;
    unroll<layout.count>([&](auto n) {
      constexpr int known = 1 << n;
      const simd::F32 upper = between<axis_of(n)>(points).upper;
      unroll<known>([&](auto k) {
        weight[known + k] = weight[k] * upper;
        weight[k] = weight[k] - weight[known + k];
      });
    });
    if constexpr (numbers > 0) values_of(typename Part::Averaged{}, chunk, i, measured);
  }
  /// Votes in units: those of the cell, and for means times the value of signal `K` - 1.
  template <int Cell, int K = 0>
  [[nodiscard]] SHORTSHOT_INLINE simd::I32 votes() const noexcept {
    if constexpr (K > 0) return truncated_product(weight[Cell], measured[K - 1]);
    return truncate_to_int(weight[Cell]);
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_SHARES_HPP
