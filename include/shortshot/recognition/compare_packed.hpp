// shortshot/recognition/compare_packed.hpp: which pairs of packed rows are near each other, for match.hpp. Hosted only:
// allocates, starts threads.
//
// The distances of a row of the database from a panel of queries are summed up at the same time, a chunk of codes after
// the other, exactly. After each chunk the sum is as far as they are apart at least: where no query of the panel can
// be nearer than the best so far, the other chunks are left out. Of rows of a scene four out of five are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "../base/simd.hpp"
#include "../base/simd_sums.hpp"
#include "../base/unroll.hpp"
#include "../batch/executor.hpp"
#include "../config.hpp"
#include "compare_rows.hpp"
#include "packed_panels.hpp"
#include "packed_rows.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Rows of the database that meet a block of queries at a time.
inline constexpr std::size_t packed_row_block = 512;

/// Distances from 0 to 2^32 - 1 in the order of signed numbers, which is what registers compare.
[[nodiscard]] inline std::int32_t ordered(std::uint32_t distance) noexcept {
  return static_cast<std::int32_t>(distance ^ 0x80000000u);
}

/// What the distances of each query are compared with: the best so far. Queries that take no part have the least.
class PackedLimits {
 public:
  template <class Rows>
  explicit PackedLimits(const AnyRows<Rows>& queries)
      : limits_((queries.count() + query_block - 1) / query_block * query_block, 0x80000000u) {
    for (std::size_t q = 0; q < queries.count(); ++q) {
      if (queries.takes_part(q)) set(q, AnyRows<Rows>::farthest);
    }
  }
  void set(std::size_t query, std::uint32_t distance) noexcept { limits_[query] = distance ^ 0x80000000u; }
  [[nodiscard]] std::uint32_t of(std::size_t query) const noexcept { return limits_[query] ^ 0x80000000u; }
  [[nodiscard]] const std::uint32_t* from(std::size_t query) const noexcept { return limits_.data() + query; }

 private:
  std::vector<std::uint32_t> limits_;
};

/// Finds the pairs that are near: nearer than `limits` has for the query, or what `best_of_rows` (null: nothing) has
/// for the row.
template <class Rows>
struct NearPackedPairs {
  using Format = CodesOf<Rows>;
  using Ops = typename Format::Ops;
  static constexpr std::size_t registers = Panel<Rows>::registers;

  const AnyRows<Rows>& queries;
  const AnyRows<Rows>& database;
  const PackedDatabase<Rows>& codes;
  const PackedLimits& limits;
  const Candidate<std::uint32_t>* best_of_rows;  // as many for each thread as there are rows
  void (*consider)(const void* considering, std::size_t thread, std::size_t query, std::size_t row);
  const void* considering;

  /// What a thread needs: panels, and of the rows that are at a panel those that may be near, with how far they are
  /// from the queries at least.
  struct Memory {
    std::vector<Panel<Rows>> panels;
    std::vector<std::size_t> rows;
    std::vector<simd::I32> distances;

    explicit Memory(const RowCodes<Rows>& codes)
        : panels(query_block / Panel<Rows>::rows, Panel<Rows>(codes)),
          rows(packed_row_block),
          distances(packed_row_block * registers) {}
  };

  /// A block of queries and all rows.
  void meet_all(Memory& memory, std::size_t thread, std::size_t begin, std::size_t end) const {
    const std::size_t used = (end - begin + Panel<Rows>::rows - 1) / Panel<Rows>::rows;
    for (std::size_t i = 0; i < used; ++i) {
      const std::size_t query = begin + i * Panel<Rows>::rows;
      memory.panels[i].pack(queries.rows(), query);
      for (std::size_t k = 0; k < Panel<Rows>::rows; ++k) memory.panels[i].set_limit(k, limits.of(query + k));
    }
    for (std::size_t first = 0; first < database.count(); first += packed_row_block) {
      const std::size_t last = std::min(first + packed_row_block, database.count());
      for (std::size_t i = 0; i < used; ++i) {
        meet(memory, memory.panels[i], thread, begin + i * Panel<Rows>::rows, first, last);
      }
    }
  }

 private:
  /// The queries of a panel, which are those from `query` on, and a block of rows.
  void meet(Memory& memory, Panel<Rows>& panel, std::size_t thread, std::size_t query, std::size_t first,
            std::size_t last) const {
    std::size_t count = 0;
    for (std::size_t row = first; row < last; ++row) {
      if (database.takes_part(row)) memory.rows[count++] = row;
    }
    for (std::size_t chunk = 0; chunk < codes.chunks() && count > 0; ++chunk) {
      count = go_on(memory, panel, count, chunk, thread, query);
    }
    for (std::size_t i = 0; i < count; ++i) {
      consider_lanes(panel, thread, query, memory.rows[i], memory.distances.data() + i * registers);
    }
  }

  /// Adds a chunk for the first `count` rows; keeps those that may still be near.
  [[nodiscard]] std::size_t go_on(Memory& memory, const Panel<Rows>& panel, std::size_t count, std::size_t chunk,
                                  std::size_t thread, std::size_t query) const {
    std::size_t* const rows = memory.rows.data();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; i += packed_tile) {
      const typename Ops::Code* tile[packed_tile];
      for (std::size_t r = 0; r < packed_tile; ++r) tile[r] = codes.at(rows[std::min(i + r, count - 1)], chunk);
      PanelSums<Ops> sums[packed_tile];
      sum_up<Ops>(panel.cells(chunk), tile, codes.chunk_steps(chunk), sums);
      for (std::size_t r = 0; r < packed_tile && i + r < count; ++r) {
        const std::size_t row = rows[i + r];
        const std::uint32_t of_row = limit_of_row(thread, row);
        if (chunk == 0 && !panel.any_near(sums[r], codes.norm(row, 0), of_row)) continue;
        const simd::I32* const before = memory.distances.data() + (i + r) * registers;
        simd::I32 distances[registers];
        unroll<int{registers}>([&](auto k) { distances[k] = chunk == 0 ? simd::all_int(ordered(0)) : before[k]; });
        add(panel, row, chunk, sums[r], distances);
        if (chunk > 0 && !any(near(query, of_row, distances))) continue;
        simd::I32* const after = memory.distances.data() + kept * registers;
        unroll<int{registers}>([&](auto k) { after[k] = distances[k]; });
        rows[kept++] = row;
      }
    }
    return kept;
  }

  /// 0 if it does not count.
  [[nodiscard]] std::uint32_t limit_of_row(std::size_t thread, std::size_t row) const noexcept {
    return best_of_rows != nullptr ? best_of_rows[thread * database.count() + row].compared : 0;
  }

  /// Adds what a chunk adds to the distances.
  [[gnu::always_inline]] void add(const Panel<Rows>& panel, std::size_t row, std::size_t chunk,
                                  const PanelSums<Ops>& sums, simd::I32 (&distances)[registers]) const {
    constexpr std::size_t widened = Ops::rows / simd::lanes;
    const simd::I32 row_norm = simd::all_int(static_cast<std::int32_t>(codes.norm(row, chunk)));
    const std::uint32_t* const norms = panel.norms(chunk);
    unroll<int{packed_sums}>([&](auto s) {
      simd::I32 wide[widened];
      Ops::widen(sums.of[s], wide);
      unroll<int{widened}>([&](auto w) {
        constexpr std::size_t k = s * widened + w;
        const simd::I32 both = simd::load(norms + k * simd::lanes) + row_norm;
        distances[k] = distances[k] + Format::distances(both, wide[w]);
      });
    });
  }

  [[nodiscard, gnu::always_inline]] simd::Mask near(std::size_t query, std::uint32_t of_row,
                                                    const simd::I32 (&distances)[registers]) const {
    const std::uint32_t* const of_queries = limits.from(query);
    simd::Mask near = simd::load(of_queries) > distances[0];
    unroll<int{registers - 1}>(
        [&](auto k) { near = near | (simd::load(of_queries + (k + 1) * simd::lanes) > distances[k + 1]); });
    const simd::I32 limit = simd::all_int(ordered(of_row));
    if (of_row > 0) unroll<int{registers}>([&](auto k) { near = near | (limit > distances[k]); });
    return near;
  }

  /// All queries of a panel that are near.
  void consider_lanes(Panel<Rows>& panel, std::size_t thread, std::size_t query, std::size_t row,
                      const simd::I32* of_queries) const {
    const simd::I32 of_row = simd::all_int(ordered(limit_of_row(thread, row)));
    for (std::size_t k = 0; k < Panel<Rows>::rows; k += simd::lanes) {
      const simd::I32 distances = of_queries[k / simd::lanes];
      const simd::Mask near = (simd::load(limits.from(query + k)) > distances) | (of_row > distances);
      if (!any(near)) continue;
      float is_near[simd::lanes];
      simd::store(is_near, simd::keep(near, simd::all(1.0f)));
      for (std::size_t lane = 0; lane < simd::lanes && query + k + lane < queries.count(); ++lane) {
        if (is_near[lane] == 0.0f || !queries.takes_part(query + k + lane)) continue;
        consider(considering, thread, query + k + lane, row);
        panel.set_limit(k + lane, limits.of(query + k + lane));
      }
    }
  }
};

/// Calls consider(thread, query, row) for all pairs that take part and are nearer than the best so far, of the query or
/// (if there is one) of the row; one thread gets queries in ascending order for each row, and rows for each query.
template <class Executor, class Rows, class Consider>
void for_near(Executor& executor, std::size_t team, const AnyRows<Rows>& queries, const AnyRows<Rows>& database,
              const PackedLimits& limits, const Candidate<std::uint32_t>* best_of_rows, const Consider& consider) {
  const auto call = [](const void* considering, std::size_t thread, std::size_t query, std::size_t row) {
    (*static_cast<const Consider*>(considering))(thread, query, row);
  };
  const PackedDatabase<Rows> codes(database.rows());
  const NearPackedPairs<Rows> pairs{queries, database, codes, limits, best_of_rows, call, &consider};
  std::vector<typename NearPackedPairs<Rows>::Memory> memory;
  for (std::size_t t = 0; t < team; ++t) memory.emplace_back(codes.codes());
  for_blocks(executor, team, queries.count(), query_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    pairs.meet_all(memory[thread], thread, begin, end);
  });
}

template <class Rows>
struct PackedComparison : PairComparison<Rows> {
  using Limits = PackedLimits;
};
template <int Bits>
struct Comparison<CodedRows<Bits>> : PackedComparison<CodedRows<Bits>> {};
template <>
struct Comparison<BitRows> : PackedComparison<BitRows> {};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
