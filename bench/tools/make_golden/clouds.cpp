#include "clouds.hpp"

#include <algorithm>
#include <cmath>

#include "tools/scene/random.hpp"

namespace shortshot_bench::make_golden {
namespace {

std::uint8_t byte_of(double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); }

void add(Cloud& cloud, const Vec3& p, const Vec3& color) {
  for (const double coordinate : {p.x, p.y, p.z}) cloud.points.push_back(static_cast<float>(coordinate));
  for (const double channel : {color.x, color.y, color.z}) cloud.rgb.push_back(byte_of(channel));
}

void add_keypoint(Cloud& cloud, std::size_t point, const std::string& kind) {
  cloud.keypoints.push_back(static_cast<std::int32_t>(point));
  cloud.keypoint_kind.push_back(kind);
}

// Key points all over what was added last.
void add_keypoints(Cloud& cloud, std::size_t count, const std::string& kind) {
  const std::size_t points = cloud.points.size() / 3;
  for (std::size_t k = 0; k < count; ++k) add_keypoint(cloud, (2 * k + 1) * points / (2 * count), kind);
}

// Hills, 12 cm wide and 70 cm before the camera.
Vec3 on_hills(Random& random) {
  const double x = random.uniform(-0.06, 0.06);
  const double y = random.uniform(-0.06, 0.06);
  const double hill = x * x * (4.0 + 60.0 * x) - y * (x + 2.5 * y) + 900.0 * x * x * y * y;
  return {x, y, 0.7 + hill + 0.0005 * random.normal()};
}

Cloud relief() {
  Cloud cloud{"compact_relief", "hills, chequered and speckled", {}, {}, {}, {}};
  Random random(201);
  const Vec3 colors[] = {random.vivid_color(), random.vivid_color()};
  for (int i = 0; i < 360; ++i) {
    const Vec3 p = on_hills(random);
    const auto square = static_cast<int>(std::floor(p.x / 0.02) + std::floor(p.y / 0.015));
    const double light = 0.8 + 3.0 * p.x;
    add(cloud, p, colors[square & 1] * (light + 0.05 * random.normal()));
  }
  add_keypoints(cloud, 18, "textured");
  return cloud;
}

Cloud edge() {
  Cloud cloud{"compact_edge", "two walls that meet in an edge, each of its own color", {}, {}, {}, {}};
  Random random(202);
  const Vec3 colors[] = {random.vivid_color(), random.vivid_color()};
  for (int i = 0; i < 320; ++i) {
    const double along = random.uniform(-0.06, 0.06);
    const double away = random.uniform(-0.06, 0.06);
    const bool right = away > 0.0;
    const Vec3 p{0.8 * away, along + 0.1 * away, 0.6 + (right ? 0.6 : -0.7) * away + 0.0003 * random.normal()};
    add(cloud, p, colors[right ? 1 : 0] * random.uniform(0.9, 1.0));
  }
  add_keypoints(cloud, 18, "edge");
  return cloud;
}

Cloud noise() {
  Cloud cloud{"compact_noise", "points in a box, each of any color", {}, {}, {}, {}};
  Random random(203);
  for (int i = 0; i < 400; ++i) {
    const Vec3 p{random.uniform(-0.05, 0.05), random.uniform(-0.04, 0.04), random.uniform(0.5, 0.56)};
    add(cloud, p, {random.uniform(0.0, 256.0), random.uniform(0.0, 256.0), random.uniform(0.0, 256.0)});
  }
  add_keypoints(cloud, 18, "noise");
  return cloud;
}

Cloud bare() {
  Cloud cloud{"compact_bare", "hills of one color; groups of few points, far from each other", {}, {}, {}, {}};
  Random random(204);
  const Vec3 color = random.vivid_color();
  for (int i = 0; i < 240; ++i) add(cloud, on_hills(random), color);
  add_keypoints(cloud, 8, "one_color");
  for (const int others : {0, 1, 2, 3, 4, 5, 6, 8, 12}) {
    add_keypoint(cloud, cloud.points.size() / 3, std::to_string(others) + "_others");
    for (int i = 0; i < others + 1; ++i) {
      const Vec3 p{0.5 * others + random.uniform(1.0, 1.02), random.uniform(0.0, 0.02), random.uniform(0.7, 0.72)};
      add(cloud, p, random.vivid_color());
    }
  }
  return cloud;
}

}  // namespace

std::vector<Cloud> make_clouds() { return {relief(), edge(), noise(), bare()}; }

}  // namespace shortshot_bench::make_golden
