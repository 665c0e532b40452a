// shortshot/cloud/view_of.hpp: views of containers of structs, PCL's clouds among them, by their members' names.
//
// No other library is included: whatever has the members is understood. A point needs float x, y, z (in that or any
// order, with any padding), for color one-byte r, g, b (in any order: PCL keeps b, g, r, a), and for a normal float
// normal_x, normal_y, normal_z, which may also stand in structs of their own; for an intensity a float, a std::uint8_t
// or a std::uint16_t of that name (pcl::PointXYZI).
#pragma once

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

#include "../config.hpp"
#include "cloud.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class P, class = void>
struct HasRgb : std::false_type {};
template <class P>
struct HasRgb<P, std::void_t<decltype(P::r), decltype(P::g), decltype(P::b)>>
    : std::bool_constant<sizeof(P::r) == 1 && sizeof(P::g) == 1 && sizeof(P::b) == 1> {};

template <class P, class = void>
struct HasNormal : std::false_type {};
template <class P>
struct HasNormal<P, std::void_t<decltype(P::normal_x), decltype(P::normal_y), decltype(P::normal_z)>>
    : std::bool_constant<std::is_same<std::remove_cv_t<decltype(P::normal_x)>, float>::value &&
                         std::is_same<std::remove_cv_t<decltype(P::normal_y)>, float>::value &&
                         std::is_same<std::remove_cv_t<decltype(P::normal_z)>, float>::value> {};

template <class P, class = void>
struct HasIntensity : std::false_type {};
template <class P>
struct HasIntensity<P, std::void_t<decltype(P::intensity)>>
    : std::bool_constant<is_channel_scalar<std::remove_cv_t<decltype(P::intensity)>>> {};

template <class C, class = void>
struct HasPoints : std::false_type {};
template <class C>
struct HasPoints<C, std::void_t<decltype(std::declval<const C&>().points.data())>> : std::true_type {};

/// view_of()'s second argument is a container, unless it is a count.
template <class C>
using IfContainer = std::enable_if_t<!std::is_convertible<C, std::size_t>::value>;

/// The structs in a container, or in the `points` of a pcl::PointCloud-shaped object.
template <class C>
[[nodiscard]] const auto& structs_of(const C& container) noexcept {
  if constexpr (HasPoints<C>::value) {
    return container.points;
  } else {
    return container;
  }
}

template <class Member>
[[nodiscard]] const unsigned char* bytes_of(const Member& member) noexcept {
  return reinterpret_cast<const unsigned char*>(&member);
}

template <class P>
[[nodiscard]] Float3Channel normals_of(const P* structs, std::size_t count) noexcept {
  if (structs == nullptr || count == 0) return {};
  return {bytes_of(structs->normal_x), bytes_of(structs->normal_y), bytes_of(structs->normal_z), sizeof(P)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// View of `count` structs with members x, y, z and, if they have them, r, g, b; normal_x, normal_y, normal_z; and
/// intensity.
template <class P>
[[nodiscard]] CloudView view_of(const P* points, std::size_t count) noexcept {
  static_assert(std::is_same<std::remove_cv_t<decltype(P::x)>, float>::value &&
                    std::is_same<std::remove_cv_t<decltype(P::y)>, float>::value &&
                    std::is_same<std::remove_cv_t<decltype(P::z)>, float>::value,
                "view_of() supports points with float members x, y and z");
  CloudView view{};
  view.size = count;
  view.width = count;
  view.height = 1;
  if (points == nullptr || count == 0) return view;  // to be refused by validate()
  view.points = {detail::bytes_of(points->x), detail::bytes_of(points->y), detail::bytes_of(points->z), sizeof(P)};
  if constexpr (detail::HasRgb<P>::value) {
    view.colors = {detail::bytes_of(points->r), detail::bytes_of(points->g), detail::bytes_of(points->b), sizeof(P)};
  }
  if constexpr (detail::HasNormal<P>::value) view.normals = detail::normals_of(points, count);
  if constexpr (detail::HasIntensity<P>::value) return with_intensities(view, &points->intensity, sizeof(P));
  return view;
}

/// View of an array, a std::vector or anything else with data() and size(); or of a pcl::PointCloud-shaped object:
/// `points` with data() and size(), and `width` and `height`.
template <class Container>
[[nodiscard]] CloudView view_of(const Container& cloud) noexcept {
  const auto& structs = detail::structs_of(cloud);
  const CloudView view = view_of(std::data(structs), std::size(structs));
  if constexpr (detail::HasPoints<Container>::value) {
    if (static_cast<std::size_t>(cloud.width) * cloud.height == view.size) {
      return organized(view, cloud.width, cloud.height);
    }
  }
  return view;
}

/// The same with normals from a second container of structs with members normal_x, normal_y, normal_z, such as a
/// pcl::PointCloud<pcl::Normal>; normals that the points have themselves are not read. sizes_differ if the numbers of
/// structs do.
template <class Container, class Normals, class = detail::IfContainer<Normals>>
[[nodiscard]] CloudView view_of(const Container& cloud, const Normals& normals) noexcept {
  const auto& structs = detail::structs_of(normals);
  using Struct = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(structs))>>;
  static_assert(detail::HasNormal<Struct>::value,
                "view_of() supports normals with float members normal_x, normal_y and normal_z");
  CloudView view = view_of(cloud);
  if (std::size(structs) != view.size) return detail::unusable_view(Status::sizes_differ);
  view.normals = detail::normals_of(std::data(structs), std::size(structs));
  return view;
}

/// A container that dies at the end of the statement cannot be viewed.
template <class Container>
CloudView view_of(const Container&& cloud) = delete;
template <class Container, class Normals, class = detail::IfContainer<Normals>>
CloudView view_of(const Container&& cloud, const Normals& normals) = delete;
template <class Container, class Normals, class = detail::IfContainer<Normals>>
CloudView view_of(const Container& cloud, const Normals&& normals) = delete;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
