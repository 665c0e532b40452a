// A stand-in for what ROS 2 makes of sensor_msgs/msg/PointCloud2: the fields of the message, without its headers.
#pragma once

#include "cloud/point_cloud2_message.hpp"

namespace sensor_msgs::msg {

using PointCloud2 = unit::CloudMessage;

}  // namespace sensor_msgs::msg
