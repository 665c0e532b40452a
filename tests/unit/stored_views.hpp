// Views of objects made of key points with random frames and descriptors, in storages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "synthetic_objects.hpp"

namespace unit {

/// Key points with random frames and descriptors of D, seen after a motion, with a little noise in the descriptors.
template <class D>
ss::Features<D> view_of(std::uint32_t object, const Motion& motion, std::uint32_t noise_seed) {
  Random random(object), noise(noise_seed);
  ss::Features<D> features;
  for (std::size_t i = 0; i < 12; ++i) {
    for (int v = 0; v < D::size; ++v) {
      features.values.push_back(random.between(-0.15f, 0.3f) + noise.between(-0.01f, 0.01f));
    }
    ss::KeyPoint key{};
    key.position =
        motion(ss::Point{random.between(-0.1f, 0.1f), random.between(-0.1f, 0.1f), random.between(-0.1f, 0.1f)});
    const Motion turn = random_motion(random);
    ss::Frame frame;
    for (int k = 0; k < 3; ++k) {
      frame.x[k] = turn.rotation[0][k];
      frame.y[k] = turn.rotation[1][k];
      frame.z[k] = turn.rotation[2][k];
    }
    features.status.push_back(i == 3 ? ss::Status::ambiguous_frame : ss::Status::ok);
    features.keypoints.push_back(key);
    features.frames.push_back(motion(frame));
    features.frame_confidence.push_back({});
    features.neighbors.push_back(10);
  }
  return features;
}

template <class Stored, class D>
ss::StoredFeatures<Stored> stored(const ss::Features<D>& features) {
  ss::StoredFeatures<Stored> out;
  REQUIRE(ss::store(features, out) == ss::Status::ok);
  return out;
}

}  // namespace unit
