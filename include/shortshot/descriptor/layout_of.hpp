// shortshot/descriptor/layout_of.hpp: what the values of a descriptor mean, as a string. Hosted only: allocates.
#pragma once

#include <string>

#include "../config.hpp"
#include "layout_text.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

struct StringText {
  std::string string;
  // Called, not inlined: text is put together from many pieces, and a compiler would take its time for each.
  [[gnu::noinline]] void add(const char* piece) { string += piece; }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// What the values of descriptor D mean and how they are laid out, in English and in ASCII: its voting rule, its cell
/// convention, and for each part its signal, histogram bins, color conversion, grid (radius x elevation x azimuth) and
/// radius scale. SCSH-336:
///
///     published voting, published cells: occupancy 3x4x8 equal shells | color distance 15 bins (published Lab) 2x2x4
///     equal shells
///
/// (in one line). Two types with the same text have values that can be compared; two that differ in anything named here
/// have different texts. What is no part of D is not in it: the radii, and how frames were turned. A policy of your own
/// needs a `name` as those of the library have, which says everything about it, parameters included. Allocates.
template <class D>
[[nodiscard]] std::string layout_of() {
  detail::StringText text;
  detail::add_layout(text, static_cast<const D*>(nullptr));
  return text.string;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
