// shortshot/search/nanoflann_missing.hpp: what stands for NanoflannSearch until <nanoflann.hpp> is there.
#pragma once

#include <cstddef>

#include "../cloud/cloud.hpp"
#include "../config.hpp"

namespace shortshot::detail::not_included {
inline namespace SHORTSHOT_CODE {

class NanoflannSearch {
 public:
  template <class... Options>
  explicit NanoflannSearch(const CloudView&, const Options&...) {
    static_assert(sizeof...(Options) > 999,
                  "NanoflannSearch needs <nanoflann.hpp> included before shortshot.hpp (which may be included again)");
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail::not_included

namespace shortshot {
// A directive, not a declaration: the class itself, as soon as it is there, comes before what a directive shows.
using namespace detail::not_included;
}  // namespace shortshot
