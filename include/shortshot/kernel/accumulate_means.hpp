// shortshot/kernel/accumulate_means.hpp: votes for a part's means: those of the cells themselves, and votes times the
// values of signals.
#ifndef SHORTSHOT_KERNEL_ACCUMULATE_MEANS_HPP
#define SHORTSHOT_KERNEL_ACCUMULATE_MEANS_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/voting.hpp"
#include "accumulate.hpp"
#include "vote_shares.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes times the values of the `Signals`, for neighbor `i` of a chunk (or a register of them).
template <class Chunk, class... Signals>
SHORTSHOT_INLINE void multiply(SignalList<Signals...>, const Chunk& chunk, std::uint32_t i, simd::I32 weight,
                               simd::I32 (&products)[sizeof...(Signals)]) noexcept {
  const simd::F32 votes = to_float(weight);
  std::size_t k = 0;
  ((products[k++] = round_to_int(votes * Signals::value(simd::load(chunk.row(Chunk::template row_of<Signals>, i))))),
   ...);
}

/// One chunk into a part of means: its votes to `weights`, the products to `values`; integers, bit for bit.
template <class Voting, class Means, class Chunk>
[[gnu::noinline]] inline void accumulate_means(const Chunk& chunk, VoteUnit unit, float* weights,
                                               float* values) noexcept {
  using Counts = typename Means::Counts;
  constexpr int count = votes_of<Voting, Counts>;
  constexpr std::size_t signals = static_cast<std::size_t>(Means::values);
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    PointShares shares = grid_shares<Voting, Counts, 1>(coordinates_at(chunk, i), unit);
    const Votes<count> votes = votes_at<Voting, Counts>(chunk, i, shares, unit);
    const std::size_t lanes = size - i < simd::lanes ? size - i : simd::lanes;
    each<count>([&](auto k) {
      simd::I32 products[signals];
      multiply(typename Means::Averaged{}, chunk, i, votes.weight[k], products);
      std::int32_t index[simd::lanes];
      std::int32_t weight[simd::lanes];
      std::int32_t product[signals][simd::lanes];
      simd::store(index, votes.index[k]);
      simd::store(weight, votes.weight[k]);
      for (std::size_t s = 0; s < signals; ++s) simd::store(product[s], products[s]);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        add_bits(weights + index[lane], weight[lane]);
        float* const cell = values + Means::values * index[lane];
        for (std::size_t s = 0; s < signals; ++s) add_bits(cell + s, product[s][lane]);
      }
    });
  }
}

/// Sums to means, given the sums of votes.
template <class Means>
inline void divide_by_votes(float* values, const float* weights) noexcept {
  float all = 0.0f;
  for (int cell = 0; cell < Means::Grid::cells; ++cell) all += weights[cell];
  if (!(all > 0.0f)) return;  // nobody voted: all sums are 0
  const float shrinkage = unfused(all * (static_cast<float>(Means::shrink_percent) / (100.0f * Means::Grid::cells)));
  for (int cell = 0; cell < Means::Grid::cells; ++cell) {
    const float inverse = 1.0f / (weights[cell] + shrinkage);
    float* const means = values + Means::values * cell;
    for (int k = 0; k < Means::values; ++k) means[k] = unfused(means[k] * inverse);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_ACCUMULATE_MEANS_HPP
