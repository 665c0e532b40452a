// A cloud's descriptors, with frames turned towards its camera.
#pragma once

#include "shortshot/batch/describe_cloud.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench {

/// Lengths in the cloud's own unit. Throws std::runtime_error with what is wrong.
template <class D>
shortshot::Features<D> described(const RgbdCloud& cloud, float radius, float leaf, unsigned threads) {
  shortshot::CloudOptions how;
  how.radius = radius;
  how.leaf = leaf;
  how.viewpoint = camera_of_cloud(cloud);
  how.threads = threads;
  shortshot::Features<D> features;
  require(describe_cloud(view_of_cloud(cloud), how, features));
  return features;
}

}  // namespace shortshot_bench
