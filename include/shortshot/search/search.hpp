// shortshot/search/search.hpp: what a search is.
#ifndef SHORTSHOT_SEARCH_SEARCH_HPP
#define SHORTSHOT_SEARCH_SEARCH_HPP

#include <cstddef>
#include <type_traits>
#include <utility>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "neighborhood.hpp"
#include "radius.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A search is anything with three functions:
/// * `Status gather(const Point& center, Radius radius, Neighbors& out) const`, for Neighborhood and whatever else it
///   shall work with, offers each valid point within the radius to `out` exactly once, in any order, by the index it
///   has in the cloud: extend::clear(out, center) before the first, extend::offer() for each that may be one, and
///   extend::outcome(out) as the result. It returns status() if that is not ok. It allocates nothing, and several
///   threads may call it at once;
/// * `Status status() const` says why it cannot be asked, if so: what its build() returned;
/// * `std::size_t cloud_size() const` is the size of its cloud, so that it is not asked about another one.
template <class Search, class = void>
struct IsSearch : std::false_type {};
template <class Search>
struct IsSearch<
    Search,
    std::void_t<decltype(std::declval<const Search&>().gather(std::declval<const Point&>(), std::declval<Radius>(),
                                                              std::declval<Neighborhood&>())),
                decltype(std::declval<const Search&>().status()), decltype(std::declval<const Search&>().cloud_size())>>
    : std::bool_constant<
          std::is_same<decltype(std::declval<const Search&>().gather(
                           std::declval<const Point&>(), std::declval<Radius>(), std::declval<Neighborhood&>())),
                       Status>::value &&
          std::is_same<decltype(std::declval<const Search&>().status()), Status>::value &&
          std::is_convertible<decltype(std::declval<const Search&>().cloud_size()), std::size_t>::value> {};

/// Can this cloud be searched, and is this a search over it?
template <class Search>
[[nodiscard]] inline Status validate_search(const CloudView& cloud, const Search& search) noexcept {
  static_assert(IsSearch<Search>::value,
                "A search has `Status gather(const Point&, Radius, Neighbors&) const`, `Status status() const` and "
                "`std::size_t cloud_size() const`. See 'How to add a search' in include/shortshot/README.md");
  Status status = validate(cloud);
  if constexpr (IsSearch<Search>::value) {
    if (status == Status::ok) status = search.status();
    if (status == Status::ok && search.cloud_size() != cloud.size) status = Status::bad_view;
  }
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_SEARCH_HPP
