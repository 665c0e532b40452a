#include "paper/truth.hpp"

#include <cmath>

namespace shortshot_bench::paper {

Place place_of(const shortshot::Point& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

Place moved(const datasets::RigidMotion& t, const Place& p) {
  Place q{};
  for (std::size_t i = 0; i < 3; ++i) q[i] = t[4 * i] * p[0] + t[4 * i + 1] * p[1] + t[4 * i + 2] * p[2] + t[4 * i + 3];
  return q;
}

double distance(const Place& a, const Place& b) {  // of rooms: std::hypot() takes ten times as long
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

Truth::Truth(const datasets::RigidMotion& motion, const View& source, const View& target, float correct_distance)
    : targets_(target.keypoints().size()) {
  for (const shortshot::KeyPoint& s : source.keypoints()) {
    const Place place = moved(motion, place_of(s.position));
    bool any = false;
    for (const shortshot::KeyPoint& t : target.keypoints()) {
      right_.push_back(distance(place, place_of(t.position)) <= static_cast<double>(correct_distance));
      any = any || right_.back();
    }
    matchable_.push_back(any);
  }
}

RightMatches count_right_nearest(const Described& source, const Described& target, const Truth& truth) {
  std::vector<shortshot::Match> nearest;
  require(shortshot::nearest(source.rows().descriptors, target.rows().descriptors, 1, nearest));
  RightMatches count;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (!truth.is_matchable(i)) continue;
    ++count.of;
    if (nearest[i].row != shortshot::no_row && truth.is_right(i, nearest[i].row)) ++count.right;
  }
  return count;
}

ReciprocalMatches match_reciprocally(const Described& source, const Described& target, const Truth& truth) {
  std::vector<shortshot::MatchedPair> correspondences;
  require(shortshot::reciprocal_correspondences(source.rows().descriptors, target.rows().descriptors, correspondences));
  ReciprocalMatches matches;
  for (const shortshot::MatchedPair& c : correspondences) {
    matches.pairs.push_back({source.keypoints[c.source].position, target.keypoints[c.target].position});
    if (truth.is_right(c.source, c.target)) ++matches.right;
  }
  return matches;
}

}  // namespace shortshot_bench::paper
