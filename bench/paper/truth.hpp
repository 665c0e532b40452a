// Where the key points of one view truly lie in another one, and which matches are right therefore.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "paper/configuration.hpp"
#include "paper/datasets/rigid_motion.hpp"
#include "paper/view.hpp"

namespace shortshot_bench::paper {

using Place = std::array<double, 3>;

Place place_of(const shortshot::Point& p);
Place moved(const datasets::RigidMotion& motion, const Place& p);
double distance(const Place& a, const Place& b);

/// Which of the target's key points lie where those of the source truly are, at most `correct_distance` meters away.
class Truth {
 public:
  Truth(const datasets::RigidMotion& motion, const View& source, const View& target, float correct_distance);

  bool is_matchable(std::size_t source) const { return matchable_[source]; }  // has a counterpart
  bool is_right(std::size_t source, std::size_t target) const { return right_[source * targets_ + target]; }

 private:
  std::size_t targets_;
  std::vector<bool> right_;
  std::vector<bool> matchable_;
};

struct RightMatches {
  std::size_t right = 0;
  std::size_t of = 0;
};

/// Of the source's key points that have a counterpart, those whose nearest neighbor is one.
RightMatches count_right_nearest(const Described& source, const Described& target, const Truth& truth);

/// Reciprocal nearest neighbors.
struct ReciprocalMatches {
  std::vector<shortshot::PointPair> pairs;
  std::size_t right = 0;
};
ReciprocalMatches match_reciprocally(const Described& source, const Described& target, const Truth& truth);

}  // namespace shortshot_bench::paper
