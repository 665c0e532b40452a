// The README's examples for ROS 2 and for robotics, one after the other: two messages, the second of what the first
// shows turned by a right angle about the camera's axis, and the pose between them.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sensor_msgs/msg/point_cloud2.hpp>

#include "shortshot.hpp"

using Rows = shortshot::StoredFeatures<shortshot::NibbleDescriptor<shortshot::ShapeColor95>>;
shortshot::Status describe(const sensor_msgs::msg::PointCloud2& message, Rows& rows);
shortshot::Status pose_between(const Rows& now, const Rows& before, shortshot::Pose& pose);

namespace {

sensor_msgs::msg::PointCloud2 sheet(bool is_turned) {
  sensor_msgs::msg::PointCloud2 message;
  constexpr std::uint32_t side = 200;
  message.width = side * side;
  message.point_step = 16;
  message.row_step = message.width * message.point_step;
  message.fields = unit::floats_xyz_and({{"rgb", 12, unit::float32, 1}});
  message.data.resize(message.row_step);
  for (std::uint32_t i = 0; i < message.width; ++i) {
    const float x = 0.002f * static_cast<float>(i % side);
    const float y = 0.002f * static_cast<float>(i / side);
    const float place[3] = {is_turned ? -y : x, is_turned ? x : y, 1 + 3 * x * y * (0.3f - x)};
    const std::uint32_t color = i % side << 16 | i / side << 8 | 90u;
    std::memcpy(message.data.data() + 16 * i, place, sizeof place);
    std::memcpy(message.data.data() + 16 * i + 12, &color, sizeof color);
  }
  return message;
}

}  // namespace

int main() {
  Rows before, now;
  if (describe(sheet(false), before) != shortshot::Status::ok) return 1;
  if (describe(sheet(true), now) != shortshot::Status::ok) return 2;
  shortshot::Pose pose;
  if (pose_between(now, before, pose) != shortshot::Status::ok) return 3;
  const auto& r = pose.rotation;  // before = pose * now: what is at -y, x now was at x, y
  const float off = std::fabs(r[1] - 1) + std::fabs(r[3] + 1) + std::fabs(r[8] - 1);
  std::printf("the rotation is off by %g\n", static_cast<double>(off));
  return off < 0.02f ? 0 : 4;
}
