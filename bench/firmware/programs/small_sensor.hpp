// What the board with a small depth sensor, and the host that prepares its model, must have in common: from a frame of
// millimeters to one descriptor, of all that the sensor sees.
#pragma once

#include <cstddef>
#include <cstdint>

#if __has_include("shortshot.hpp")
#include "shortshot.hpp"  // the board's only header
#else
#include "shortshot/shortshot.hpp"
#endif

namespace small_sensor {

/// The shape part of ShapeColor95, which needs neither colors nor normals: 64 values, 32 bytes as nibbles.
using Descriptor =
    shortshot::Descriptor<shortshot::MultilinearVoting, shortshot::HeightPart<shortshot::SphericalGrid<2, 4, 8>>>;
using Stored = shortshot::NibbleDescriptor<Descriptor>;

inline constexpr float radius = 0.10f;           // from the middle of what is seen: all of it
inline constexpr std::size_t most_points = 384;  // zones are averaged in blocks until there are no more
inline constexpr std::uint32_t activated = 3;    // codewords: if all say the same, the board is sure

struct Sensor {
  const char* name;     // of its figures
  std::uint32_t width;  // zones
  std::uint32_t height;
  float half_width;     // of what it sees at a distance of 1: the tangent of half the angle
  bool has_few_points;  // too few for a local reference frame: its own axes are the frame
};
inline constexpr Sensor sensors[] = {{"SmallSensor8x8", 8, 8, 0.414f, true},
                                     {"SmallSensor16x16", 16, 16, 0.414f, false},
                                     {"SmallSensor32x24", 32, 24, 0.5f, false},
                                     {"SmallSensor64x48", 64, 48, 0.5f, false}};

/// Of flat hand, fist, pointing, two fingers, ball, box, can and bowl: what a few points can tell at all.
inline constexpr std::uint32_t kinds[] = {0, 1, 1, 1, 2, 3, 3, 4};
/// Where hands fit into the view, and fill enough zones of the smallest sensor: millimeters, from and to.
inline constexpr std::uint32_t best_distances[] = {170, 350};

inline constexpr shortshot::Frame own_axes{{1.0f, 0.0f, 0.0f}, {0.0f, -1.0f, 0.0f}, {0.0f, 0.0f, -1.0f}};

template <std::size_t Most>
struct Points {
  float xyz[3 * Most];
  std::size_t size;
  shortshot::Point middle;
};

/// Sum and number of the zones of a block where something was measured; 0 of 0 if they are less than half of it.
struct Block {
  std::uint32_t millimeters;
  std::uint32_t zones;
};
inline Block block_at(const std::uint16_t* depths, const Sensor& sensor, std::uint32_t u, std::uint32_t v,
                      std::uint32_t side) {
  Block block{0, 0};
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const std::uint32_t depth = depths[(v + i / side) * sensor.width + u + i % side];
    block.millimeters += depth;
    block.zones += depth > 0 ? 1u : 0u;
  }
  return 2 * block.zones >= side * side ? block : Block{0, 0};
}

/// Calls use(block, u, v) for each block with a measurement.
template <class Use>
void for_blocks(const std::uint16_t* depths, const Sensor& sensor, std::uint32_t side, const Use& use) {
  for (std::uint32_t v = 0; v < sensor.height; v += side) {
    for (std::uint32_t u = 0; u < sensor.width; u += side) {
      const Block block = block_at(depths, sensor, u, v, side);
      if (block.zones > 0) use(block, u, v);
    }
  }
}

/// Side of the smallest blocks of which there are at most most_points: a power of two.
inline std::uint32_t side_of_blocks(const std::uint16_t* depths, const Sensor& sensor) {
  for (std::uint32_t side = 1;; side *= 2) {
    std::size_t count = 0;
    for_blocks(depths, sensor, side, [&](const Block&, std::uint32_t, std::uint32_t) { ++count; });
    if (count <= most_points) return side;
  }
}

/// Row by row, millimeters along the optical axis, 0 where nothing was measured, as points of a pinhole camera.
template <std::size_t Most>
void to_points(const std::uint16_t* depths, const Sensor& sensor, Points<Most>& out) {
  using shortshot::extend::unfused;
  const std::uint32_t side = side_of_blocks(depths, sensor);
  const float half_zone = sensor.half_width / static_cast<float>(sensor.width);
  float sum[3] = {};
  out.size = 0;
  for_blocks(depths, sensor, side, [&](const Block& block, std::uint32_t u, std::uint32_t v) {
    const float z = static_cast<float>(block.millimeters) / static_cast<float>(1000 * block.zones);
    const auto along = [&](std::uint32_t zone, std::uint32_t zones) {
      return unfused(static_cast<float>(static_cast<std::int32_t>(2 * zone + side - zones)) * half_zone * z);
    };
    const float point[] = {along(u, sensor.width), along(v, sensor.height), z};
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += point[i];
      out.xyz[3 * out.size + i] = point[i];
    }
    ++out.size;
  });
  const auto count = static_cast<float>(out.size > 0 ? out.size : 1);
  out.middle = {sum[0] / count, sum[1] / count, sum[2] / count};
}

/// The descriptor of all points around their middle.
template <bool HasFewPoints, std::size_t Most, class Memory>
shortshot::Status describe(const Points<Most>& points, Memory& workspace, Stored& out) {
  const shortshot::CloudView cloud = shortshot::view_xyz(points.xyz, points.size);
  const shortshot::BruteSearch search(cloud);
  shortshot::KeyPoint key;
  key.position = points.middle;
  float values[Descriptor::size];
  shortshot::Status status = shortshot::Status::ok;
  if constexpr (HasFewPoints) {
    status = shortshot::describe_at<Descriptor>(cloud, search, key, own_axes, radius, workspace, values);
  } else {
    shortshot::Support support = radius;
    support.viewpoint = shortshot::Viewpoint::towards({});
    status = shortshot::describe_at<Descriptor>(cloud, search, key, support, workspace, values);
  }
  shortshot::quantize(values, out);
  return status;
}

}  // namespace small_sensor
