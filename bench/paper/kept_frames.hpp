// Only those key points of a cloud whose frames are the surest, and as a control as many at random: each is a
// configuration of its own, "scsh336-best50" and "scsh336-random50" for half of the key points of "scsh336".
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"

namespace shortshot_bench::paper {

struct KeptFrames {
  unsigned percent = 100;  // of the key points that can be described
  bool at_random = false;  // in place of the best
};

/// A configuration's name, taken apart. A name that does not say what is kept is all `descriptor`.
struct KeptName {
  std::string descriptor;
  KeptFrames kept;
};
KeptName kept_name_of(const std::string& name);

/// "scsh336-best50" or "scsh336-random50".
std::string name_of(const KeptName& name);

/// Is there a name that says what is kept?
bool keeps_frames(const std::vector<std::string>& names);

/// Each name, followed by itself with the best and with as many at random of each percentage.
std::vector<std::string> with_kept_frames(const std::vector<std::string>& names,
                                          const std::vector<unsigned>& percentages);

/// 0 to 1, from the bits of the key point's position: the same whatever its place among the others.
float hash_of(const shortshot::KeyPoint& key);

/// Leaves out the others.
template <class D>
shortshot::Status keep_frames(shortshot::Features<D>& features, const std::vector<shortshot::KeyPoint>& keypoints,
                              const KeptFrames& kept) {
  for (std::size_t row = 0; row < features.size() && kept.at_random; ++row) {
    const float chance = hash_of(keypoints[row]);
    features.frame_confidence[row] = {chance, 0.5f * chance, 0.5f * chance};
  }
  return shortshot::keep_best_frames(features, static_cast<float>(kept.percent) / 100.0f);
}

}  // namespace shortshot_bench::paper
