#include "speed/peers/naive_color.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shortshot_bench::peers {
namespace {

constexpr int root_steps = 4000;

std::array<float, 256> make_linear() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float c = static_cast<float>(i) / 255.0f;
    const auto base = static_cast<double>((c + 0.055f) / 1.055f);
    table[i] = c > 0.04045f ? static_cast<float>(std::pow(base, static_cast<double>(2.4f))) : c / 12.92f;
  }
  return table;
}

/// One more than published: white reads it.
std::array<double, root_steps + 1> make_roots() {
  std::array<double, root_steps + 1> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto t = static_cast<double>(static_cast<float>(i) / static_cast<float>(root_steps));
    table[i] = t > 0.008856 ? std::pow(t, 0.3333) : 7.787 * t + 16.0 / 116.0;
  }
  return table;
}

double root(float ratio) {
  static const std::array<double, root_steps + 1> table = make_roots();
  return table[static_cast<std::size_t>(ratio * static_cast<float>(root_steps))];
}

}  // namespace

std::array<double, 3> naive_lab(const std::uint8_t* rgb) {
  static const std::array<float, 256> linear = make_linear();
  const float r = linear[rgb[0]];
  const float g = linear[rgb[1]];
  const float b = linear[rgb[2]];
  const double fx = root((r * 0.412453f + g * 0.357580f + b * 0.180423f) / 0.95047f);
  const double fy = root(r * 0.212671f + g * 0.715160f + b * 0.072169f);
  const double fz = root((r * 0.019334f + g * 0.119193f + b * 0.950227f) / 1.08883f);
  const auto clamped = [](double value) { return std::max(-120.0, std::min(120.0, value)); };
  return {std::min(100.0, 116.0 * fy - 16.0), clamped(500.0 * (fx - fy)), clamped(200.0 * (fy - fz))};
}

double naive_color_distance(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  const double chroma = (std::abs(p[1] - q[1]) / 120.0 + std::abs(p[2] - q[2]) / 120.0) / 2.0;
  return std::min(1.0, (std::abs(p[0] - q[0]) / 100.0 + chroma) / 3.0);
}

}  // namespace shortshot_bench::peers
