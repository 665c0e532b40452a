// Where one cloud is in another: key points, descriptors, pairs of them, a pose, and how sure it is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/io/rgbd_cloud.hpp"
#include "tools/match/chance.hpp"
#include "tools/match/refine.hpp"

namespace shortshot_bench {

struct MatchOptions {
  float radius = 0.0f;     // of the supports; 0: suggested for both clouds together
  float leaf = 0.0f;       // of the key points; 0: a quarter of the radius
  double expected = 0.01;  // found: chance would find fewer poses as good as that
  std::uint32_t tries = 50000;
  unsigned threads = 1;
};

struct MatchResult {
  std::string descriptor;
  float spacing = 0.0f;  // of the cloud whose points lie farther apart
  float radius = 0.0f;
  float leaf = 0.0f;
  float reach = 0.0f;                        // inliers are nearer to their targets
  std::vector<shortshot::Point> a, b;        // key points that were described
  std::vector<shortshot::MatchedPair> rows;  // from b to a: each other's nearest
  std::vector<std::uint32_t> inliers;        // of these
  Chance chance;
  float extent[3] = {};    // of the inliers in b, along their principal axes, longest first: standard deviations
  shortshot::Pose pose{};  // a = pose * b, refined
  Fit fit;                 // of b's surface to a's, under it
  bool is_found = false;

  shortshot::Point in_a(std::uint32_t pair) const { return a[rows[pair].target]; }
  shortshot::Point in_b(std::uint32_t pair) const { return b[rows[pair].source]; }
};

/// With colors where both clouds have them. Throws std::runtime_error with the library's own words for a cloud that
/// cannot be described; that nothing is found is no error.
MatchResult match_clouds(const RgbdCloud& a, const RgbdCloud& b, const MatchOptions& options);

/// What the fit of a result was measured with.
RefineOptions refine_options_of(const MatchResult& result);

/// The angle of a pose's rotation.
double degrees_of(const shortshot::Pose& pose);
/// The angle between the rotations of both.
double degrees_between(const shortshot::Pose& a, const shortshot::Pose& b);

/// The same points, moved; colors stay.
RgbdCloud moved(const RgbdCloud& cloud, const shortshot::Pose& pose);

}  // namespace shortshot_bench
