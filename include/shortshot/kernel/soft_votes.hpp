// shortshot/kernel/soft_votes.hpp: multilinear votes for parts of compact descriptors, a register of neighbors at a
// time.
//
// The four cells between which a point lies on two axes (or the four numbers that a cell of means adds up) are kept
// side by side, in a quad: one addition for four votes. Cells are so kept several times over, once for each quad they
// belong to, and brought together at the end. And every lane has quads of its own: neighbors that follow each other lie
// in the same cells, where each addition would wait for the one before.
#ifndef SHORTSHOT_KERNEL_SOFT_VOTES_HPP
#define SHORTSHOT_KERNEL_SOFT_VOTES_HPP

#include <cstddef>
#include <cstdint>
#include <utility>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "accumulate.hpp"
#include "soft_layout.hpp"
#include "soft_shares.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

using simd::Quad;

/// Votes of a register for part `I` of a descriptor, to the quads of all parts.
template <class D, std::size_t I, class Part>
struct SoftVotes : SoftShares<D, I, Part> {
  using Shares = SoftShares<D, I, Part>;
  using Shares::layout, Shares::numbers;
  static constexpr int corners = layout.corners();

  SHORTSHOT_INLINE void add(const SoftPoints<D>& points, Quad* sums) const noexcept {
    constexpr int lanes = static_cast<int>(simd::lanes);
    simd::I32 first = simd::all_int(0);  // in bytes
    unroll<layout.count>([&](auto i) {
      constexpr int bytes = layout.strides[i] * static_cast<int>(sizeof(Quad));
      first = first + simd::small_product(Shares::template between<i>(points).lower, simd::all_int(bytes));
    });
    std::uint32_t place[simd::lanes];
    simd::store(place, first);
    unsigned char* quad[simd::lanes];
    unroll<lanes>(
        [&](auto lane) { quad[lane] = reinterpret_cast<unsigned char*>(sums + lane * quads_of<D>()) + place[lane]; });
    unroll<corners * layout.of_cell>([&](auto n) {
      constexpr int corner = n / layout.of_cell;
      constexpr int q = n % layout.of_cell;
      Quad quads[simd::lanes];
      transpose(member<corner, 4 * q>(), member<corner, 4 * q + 1>(), member<corner, 4 * q + 2>(),
                member<corner, 4 * q + 3>(), quads);
      constexpr int offset = soft_quads(D{}, static_cast<int>(I)) + step(corner) + q;
      unroll<lanes>([&](auto lane) { reinterpret_cast<Quad*>(quad[lane])[offset] += quads[lane]; });
    });
  }

 private:
  /// The votes of a corner for number `K` of a cell, or for cell `K` within a quad.
  template <int Corner, int K>
  [[nodiscard]] SHORTSHOT_INLINE simd::I32 member() const noexcept {
    if constexpr (K < numbers) {
      return this->template votes<Corner, K>();
    } else if constexpr (numbers == 0 && K < 1 << layout.within) {
      return this->template votes<Corner + K * corners>();
    } else {
      return simd::all_int(0);
    }
  }
  /// From a point's first quad to that of corner `k`.
  static constexpr int step(int k) noexcept {
    int quads = 0;
    for (int i = layout.within; i < layout.count; ++i) quads += (k >> (i - layout.within) & 1) * layout.strides[i];
    return quads;
  }
};

template <class D, std::size_t I, class Part, class Chunk>
SHORTSHOT_INLINE void add_to_quads(const Chunk& chunk, std::uint32_t i, const SoftPoints<D>& points,
                                   Quad* sums) noexcept {
  SoftVotes<D, I, Part> votes;
  votes.share(points, chunk, i);
  votes.add(points, sums);
}

/// One chunk into the quads of all parts. What is beyond its end becomes points that count for nothing.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void add_soft_votes(Descriptor<Voting, Parts...> descriptor, std::index_sequence<I...>,
                                             Chunk& chunk, float one, Quad* sums) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t k = size; k % simd::lanes != 0; ++k) {
    for (int row = 0; row < Chunk::rows_of_place + Chunk::signals; ++row) {
      chunk.rows[k + static_cast<std::uint32_t>(row) * Chunk::room] = 0.0f;
    }
  }
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    SoftPoints<D> points;
    points.unit = simd::all(one);
    if (size - i < simd::lanes) points.unit = keep(simd::first(size - i), points.unit);
    points.locate(descriptor, chunk, i);
    (add_to_quads<D, I, Parts>(chunk, i, points, sums), ...);
  }
}

/// Adds a part's quads to its cells, axis by axis from the last one on. `place`: of the lower cells; `steps`: from
/// there to the upper cells within a quad.
template <class Part, int Axes>
SHORTSHOT_INLINE void gather_quads(const Quad* sums, int place, const int (&steps)[2], float* weights,
                                   float* values) noexcept {
  constexpr SoftLayout layout = soft_layout<Part>;
  if constexpr (Axes > 0) {
    constexpr int i = Axes - 1;
    constexpr SoftAxis axis = layout.axes[i];
    constexpr int size = i < layout.within ? axis.lowers() : axis.cells + (axis.is_around() ? 1 : 0);
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
    const Quad sum = *sums;
    add_bits(values + place, sum[0]);
    if constexpr (layout.within > 0) add_bits(values + place + steps[0], sum[1]);
    if constexpr (layout.within > 1) {
      add_bits(values + place + steps[1], sum[2]);
      add_bits(values + place + steps[1] + steps[0], sum[3]);
    }
  }
}

template <class Voting, class... Parts, std::size_t... I>
inline void gather_all_quads(Descriptor<Voting, Parts...>, std::index_sequence<I...>, Quad* sums, float* weights,
                             float* values) noexcept {
  using D = Descriptor<Voting, Parts...>;
  for (int k = 0; k < quads_of<D>(); ++k) {
    unroll<static_cast<int>(simd::lanes) - 1>([&](auto lane) { sums[k] += sums[(lane + 1) * quads_of<D>() + k]; });
  }
  const int none[2] = {};
  (gather_quads<Parts, soft_layout<Parts>.count>(sums + soft_quads(D{}, static_cast<int>(I)), 0, none,
                                                 weights + D::weight_offset(I), values + D::offset(I)),
   ...);
}

/// Bytes of a chunk, of sums of votes, and of quads.
template <class D, std::uint32_t ChunkSize>
constexpr std::size_t soft_scratch_bytes() noexcept {
  constexpr auto quads = simd::lanes > 1 ? simd::lanes * static_cast<std::size_t>(quads_of<D>()) : 0;
  return sizeof(Chunk<typename D::Signals, ChunkSize>) + sizeof(float) * static_cast<std::size_t>(D::weight_cells) +
         sizeof(Quad) * quads;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_VOTES_HPP
