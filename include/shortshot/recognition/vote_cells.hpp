// shortshot/recognition/vote_cells.hpp: which votes may be close to a place, without a look at all of them. Hosted
// only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "vote_centers.hpp"
#include "vote_centers_list.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes (borrowed, finite) in cubic cells. For each cell that has votes, those in it and in the cells next to it are
/// listed once, as they are ordered.
///
/// A cell is known by the number of its row and its place in it. Rows that are far from each other may have the same
/// number, and 2^53 cells from the origin and beyond there is but one: some votes too many are found then, but none is
/// missing. Allocates about 70 bytes for each vote, and 12 for each list that a vote is in: one where votes are sparse,
/// at most 27 (twice as much for a moment, as vectors grow).
class VoteCells {
 public:
  /// What a search for votes needs, without allocating.
  struct Memory {
    explicit Memory(std::size_t most) : centers(most) { indices.reserve(most); }
    std::vector<std::size_t> indices;
    VoteCentersList centers;
  };

  VoteCells(const Vote* begin, const Vote* end, float distance)
      : votes_(begin),
        units_per_meter_(extend::math::power_of_two_below(512.0f / distance)),
        farthest_(most_units / units_per_meter_),
        cell_(static_cast<std::int64_t>(distance * units_per_meter_) + 2) {
    const auto count = static_cast<std::size_t>(end - begin);
    members_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) members_.push_back({cell_of(begin[i].center), i});
    std::sort(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
      return a.cell < b.cell || (!(b.cell < a.cell) && a.vote < b.vote);
    });
    std::vector<std::size_t> indices;
    indices.reserve(count);
    for (const Member& member : members_) {
      if (lists_.empty() || lists_.back().cell < member.cell) write_list(member.cell, indices);
    }
  }

  /// All votes within the distance of a place, and others, as they are ordered; here or in `memory`.
  [[nodiscard]] VoteCenters around(const Point& place, Memory& memory) const noexcept {
    const Cell cell = cell_of(place);
    const auto list = std::lower_bound(lists_.begin(), lists_.end(), cell,
                                       [](const List& one, const Cell& other) { return one.cell < other; });
    if (list != lists_.end() && !(cell < list->cell)) {
      const float* const x = xyz_.data() + list->begin;
      return {x, x + list->padded, x + 2 * list->padded, list->padded};
    }
    find_around(cell, memory.indices);
    memory.centers.assign(votes_, memory.indices);
    return memory.centers.centers();
  }

  /// The votes' indices, cell by cell.
  template <class Function>
  void for_each_by_cells(const Function& f) const {
    for (const Member& member : members_) f(member.vote);
  }

 private:
  struct Cell {
    std::uint64_t row;
    std::int64_t x;
    [[nodiscard]] bool operator<(const Cell& other) const noexcept {
      return row < other.row || (row == other.row && x < other.x);
    }
  };
  struct Member {
    Cell cell;
    std::size_t vote;
  };
  struct List {
    Cell cell;
    std::size_t begin;
    std::size_t padded;
  };

  /// Rounded down to whole units exactly, and then to whole cells: how far from the origin does not matter.
  [[nodiscard]] std::int64_t along(float coordinate) const noexcept {
    const float near_by = coordinate > farthest_ ? farthest_ : coordinate < -farthest_ ? -farthest_ : coordinate;
    const float position = near_by * units_per_meter_;
    auto units = static_cast<std::int64_t>(position);
    if (static_cast<float>(units) > position) --units;
    return (units < 0 ? units - (cell_ - 1) : units) / cell_;
  }

  /// Modulo 2^64, with steps of which no sum of a few is zero.
  [[nodiscard]] static std::uint64_t row(std::int64_t y, std::int64_t z) noexcept {
    return static_cast<std::uint64_t>(y) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(z) * 0xC2B2AE3D27D4EB4Fu;
  }

  [[nodiscard]] Cell cell_of(const Point& p) const noexcept { return {row(along(p.y), along(p.z)), along(p.x)}; }

  /// The votes in a cell and in the 26 next to it.
  void find_around(const Cell& cell, std::vector<std::size_t>& indices) const noexcept {
    indices.clear();
    for (std::int64_t z = -1; z <= 1; ++z) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        const Cell first{cell.row + row(y, z), cell.x - 1};
        const Cell last{first.row, cell.x + 1};
        auto member = std::lower_bound(members_.begin(), members_.end(), first,
                                       [](const Member& one, const Cell& other) { return one.cell < other; });
        for (; member != members_.end() && !(last < member->cell); ++member) indices.push_back(member->vote);
      }
    }
    std::sort(indices.begin(), indices.end());
  }

  void write_list(const Cell& cell, std::vector<std::size_t>& indices) {
    find_around(cell, indices);
    const List list{cell, xyz_.size(), padded(indices.size())};
    xyz_.resize(list.begin + 3 * list.padded);
    float* const x = xyz_.data() + list.begin;
    write_centers(votes_, indices, x, x + list.padded, x + 2 * list.padded);
    lists_.push_back(list);
  }

  static constexpr float most_units = 4611686018427387904.0f;  // 2^62

  const Vote* votes_;
  float units_per_meter_;  // a power of two
  float farthest_;
  std::int64_t cell_;            // how wide, in units: the distance, and 2 for what is rounded
  std::vector<Member> members_;  // in ascending order of cells, then of votes
  std::vector<List> lists_;      // in ascending order of cells
  std::vector<float> xyz_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
