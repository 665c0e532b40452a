// shortshot/base/same_bits.hpp: a value as another type of plain data.
#pragma once

#include <cstring>
#include <type_traits>

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// C++20's std::bit_cast.
template <class To, class From>
[[nodiscard, gnu::always_inline]] inline To same_bits(const From& from) noexcept {
  static_assert(
      sizeof(To) == sizeof(From) && std::is_trivially_copyable<To>::value && std::is_trivially_copyable<From>::value,
      "plain data of one size");
  union Uninitialized {
    Uninitialized() noexcept {}
    To value;
  } to;
  std::memcpy(static_cast<void*>(&to.value), &from, sizeof from);
  return to.value;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
