// shortshot/recognition/row_format.hpp: what rows of descriptors must have to be matched: for who stores them in a
// format of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "../config.hpp"
#include "../status.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

template <class Rows, class = void>
struct HasCount : std::false_type {};
template <class Rows>
struct HasCount<Rows, std::void_t<decltype(static_cast<std::size_t>(std::declval<const Rows&>().count))>>
    : std::true_type {};

template <class Rows, class = void>
struct HasStatus : std::false_type {};
template <class Rows>
struct HasStatus<Rows, std::void_t<decltype(std::declval<const Rows&>().status)>>
    : std::is_convertible<decltype(std::declval<const Rows&>().status), const Status*> {};

template <class Rows, class = void>
struct HasFits : std::false_type {};
template <class Rows>
struct HasFits<Rows, std::void_t<decltype(std::declval<const Rows&>().fits(std::declval<const Rows&>()))>>
    : std::is_convertible<decltype(std::declval<const Rows&>().fits(std::declval<const Rows&>())), bool> {};

template <class Rows, class = void>
struct RowsNumber {
  using type = void;
};
template <class Rows>
struct RowsNumber<Rows, std::void_t<decltype(std::declval<const Rows&>().compare(
                            std::size_t{}, std::declval<const Rows&>(), std::size_t{}))>> {
  using type = decltype(std::declval<const Rows&>().compare(std::size_t{}, std::declval<const Rows&>(), std::size_t{}));
};

template <class Rows, class = void>
struct HasDistance : std::false_type {};
template <class Rows>
struct HasDistance<
    Rows, std::void_t<decltype(std::declval<const Rows&>().distance(std::declval<typename RowsNumber<Rows>::type>()))>>
    : std::is_convertible<
          decltype(std::declval<const Rows&>().distance(std::declval<typename RowsNumber<Rows>::type>())), float> {};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// Can Rows be given to nearest(), reciprocal_correspondences() and ratio_correspondences()? They take whatever has
///
///     struct Rows {  // borrowed: copied, and asked by several threads at the same time
///       std::size_t count;                   // how many there are
///       const shortshot::Status* status;     // one per row: those that are not ok are left out; null: all are ok
///       bool fits(const Rows& other) const;  // can they be compared? bad_rows if not
///       Number compare(std::size_t row, const Rows& other, std::size_t others_row) const;
///       float distance(Number compared) const;  // what Match::distance says of it
///     };
///
/// compare() gives an integer or a float that is the larger the farther away: a sum of squares saves the root of each
/// pair. It is less than the largest one of its type; a row for which it is that, or NaN, is nobody's match. The
/// library's own rows are made like that, and compared faster than pair by pair.
template <class Rows>
inline constexpr bool is_row_format =
    std::conjunction<detail::HasCount<Rows>, detail::HasStatus<Rows>, detail::HasFits<Rows>,
                     std::is_arithmetic<typename detail::RowsNumber<Rows>::type>, detail::HasDistance<Rows>>::value;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Says what is missing.
template <class Rows>
constexpr void require_row_format() noexcept {
  static_assert(HasCount<Rows>::value, "matching supports rows with `std::size_t count`: see extend::is_row_format");
  static_assert(HasStatus<Rows>::value,
                "matching supports rows with `const Status* status`: see extend::is_row_format");
  static_assert(HasFits<Rows>::value,
                "matching supports rows with `bool fits(const Rows& other) const`: see extend::is_row_format");
  static_assert(std::is_arithmetic<typename RowsNumber<Rows>::type>::value,
                "matching supports rows with `Number compare(std::size_t row, const Rows& other, std::size_t "
                "others_row) const`, an integer or a float: see extend::is_row_format");
  static_assert(!std::is_arithmetic<typename RowsNumber<Rows>::type>::value || HasDistance<Rows>::value,
                "matching supports rows with `float distance(Number compared) const`: see extend::is_row_format");
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
