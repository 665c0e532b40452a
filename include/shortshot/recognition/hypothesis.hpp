// shortshot/recognition/hypothesis.hpp: what recognizers are told, and what they say.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// How objects are looked for. Trivially copyable.
struct RecognizerOptions {
  float bandwidth = 0.03f;      ///< h of the density of votes, 1e-6 to 1e6 meters: about how far votes miss the center
  std::uint32_t neighbors = 1;  ///< nearest codewords that each descriptor activates, 1 to 1024
  std::uint32_t most = 8;       ///< hypotheses at the most, from 1 on
};

/// An object that may be there; see Recognizer::class_name() and instance_name() for the numbers. Trivial type.
struct Hypothesis {
  std::uint32_t object_class;  ///< number of the class
  std::uint32_t instance;      ///< number of the instance, among those of all classes
  Point center;                ///< where that of the training views is in this view
  float score;  ///< density of the class' votes there: 1 for each that hits it, exp(-d^2 / (2 h^2)) if d meters off
};

/// A key point as recognizers need it. Trivial type.
template <class Stored>
struct StoredKeyPoint {
  Stored descriptor;  ///< as it is stored
  Point position;     ///< where the key point is in the view
  Frame frame;        ///< its local reference frame
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// ok or bad_option.
[[nodiscard]] inline Status validate(const RecognizerOptions& options) noexcept {
  const bool usable = options.bandwidth >= 1e-6f && options.bandwidth <= 1e6f && options.neighbors >= 1 &&
                      options.neighbors <= 1024 && options.most >= 1;
  return usable ? Status::ok : Status::bad_option;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Does one of these say the same: the class, within the bandwidth of the place?
[[nodiscard]] inline bool is_known(const Hypothesis* known, std::size_t count, std::uint32_t object_class,
                                   const Point& at, float bandwidth) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const bool same_class = known[i].object_class == object_class;
    if (same_class && squared_distance(known[i].center, at) <= unfused(bandwidth * bandwidth)) return true;
  }
  return false;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
