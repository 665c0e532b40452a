// Objects made of key points with random frames and descriptors, and views of them after any rigid motion.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fixtures.hpp"

namespace unit {

inline constexpr std::size_t synthetic_size = 24;  // values of a descriptor
const std::string synthetic_layout = "synthetic";  // not inline: constants of the tests are made of it, after it

/// x -> rotation x + translation; the rows of the rotation are a frame's axes, too.
struct Motion {
  float rotation[3][3];
  ss::Point translation;

  [[nodiscard]] ss::Point turned(const float (&v)[3]) const {
    const auto row = [&](int k) { return rotation[k][0] * v[0] + rotation[k][1] * v[1] + rotation[k][2] * v[2]; };
    return {row(0), row(1), row(2)};
  }
  [[nodiscard]] ss::Point operator()(const ss::Point& p) const {
    const ss::Point q = turned({p.x, p.y, p.z});
    return {q.x + translation.x, q.y + translation.y, q.z + translation.z};
  }
  [[nodiscard]] ss::Frame operator()(const ss::Frame& frame) const {
    const ss::Point x = turned(frame.x);
    const ss::Point y = turned(frame.y);
    const ss::Point z = turned(frame.z);
    return {{x.x, x.y, x.z}, {y.x, y.y, y.z}, {z.x, z.y, z.z}};
  }
};

inline constexpr Motion no_motion{{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}, {0.0f, 0.0f, 0.0f}};

/// Of a unit quaternion of any direction.
inline Motion random_motion(Random& random) {
  float q[4];
  float norm = 0.0f;
  for (float& component : q) component = random.between(-1.0f, 1.0f);
  for (const float component : q) norm += component * component;
  for (float& component : q) component /= std::sqrt(norm);
  const float w = q[0], x = q[1], y = q[2], z = q[3];
  return {{{1.0f - 2.0f * (y * y + z * z), 2.0f * (x * y - z * w), 2.0f * (x * z + y * w)},
           {2.0f * (x * y + z * w), 1.0f - 2.0f * (x * x + z * z), 2.0f * (y * z - x * w)},
           {2.0f * (x * z - y * w), 2.0f * (y * z + x * w), 1.0f - 2.0f * (x * x + y * y)}},
          {random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f)}};
}

/// What extract() gives of a view, with the key points.
struct View {
  std::vector<float> values;
  std::vector<ss::Status> status;
  std::vector<ss::KeyPoint> keypoints;
  std::vector<ss::Frame> frames;

  [[nodiscard]] std::size_t size() const { return status.size(); }
  [[nodiscard]] ss::FeatureRows rows() const {
    return {{values.data(), size(), synthetic_size, status.data()}, keypoints.data(), frames.data()};
  }
  void append(const View& other) {
    values.insert(values.end(), other.values.begin(), other.values.end());
    status.insert(status.end(), other.status.begin(), other.status.end());
    keypoints.insert(keypoints.end(), other.keypoints.begin(), other.keypoints.end());
    frames.insert(frames.end(), other.frames.begin(), other.frames.end());
  }
};

/// Key points up to 10 cm from the object's center, which is the origin.
inline View synthetic_object(std::uint32_t seed, std::size_t keypoints) {
  Random random(seed);
  View view;
  for (std::size_t i = 0; i < keypoints; ++i) {
    for (std::size_t k = 0; k < synthetic_size; ++k) view.values.push_back(random.between(0.0f, 1.0f));
    const Motion m = random_motion(random);
    view.status.push_back(ss::Status::ok);
    view.keypoints.push_back({{0.1f * m.translation.x, 0.1f * m.translation.y, 0.1f * m.translation.z}, {}});
    view.frames.push_back(m(ss::Frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}));
  }
  return view;
}

/// The object elsewhere, with values up to `noise` off.
inline View moved(View view, const Motion& motion, float noise = 0.0f, std::uint32_t seed = 1) {
  Random random(seed);
  for (ss::KeyPoint& key : view.keypoints) key.position = motion(key.position);
  for (ss::Frame& frame : view.frames) frame = motion(frame);
  for (float& value : view.values) value += random.between(-noise, noise);
  return view;
}

inline float distance(const ss::Point& a, const ss::Point& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

inline bool same_bits(const std::vector<ss::Hypothesis>& a, const std::vector<ss::Hypothesis>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

}  // namespace unit
