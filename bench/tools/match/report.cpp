#include "tools/match/report.hpp"

#include <array>
#include <cstdio>

#include "tools/match/pictures.hpp"

namespace shortshot_bench {
namespace {

/// Of B on A: where that was all, poses were found that some edge determines, and nothing beside it.
constexpr float little = 0.25f;

double number(float v) { return static_cast<double>(v); }

void print_pose(const MatchResult& result) {
  std::printf("  inliers             %zu within %.2g, %.2g x %.2g x %.2g large (standard deviations)\n",
              result.inliers.size(), number(result.reach), number(result.extent[0]), number(result.extent[1]),
              number(result.extent[2]));
  std::printf(
      "  by chance           10^%.1f poses as good: a wrong pair agrees with a probability of %.2g; of %zu places "
      "that\n",
      result.chance.log10_expected, result.chance.agreement, result.chance.at.places);
  std::printf("  %-19s are %.2g apart the pair that is most alike agrees at %zu, and any one at %zu\n", "",
              number(result.radius), result.chance.at.nearest, result.chance.at.any);
}

}  // namespace

std::string pose_text(const shortshot::Pose& pose) {
  std::string text;
  std::array<char, 120> line{};
  for (std::size_t row = 0; row < 3; ++row) {
    const float* const r = pose.rotation + 3 * row;
    std::snprintf(line.data(), line.size(), "%.9g %.9g %.9g %.9g\n", number(r[0]), number(r[1]), number(r[2]),
                  number(pose.translation[row]));
    text += line.data();
  }
  return text + "0 0 0 1\n";
}

void print_report(const MatchResult& result, double milliseconds) {
  std::printf("  lengths             in the clouds' unit: radius %g, leaf %g; points lie %.2g apart\n",
              number(result.radius), number(result.leaf), number(result.spacing));
  std::printf("  key points          %zu in A, %zu in B, by %s\n", result.a.size(), result.b.size(),
              result.descriptor.c_str());
  std::printf("  pairs               %zu that are each other's nearest; %.0f ms in all\n", result.rows.size(),
              milliseconds);
  if (result.inliers.size() >= 3) print_pose(result);
  if (result.is_found) {
    std::printf("  refined             %.0f %% of B's points lie on A, %.2g off (root mean square)\n",
                100.0 * number(result.fit.share), number(result.fit.deviation));
    std::printf("  pose                B is turned by %.1f degrees; A = pose * B:\n%s", degrees_of(result.pose),
                pose_text(result.pose).c_str());
    if (result.fit.share < little) std::printf("note: little of B lies on A; look at both before you trust the pose\n");
  }
  std::printf("%s\n", verdict_of(result).c_str());
}

std::string quiet_line(const MatchResult& result) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%d %zu %zu %zu %zu %.2f %.3f", result.is_found ? 1 : 0,
                result.inliers.size(), result.rows.size(), result.chance.at.any, result.chance.at.places,
                result.chance.log10_expected, number(result.fit.share));
  std::string line = text.data();
  const shortshot::Pose pose = result.is_found ? result.pose : shortshot::Pose{};
  for (std::size_t k = 0; k < 12; ++k) {
    const float v = k % 4 < 3 ? pose.rotation[3 * (k / 4) + k % 4] : pose.translation[k / 4];
    std::snprintf(text.data(), text.size(), " %.9g", number(v));
    line += text.data();
  }
  return line;
}

}  // namespace shortshot_bench
