// shortshot/descriptor/layout_text.hpp: what the values of a descriptor mean, as text: for files, and for code that
// knows descriptors only at run time. Hosted only: allocates.
#pragma once

#include <numeric>
#include <string>
#include <type_traits>

#include "../config.hpp"
#include "descriptor.hpp"
#include "spherical_grid.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Policy, class = void>
struct HasName : std::false_type {};
template <class Policy>
struct HasName<Policy, std::void_t<decltype(std::string(Policy::name))>> : std::true_type {};

template <class Policy>
[[nodiscard]] std::string name_of() {
  static_assert(HasName<Policy>::value,
                "layout_of<D>() supports policies with `static constexpr const char* name`, which must tell them from "
                "all others");
  return Policy::name;
}

/// What a radius scale's name leaves open.
template <class Scale>
struct ScaleParameters {
  [[nodiscard]] static std::string text() { return {}; }
};
template <int Numerator, int Denominator>
struct ScaleParameters<LogRadius<Numerator, Denominator>> {
  [[nodiscard]] static std::string text() {
    constexpr int common = std::gcd(Numerator, Denominator);
    return " from " + std::to_string(Numerator / common) + '/' + std::to_string(Denominator / common);
  }
};

template <class Signal>
[[nodiscard]] std::string signal_text() {
  std::string text = name_of<Signal>();
  if constexpr (Signal::has_histogram) text += ' ' + std::to_string(Signal::bins) + " bins";
  if constexpr (!std::is_void<typename Signal::Rule>::value) text += " (" + name_of<typename Signal::Rule>() + ')';
  return text;
}

template <class Part>
[[nodiscard]] std::string part_text() {
  using Grid = typename Part::Grid;
  using Scale = typename Part::Scale;
  return signal_text<typename Part::Signal>() + ' ' + std::to_string(Grid::radial) + 'x' +
         std::to_string(Grid::elevation) + 'x' + std::to_string(Grid::azimuth) + ' ' + name_of<Scale>() +
         ScaleParameters<Scale>::text();
}

template <class Voting, class... Parts>
[[nodiscard]] std::string layout_text(const Descriptor<Voting, Parts...>*) {
  std::string text = name_of<Voting>() + ", " + name_of<typename Descriptor<Voting, Parts...>::Cells>();
  const char* separator = ": ";
  ((text += separator + part_text<Parts>(), separator = " | "), ...);
  return text;
}

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
  return detail::layout_text(static_cast<const D*>(nullptr));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
