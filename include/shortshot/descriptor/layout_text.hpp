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

// Called, not inlined: text is put together from many pieces, and a compiler would take its time for each.
[[gnu::noinline]] inline void add(std::string& text, const char* more) { text += more; }
[[gnu::noinline]] inline void add(std::string& text, int number) { text += std::to_string(number); }
template <class... Pieces>
void add_all(std::string& text, Pieces... pieces) {
  (add(text, pieces), ...);
}

template <class Policy>
[[nodiscard]] const char* name_of() noexcept {
  static_assert(HasName<Policy>::value,
                "layout_of<D>() supports policies with `static constexpr const char* name`, which must tell them from "
                "all others");
  return Policy::name;
}

/// What a radius scale's name leaves open.
template <class Scale>
struct ScaleParameters {
  static void add_to(std::string&) {}
};
template <int Numerator, int Denominator>
struct ScaleParameters<LogRadius<Numerator, Denominator>> {
  static void add_to(std::string& text) {
    constexpr int common = std::gcd(Numerator, Denominator);
    add_all(text, " from ", Numerator / common, "/", Denominator / common);
  }
};

/// What a part's finish says of itself; nothing where sums are its values.
template <class Finish>
struct FinishText {
  static void add_to(std::string& text) { add_all(text, ", ", name_of<Finish>()); }
};
template <>
struct FinishText<PlainSums> {
  static void add_to(std::string&) {}
};
template <int PerMille>
struct FinishText<RootOfShares<PerMille>> {
  static void add_to(std::string& text) {
    add_all(text, ", ", name_of<RootOfShares<PerMille>>(), ", length ", PerMille, "/1000");
  }
};
template <int PerMille, int FloorPercent, int NoisePerMille>
struct FinishText<SignedRoots<PerMille, FloorPercent, NoisePerMille>> {
  static void add_to(std::string& text) {
    add_all(text, ", ", name_of<SignedRoots<PerMille, FloorPercent, NoisePerMille>>(), ", length ", PerMille,
            "/1000, floor ", FloorPercent, "/100, noise ", NoisePerMille, "/1000");
  }
};

template <class Signal>
void add_color(std::string& text) {
  if constexpr (!std::is_void<typename Signal::Rule>::value) {
    add_all(text, " (", name_of<typename Signal::Rule>());
    if constexpr (std::is_same<typename Signal::Reference, MeanColor>::value)
      add_all(text, " from ", name_of<MeanColor>());
    add(text, ")");
  }
}

template <class First, class... Others>
void add_means(std::string& text, SignalList<First, Others...>) {
  add_all(text, "means of ", name_of<First>());
  (add_all(text, " & ", name_of<Others>()), ...);
  add_color<First>(text);
}

template <class Part>
void add_part(std::string& text) {
  using Grid = typename Part::Grid;
  if constexpr (Part::weight_cells > 0) {
    add_means(text, typename Part::Averaged{});
    add_all(text, " shrunk by ", Part::shrink_percent, "/100");
  } else {
    using Signal = typename Part::Signal;
    add(text, name_of<Signal>());
    if constexpr (Signal::has_histogram) add_all(text, " ", Signal::bins, " bins");
    add_color<Signal>(text);
  }
  add_all(text, " ", Grid::radial, "x", Grid::elevation, "x", Grid::azimuth, " ", name_of<typename Part::Scale>());
  ScaleParameters<typename Part::Scale>::add_to(text);
  FinishText<typename Part::Finish>::add_to(text);
}

template <class Voting, class... Parts>
[[nodiscard]] std::string layout_text(const Descriptor<Voting, Parts...>*) {
  std::string text;
  add_all(text, name_of<Voting>(), ", ", name_of<typename Descriptor<Voting, Parts...>::Cells>());
  const char* separator = ": ";
  ((add(text, separator), add_part<Parts>(text), separator = " | "), ...);
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
