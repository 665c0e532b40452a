// What two libraries compiled with different flags hand each other. LIBRARY is the namespace, one for each.
#pragma once

#include <cstdint>
#include <shortshot/shortshot.hpp>
#include <string>
#include <vector>

namespace border {

using D = shortshot::Scsh336;

/// All that a program could want of one library, and give to the other.
struct Library {
  shortshot::Support (*support)(shortshot::Radius radius);
  shortshot::Status (*describe)(const shortshot::CloudView& cloud, const shortshot::Support& support,
                                shortshot::Features<D>& features);
  shortshot::Status (*normals)(const shortshot::CloudView& cloud, const shortshot::Viewpoint& viewpoint,
                               std::vector<shortshot::SurfaceNormal>& normals);
  shortshot::Status (*match)(const shortshot::Features<D>& a, const shortshot::Features<D>& b,
                             std::vector<shortshot::MatchedPair>& pairs);
  shortshot::Status (*pose)(const std::vector<shortshot::PointPair>& pairs, shortshot::Pose& pose,
                            std::vector<std::uint32_t>& inliers);
  shortshot::Status (*train)(shortshot::Recognizer& recognizer, const shortshot::Features<D>& features);
  shortshot::Status (*recognize)(const shortshot::Recognizer& recognizer, const shortshot::Features<D>& features,
                                 std::vector<shortshot::Hypothesis>& objects);
  shortshot::Status (*save)(const shortshot::Recognizer& recognizer, std::vector<std::uint8_t>& bytes);
  shortshot::Status (*load)(const std::vector<std::uint8_t>& bytes, shortshot::Recognizer& recognizer);
};

Library plain();       // -O2
Library small_avx2();  // -Os -mavx2 -mfma -mlzcnt

}  // namespace border
