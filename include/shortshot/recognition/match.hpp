// shortshot/recognition/match.hpp: the nearest descriptors of another set, exactly, and pairs that are each other's
// nearest. Hosted only: allocates, starts threads.
//
// |a - b|^2 = |a|^2 + |b|^2 - 2 ab makes of all distances one matrix product, 1.4 (SSE2) to 1.7 (AVX2) times as fast as
// squared differences blocked in the same way, but cancellation costs it digits where rows are close. So the product
// only rules out: where, by a bound on its rounding, a row may be nearer than the best so far, the distance is computed
// again as a sum of squared differences, and that decides. In rows of no particular order that is so for about
// log(count) rows of each query.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../batch/executor.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "descriptor_rows.hpp"
#include "products.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// In place of a row's number where there is none.
inline constexpr std::uint32_t no_row = 0xFFFFFFFFu;

/// A row of the database and its distance (L2) from the query.
struct Match {
  std::uint32_t row;
  float distance;
};

/// A row of each of two sets, and their distance (L2).
struct MatchedPair {
  std::uint32_t source;
  std::uint32_t target;
  float distance;
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Queries that a thread takes at a time, and rows of the database that meet them at a time: few enough for a CPU's
/// second cache, many enough to be worth their way there.
inline constexpr std::size_t query_block = 128;
inline constexpr std::size_t row_block = 96;
static_assert(query_block % panel_rows == 0 && row_block % tile_rows == 0, "whole tiles");

/// More than twice any squared distance; finite, so that nothing here depends on how infinities compare.
inline constexpr float out_of_reach = std::numeric_limits<float>::max();

/// In eight sums, whatever the number of lanes, for the same bits on every machine.
[[nodiscard]] inline float squared_distance(const float* a, const float* b, std::size_t size) noexcept {
  constexpr std::size_t width = 8;
  static_assert(width % simd::lanes == 0, "whole registers");
  simd::F32 lanes[width / simd::lanes] = {};
  const auto add = [&lanes](const float* x, const float* y) {
    for (std::size_t k = 0; k < width; k += simd::lanes) {
      const simd::F32 difference = simd::load(x + k) - simd::load(y + k);
      lanes[k / simd::lanes] = lanes[k / simd::lanes] + difference * difference;
    }
  };
  const std::size_t whole = size - size % width;
  for (std::size_t i = 0; i < whole; i += width) add(a + i, b + i);
  float rest[2][width] = {};
  std::copy(a + whole, a + size, rest[0]);
  std::copy(b + whole, b + size, rest[1]);
  add(rest[0], rest[1]);
  float sums[width];
  for (std::size_t k = 0; k < width; k += simd::lanes) simd::store(sums + k, lanes[k / simd::lanes]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// Rows with half of their squared norms, each less its share of the rounding: half_norm(a) + half_norm(b) - (the
/// product ab) is not above half of squared_distance(a, b), in whatever order the product was summed up.
///
/// A sum of n products errs by n 2^-24 |a| |b| at most (to first order), hence the two norms and twice the product
/// together by 2 n 2^-24 (|a|^2 + |b|^2), and squared_distance(), which is not above 2 (|a|^2 + |b|^2), by as much
/// again. 5 instead of 4 makes up for higher orders, 16 for the few other operations, min() for squares that underflow.
class ComparedRows {
 public:
  explicit ComparedRows(const DescriptorRows& rows)
      : rows_(rows), origin_(rows.size), half_norms_(whole_panels(rows.count), out_of_reach) {
    const auto size = static_cast<float>(rows.size);
    const float kept = 1.0f - 5.0f * (size + 16.0f) * (1.0f / 16777216.0f);
    const float underflow = size * std::numeric_limits<float>::min();
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (!is_ok(rows, i)) continue;
      const float norm = squared_distance(at(i), origin_.data(), rows.size);
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
  [[nodiscard]] float squared_distance_to(const ComparedRows& other, std::size_t row,
                                          std::size_t others_row) const noexcept {
    return squared_distance(at(row), other.at(others_row), rows_.size);
  }

  /// Zeros for rows that take no part.
  void pack_panel(std::size_t first, float* panel) const noexcept {
    const float* rows[panel_rows];
    for (std::size_t k = 0; k < panel_rows; ++k) rows[k] = takes_part(first + k) ? at(first + k) : origin_.data();
    pack(rows, rows_.size, panel);
  }
  /// With rows from `first` on; the last one's again where there are no more.
  void multiply_tile(const float* panel, std::size_t first, PanelProducts (&products)[tile_rows]) const noexcept {
    const float* rows[tile_rows];
    for (std::size_t k = 0; k < tile_rows; ++k) rows[k] = at(std::min(first + k, rows_.count - 1));
    multiply(panel, rows, rows_.size, products);
  }

 private:
  [[nodiscard]] const float* at(std::size_t row) const noexcept { return rows_.values + row * rows_.size; }

  DescriptorRows rows_;
  std::vector<float> origin_;
  std::vector<float> half_norms_;
};

/// ok or bad_rows.
[[nodiscard]] inline Status check_comparable(const DescriptorRows& a, const DescriptorRows& b) noexcept {
  const bool numbered = a.count < no_row && b.count < no_row;
  return validate(a) == Status::ok && validate(b) == Status::ok && a.size == b.size && numbered ? Status::ok
                                                                                                : Status::bad_rows;
}

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
          PanelProducts products[tile_rows];
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
void for_candidates(const ComparedRows& queries, std::size_t first, float half_norm, const PanelProducts& products,
                    const Limits& limits, const Consider& consider) {
  for (std::size_t k = 0; k < panel_rows; k += simd::lanes) {
    const std::size_t query = first + k;
    const simd::F32 half_norms = simd::load(queries.half_norm(query));
    const simd::F32 half_distances = (half_norms - products.of[k / simd::lanes]) + simd::all(half_norm);
    const simd::Mask near = half_distances < limits(query);
    if (!any(near)) continue;
    std::int32_t is_near[simd::lanes];
    simd::store(is_near, keep(near, simd::all_int(1)));
    for (std::size_t lane = 0; lane < simd::lanes; ++lane) {
      if (is_near[lane] != 0 && queries.takes_part(query + lane)) consider(query + lane);
    }
  }
}

/// Puts a match that is nearer than the last of k, which are in ascending order, behind those that are as near.
inline void insert(Match* best, std::size_t k, const Match& match) noexcept {
  std::size_t at = k - 1;
  for (; at > 0 && match.distance < best[at - 1].distance; --at) best[at] = best[at - 1];
  best[at] = match;
}

/// The nearest match of each of `count` rows, among those that all threads have seen, to where the first one's is.
inline void merge(std::vector<Match>& seen, std::size_t count) noexcept {
  for (std::size_t i = count; i < seen.size(); ++i) {
    const Match& match = seen[i];
    Match& best = seen[i % count];
    const bool nearer = match.distance < best.distance;
    if (nearer || (match.distance == best.distance && match.row < best.row)) best = match;
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The k nearest rows of the database for each query, nearest first; of rows at the same distance the first ones come
/// first. Exact: as if all distances were computed as sums of squared differences in float, in a fixed order.
///
/// `k`        from 1 on; meant to be small (an insertion costs O(k))
/// `out`      queries.count * k: those of query i from out[i * k] on. {no_row, infinity} where the database has too few
///            rows that take part, or where the query does not. A row takes part if its status is ok and its squared
///            norm is finite and below 4e37
/// `threads`  how many threads share the work, or an executor (see extract()); the result is the same, bit for bit, for
///            any number, and on every machine
///
/// Statuses: bad_rows (null pointers, rows of different or no length, 2^32 - 1 rows or more), bad_option (k, or more
/// results than memory has room for); `out` is empty then. O(queries.count * database.count * size), at the speed of
/// Eigen's matrix product; a database in the order of falling distances, or of copies, costs a sum of squared
/// differences for each pair on top of it. Allocates `out`, 8 bytes for each query, 4 for each row of the database, and
/// 512 for each value of a row and each thread. May throw what extract() may.
template <class Threads = unsigned>
[[nodiscard]] Status nearest(const DescriptorRows& queries, const DescriptorRows& database, std::size_t k,
                             std::vector<Match>& out, Threads&& threads = 1u) {
  out.clear();
  const Status usable = detail::check_comparable(queries, database);
  if (usable != Status::ok) return usable;
  if (k == 0 || queries.count > out.max_size() / k) return Status::bad_option;

  out.assign(queries.count * k, {no_row, detail::out_of_reach});
  const detail::ComparedRows from(queries);
  const detail::ComparedRows to(database);
  std::vector<float> half_worst(detail::ComparedRows::whole_panels(queries.count), 0.5f * detail::out_of_reach);
  auto&& executor = detail::executor_of(threads, (queries.count + detail::query_block - 1) / detail::query_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  const auto limits = [&](std::size_t q) { return extend::simd::load(half_worst.data() + q); };
  const auto compare = [&](std::size_t, std::size_t first, std::size_t row, const detail::PanelProducts& products) {
    detail::for_candidates(from, first, *to.half_norm(row), products, limits, [&](std::size_t q) {
      Match* const best = out.data() + q * k;
      const float distance = from.squared_distance_to(to, q, row);
      if (!(distance < best[k - 1].distance)) return;
      detail::insert(best, k, {static_cast<std::uint32_t>(row), distance});
      half_worst[q] = 0.5f * best[k - 1].distance;
    });
  };
  detail::for_products(executor, team, from, to, compare);
  for (Match& match : out) {
    match.distance = match.row == no_row ? std::numeric_limits<float>::infinity() : extend::simd::sqrt(match.distance);
  }
  return Status::ok;
}

/// The pairs of rows that are each other's nearest neighbor as nearest() has it, in ascending order of the source: one
/// pass over the products gives both directions.
///
/// `threads`, statuses, the rows that take part, cost and memory: as for nearest(). Allocates 8 bytes more for each row
/// of the source, and for each row of the target and each thread.
template <class Threads = unsigned>
[[nodiscard]] Status reciprocal_correspondences(const DescriptorRows& source, const DescriptorRows& target,
                                                std::vector<MatchedPair>& out, Threads&& threads = 1u) {
  out.clear();
  const Status usable = detail::check_comparable(source, target);
  if (usable != Status::ok) return usable;

  const detail::ComparedRows from(source);
  const detail::ComparedRows to(target);
  auto&& executor = detail::executor_of(threads, (source.count + detail::query_block - 1) / detail::query_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  const Match none{no_row, detail::out_of_reach};
  std::vector<Match> of_source(source.count, none);
  std::vector<float> half_worst(detail::ComparedRows::whole_panels(source.count), 0.5f * detail::out_of_reach);
  std::vector<Match> of_target(team * target.count, none);  // what each thread has seen, one after the other
  const auto compare = [&](std::size_t thread, std::size_t first, std::size_t t,
                           const detail::PanelProducts& products) {
    Match& nearest_source = of_target[thread * target.count + t];
    const extend::simd::F32 half_distance = extend::simd::all(0.5f * nearest_source.distance);
    const auto limits = [&](std::size_t s) {
      return extend::simd::max(extend::simd::load(half_worst.data() + s), half_distance);
    };
    detail::for_candidates(from, first, *to.half_norm(t), products, limits, [&](std::size_t s) {
      const float distance = from.squared_distance_to(to, s, t);
      if (distance < nearest_source.distance) nearest_source = {static_cast<std::uint32_t>(s), distance};
      if (!(distance < of_source[s].distance)) return;
      of_source[s] = {static_cast<std::uint32_t>(t), distance};
      half_worst[s] = 0.5f * distance;
    });
  };
  detail::for_products(executor, team, from, to, compare);
  detail::merge(of_target, target.count);
  for (std::size_t s = 0; s < source.count; ++s) {
    const Match& match = of_source[s];
    if (match.row == no_row || of_target[match.row].row != s) continue;
    out.push_back({static_cast<std::uint32_t>(s), match.row, extend::simd::sqrt(match.distance)});
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
