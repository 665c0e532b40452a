// shortshot/kernel/describe_at.hpp: one key point from cloud to descriptor: search, frame and kernel in one call.
#ifndef SHORTSHOT_KERNEL_DESCRIBE_AT_HPP
#define SHORTSHOT_KERNEL_DESCRIBE_AT_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../color/color_source.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/source_set.hpp"
#include "../frame/frame.hpp"
#include "../frame/viewpoint.hpp"
#include "../search/radius.hpp"
#include "../search/search.hpp"
#include "../search/workspace.hpp"
#include "../status.hpp"
#include "describe.hpp"
#include "support.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Can this cloud be described by D with this search and support? All that can be said before the first key point.
template <class D, class Search>
[[nodiscard, gnu::always_inline]] inline Status validate(const CloudView& cloud, const Search& search,
                                                         const Support& support) noexcept {
  Status status = detail::validate_search(cloud, search);
  if (status == Status::ok) status = validate(support.radius);
  if (status == Status::ok) status = validate(support.frame_radius);
  if (status == Status::ok) status = validate(support.viewpoint);
  if (status == Status::ok && D::needs_colors && !has_colors(cloud)) status = Status::missing_colors;
  if (status == Status::ok && D::needs_normals && !has_normals(cloud)) status = Status::missing_normals;
  if (status == Status::ok && D::needs_intensities && !has_intensities(cloud)) status = Status::missing_intensities;
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// How far neighbors matter: none for a frame that D does not need.
template <class D>
[[nodiscard]] inline Radius reach_of(const Support& support) noexcept {
  return D::needs_frame ? gather_radius(support) : support.radius;
}

/// Frame and kernel of a neighborhood around `center`; for `confidence` see frame_of(). The arguments were validated
/// before. Where D needs no frame, `frame` and `confidence` stay what they are.
template <class D, std::uint32_t ChunkSize, class Neighbors, class Sources, class... Confidence>
[[nodiscard]] inline Status describe_gathered(const Neighbors& n, const Sources& sources, const Point& center,
                                              const Support& support, Frame& frame, float* out,
                                              Confidence&... confidence) noexcept {
  if constexpr (!D::needs_frame) {
    return describe_checked<D, ChunkSize>(n, sources, any_frame, support.radius, out);
  } else {
    float view[3];
    Status status = direction_at(support.viewpoint, center, view);
    if (status == Status::ok) status = frame_of(n, support.frame_radius, view, frame, confidence...);
    if (status != Status::ok) return status;
    return describe_checked<D, ChunkSize>(n, sources, frame, support.radius, out);
  }
}

template <class Kind, class = void>
struct IsMadeOfCloud : std::false_type {};
template <class Kind>
struct IsMadeOfCloud<Kind,
                     std::void_t<decltype(Kind::at(std::declval<const CloudView&>(), std::declval<const KeyPoint&>()))>>
    : std::true_type {};

/// The source of one kind at a key point: made of the cloud, or the first of the caller's own that stands for it. An
/// array of the whole cloud's colors, converted before, stands for colors.
template <class Kind, class Key>
[[nodiscard]] inline auto source_at(const CloudView& cloud, const Key& key) noexcept {
  static_assert(IsMadeOfCloud<Kind>::value,
                "D has a signal whose source is not made of the cloud: it supports sources of yours as last arguments");
  return Kind::at(cloud, key);
}
template <class Kind, class Key, class First, class... Own>
[[nodiscard]] inline auto source_at(const CloudView& cloud, const Key& key, const First& first,
                                    const Own&... own) noexcept {
  if constexpr (StandsFor<Kind, First>::value) {
    return first;
  } else if constexpr (std::is_pointer<std::decay_t<First>>::value && channel_of<Kind> == Channel::colors) {
    using Color = std::remove_const_t<std::remove_pointer_t<std::decay_t<First>>>;
    const Lab reference = reference_at<typename Kind::Rule>(key);
    const Color* const colors = first;
    return StoredColors<Color>{key.has_color ? colors : nullptr, reference};
  } else {
    return source_at<Kind>(cloud, key, own...);
  }
}

/// All sources of a descriptor at a key point.
template <class... Kinds, class Key, class... Own>
[[nodiscard]] inline auto sources_at(extend::SourceKinds<Kinds...>, const CloudView& cloud, const Key& key,
                                     const Own&... own) noexcept {
  return sources(source_at<Kinds>(cloud, key, own...)...);
}

/// A key point of describe_at(), by index or as it is, with what D needs of it.
template <class D, class Place>
[[nodiscard]] inline Status find_key(const CloudView& cloud, const Place& place, KeyPoint& key) noexcept {
  if constexpr (std::is_integral<Place>::value) {
    if (!is_index(cloud, place)) return Status::bad_keypoint;
    const auto index = static_cast<std::size_t>(place);
    key.position = point(cloud, index);
    key.has_color = D::needs_colors;
    key.has_intensity = D::needs_intensities;
    if constexpr (D::needs_colors && !D::compares_with_mean) key.color = color(cloud, index);
    if constexpr (D::needs_intensities) key.intensity = intensity(cloud, index);
  } else {
    key = place;
  }
  return Status::ok;
}

/// A key point as D's sources see it: where colors are compared with their mean, its own may be missing.
template <class D>
[[nodiscard, gnu::always_inline]] inline decltype(auto) key_for(const KeyPoint& key) noexcept {
  if constexpr (D::compares_with_mean) {
    KeyWithoutColor seen(key);
    seen.has_color = true;
    return seen;
  } else {
    return (key);
  }
}

/// Everything up to the gathered neighborhood; finish(neighborhood, sources, position) makes the descriptor of it.
template <class D, class Search, class Place, class Memory, class Finish, class... Own>
[[nodiscard, gnu::always_inline]] inline Status describe_key(const CloudView& cloud, const Search& search,
                                                             const Place& place, const Support& support,
                                                             Memory& workspace, float* out, const Finish& finish,
                                                             const Own&... own) noexcept {
  std::memset(out, 0, D::size_bytes);
  KeyPoint key;
  Status status = validate<D>(cloud, search, support);
  if (status == Status::ok) status = find_key<D>(cloud, place, key);
  if (status == Status::ok && !is_finite(key.position)) status = Status::invalid_keypoint;
  if (status != Status::ok) return status;
  const auto sources = sources_at(typename D::Sources{}, cloud, key_for<D>(key), own...);
  auto n = neighborhood_in(workspace, cloud);
  status = status_of(typename D::Sources{}, sources);
  if (status == Status::ok) status = search.gather(key.position, reach_of<D>(support), n);
  return status == Status::ok ? finish(n, sources, key.position) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describe one key point of a cloud, given by its index or as a KeyPoint.
///
/// `search`     any search over this cloud
/// `support`    radii and, if known, the camera's position; a plain float is the radius in meters
/// `workspace`  a Workspace<MaxNeighbors> or a CompactWorkspace<MaxNeighbors>: all the memory there is
/// `out`        D::size floats: the descriptor, L2 norm 1, or all zeros if the status is not ok
/// `own`        sources of yours for D's signals, which come before those that the cloud has; a pointer to colors
///              (Lab or PackedLab), one per point, that convert_colors() made by D's own rule: without them, bytes of
///              neighbors are converted again for every key point
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint,
/// missing_colors, missing_normals, missing_intensities (of the cloud or the key point), bad_keypoint (the index),
/// invalid_keypoint, too_many_neighbors (the workspace is too small: Neighborhood::found of a gather() says what it
/// takes), too_few_neighbors, ambiguous_frame; and what the search's build() returned, if not ok. If D needs no frame
/// (D::needs_frame), none is estimated: no ambiguous_frame, and one neighbor is enough. No allocation; reentrant, one
/// workspace per thread.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Search, class Place = KeyPoint, class Memory,
          class... Own>
[[nodiscard, gnu::always_inline]] inline Status describe_at(const CloudView& cloud, const Search& search,
                                                            const Place& place, const Support& support,
                                                            Memory& workspace, float* out, const Own&... own) noexcept {
  return detail::describe_key<D>(
      cloud, search, place, support, workspace, out,
      [&](const auto& n, const auto& sources, const Point& position) __attribute__((always_inline)) {
        Frame frame;
        return detail::describe_gathered<D, ChunkSize>(n, sources, position, support, frame, out);
      },
      own...);
}

/// The same in a frame that the caller knows; bad_frame if it is not orthonormal.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Search, class Place = KeyPoint, class Memory,
          class... Own>
[[nodiscard, gnu::always_inline]] inline Status describe_at(const CloudView& cloud, const Search& search,
                                                            const Place& place, const Frame& frame, Radius radius,
                                                            Memory& workspace, float* out, const Own&... own) noexcept {
  return detail::describe_key<D>(
      cloud, search, place, radius, workspace, out,
      [&](const auto& n, const auto& sources, const Point&)
          __attribute__((always_inline)) { return describe<D, ChunkSize>(n, sources, frame, radius, out); },
      own...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_KERNEL_DESCRIBE_AT_HPP
