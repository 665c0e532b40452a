// Seeded clouds and the few helpers that all unit tests share.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

#include "under_test.hpp"

namespace shortshot {

inline doctest::String toString(Status status) { return message(status); }  // found by doctest's reports

}  // namespace shortshot

namespace unit {

namespace ss = shortshot;

inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// The engine's own numbers only: the standard's distributions differ from one standard library to the next.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_()); }
  std::size_t below(std::size_t n) { return bits() % n; }
  float between(float low, float high) {
    return low + (high - low) * (static_cast<float>(bits() >> 8) * (1.0f / 16777216.0f));
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(bits() >> 24); }
  /// Rounded towards zero to a multiple of 2^-`digits`: sums and differences of such numbers are exact.
  float dyadic(float low, float high, int digits) {
    const auto quanta = static_cast<float>(1 << digits);
    return static_cast<float>(static_cast<int>(between(low, high) * quanta)) / quanta;
  }

 private:
  std::mt19937 engine_;
};

struct TestCloud {
  std::vector<float> xyz;
  std::vector<std::uint8_t> rgb;
  std::vector<ss::SurfaceNormal> normals;  // none, or one per point

  [[nodiscard]] std::size_t size() const { return xyz.size() / 3; }
  void add(float x, float y, float z, ss::Rgb color = {128, 64, 32}) {
    xyz.insert(xyz.end(), {x, y, z});
    rgb.insert(rgb.end(), {color.r, color.g, color.b});
  }
  void add(const ss::Point& p, ss::Rgb color = {128, 64, 32}) { add(p.x, p.y, p.z, color); }
  [[nodiscard]] ss::Point at(std::size_t i) const { return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}; }
  [[nodiscard]] ss::Rgb color_at(std::size_t i) const { return {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]}; }
  [[nodiscard]] ss::CloudView view() const {
    const ss::CloudView points = ss::view_xyz_rgb(xyz.data(), rgb.data(), size());
    return normals.empty() ? points : ss::with_normals(points, normals.data());
  }
};

/// A curved patch, 20 cm wide and a meter away, with a chequered, speckled texture.
inline TestCloud curved_surface(std::uint32_t seed, std::size_t points) {
  Random random(seed);
  TestCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const float x = random.between(-0.1f, 0.1f);
    const float y = random.between(-0.1f, 0.1f);
    const float z =
        0.9f + 3.0f * x * x - 2.0f * x * y + 40.0f * x * x * x - 1.5f * y * y + random.between(0.0f, 0.002f);
    const bool dark = (static_cast<int>((x + 0.1f) * 50.0f) + static_cast<int>((y + 0.1f) * 50.0f)) % 2 == 0;
    const auto speckle = static_cast<std::uint8_t>(random.byte() / 4);
    const auto base = static_cast<std::uint8_t>(dark ? 20 : 150);
    cloud.add(x, y, z,
              {static_cast<std::uint8_t>(base + speckle), base, static_cast<std::uint8_t>(200 - base + speckle)});
  }
  return cloud;
}

inline constexpr ss::SurfaceNormal no_normal{not_a_number, not_a_number, not_a_number};

inline ss::SurfaceNormal unit_normal(float x, float y, float z) {
  const float length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

/// The cloud with the curved surface's own normals, each tilted by up to `noise`; one in fifty is missing.
inline TestCloud with_surface_normals(TestCloud cloud, std::uint32_t seed, float noise = 0.2f) {
  Random random(seed);
  cloud.normals.clear();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::Point p = cloud.at(i);
    const float x = 6.0f * p.x - 2.0f * p.y + 120.0f * p.x * p.x + random.between(-noise, noise);
    const float y = -2.0f * p.x - 3.0f * p.y + random.between(-noise, noise);
    cloud.normals.push_back(random.below(50) == 0 ? no_normal : unit_normal(x, y, -1.0f));
  }
  return cloud;
}

/// The cloud with normals of any direction; one in fifty is missing.
inline TestCloud with_random_normals(TestCloud cloud, std::uint32_t seed) {
  Random random(seed);
  cloud.normals.clear();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float x = random.between(-1.0f, 1.0f);
    const float y = random.between(-1.0f, 1.0f);
    const float z = random.between(0.1f, 1.0f);
    const ss::SurfaceNormal normal = unit_normal(x, y, random.below(2) == 0 ? z : -z);
    cloud.normals.push_back(random.below(50) == 0 ? no_normal : normal);
  }
  return cloud;
}

/// Points in a box of 20 cm, denser towards one corner, each of any color.
inline TestCloud blob(std::uint32_t seed, std::size_t points) {
  Random random(seed);
  const auto skewed = [&random] {
    const float t = random.between(0.0f, 1.0f);
    return 0.2f * (0.7f * t + 0.3f * t * t) - 0.1f;
  };
  TestCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const float x = skewed();
    const float y = skewed();
    const float z = skewed();
    cloud.add(x, y, z, {random.byte(), random.byte(), random.byte()});
  }
  return cloud;
}

/// All grays, a lattice of 17^3 colors over the whole gamut, and random ones.
inline std::vector<ss::Rgb> many_colors() {
  std::vector<ss::Rgb> colors;
  for (int v = 0; v < 256; ++v) {
    const auto gray = static_cast<std::uint8_t>(v);
    colors.push_back({gray, gray, gray});
  }
  for (int k = 0; k < 17 * 17 * 17; ++k) {
    const auto level = [](int step) { return static_cast<std::uint8_t>(std::min(255, 16 * step)); };
    colors.push_back({level(k % 17), level(k / 17 % 17), level(k / 289)});
  }
  Random random(1);
  for (int k = 0; k < 5000; ++k) colors.push_back({random.byte(), random.byte(), random.byte()});
  return colors;
}

/// Room for a gathered neighborhood of any size.
struct Room {
  explicit Room(std::size_t n) : floats(4 * n), index(n), capacity(static_cast<std::uint32_t>(n)) {}
  [[nodiscard]] ss::Neighborhood neighborhood() {
    float* p = floats.data();
    return {p, p + capacity, p + 2 * std::size_t{capacity}, p + 3 * std::size_t{capacity}, index.data(), capacity, 0, 0,
            {}};
  }
  std::vector<float> floats;
  std::vector<std::uint32_t> index;
  std::uint32_t capacity;
};

/// The neighbors that a search finds, as a sorted list: a neighbor offered twice stays visible.
template <class Search>
std::vector<std::uint32_t> found_by(const Search& search, const ss::Point& center, ss::Radius radius, Room& room) {
  ss::Neighborhood n = room.neighborhood();
  const ss::Status status = search.gather(center, radius, n);
  REQUIRE(status == ss::Status::ok);
  std::vector<std::uint32_t> indices(n.index, n.index + n.size);
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// Every point of the view is that of the cloud, and its color too, where it has colors.
inline void require_same_points(const ss::CloudView& view, const TestCloud& cloud, bool colors) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::Point p = ss::point(view, i);
    const ss::Point q = cloud.at(i);
    REQUIRE((p.x == q.x && p.y == q.y && p.z == q.z));
    if (!colors) continue;
    const ss::Rgb c = ss::color(view, i);
    const ss::Rgb d = cloud.color_at(i);
    REQUIRE((c.r == d.r && c.g == d.g && c.b == d.b));
  }
}

/// A search that cannot be asked says so, in status() and to everyone who asks, and finds nothing.
template <class Search>
bool refuses(const Search& search, const ss::Point& center, ss::Radius radius, ss::Status expected) {
  Room room(16);
  ss::Neighborhood n = room.neighborhood();
  n.size = n.found = 7;
  return search.status() == expected && search.gather(center, radius, n) == expected && n.size == 0 && n.found == 0;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  static_assert(std::is_trivially_copyable<T>::value, "plain data, without gaps");
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

inline bool all_zero(const std::vector<float>& values) {  // false for NaN
  return std::all_of(values.begin(), values.end(), [](float v) { return v == 0.0f; });
}

template <class D>
std::vector<float> garbage() {  // what an output holds before a call that must zero it
  return std::vector<float>(static_cast<std::size_t>(D::size), not_a_number);
}

inline double l2_distance(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += d * d;
  }
  return std::sqrt(sum);
}

}  // namespace unit
