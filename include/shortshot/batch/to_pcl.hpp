// shortshot/batch/to_pcl.hpp: descriptors as PCL's clouds of signatures, without including PCL. Hosted only.
//
// The other way needs nothing: of a pcl::PointCloud<pcl::SHOT352> `cloud`, the floats of row i are cloud[i].descriptor,
// in the layout of PclShot352, for binarize() and for comparing with rows of Features.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "../config.hpp"
#include "../status.hpp"
#include "features.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Copies features into a cloud shaped as pcl::PointCloud<pcl::SHOT352> or <pcl::SHOT1344>: `points` of structs with
/// float descriptor[D::size] and rf[9], `width`, `height`, `is_dense`. One point per key point, in order; rf is the
/// frame's axes x, y and z.
///
/// A key point without descriptor is NaN in all its floats, as in PCL, and the cloud is not dense then. Allocates the
/// points; may throw what their resize() does.
template <class D, class PclCloud>
void to_pcl(const Features<D>& features, PclCloud& cloud) {
  using Signature = std::remove_reference_t<decltype(cloud.points[0])>;
  static_assert(sizeof(Signature::descriptor) == D::size_bytes && sizeof(Signature::rf) == sizeof(Frame),
                "to_pcl() supports clouds of structs with float descriptor[D::size] and rf[9]");
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  cloud.points.resize(features.size());
  cloud.width = static_cast<std::uint32_t>(features.size());
  cloud.height = 1;
  cloud.is_dense = true;
  for (std::size_t row = 0; row < features.size(); ++row) {
    Signature& out = cloud.points[row];
    if (features.status[row] == Status::ok) {
      std::copy_n(features[row], D::size, out.descriptor);
      const Frame& frame = features.frames[row];
      std::copy_n(frame.z, 3, std::copy_n(frame.y, 3, std::copy_n(frame.x, 3, out.rf)));
    } else {
      std::fill_n(out.descriptor, D::size, not_a_number);
      std::fill_n(out.rf, 9, not_a_number);
      cloud.is_dense = false;
    }
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
