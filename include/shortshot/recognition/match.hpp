// shortshot/recognition/match.hpp: the nearest descriptors of another set, exactly, and pairs that are each other's
// nearest. Hosted only: allocates, starts threads. Needs Eigen.
//
// |a - b|^2 = |a|^2 + |b|^2 - 2 ab makes of all distances one matrix product, two to six times as fast as sums of
// squared differences (SSE2, AVX2), but cancellation costs it digits where rows are close. So the product only rules
// out: where, by a bound on its rounding, a row may be nearer than the best so far, the distance is computed again as a
// sum of squared differences, and that decides. In rows of no particular order that is so for about log(count) rows of
// each query.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../batch/executor.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "descriptor_rows.hpp"

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

/// Rows of queries and of the database in one product: with fewer, more of the time goes into Eigen's packing.
inline constexpr std::size_t product_rows = 128;
inline constexpr std::size_t product_columns = 1024;

using Products = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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
  explicit ComparedRows(const DescriptorRows& rows) : rows_(rows), half_norms_(rows.count, out_of_reach) {
    const auto size = static_cast<float>(rows.size);
    const float kept = 1.0f - 5.0f * (size + 16.0f) * (1.0f / 16777216.0f);
    const float underflow = size * std::numeric_limits<float>::min();
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (!is_ok(rows, i)) continue;
      const float norm = block(i, i + 1).squaredNorm();
      if (math::is_finite(8.0f * norm)) half_norms_[i] = 0.5f * kept * norm - underflow;
    }
  }

  [[nodiscard]] std::size_t count() const noexcept { return rows_.count; }
  [[nodiscard]] float half_norm(std::size_t row) const noexcept { return half_norms_[row]; }
  [[nodiscard]] bool takes_part(std::size_t row) const noexcept { return half_norms_[row] < out_of_reach; }

  [[nodiscard]] Eigen::Map<const Products> block(std::size_t begin, std::size_t end) const noexcept {
    return {at(begin), static_cast<Eigen::Index>(end - begin), static_cast<Eigen::Index>(rows_.size)};
  }
  [[nodiscard]] float squared_distance_to(const ComparedRows& other, std::size_t row,
                                          std::size_t others_row) const noexcept {
    return squared_distance(at(row), other.at(others_row), rows_.size);
  }

 private:
  [[nodiscard]] const float* at(std::size_t row) const noexcept { return rows_.values + row * rows_.size; }

  DescriptorRows rows_;
  std::vector<float> half_norms_;
};

/// ok or bad_rows.
[[nodiscard]] inline Status check_comparable(const DescriptorRows& a, const DescriptorRows& b) noexcept {
  const bool numbered = a.count < no_row && b.count < no_row;
  return validate(a) == Status::ok && validate(b) == Status::ok && a.size == b.size && numbered ? Status::ok
                                                                                                : Status::bad_rows;
}

/// Shares blocks of queries among threads. compare(thread, q, first, last, products) is called for each query that
/// takes part, with its products with rows [first, last) of the database; one thread gets queries, and rows, in
/// ascending order.
template <class Executor, class Compare>
void for_products(Executor& executor, std::size_t team, const ComparedRows& queries, const ComparedRows& database,
                  const Compare& compare) {
  const auto rows = static_cast<Eigen::Index>(std::min(queries.count(), product_rows));
  const auto columns = static_cast<Eigen::Index>(std::min(database.count(), product_columns));
  std::vector<Products> memory(team, Products(rows, columns));
  const auto compare_block = [&](std::size_t thread, std::size_t begin, std::size_t end) {
    Products& products = memory[thread];
    for (std::size_t first = 0; first < database.count(); first += product_columns) {
      const std::size_t last = std::min(first + product_columns, database.count());
      products.topLeftCorner(static_cast<Eigen::Index>(end - begin), static_cast<Eigen::Index>(last - first))
          .noalias() = queries.block(begin, end) * database.block(first, last).transpose();
      for (std::size_t q = begin; q < end; ++q) {
        if (!queries.takes_part(q)) continue;
        compare(thread, q, first, last, &products(static_cast<Eigen::Index>(q - begin), 0));
      }
    }
  };
  for_blocks(executor, team, queries.count(), product_rows, compare_block);
}

/// Puts a match that is nearer than the last of k, which are in ascending order, behind those that are as near.
inline void insert(Match* best, std::size_t k, const Match& match) noexcept {
  std::size_t at = k - 1;
  for (; at > 0 && match.distance < best[at - 1].distance; --at) best[at] = best[at - 1];
  best[at] = match;
}

/// The nearest match of each row among those that the threads have seen.
[[nodiscard]] inline std::vector<Match> nearest_of_all(const std::vector<std::vector<Match>>& seen) {
  std::vector<Match> best = seen.front();
  for (const std::vector<Match>& matches : seen) {
    for (std::size_t i = 0; i < best.size(); ++i) {
      const Match& match = matches[i];
      const bool nearer = match.distance < best[i].distance;
      if (nearer || (match.distance == best[i].distance && match.row < best[i].row)) best[i] = match;
    }
  }
  return best;
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
/// differences for each pair on top of it. Allocates `out`, 4 bytes for each row of both, and for each thread 128 x
/// 1024 products (512 KB) and Eigen's copies of the factors (below 5 KB for each value of a row). May throw what
/// extract() may. In programs that are compiled with -fopenmp, Eigen starts threads of its own unless
/// Eigen::setNbThreads(1) was called.
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
  auto&& executor = detail::executor_of(threads, (queries.count + detail::product_rows - 1) / detail::product_rows);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  const auto compare = [&](std::size_t, std::size_t q, std::size_t first, std::size_t last, const float* products) {
    Match* const best = out.data() + q * k;
    const float& worst = best[k - 1].distance;
    for (std::size_t row = first; row < last; ++row) {
      const float half_distance = (from.half_norm(q) - products[row - first]) + to.half_norm(row);
      if (!(half_distance < 0.5f * worst)) continue;
      const float distance = from.squared_distance_to(to, q, row);
      if (distance < worst) detail::insert(best, k, {static_cast<std::uint32_t>(row), distance});
    }
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
  auto&& executor = detail::executor_of(threads, (source.count + detail::product_rows - 1) / detail::product_rows);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  const Match none{no_row, detail::out_of_reach};
  std::vector<Match> of_source(source.count, none);
  std::vector<std::vector<Match>> of_target(team, std::vector<Match>(target.count, none));  // what each thread has seen
  const auto compare = [&](std::size_t thread, std::size_t s, std::size_t first, std::size_t last,
                           const float* products) {
    Match& nearest_target = of_source[s];
    Match* const nearest_source = of_target[thread].data();
    for (std::size_t t = first; t < last; ++t) {
      const float half_distance = (from.half_norm(s) - products[t - first]) + to.half_norm(t);
      if (!(half_distance < 0.5f * std::max(nearest_target.distance, nearest_source[t].distance))) continue;
      const float distance = from.squared_distance_to(to, s, t);
      if (distance < nearest_target.distance) nearest_target = {static_cast<std::uint32_t>(t), distance};
      if (distance < nearest_source[t].distance) nearest_source[t] = {static_cast<std::uint32_t>(s), distance};
    }
  };
  detail::for_products(executor, team, from, to, compare);
  const std::vector<Match> sources = detail::nearest_of_all(of_target);
  for (std::size_t s = 0; s < source.count; ++s) {
    const Match& match = of_source[s];
    if (match.row == no_row || sources[match.row].row != s) continue;
    out.push_back({static_cast<std::uint32_t>(s), match.row, extend::simd::sqrt(match.distance)});
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
