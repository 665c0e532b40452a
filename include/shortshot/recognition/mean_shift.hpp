// shortshot/recognition/mean_shift.hpp: the maxima of a density of many votes in space. Hosted only: allocates.
#pragma once

#include <cstddef>

#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "climb.hpp"
#include "vote_cells.hpp"
#include "vote_centers.hpp"
#include "vote_centers_list.hpp"
#include "vote_density.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Climbs from votes (finite, borrowed, of one class) to the maxima of their density. The result is that of a look at
/// all votes for each step, bit for bit. Only constructors allocate; see VoteCells.
class MeanShift {
 public:
  /// What a thread needs for climbs among up to `most` votes, and keeps from one to the next: those close to a place.
  /// Not to be used after the end of a MeanShift that has used it.
  class Memory {
   public:
    explicit Memory(std::size_t most) : search_(most), close_(most) {}
    Memory(Memory&&) = default;  // a copy would have no room
    Memory(const Memory&) = delete;

   private:
    friend class MeanShift;
    VoteCells::Memory search_;
    VoteCentersList close_;
    Point middle_{};
    const MeanShift* owner_ = nullptr;
  };

  MeanShift(const Vote* begin, const Vote* end, float bandwidth)
      : density_(bandwidth), cells_(begin, end, close * bandwidth) {}

  /// The maximum where the mean shift from a vote ends, after 100 steps at the most. Cheapest where the last climb with
  /// the same memory, since this was made, began or ended close by.
  [[nodiscard]] Peak climb(const Vote& vote, Memory& memory) const noexcept {
    return detail::climb(density_, vote.center, [&](const Point& at) { return reachable(at, memory); });
  }

  /// The votes' indices, those that are close to each other one after the other.
  template <class Function>
  void for_each_vote(const Function& f) const {
    cells_.for_each_by_cells(f);
  }

 private:
  static constexpr float margin = 0.75f;  // how far from its middle a list of what is close is good, in bandwidths
  static constexpr float close = 1.001f * (VoteDensity::reach + margin);

  /// All votes in reach of a place, and few others.
  [[nodiscard]] VoteCenters reachable(const Point& at, Memory& memory) const noexcept {
    const float bandwidth = density_.bandwidth();
    const bool known = memory.owner_ == this &&
                       squared_distance(at, memory.middle_) < extend::unfused(margin * bandwidth * margin * bandwidth);
    if (!known) {
      memory.close_.assign_close(cells_.around(at, memory.search_), at, close * bandwidth);
      memory.middle_ = at;
      memory.owner_ = this;
    }
    return memory.close_.centers();
  }

  VoteDensity density_;
  VoteCells cells_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
