// A stand-in for what ROS 2 makes of sensor_msgs/msg/PointCloud2: the fields of the message, without its headers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sensor_msgs::msg {

struct PointField {
  static constexpr std::uint8_t FLOAT32 = 7;
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;
};

struct PointCloud2 {
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = false;
};

}  // namespace sensor_msgs::msg
