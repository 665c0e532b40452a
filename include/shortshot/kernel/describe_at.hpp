// shortshot/kernel/describe_at.hpp: one key point from cloud to descriptor: search, frame and kernel in one call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "../cloud/cloud.hpp"
#include "../cloud/normal_source.hpp"
#include "../color/lab.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "../frame/frame.hpp"
#include "../search/neighborhood.hpp"
#include "../status.hpp"
#include "describe.hpp"

namespace shortshot {

/// A place to describe: a point of the cloud, or any other position (a voxel's centroid) with its color. The color is
/// what color distances refer to; descriptors without color ignore it. Trivial type.
struct KeyPoint {
  Point position;
  Rgb color;
};

inline namespace SHORTSHOT_ISA {

/// The key point at point `index` of a cloud, which must be below cloud.size.
[[nodiscard]] inline KeyPoint keypoint(const CloudView& cloud, std::size_t index) noexcept {
  return {point(cloud, index), has_colors(cloud) ? color(cloud, index) : Rgb{}};
}

/// What is described around a key point. Converts from a radius: `0.04f` is a support of 4 cm in SHOT's own frame.
struct Support {
  Radius radius;           ///< of the descriptor
  Radius frame_radius;     ///< of the local reference frame; may be smaller or larger
  const Point* viewpoint;  ///< where the camera is, in the cloud's coordinates: turns the frames' z; null: by vote

  constexpr Support(Radius r) noexcept : radius(r), frame_radius(r), viewpoint(nullptr) {}  // NOLINT: see above
  constexpr Support(float r) noexcept : Support(Radius(r)) {}                               // NOLINT: see above
};

/// Can this cloud be described by D with this search and support? All that can be said before the first key point.
template <class D, class Search>
[[nodiscard]] inline Status check(const CloudView& cloud, const Search& search, const Support& support) noexcept {
  Status status = check(cloud);
  if (status == Status::ok) status = search.status();
  if (status == Status::ok && search.cloud_size() != cloud.size) status = Status::bad_view;
  if (status == Status::ok) status = check(support.radius);
  if (status == Status::ok) status = check(support.frame_radius);
  if (status == Status::ok && support.viewpoint && !is_finite(*support.viewpoint)) status = Status::bad_viewpoint;
  if (status == Status::ok && D::needs_colors && !has_colors(cloud)) status = Status::missing_colors;
  if (status == Status::ok && D::needs_normals && !has_normals(cloud)) status = Status::missing_normals;
  return status;
}

namespace detail {

/// The larger of the two radii.
[[nodiscard]] inline Radius gather_radius(const Support& support) noexcept {
  return support.frame_radius.squared > support.radius.squared ? support.frame_radius : support.radius;
}

/// The source of a cloud's own normals.
template <class D>
[[nodiscard]] inline auto normals_of(const CloudView& cloud) noexcept {
  if constexpr (D::needs_normals) {
    return CloudNormals{cloud};
  } else {
    return NoNormals{};
  }
}

/// Frame and kernel; for `colors` see describe(), for `confidence` frame_of(). The other arguments were checked before.
template <class D, std::uint32_t ChunkSize, class Neighbors, class Colors, class... Confidence>
[[nodiscard]] inline Status describe_gathered(const CloudView& cloud, const Neighbors& n, const Colors& colors,
                                              const Point& center, const Support& support, Frame& frame, float* out,
                                              Confidence&... confidence) noexcept {
  const Point* eye = support.viewpoint;
  const float towards[3] = {eye ? eye->x - center.x : 0.0f, eye ? eye->y - center.y : 0.0f,
                            eye ? eye->z - center.z : 0.0f};
  if (!math::is_finite(towards)) return Status::bad_viewpoint;  // so far away that the difference overflows
  const Status status = frame_of(n, support.frame_radius, towards, frame, confidence...);
  if (status != Status::ok) return status;
  return describe_checked<D, ChunkSize>(n, colors, normals_of<D>(cloud), frame, support.radius, out);
}

/// In place of colors that were converted before: none, neighbors' bytes are converted whenever they are needed.
struct ConvertEach {};

/// Where D's colors come from, as seen from a key point: from an array of the whole cloud's ones, or from its bytes.
template <class D, class Color = ConvertEach>
[[nodiscard]] inline auto colors_of(const CloudView& cloud, const Rgb& reference,
                                    const Color* converted = nullptr) noexcept {
  if constexpr (!D::needs_colors) {
    return NoColors{};
  } else if constexpr (std::is_same<Color, ConvertEach>::value) {
    return RgbColors<typename D::LabRule>(cloud, to_lab<typename D::LabRule>(reference));
  } else {
    return StoredColors<Color>{converted, to_lab<typename D::LabRule>(reference)};
  }
}

/// A key point of describe_at(), by index or as it is. Descriptors without color need none of the key point's.
template <class D, class Place>
[[nodiscard]] inline Status find_key(const CloudView& cloud, const Place& place, KeyPoint& key) noexcept {
  if constexpr (std::is_integral<Place>::value) {
    const auto index = static_cast<std::size_t>(place);  // a negative one becomes far too large
    if (index >= cloud.size) return Status::bad_keypoint;
    key.position = point(cloud, index);
    if constexpr (D::needs_colors) key.color = color(cloud, index);
  } else {
    key = place;
  }
  return Status::ok;
}

/// Everything up to the gathered neighborhood; finish(neighborhood, colors, position) makes the descriptor of it.
template <class D, class Search, class Place, class Memory, class Color, class Finish>
[[nodiscard]] inline Status describe_key(const CloudView& cloud, const Search& search, const Place& place,
                                         const Support& support, Memory& workspace, float* out, const Color* converted,
                                         const Finish& finish) noexcept {
  std::memset(out, 0, D::size_bytes);
  KeyPoint key;
  Status status = check<D>(cloud, search, support);
  if (status == Status::ok) status = find_key<D>(cloud, place, key);
  if (status == Status::ok && !is_finite(key.position)) status = Status::invalid_keypoint;
  if (status != Status::ok) return status;
  const auto colors = colors_of<D>(cloud, key.color, converted);
  auto n = neighborhood_in(workspace, cloud, key.position);
  status = colors.status();
  if (status == Status::ok) status = search.gather(key.position, gather_radius(support), n);
  return status == Status::ok ? finish(n, colors, key.position) : status;
}

}  // namespace detail

/// Describe one key point of a cloud, given by its index or as a KeyPoint.
///
/// `search`     any search over this cloud
/// `support`    radii and, if known, the camera's position; a plain float is the radius in meters
/// `workspace`  a Workspace<MaxNeighbors> or a CompactWorkspace<MaxNeighbors>: all the memory there is
/// `out`        D::size floats: the descriptor, L2 norm 1, or all zeros if the status is not ok
/// `converted`  colors (Lab or PackedLab), one per point, that convert_colors() made by D's own rule; without them,
///              bytes of neighbors are converted again for every key point
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint,
/// missing_colors, missing_normals, bad_keypoint (the index), invalid_keypoint, too_many_neighbors (the workspace is
/// too small: Neighborhood::found of a gather() says what it takes), too_few_neighbors, ambiguous_frame; and what the
/// search's build() returned, if not ok. No allocation; reentrant, one workspace per thread.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Search, class Place = KeyPoint, class Memory,
          class Color = detail::ConvertEach>
[[nodiscard]] inline Status describe_at(const CloudView& cloud, const Search& search, const Place& place,
                                        const Support& support, Memory& workspace, float* out,
                                        const Color* converted = nullptr) noexcept {
  return detail::describe_key<D>(cloud, search, place, support, workspace, out, converted,
                                 [&](const auto& n, const auto& colors, const Point& position) {
                                   Frame frame;
                                   return detail::describe_gathered<D, ChunkSize>(cloud, n, colors, position, support,
                                                                                  frame, out);
                                 });
}

/// The same in a frame that the caller knows; bad_frame if it is not orthonormal.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Search, class Place = KeyPoint, class Memory,
          class Color = detail::ConvertEach>
[[nodiscard]] inline Status describe_at(const CloudView& cloud, const Search& search, const Place& place,
                                        const Frame& frame, Radius radius, Memory& workspace, float* out,
                                        const Color* converted = nullptr) noexcept {
  return detail::describe_key<D>(
      cloud, search, place, radius, workspace, out, converted, [&](const auto& n, const auto& colors, const Point&) {
        return describe<D, ChunkSize>(n, colors, detail::normals_of<D>(cloud), frame, radius, out);
      });
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
