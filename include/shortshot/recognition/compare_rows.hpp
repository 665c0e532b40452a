// shortshot/recognition/compare_rows.hpp: which pairs of rows may be near each other, for match.hpp. Hosted only:
// allocates, starts threads.
//
// |a - b|^2 = |a|^2 + |b|^2 - 2 ab makes of all distances of floats one matrix product, 1.4 (SSE2) to 1.7 (AVX2) times
// as fast as squared differences blocked in the same way, but cancellation costs it digits where rows are close. So the
// product only rules out: where, by a bound on its rounding, a row may be nearer than the best so far, the distance is
// computed again as a sum of squared differences, and that decides. In rows of no particular order that is so for about
// log(count) rows of each query.
//
// Packed rows have compare_packed.hpp. Of rows in any other format every pair is compared.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "../base/math.hpp"
#include "../base/products.hpp"
#include "../base/simd.hpp"
#include "../batch/executor.hpp"
#include "../config.hpp"
#include "../dispatch/widest.hpp"
#include "../status.hpp"
#include "descriptor_rows.hpp"
#include "l2_distance.hpp"
#include "row_format.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Queries that a thread takes at a time, and rows of the database that meet them at a time: few enough for a CPU's
/// second cache, many enough to be worth their way there.
inline constexpr std::size_t query_block = 128;
inline constexpr std::size_t row_block = 96;
static_assert(query_block % panel_rows == 0 && row_block % tile_rows == 0, "whole tiles");

/// A match before what was compared became a distance.
template <class Number>
struct Candidate {
  std::uint32_t row;
  Number compared;
};

/// More than twice any squared distance; finite, so that nothing here depends on how infinities compare.
inline constexpr float out_of_reach = std::numeric_limits<float>::max();

/// Rows with half of their squared norms, each less its share of the rounding: half_norm(a) + half_norm(b) - (the
/// product ab) is not above half of squared_l2_distance(a, b), in whatever order the product was summed up.
///
/// A sum of n products errs by n 2^-24 |a| |b| at most (to first order), hence the two norms and twice the product
/// together by 2 n 2^-24 (|a|^2 + |b|^2), and squared_l2_distance(), which is not above 2 (|a|^2 + |b|^2), by as much
/// again. 5 instead of 4 makes up for higher orders, 16 for the few other operations, min() for squares that underflow.
class ComparedRows {
 public:
  using Number = float;
  static constexpr Number farthest = out_of_reach;

  explicit ComparedRows(const DescriptorRows& rows)
      : rows_(rows), origin_(rows.size), half_norms_(whole_panels(rows.count), out_of_reach) {
    const auto size = static_cast<float>(rows.size);
    const float kept = 1.0f - 5.0f * (size + 16.0f) * (1.0f / 16777216.0f);
    const float underflow = size * std::numeric_limits<float>::min();
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (!is_ok(rows, i)) continue;
      const float norm = squared_l2_distance(at(i), origin_.data(), rows.size);
      if (math::is_finite(8.0f * norm)) half_norms_[i] = unfused(0.5f * kept * norm) - underflow;
    }
  }

  /// A multiple of the rows of a panel: what is behind the last row takes no part.
  [[nodiscard]] static std::size_t whole_panels(std::size_t count) noexcept {
    return (count + panel_rows - 1) / panel_rows * panel_rows;
  }
  [[nodiscard]] std::size_t count() const noexcept { return rows_.count; }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size; }
  [[nodiscard]] const float* half_norm(std::size_t row) const noexcept { return half_norms_.data() + row; }
  [[nodiscard]] bool takes_part(std::size_t row) const noexcept { return half_norms_[row] < out_of_reach; }
  [[nodiscard]] float compare(std::size_t row, const ComparedRows& other, std::size_t others_row) const noexcept {
    return squared_l2_distance(at(row), other.at(others_row), rows_.size);
  }

  /// Zeros for rows that take no part.
  void pack_panel(std::size_t first, float* panel) const noexcept {
    const float* rows[panel_rows];
    for (std::size_t k = 0; k < panel_rows; ++k) rows[k] = takes_part(first + k) ? at(first + k) : origin_.data();
    pack(rows, rows_.size, panel);
  }
  /// With rows from `first` on; the last one's again where there are no more.
  void multiply_tile(const float* panel, std::size_t first, float (&products)[tile_rows][panel_rows]) const noexcept {
    const float* rows[tile_rows];
    for (std::size_t k = 0; k < tile_rows; ++k) rows[k] = at(std::min(first + k, rows_.count - 1));
    multiply_widest(panel, rows, rows_.size, products);
  }

 private:
  [[nodiscard]] const float* at(std::size_t row) const noexcept { return rows_.values + row * rows_.size; }

  DescriptorRows rows_;
  std::vector<float> origin_;
  std::vector<float> half_norms_;
};

/// Shares blocks of queries among threads. compare(thread, first, row, products) is called for panels of queries, from
/// `first` on, with their products with a row of the database that takes part; one thread gets queries in ascending
/// order for each row, and rows for each query.
template <class Executor, class Compare>
void for_products(Executor& executor, std::size_t team, const ComparedRows& queries, const ComparedRows& database,
                  const Compare& compare) {
  const std::size_t size = queries.size();
  const std::size_t block_values = std::min(ComparedRows::whole_panels(queries.count()), query_block) * size;
  std::vector<float> panels(team * block_values);
  const auto compare_block = [&](std::size_t thread, std::size_t begin, std::size_t end) {
    float* const block = panels.data() + thread * block_values;
    for (std::size_t q = begin; q < end; q += panel_rows) queries.pack_panel(q, block + (q - begin) * size);
    for (std::size_t first = 0; first < database.count(); first += row_block) {
      const std::size_t last = std::min(first + row_block, database.count());
      for (std::size_t q = begin; q < end; q += panel_rows) {
        for (std::size_t tile = first; tile < last; tile += tile_rows) {
          float products[tile_rows][panel_rows];
          database.multiply_tile(block + (q - begin) * size, tile, products);
          for (std::size_t row = tile; row < std::min(tile + tile_rows, last); ++row) {
            if (database.takes_part(row)) compare(thread, q, row, products[row - tile]);
          }
        }
      }
    }
  };
  for_blocks(executor, team, queries.count(), query_block, compare_block);
}

/// Calls consider(query) for those queries of a panel, from `first` on, whose squared distance from a row, of which
/// there is a half norm, may be below twice the limits(query), which are in a register for each query and those next.
template <class Limits, class Consider>
void for_candidates(const ComparedRows& queries, std::size_t first, float half_norm,
                    const float (&products)[panel_rows], const Limits& limits, const Consider& consider) {
  for (std::size_t k = 0; k < panel_rows; k += simd::lanes) {
    const std::size_t query = first + k;
    const simd::F32 half_norms = simd::load(queries.half_norm(query));
    const simd::F32 half_distances = (half_norms - simd::load(products + k)) + simd::all(half_norm);
    const simd::Mask near = half_distances < limits(query);
    if (!any(near)) continue;
    std::int32_t is_near[simd::lanes];
    simd::store(is_near, keep(near, simd::all_int(1)));
    for (std::size_t lane = 0; lane < simd::lanes; ++lane) {
      if (is_near[lane] != 0 && queries.takes_part(query + lane)) consider(query + lane);
    }
  }
}

/// What of each query's best so far its products are compared with.
class QueryLimits {
 public:
  explicit QueryLimits(const ComparedRows& queries)
      : halves_(ComparedRows::whole_panels(queries.count()), 0.5f * out_of_reach) {}
  void set(std::size_t query, float squared_distance) noexcept { halves_[query] = 0.5f * squared_distance; }
  [[nodiscard]] simd::F32 halves(std::size_t query) const noexcept { return simd::load(halves_.data() + query); }

 private:
  std::vector<float> halves_;
};

/// Of the products that for_products() calls it with, those of pairs that may be near: nearer than `limits` has for the
/// query, or what `best_of_rows` (null: nothing) has for the row. One type for all that is done with them, because they
/// are few, and what is around them takes a compiler its time.
struct NearPairs {
  const ComparedRows& queries;
  const ComparedRows& database;
  const QueryLimits& limits;
  const Candidate<float>* best_of_rows;  // as many for each thread as there are rows
  void (*consider)(const void* considering, std::size_t thread, std::size_t query, std::size_t row);
  const void* considering;

  void operator()(std::size_t thread, std::size_t first, std::size_t row, const float (&products)[panel_rows]) const {
    const float of_row = best_of_rows != nullptr ? best_of_rows[thread * database.count() + row].compared : 0.0f;
    const simd::F32 half_of_row = simd::all(0.5f * of_row);
    const auto halves = [&](std::size_t query) { return simd::max(limits.halves(query), half_of_row); };
    for_candidates(queries, first, *database.half_norm(row), products, halves,
                   [&](std::size_t query) { consider(considering, thread, query, row); });
  }
};

/// Calls consider(thread, query, row) for all pairs that take part and are nearer than the best so far, of the query or
/// (if there is one) of the row, and for others; in the order of for_products().
template <class Executor, class Consider>
void for_near(Executor& executor, std::size_t team, const ComparedRows& queries, const ComparedRows& database,
              const QueryLimits& limits, const Candidate<float>* best_of_rows, const Consider& consider) {
  const auto call = [](const void* considering, std::size_t thread, std::size_t query, std::size_t row) {
    (*static_cast<const Consider*>(considering))(thread, query, row);
  };
  for_products(executor, team, queries, database, NearPairs{queries, database, limits, best_of_rows, call, &consider});
}

/// Rows in any format, with the same functions.
template <class Rows>
class AnyRows {
 public:
  using Number = typename RowsNumber<Rows>::type;
  static constexpr Number farthest = std::numeric_limits<Number>::max();

  explicit AnyRows(const Rows& rows) noexcept : rows_(rows) {}
  [[nodiscard]] const Rows& rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t count() const noexcept { return rows_.count; }
  [[nodiscard]] bool takes_part(std::size_t row) const noexcept { return is_ok(rows_, row); }
  [[nodiscard]] Number compare(std::size_t row, const AnyRows& other, std::size_t others_row) const {
    return rows_.compare(row, other.rows_, others_row);
  }

 private:
  const Rows& rows_;
};

struct NoLimits {
  template <class Rows>
  explicit NoLimits(const AnyRows<Rows>&) noexcept {}
  template <class Number>
  void set(std::size_t, Number) noexcept {}
};

template <class Executor, class Rows, class Consider>
void for_near(Executor& executor, std::size_t team, const AnyRows<Rows>& queries, const AnyRows<Rows>& database,
              const NoLimits&, const Candidate<typename AnyRows<Rows>::Number>*, const Consider& consider) {
  const auto compare_block = [&](std::size_t thread, std::size_t begin, std::size_t end) {
    for (std::size_t first = 0; first < database.count(); first += row_block) {
      const std::size_t last = std::min(first + row_block, database.count());
      for (std::size_t query = begin; query < end; ++query) {
        if (!queries.takes_part(query)) continue;
        for (std::size_t row = first; row < last; ++row) {
          if (database.takes_part(row)) consider(thread, query, row);
        }
      }
    }
  };
  for_blocks(executor, team, queries.count(), query_block, compare_block);
}

/// How rows of a format are compared.
template <class Rows>
struct PairComparison {
  using Compared = AnyRows<Rows>;
  using Limits = NoLimits;
  [[nodiscard]] static bool fit(const Rows& a, const Rows& b) { return a.fits(b); }
  template <class Number>
  [[nodiscard]] static float distance(const Rows& rows, Number compared) {
    return rows.distance(compared);
  }
};
template <class Rows>
struct Comparison : PairComparison<Rows> {};
/// Rows of floats, or of what stands for them.
template <class Rows, class SomeCompared>
struct FloatComparison {
  using Compared = SomeCompared;
  using Limits = QueryLimits;
  [[nodiscard]] static bool fit(const Rows& a, const Rows& b) noexcept {
    return validate(a) == Status::ok && validate(b) == Status::ok && a.size == b.size;
  }
  [[nodiscard]] static float distance(const Rows&, float compared) noexcept { return simd::sqrt(compared); }
};
template <>
struct Comparison<DescriptorRows> : FloatComparison<DescriptorRows, ComparedRows> {};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
