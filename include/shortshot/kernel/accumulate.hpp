// shortshot/kernel/accumulate.hpp: the kernel's second pass. A chunk of located neighbors is shared among the cells of
// each part, and their votes are added up.
#ifndef SHORTSHOT_KERNEL_ACCUMULATE_HPP
#define SHORTSHOT_KERNEL_ACCUMULATE_HPP

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/concepts.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/voting.hpp"
#include "single_votes.hpp"
#include "to_spherical.hpp"
#include "vote_shares.hpp"
#include "vote_sums.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Is vote `k` of a neighbor, to its partner along an axis of the grid, of the same weight for all parts on the grid?
template <class Voting>
constexpr bool is_shared(int k) noexcept {
  return PartnersGetOwnShare<Voting>::value && 1 <= k && k <= 3;
}

/// The votes of a chunk for one part, lane-wise: `count` arrays of indices, and as many of weights. Votes go through
/// memory: taken out of registers lane by lane they would cost twice as much.
template <class Voting, class PartType, class Index, std::uint32_t ChunkSize>
struct VoteRows {
  using Part = PartType;
  static constexpr int count = votes_of<Voting, Part>;
  Index index[count * ChunkSize];
  std::int32_t weight[count * ChunkSize];

  VoteRows() noexcept {}  // leaves the arrays as they are

  /// Votes of one register of neighbors, from `i` on. Weights that the `First` part on the grid has as well are kept
  /// there only.
  template <bool First>
  SHORTSHOT_INLINE void keep_weights(std::uint32_t i, const simd::I32* weights) noexcept {
    unroll<count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      if constexpr (First || !is_shared<Voting>(k)) simd::store(weight + i + k * ChunkSize, weights[k]);
    });
  }
};

/// Those for the part that begins at value `Offset` of the descriptor; indices are positions in the part.
template <class Voting, class Part, int Offset, std::uint32_t ChunkSize>
struct ChunkVotes : VoteRows<Voting, Part, std::int32_t, ChunkSize> {
  static constexpr bool goes_to_distinct_places = false;
  using ChunkVotes::VoteRows::count;
  ChunkVotes() noexcept {}  // else `ChunkVotes()` is zeros

  /// Where index 0 of vote `k` is.
  static constexpr int origin(int) noexcept { return Offset; }

  template <bool First, class Chunk>
  SHORTSHOT_INLINE void cast(const Chunk& chunk, std::uint32_t i, PointShares&& shares, const VoteUnit& unit) noexcept {
    const Votes<count> votes = votes_at<Voting, Part>(chunk, i, shares, unit);
    unroll<count>([&](auto k) { simd::store(this->index + i + k * ChunkSize, votes.index[k]); });
    this->template keep_weights<First>(i, votes.weight);
  }
};

/// The largest number of votes that a neighbor has for any of these parts.
template <class First, class... Others>
inline constexpr int votes_of_most = [] {
  int most = First::count;
  ((most = Others::count > most ? Others::count : most), ...);
  return most;
}();

/// Where vote `K` of neighbor `i` of a chunk goes.
template <int K, std::uint32_t ChunkSize, class Votes>
[[nodiscard]] SHORTSHOT_INLINE float* place_of_vote(float* out, const Votes& votes, std::uint32_t i) noexcept {
  return out + Votes::origin(K) + std::ptrdiff_t{votes.index[K * ChunkSize + i]};
}

/// Vote `K` of neighbor `i` of a chunk, of the weight that `source` has.
template <int K, std::uint32_t ChunkSize, class Votes, class Source>
SHORTSHOT_INLINE void add_vote(float* out, const Votes& votes, const Source& source, std::uint32_t i) noexcept {
  if constexpr (K < Votes::count) {
    add_bits(place_of_vote<K, ChunkSize>(out, votes, i), source.weight[K * ChunkSize + i]);
  }
}

/// Votes of one neighbor for a part, to distinct places: their sums are loaded together, and no load waits for a store.
template <int Count>
struct DistinctVotes {
  float* places[static_cast<std::size_t>(Count)];
  std::int32_t sums[static_cast<std::size_t>(Count)];

  template <class Voting, std::uint32_t ChunkSize, bool OneGrid, class First, class Votes>
  SHORTSHOT_INLINE void load(std::uint32_t i, float* out, const First& first, const Votes& votes) noexcept {
    unroll<Count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      places[k] = place_of_vote<k, ChunkSize>(out, votes, i);
      if constexpr (OneGrid && is_shared<Voting>(k)) {
        sums[k] = sum_at(places[k], first.weight[k * ChunkSize + i]);
      } else {
        sums[k] = sum_at(places[k], votes.weight[k * ChunkSize + i]);
      }
    });
  }
  SHORTSHOT_INLINE void store() const noexcept {
    unroll<Count>([&](auto k) SHORTSHOT_INLINE_LAMBDA { set_bits(places[k], sums[k]); });
  }
};

/// All votes of neighbor `i` of a chunk, for several parts; on one grid, or each on its own.
template <class Voting, std::uint32_t ChunkSize, bool OneGrid, class First, class... Others>
SHORTSHOT_INLINE void add_votes(std::uint32_t i, float* out, const First& first, const Others&... others) noexcept {
  if constexpr (First::goes_to_distinct_places && !simd::adds_to_memory) {
    const auto add = [&](auto of_first, auto... of_others) SHORTSHOT_INLINE_LAMBDA {
      of_first.template load<Voting, ChunkSize, OneGrid>(i, out, first, first);
      (of_others.template load<Voting, ChunkSize, OneGrid>(i, out, first, others), ...);
      of_first.store();
      (of_others.store(), ...);
    };
    add(DistinctVotes<First::count>(), DistinctVotes<Others::count>()...);
  } else {
    unroll<votes_of_most<First, Others...>>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      add_vote<k, ChunkSize>(out, first, first, i);
      if constexpr (OneGrid && is_shared<Voting>(k)) {
        (add_vote<k, ChunkSize>(out, others, first, i), ...);
      } else {
        (add_vote<k, ChunkSize>(out, others, others, i), ...);
      }
    });
  }
}

/// The votes of a chunk for several parts. Neighbors from the four stretches of a full chunk are taken in turn.
template <class Voting, std::uint32_t ChunkSize, bool OneGrid, class... Votes>
SHORTSHOT_INLINE void scatter(std::uint32_t size, float* out, const Votes&... votes) noexcept {
  constexpr std::uint32_t quarter = ChunkSize / 4;  // a stretch of a full chunk; any other split would do
  static_assert(stretches_of_full_chunk == 4 && ChunkSize % 4 == 0, "what is written out below");
  const auto add = [&](std::uint32_t i)
                       SHORTSHOT_INLINE_LAMBDA { add_votes<Voting, ChunkSize, OneGrid>(i, out, votes...); };
  std::uint32_t i = 0;
  if (size > 3 * quarter) {
    for (; i < size - 3 * quarter; ++i) unroll<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA { add(i + k * quarter); });
    for (; i < quarter; ++i) {
      for (std::uint32_t k = i; k < 3 * quarter; k += quarter) add(k);
    }
  } else {
    for (; i < size; ++i) add(i);
  }
}

/// One chunk into parts that have one grid: points are shared among its cells once for all of them. (`unit` is a
/// copy: see Collector.)
template <class Voting, class Chunk, class First, class... Others>
inline void accumulate(const Chunk& chunk, VoteUnit unit, float* out, First&& first, Others&&... others) noexcept {
  using Part = typename std::decay_t<First>::Part;
  constexpr int values = [] {
    int divisor = Part::values;
    ((divisor = std::gcd(divisor, std::decay_t<Others>::Part::values)), ...);
    return divisor;
  }();
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    const Coordinates at = coordinates_at(chunk, i);
    if constexpr (sizeof...(Others) == 0) {
      first.template cast<true>(chunk, i, grid_shares<Voting, Part, values>(at, unit), unit);
    } else {
      const PointShares shares = grid_shares<Voting, Part, values>(at, unit);
      first.template cast<true>(chunk, i, widened<Part::values / values>(shares), unit);
      (others.template cast<false>(chunk, i, widened<std::decay_t<Others>::Part::values / values>(shares), unit), ...);
    }
  }
  scatter<Voting, Chunk::room, true>(size, out, first, others...);
}

template <class Voting, class... Parts, std::size_t... I, class Chunk>
inline void accumulate_all(Descriptor<Voting, Parts...> descriptor, std::index_sequence<I...> parts, const Chunk& chunk,
                           const VoteUnit& unit, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  if constexpr (simd::lanes == 1 && small_code) {
    (add_points_of_part<Voting, typename Parts::Cells, typename Parts::Scale, SignedOf<Parts>>(
         chunk, Parts::template axes<Parts::values>, signal_row<Parts, Chunk>(), unit, out + D::offset(I)),
     ...);
  } else if constexpr (simd::lanes == 1) {
    add_points(descriptor, parts, chunk, unit, out);
  } else if constexpr (HaveOneGrid<Parts...>::value) {
    accumulate<Voting>(chunk, unit, out, ChunkVotes<Voting, Parts, D::offset(I), Chunk::room>()...);
  } else {
    const auto accumulate_part = [&](auto part, float* values) {
      accumulate<Voting>(chunk, unit, values, ChunkVotes<Voting, decltype(part), 0, Chunk::room>());
    };
    (accumulate_part(Parts{}, out + D::offset(I)), ...);
  }
}

/// Bytes of a chunk and its votes, those of parts on one grid at the same time.
template <std::uint32_t ChunkSize, class Voting, class... Parts>
constexpr std::size_t scratch_bytes(Descriptor<Voting, Parts...>) noexcept {
  using D = Descriptor<Voting, Parts...>;
  constexpr std::size_t votes[] = {(Parts::weight_cells > 0 ? 0 : sizeof(ChunkVotes<Voting, Parts, 0, ChunkSize>))...};
  std::size_t most = 0;
  for (const std::size_t bytes : votes)
    most = HaveOneGrid<Parts...>::value ? most + bytes : most < bytes ? bytes : most;
  return sizeof(Chunk<typename D::Signals, ChunkSize>) + (simd::lanes == 1 ? 0 : most);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_ACCUMULATE_HPP
