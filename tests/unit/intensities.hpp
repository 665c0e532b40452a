// For the tests of the signal of intensities: clouds that have some, and one descriptor in a frame.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace unit {

inline constexpr float echo_radius = 0.05f;

inline bool has_echo(float intensity) { return std::isfinite(intensity); }

/// Echoes of all kinds: bright and dark, none at all, below zero, and not measured.
inline std::vector<float> some_intensities(std::uint32_t seed, std::size_t points) {
  Random random(seed);
  std::vector<float> intensities;
  for (std::size_t i = 0; i < points; ++i) {
    const float bright = random.between(0.5f, 4000.0f);
    const float odd[] = {0.0f, -bright, not_a_number, infinity, -infinity, 1e-30f, 1e30f};
    const std::size_t kind = random.below(40);
    intensities.push_back(kind < 7 ? odd[kind] : bright);
  }
  return intensities;
}

inline ss::CloudView lit(const TestCloud& cloud, const std::vector<float>& intensities) {
  return ss::with_intensities(cloud.view(), intensities.data());
}

inline ss::Frame frame_at(const ss::CloudView& cloud, const ss::Point& p) {
  Room room(cloud.size);
  ss::Neighborhood n = room.neighborhood();
  ss::Frame frame{};
  REQUIRE(ss::BruteSearch{cloud}.gather(p, echo_radius, n) == ss::Status::ok);
  REQUIRE(ss::estimate_frame(n, echo_radius, frame) == ss::Status::ok);
  return frame;
}

template <class Descriptor, class Place>
ss::Status describe(const ss::CloudView& cloud, const Place& place, const ss::Frame& frame, std::vector<float>& out) {
  static ss::Workspace<2048> workspace;
  out = garbage<Descriptor>();
  return ss::describe_at<Descriptor>(cloud, ss::BruteSearch{cloud}, place, frame, echo_radius, workspace, out.data());
}

/// In the library's own frame.
template <class Descriptor>
std::vector<float> described(const ss::CloudView& cloud, std::size_t key) {
  std::vector<float> out;
  REQUIRE(describe<Descriptor>(cloud, key, frame_at(cloud, ss::point(cloud, key)), out) == ss::Status::ok);
  return out;
}

}  // namespace unit
