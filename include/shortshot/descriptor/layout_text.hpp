// shortshot/descriptor/layout_text.hpp: what the values of a descriptor mean, in English: for files, and for code that
// knows descriptors only at run time. What becomes of the text is up to whom it is told to: a string (layout_of.hpp),
// or a number (LayoutNumber), which needs no memory.
#pragma once

#include <cstdint>
#include <numeric>
#include <type_traits>

#include "../base/fnv1a.hpp"
#include "../config.hpp"
#include "descriptor.hpp"
#include "spherical_grid.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Policy, class = void>
struct HasName : std::false_type {};
template <class Policy>
struct HasName<Policy, std::enable_if_t<std::is_convertible<decltype(Policy::name), const char*>::value>>
    : std::true_type {};

/// A text's pieces, one after the other, to whoever has add(const char*).
template <class Text>
constexpr void add(Text& text, const char* piece) {
  text.add(piece);
}
template <class Text>
constexpr void add(Text& text, int number) {
  char digits[12] = {};
  char* first = digits + 11;
  for (; number >= 10; number /= 10) *--first = static_cast<char>('0' + number % 10);
  *--first = static_cast<char>('0' + number);
  text.add(first);
}
template <class Text, class... Pieces>
constexpr void add_all(Text& text, Pieces... pieces) {
  (add(text, pieces), ...);
}

template <class Policy>
[[nodiscard]] constexpr const char* name_of() noexcept {
  static_assert(HasName<Policy>::value,
                "layout_of<D>() supports policies with `static constexpr const char* name`, which must tell them from "
                "all others");
  return Policy::name;
}

/// What a radius scale's name leaves open.
template <class Scale>
struct ScaleParameters {
  template <class Text>
  static constexpr void add_to(Text&) {}
};
template <int Numerator, int Denominator>
struct ScaleParameters<LogRadius<Numerator, Denominator>> {
  template <class Text>
  static constexpr void add_to(Text& text) {
    constexpr int common = std::gcd(Numerator, Denominator);
    add_all(text, " from ", Numerator / common, "/", Denominator / common);
  }
};

/// What a part's finish says of itself; nothing where sums are its values.
template <class Finish>
struct FinishText {
  template <class Text>
  static constexpr void add_to(Text& text) {
    add_all(text, ", ", name_of<Finish>());
  }
};
template <>
struct FinishText<PlainSums> {
  template <class Text>
  static constexpr void add_to(Text&) {}
};
template <int PerMille>
struct FinishText<RootOfShares<PerMille>> {
  template <class Text>
  static constexpr void add_to(Text& text) {
    add_all(text, ", ", name_of<RootOfShares<PerMille>>(), ", length ", PerMille, "/1000");
  }
};
template <int PerMille, int FloorPercent, int NoisePerMille>
struct FinishText<SignedRoots<PerMille, FloorPercent, NoisePerMille>> {
  template <class Text>
  static constexpr void add_to(Text& text) {
    add_all(text, ", ", name_of<SignedRoots<PerMille, FloorPercent, NoisePerMille>>(), ", length ", PerMille,
            "/1000, floor ", FloorPercent, "/100, noise ", NoisePerMille, "/1000");
  }
};

template <class Signal, class Text>
constexpr void add_color(Text& text) {
  if constexpr (!std::is_void<typename Signal::Rule>::value) {
    add_all(text, " (", name_of<typename Signal::Rule>());
    if constexpr (std::is_same<typename Signal::Reference, MeanColor>::value)
      add_all(text, " from ", name_of<MeanColor>());
    add(text, ")");
  }
}

template <class Text, class First, class... Others>
constexpr void add_means(Text& text, SignalList<First, Others...>) {
  add_all(text, "means of ", name_of<First>());
  (add_all(text, " & ", name_of<Others>()), ...);
  add_color<First>(text);
}

template <class Part, class Text>
constexpr void add_part(Text& text) {
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

/// What D's values mean: see layout_of().
template <class Text, class Voting, class... Parts>
constexpr void add_layout(Text& text, const Descriptor<Voting, Parts...>*) {
  add_all(text, name_of<Voting>(), ", ", name_of<typename Descriptor<Voting, Parts...>::Cells>());
  const char* separator = ": ";
  ((add(text, separator), add_part<Parts>(text), separator = " | "), ...);
}

/// A text as a number.
struct LayoutNumber {
  std::uint64_t value = fnv1a_of_nothing;
  constexpr void add(const char* piece) noexcept {
    for (; *piece != '\0'; ++piece) value = fnv1a(value, static_cast<std::uint8_t>(*piece));
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
