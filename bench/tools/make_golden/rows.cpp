#include "rows.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "unit/oracle.hpp"
#include "unit/oracle_compact.hpp"

namespace shortshot_bench::make_golden {
namespace {

std::vector<oracle::Neighbor> neighbors_of(const Cloud& cloud, std::int32_t keypoint) {
  return oracle::neighbors(cloud.points, cloud.point(static_cast<std::size_t>(keypoint)), radius * radius);
}

oracle::ShotFrame frame_at(const float* axes) { return oracle::given_frame(axes, axes + 3, axes + 6); }

}  // namespace

Frames make_frames(const Cloud& cloud) {
  constexpr float identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  Frames frames;
  for (const std::int32_t keypoint : cloud.keypoints) {
    const std::vector<oracle::Neighbor> neighbors = neighbors_of(cloud, keypoint);
    const std::array<float, 3> key = cloud.point(static_cast<std::size_t>(keypoint));
    const oracle::ShotFrame shot = oracle::shot_frame(neighbors, static_cast<double>(radius));
    const oracle::ShotFrame frame =
        shot.exists ? oracle::compact::turned_to(shot, {camera[0] - key[0], camera[1] - key[1], camera[2] - key[2]})
                    : frame_at(identity);
    for (const oracle::Vec3f& axis : {frame.x, frame.y, frame.z}) {
      frames.axes.insert(frames.axes.end(), axis.begin(), axis.end());
    }
    frames.neighbors.push_back(static_cast<std::int32_t>(neighbors.size()));
  }
  return frames;
}

std::vector<Rows> make_rows(const Cloud& cloud, const std::vector<float>& frames) {
  std::vector<Rows> result;
  for (const oracle::compact::Named& descriptor : oracle::compact::named) {
    Rows rows{descriptor.name, descriptor.size, {}, {}};
    for (std::size_t k = 0; k < cloud.keypoints.size(); ++k) {
      const std::vector<oracle::compact::Seen> seen =
          oracle::compact::seen(neighbors_of(cloud, cloud.keypoints[k]), cloud.rgb, frame_at(&frames[9 * k]), radius);
      const bool is_alone = seen.empty();
      const std::vector<double> values =
          is_alone ? std::vector<double>(rows.size, std::numeric_limits<double>::quiet_NaN()) : descriptor.of(seen);
      const std::vector<std::uint8_t> nibbles =
          oracle::compact::nibbles(descriptor, is_alone ? std::vector<double>(rows.size, 0.0) : values);
      std::copy(values.begin(), values.end(), std::back_inserter(rows.values));
      std::copy(nibbles.begin(), nibbles.end(), std::back_inserter(rows.nibbles));
    }
    result.push_back(rows);
  }
  return result;
}

}  // namespace shortshot_bench::make_golden
