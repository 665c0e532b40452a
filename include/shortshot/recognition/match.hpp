// shortshot/recognition/match.hpp: the nearest descriptors of another set, exactly; pairs that are each other's
// nearest; and those that are nearer than all others by far. Hosted only: allocates, starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "../base/unfused.hpp"
#include "../batch/executor.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "compare_packed.hpp"
#include "compare_rows.hpp"
#include "descriptor_rows.hpp"
#include "half_rows.hpp"
#include "packed_rows.hpp"
#include "row_format.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// In place of a row's number where there is none.
inline constexpr std::uint32_t no_row = 0xFFFFFFFFu;

/// A row of the database and its distance from the query.
struct Match {
  std::uint32_t row;  ///< in the database; no_row: none
  float distance;     ///< from the query, as its format counts; larger: farther
};

/// A row of each of two sets, and their distance.
struct MatchedPair {
  std::uint32_t source;  ///< row of the first set
  std::uint32_t target;  ///< row of the second set
  float distance;        ///< as their format counts
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Rows, class Number>
[[nodiscard]] float distance_of(const Rows& rows, const Candidate<Number>& candidate) {
  if (candidate.row == no_row) return std::numeric_limits<float>::infinity();
  return Comparison<Rows>::distance(rows, candidate.compared);
}

/// ok or bad_rows.
template <class Rows>
[[nodiscard]] Status check_comparable(const Rows& a, const Rows& b) {
  constexpr bool is_float = std::is_same<Rows, DescriptorRows>::value || std::is_same<Rows, HalfRows>::value;
  if constexpr (!is_float) require_row_format<Rows>();
  const bool numbered = a.count < no_row && b.count < no_row;
  return numbered && Comparison<Rows>::fit(a, b) ? Status::ok : Status::bad_rows;
}

template <class Executor>
[[nodiscard]] std::size_t team_of(const Executor& executor) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
}

/// Blocks of queries, of which there are `count`.
[[nodiscard]] inline std::size_t query_blocks(std::size_t count) noexcept {
  return (count + query_block - 1) / query_block;
}

/// Puts a candidate that is nearer than the last of k, which are in ascending order, behind those that are as near.
template <class Number>
void insert(Candidate<Number>* best, std::size_t k, const Candidate<Number>& candidate) noexcept {
  std::size_t at = k - 1;
  for (; at > 0 && candidate.compared < best[at - 1].compared; --at) best[at] = best[at - 1];
  best[at] = candidate;
}

/// The nearest candidate of each of `count` rows, among those that all threads have seen, to where the first one's is.
template <class Number>
void merge(std::vector<Candidate<Number>>& seen, std::size_t count) noexcept {
  for (std::size_t i = count; i < seen.size(); ++i) {
    const Candidate<Number>& candidate = seen[i];
    Candidate<Number>& best = seen[i % count];
    const bool nearer = candidate.compared < best.compared;
    if (nearer || (candidate.compared == best.compared && candidate.row < best.row)) best = candidate;
  }
}

/// k for each query, nearest first; no_row where there is none.
template <class Rows, class Executor>
[[nodiscard]] auto nearest_candidates(const Rows& queries, const Rows& database, std::size_t k, Executor& executor) {
  using Compared = typename Comparison<Rows>::Compared;
  using Number = typename Compared::Number;
  const Compared from(queries);
  const Compared to(database);
  typename Comparison<Rows>::Limits limits(from);
  std::vector<Candidate<Number>> best(queries.count * k, {no_row, Compared::farthest});
  for_near(executor, team_of(executor), from, to, limits, nullptr, [&](std::size_t, std::size_t q, std::size_t row) {
    Candidate<Number>* const of_query = best.data() + q * k;
    const Number compared = from.compare(q, to, row);
    if (!(compared < of_query[k - 1].compared)) return;
    insert(of_query, k, {static_cast<std::uint32_t>(row), compared});
    limits.set(q, of_query[k - 1].compared);
  });
  return best;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The k nearest rows of the database for each query, nearest first; of rows at the same distance the first ones come
/// first. Exact: as if all distances were computed.
///
/// `queries`, `database`  DescriptorRows, HalfRows, CodedRows (ByteRows, NibbleRows) or BitRows (see rows_of()), or
/// rows
///            in a format of your own
///            (extend::is_row_format). Distances are L2 for floats (sums of squared differences in float, in a fixed
///            order: l2_distance()), for bytes and nibbles, Hamming for bits
/// `k`        from 1 on; meant to be small (an insertion costs O(k))
/// `out`      queries.count * k: those of query i from out[i * k] on. {no_row, infinity} where the database has too few
///            rows that take part, or where the query does not. A row takes part if its status is ok; one of floats, if
///            its squared norm is finite and below 4e37 besides
/// `threads`  how many threads share the work, or an executor (see extract()); the result is the same, bit for bit, for
///            any number, and on every machine
///
/// Statuses: bad_rows (null pointers, rows of different or no length, 2^32 - 1 rows or more), bad_option (k, or more
/// results than memory has room for); `out` is empty then. O(queries.count * database.count * size), for floats at the
/// speed of Eigen's matrix product, for bytes, nibbles and bits in blocks as well, which stop early where all are far;
/// a database in the order of falling distances, or of copies, costs the distance of each pair on top of it. Allocates
/// `out` twice; for floats also 8 bytes for each query, 4 for each row of the database, and 512 for each value of a row
/// and each thread; for bytes, nibbles and bits 4 bytes for each query, 1 or 2 for each value (or 4 bits) of the
/// database, and for each thread some hundred KB and 256 bytes (SSE2, bits: 2 KB) for each value. May throw what
/// extract() may.
template <class Rows = DescriptorRows, class Threads = unsigned>
[[nodiscard]] Status nearest(const Rows& queries, const Rows& database, std::size_t k, std::vector<Match>& out,
                             Threads&& threads = 1u) {
  out.clear();
  const Status usable = detail::check_comparable(queries, database);
  if (usable != Status::ok) return usable;
  if (k == 0 || queries.count > out.max_size() / 2 / k) return Status::bad_option;

  auto&& executor = detail::executor_of(threads, detail::query_blocks(queries.count));
  const auto best = detail::nearest_candidates(queries, database, k, executor);
  out.assign(best.size(), {no_row, std::numeric_limits<float>::infinity()});  // distances of one's own may throw
  for (std::size_t i = 0; i < best.size(); ++i) out[i] = {best[i].row, detail::distance_of(queries, best[i])};
  return Status::ok;
}

/// The pairs of rows that are each other's nearest neighbor as nearest() has it, in ascending order of the source: one
/// pass over all pairs gives both directions.
///
/// Formats of rows, `threads`, statuses, the rows that take part and cost: as for nearest(). Allocates `out`, 8 bytes
/// for each row of the source, and for each row of the target and each thread; besides what nearest() does.
template <class Rows = DescriptorRows, class Threads = unsigned>
[[nodiscard]] Status reciprocal_correspondences(const Rows& source, const Rows& target, std::vector<MatchedPair>& out,
                                                Threads&& threads = 1u) {
  using Compared = typename detail::Comparison<Rows>::Compared;
  using Number = typename Compared::Number;
  out.clear();
  const Status usable = detail::check_comparable(source, target);
  if (usable != Status::ok) return usable;

  const Compared from(source);
  const Compared to(target);
  auto&& executor = detail::executor_of(threads, detail::query_blocks(source.count));
  const std::size_t team = detail::team_of(executor);
  const detail::Candidate<Number> none{no_row, Compared::farthest};
  typename detail::Comparison<Rows>::Limits limits(from);
  std::vector<detail::Candidate<Number>> of_source(source.count, none);
  std::vector<detail::Candidate<Number>> of_target(team * target.count, none);  // what each thread has seen
  const auto consider = [&](std::size_t thread, std::size_t s, std::size_t t) {
    const Number compared = from.compare(s, to, t);
    detail::Candidate<Number>& nearest_source = of_target[thread * target.count + t];
    if (compared < nearest_source.compared) nearest_source = {static_cast<std::uint32_t>(s), compared};
    if (!(compared < of_source[s].compared)) return;
    of_source[s] = {static_cast<std::uint32_t>(t), compared};
    limits.set(s, compared);
  };
  detail::for_near(executor, team, from, to, limits, of_target.data(), consider);
  detail::merge(of_target, target.count);
  for (std::size_t s = 0; s < source.count; ++s) {
    const detail::Candidate<Number>& candidate = of_source[s];
    if (candidate.row == no_row || of_target[candidate.row].row != s) continue;
    out.push_back({static_cast<std::uint32_t>(s), candidate.row, detail::distance_of(source, candidate)});
  }
  return Status::ok;
}

/// The pairs of each row of the source with its nearest one of the target, as nearest() has it, that are told from all
/// others: the distance is below `ratio` times that of the second nearest. In ascending order of the source.
///
/// After D. Lowe: Distinctive image features from scale-invariant keypoints (IJCV 60, 2004), where 0.8 is the ratio.
///
/// `ratio`  above 0, at most 1, which leaves out only rows whose two nearest are as near. Distances are compared as
///          Match has them, the product rounded to float: the same pairs on every machine. A target of fewer than two
///          rows that take part has no second nearest, and there is no pair: nothing says that one would be right
///
/// Formats of rows, `threads`, the rows that take part and cost: as for nearest(). Statuses: bad_rows, as there, and
/// bad_option (ratio); `out` is empty then. Allocates `out`, 16 bytes for each row of the source, and what nearest()
/// does besides.
template <class Rows = DescriptorRows, class Threads = unsigned>
[[nodiscard]] Status ratio_correspondences(const Rows& source, const Rows& target, float ratio,
                                           std::vector<MatchedPair>& out, Threads&& threads = 1u) {
  out.clear();
  const Status usable = detail::check_comparable(source, target);
  if (usable != Status::ok) return usable;
  if (!(ratio > 0.0f && ratio <= 1.0f)) return Status::bad_option;

  auto&& executor = detail::executor_of(threads, detail::query_blocks(source.count));
  const auto best = detail::nearest_candidates(source, target, 2, executor);
  for (std::size_t s = 0; s < source.count; ++s) {
    const auto& first = best[2 * s];
    const auto& second = best[2 * s + 1];
    if (second.row == no_row) continue;
    const float distance = detail::distance_of(source, first);
    if (!(distance < extend::unfused(ratio * detail::distance_of(source, second)))) continue;
    out.push_back({static_cast<std::uint32_t>(s), first.row, distance});
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
