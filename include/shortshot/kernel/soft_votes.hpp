// shortshot/kernel/soft_votes.hpp: multilinear votes for parts of compact descriptors.
//
// A point lies between the middles of two cells on each axis, and votes for both. The four cells between which it lies
// on two axes (or the four numbers that a cell of means adds up) are kept side by side, in a quad: one addition for
// four votes. Cells are so kept several times over, once for each quad they belong to, and brought together at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "accumulate.hpp"
#include "measure_signals.hpp"
#include "soft_layout.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

using Quad = float __attribute__((vector_size(16)));
using QuadSum = std::int32_t __attribute__((vector_size(16)));

/// -a where `sign` is set. (A product with -1 and the sum that follows would be fused, if harmlessly.)
inline constexpr std::int32_t sign_bit = std::numeric_limits<std::int32_t>::min();
[[nodiscard]] SHORTSHOT_INLINE Quad negated(const Quad& a, const QuadSum& signs) noexcept {
  return reinterpret_cast<Quad>(reinterpret_cast<QuadSum>(a) ^ signs);
}

/// Along one axis: the lower of the two cells, and the share of the upper one.
struct Between {
  simd::I32 lower;
  simd::F32 upper;
};

[[nodiscard]] SHORTSHOT_INLINE Between between(simd::F32 coordinate, const SoftAxis& axis) noexcept {
  using simd::all;
  const auto cells = static_cast<float>(axis.cells);
  const simd::F32 place = coordinate * all(cells) - all(0.5f);
  const simd::F32 from_first = axis.around ? place + keep(place < all(0.0f), all(cells))
                                           : simd::max(simd::min(place, all(cells - 1.0f)), all(0.0f));
  const simd::I32 lower = simd::small_min(truncate_to_int(from_first), simd::all_int(axis.lowers() - 1));
  return {lower, from_first - to_float(lower)};
}

/// What a register's neighbors have for one part, lane by lane.
template <class Part>
struct SoftLanes {
  static constexpr SoftLayout layout = soft_layout<Part>;
  static constexpr int corners = layout.corners();
  std::uint32_t quad[simd::lanes];                               // of the lower cells: its place in bytes
  float within[2][simd::lanes];                                  // shares of the upper cells
  float corner[static_cast<std::size_t>(corners)][simd::lanes];  // weights of rows of quads, in units

  SHORTSHOT_INLINE void set(const simd::F32 (&coordinates)[4], simd::F32 one) noexcept {
    simd::I32 first = simd::all_int(0);
    simd::F32 weight[static_cast<std::size_t>(corners)];
    weight[0] = one;
    unroll<layout.count>([&](auto i) {
      constexpr SoftAxis axis = layout.axes[i];
      const Between at = between(coordinates[axis.row], axis);
      first = first + simd::small_product(at.lower, simd::all_int(layout.strides[i]));
      if constexpr (i < layout.within) {
        simd::store(within[i], at.upper);
      } else {
        constexpr int known = 1 << (i - layout.within);
        unroll<known>([&](auto k) {
          weight[known + k] = weight[k] * at.upper;
          weight[k] = weight[k] - weight[known + k];
        });
      }
    });
    simd::store(quad, simd::shift_left(first, 4));
    if constexpr (corners > 1) unroll<corners>([&](auto k) { simd::store(corner[k], weight[k]); });
  }

  /// From a point's first quad to that of corner `k`.
  static constexpr int step(int k) noexcept {
    int quads = 0;
    for (int i = layout.within; i < layout.count; ++i) quads += (k >> (i - layout.within) & 1) * layout.strides[i];
    return quads;
  }
  /// Adds a quad of shares to all corners of the point in a lane.
  SHORTSHOT_INLINE void add(QuadSum* sums, std::size_t lane, const Quad& shares, float one) const noexcept {
    auto* const first = reinterpret_cast<QuadSum*>(reinterpret_cast<unsigned char*>(sums) + quad[lane]);
    unroll<corners>([&](auto k) {
      const float weight = corners == 1 ? one : corner[k][lane];
      first[step(k)] += __builtin_convertvector(shares * Quad{weight, weight, weight, weight}, QuadSum);
    });
  }
  /// The shares of the four cells within a quad.
  SHORTSHOT_INLINE Quad shares(std::size_t lane) const noexcept {
    Quad result{1.0f, 0.0f, 1.0f, 0.0f};
    if constexpr (layout.within > 0) {
      const float p = within[0][lane];
      result = result + negated(Quad{p, p, p, p}, QuadSum{sign_bit, 0, sign_bit, 0});
    }
    if constexpr (layout.within > 1) {
      const float q = within[1][lane];
      result = result * (Quad{1.0f, 1.0f, 0.0f, 0.0f} + negated(Quad{q, q, q, q}, QuadSum{sign_bit, sign_bit, 0, 0}));
    }
    return result;
  }
};

/// The numbers of a mean's cell for a register's neighbors: 1, and the values of the signals.
template <class Chunk, class... Signals, std::size_t Numbers>
SHORTSHOT_INLINE void values_of(SignalList<Signals...>, const Chunk& chunk, std::uint32_t i,
                                float (&values)[Numbers][simd::lanes]) noexcept {
  std::size_t k = 0;
  simd::store(values[0], simd::all(1.0f));
  ((simd::store(values[++k], Signals::value(simd::load(chunk.row(Chunk::template row_of<Signals>, i))))), ...);
}

/// The same of part `I` of a descriptor, and, for means, the numbers of a cell.
template <std::size_t I, class Part>
struct PartLanes : SoftLanes<Part> {
  static constexpr int numbers = Part::weight_cells > 0 ? Part::values + 1 : 0;
  float values[static_cast<std::size_t>(numbers + 1)][simd::lanes];

  template <class Chunk>
  SHORTSHOT_INLINE void set(const simd::F32 (&at)[3], const Chunk& chunk, std::uint32_t i, simd::F32 one) noexcept {
    simd::F32 coordinates[4] = {at[0], at[1], at[2], at[0]};
    if constexpr (numbers > 0) {
      values_of(typename Part::Averaged{}, chunk, i, values);
    } else if constexpr (Part::has_histogram) {
      using Signal = typename Part::Signal;
      coordinates[3] = place_in_histogram<Signal>(simd::load(chunk.row(Chunk::template row_of<Signal>, i)));
    }
    SoftLanes<Part>::set(coordinates, one);
  }
  SHORTSHOT_INLINE void add_lane(QuadSum* sums, std::size_t lane, float one) const noexcept {
    if constexpr (numbers > 0) {
      unroll<soft_layout<Part>.of_cell>([&](auto q) {
        const auto number = [&](auto k) {
          constexpr int place = 4 * decltype(q)::value + decltype(k)::value;
          if constexpr (place < numbers) return values[place][lane];
          return 0.0f;
        };
        using std::integral_constant;
        this->add(sums + q, lane,
                  Quad{number(integral_constant<int, 0>{}), number(integral_constant<int, 1>{}),
                       number(integral_constant<int, 2>{}), number(integral_constant<int, 3>{})},
                  one);
      });
    } else {
      this->add(sums, lane, this->shares(lane), one);
    }
  }
};

template <class Places, class... Parts>
struct AllLanes;
template <std::size_t... I, class... Parts>
struct AllLanes<std::index_sequence<I...>, Parts...> : PartLanes<I, Parts>... {};

/// One chunk into the quads of all parts.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void add_soft_votes(Descriptor<Voting, Parts...>, std::index_sequence<I...> places,
                                             const Chunk& chunk, float one, QuadSum* sums) noexcept {
  using D = Descriptor<Voting, Parts...>;
  AllLanes<decltype(places), Parts...> all;
  for (std::uint32_t i = 0; i < chunk.size; i += simd::lanes) {
    const std::size_t count = chunk.size - i < simd::lanes ? chunk.size - i : simd::lanes;
    const simd::F32 at[3] = {simd::load(chunk.row(0, i)), simd::load(chunk.row(1, i)), simd::load(chunk.row(2, i))};
    (static_cast<PartLanes<I, Parts>&>(all).set(at, chunk, i, simd::all(one)), ...);
    for (std::size_t lane = 0; lane < count; ++lane) {
      (static_cast<const PartLanes<I, Parts>&>(all).add_lane(sums + soft_quads(D{}, static_cast<int>(I)), lane, one),
       ...);
    }
  }
}

/// Adds a part's quads to its cells, axis by axis from the last one on. `place`: of the lower cells; `steps`: from
/// there to the upper cells within a quad.
template <class Part, int Axes>
SHORTSHOT_INLINE void gather_quads(const QuadSum* sums, int place, const int (&steps)[2], float* weights,
                                   float* values) noexcept {
  constexpr SoftLayout layout = soft_layout<Part>;
  if constexpr (Axes > 0) {
    constexpr int i = Axes - 1;
    constexpr SoftAxis axis = layout.axes[i];
    constexpr int size = i < layout.within ? axis.lowers() : axis.cells + (axis.around ? 1 : 0);
    for (int k = 0; k < size; ++k, sums += layout.strides[i]) {
      const int upper = k + 1 == axis.cells ? 0 : k + 1;
      const int first = (k == axis.cells ? 0 : k) * axis.stride;
      int further[2] = {steps[0], steps[1]};
      if constexpr (i < layout.within) further[i] = upper * axis.stride - first;
      gather_quads<Part, i>(sums, place + first, further, weights, values);
    }
  } else if constexpr (Part::weight_cells > 0) {
    add_bits(weights + place / Part::values, sums[0][0]);
    unroll<Part::values>([&](auto k) { add_bits(values + place + k, sums[(k + 1) / 4][(k + 1) % 4]); });
  } else {
    const QuadSum sum = *sums;
    add_bits(values + place, sum[0]);
    if constexpr (layout.within > 0) add_bits(values + place + steps[0], sum[1]);
    if constexpr (layout.within > 1) {
      add_bits(values + place + steps[1], sum[2]);
      add_bits(values + place + steps[1] + steps[0], sum[3]);
    }
  }
}

template <class Voting, class... Parts, std::size_t... I>
inline void gather_all_quads(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const QuadSum* sums,
                             float* weights, float* values) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const int none[2] = {};
  (gather_quads<Parts, soft_layout<Parts>.count>(sums + soft_quads(D{}, static_cast<int>(I)), 0, none,
                                                 weights + D::weight_offset(I), values + D::offset(I)),
   ...);
}

template <class Voting, class... Parts>
constexpr std::size_t soft_lanes_bytes(Descriptor<Voting, Parts...>) noexcept {
  return sizeof(AllLanes<std::make_index_sequence<sizeof...(Parts)>, Parts...>);
}

/// Bytes of a chunk, of quads, and of a register's lanes.
template <class D, std::uint32_t ChunkSize>
constexpr std::size_t soft_scratch_bytes() noexcept {
  return sizeof(Chunk<typename D::Signals, ChunkSize>) + sizeof(QuadSum) * static_cast<std::size_t>(quads_of<D>()) +
         soft_lanes_bytes(D{});
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
