// shortshot/adapters/structs.hpp: views of containers of structs, PCL's clouds among them, by their members' names.
//
// No other library is included: whatever has the members is understood. A point needs float x, y, z (in that or any
// order, with any padding) and, for colour, one-byte r, g, b (in any order: PCL keeps b, g, r, a).
#pragma once

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

#include "../cloud.hpp"
#include "../config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

template <class P, class = void>
struct HasRgb : std::false_type {};
template <class P>
struct HasRgb<P, std::void_t<decltype(P::r), decltype(P::g), decltype(P::b)>>
    : std::bool_constant<sizeof(P::r) == 1 && sizeof(P::g) == 1 && sizeof(P::b) == 1> {};

template <class C, class = void>
struct HasPoints : std::false_type {};
template <class C>
struct HasPoints<C, std::void_t<decltype(std::declval<const C&>().points.data())>> : std::true_type {};

template <class Member>
[[nodiscard]] const unsigned char* bytes_of(const Member& member) noexcept {
  return reinterpret_cast<const unsigned char*>(&member);
}

}  // namespace detail

/// View of `count` structs with members x, y, z and, if they have them, r, g, b.
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
  if (points == nullptr || count == 0) return view;  // to be refused by check()
  view.points = {detail::bytes_of(points->x), detail::bytes_of(points->y), detail::bytes_of(points->z), sizeof(P)};
  if constexpr (detail::HasRgb<P>::value) {
    view.colors = {detail::bytes_of(points->r), detail::bytes_of(points->g), detail::bytes_of(points->b), sizeof(P)};
  }
  return view;
}

/// View of an array, a std::vector or anything else with data() and size(); or of a pcl::PointCloud-shaped object:
/// `points` with data() and size(), and `width` and `height`.
template <class Container>
[[nodiscard]] CloudView view_of(const Container& cloud) noexcept {
  if constexpr (detail::HasPoints<Container>::value) {
    const CloudView view = view_of(cloud.points.data(), cloud.points.size());
    return static_cast<std::size_t>(cloud.width) * cloud.height == view.size
               ? organized(view, cloud.width, cloud.height)
               : view;
  } else {
    return view_of(std::data(cloud), std::size(cloud));
  }
}

/// A container that dies at the end of the statement cannot be viewed.
template <class Container>
CloudView view_of(const Container&& cloud) = delete;

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
