// Random numbers and directions that are the same on every machine: no std distributions, for only the engine's output
// is specified by the standard, and no libm besides sqrt.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace shortshot_bench {

struct Vec3 {
  double x, y, z;
};
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 mix(const Vec3& a, const Vec3& b, double weight) { return a + (b - a) * weight; }

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_()) * 0x1p-32; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_()); }
  double normal() {  // Irwin-Hall: mean 0, variance 1, cut at 6 sigma
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }
  Vec3 horizontal_direction() {
    for (;;) {
      const Vec3 v{uniform(-1.0, 1.0), uniform(-1.0, 1.0), 0.0};
      const double length = norm(v);
      if (length > 0.1 && length <= 1.0) return v * (1.0 / length);
    }
  }
  Vec3 vivid_color() {  // one strong, one middling and one weak channel, in random order
    std::array<double, 3> c{{uniform(170.0, 245.0), uniform(60.0, 210.0), uniform(15.0, 90.0)}};
    std::swap(c[0], c[bits() % 3]);
    std::swap(c[1], c[1 + bits() % 2]);
    return {c[0], c[1], c[2]};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace shortshot_bench
