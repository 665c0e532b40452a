// shortshot/kernel/soft_layout.hpp: where the quads of a compact descriptor's parts are, see soft_votes.hpp; all of it
// known while compiling.
#ifndef SHORTSHOT_KERNEL_SOFT_LAYOUT_HPP
#define SHORTSHOT_KERNEL_SOFT_LAYOUT_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "../descriptor/conventions.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/voting.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// An axis with more than one cell. `row`: the coordinate, 3 for the signal. `stride`: in the descriptor, of its cells.
struct SoftAxis {
  std::int16_t row, cells, stride;
  /// The azimuth's: the upper cell of the last one is the first.
  [[nodiscard]] constexpr bool is_around() const noexcept { return row == 2; }
  /// Places of the lower cell.
  [[nodiscard]] constexpr int lowers() const noexcept { return is_around() ? cells : cells - 1; }
  /// The same where parts' signals are told apart.
  [[nodiscard]] constexpr SoftAxis of_part(int part) const noexcept {
    return {static_cast<std::int16_t>(row < 3 ? row : 3 + part), cells, stride};
  }
};

/// Where a part's quads are. The first two axes are within a quad (none, where quads are a cell's numbers); cells of
/// the others are rows of quads.
struct SoftLayout {
  SoftAxis axes[4];
  int count;       ///< of axes
  int within;      ///< axes within a quad
  int of_cell;     ///< quads of a cell of means; 1
  int strides[4];  ///< in quads
  int quads;

  constexpr void add(int row, int axis_cells, int stride) noexcept {
    if (axis_cells == 1) return;
    axes[count++] = {static_cast<std::int16_t>(row), static_cast<std::int16_t>(axis_cells),
                     static_cast<std::int16_t>(stride)};
  }
  constexpr void lay_out(int axes_within) noexcept {
    within = count < axes_within ? count : axes_within;
    quads = of_cell;
    for (int i = 0; i < count; ++i) {
      strides[i] = quads;
      quads *= i < within ? axes[i].lowers() : axes[i].cells + (axes[i].is_around() ? 1 : 0);
    }
  }
  [[nodiscard]] constexpr int corners() const noexcept { return 1 << (count - within); }
};

template <class Part>
inline constexpr SoftLayout soft_layout = [] {
  SoftLayout layout{};
  constexpr bool means = Part::weight_cells > 0;
  constexpr extend::CellStrides cells = Part::Cells::template strides<typename Part::Grid>;
  layout.of_cell = means ? (Part::values + 4) / 4 : 1;
  if (!means) layout.add(3, Part::values, 1);
  layout.add(0, Part::Grid::radial, Part::values * cells.radial);
  layout.add(1, Part::Grid::elevation, Part::values * cells.elevation);
  layout.add(2, Part::Grid::azimuth, Part::values * cells.azimuth);
  layout.lay_out(means ? 0 : 2);
  return layout;
}();

/// The axes of all parts, those with the same cells of the same coordinate once: a point's place on each is found once.
template <int Parts>
struct SoftPlaces {
  SoftAxis axes[static_cast<std::size_t>(4 * Parts)];
  int count;

  [[nodiscard]] constexpr int find(const SoftAxis& axis) const noexcept {
    int k = 0;
    while (k < count && (axes[k].row != axis.row || axes[k].cells != axis.cells)) ++k;
    return k;
  }
  constexpr void add(const SoftLayout& layout, int part) noexcept {
    for (int i = 0; i < layout.count; ++i) {
      const SoftAxis axis = layout.axes[i].of_part(part);
      if (find(axis) == count) axes[count++] = axis;
    }
  }
};

template <class Voting, class... Parts>
constexpr SoftPlaces<sizeof...(Parts)> soft_places(Descriptor<Voting, Parts...>) noexcept {
  SoftPlaces<sizeof...(Parts)> places{};
  int part = 0;
  (places.add(soft_layout<Parts>, part++), ...);
  return places;
}

/// All quads of a descriptor's parts before part `part`.
template <class Voting, class... Parts>
constexpr int soft_quads(Descriptor<Voting, Parts...>, int part) noexcept {
  constexpr int quads[] = {soft_layout<Parts>.quads...};
  int sum = 0;
  for (int k = 0; k < part; ++k) sum += quads[k];
  return sum;
}

/// Most quads: with those of every lane 16 KB of stack.
inline constexpr int most_quads = 1024 / static_cast<int>(simd::lanes);

template <class Voting, class... Parts>
constexpr bool has_linear_radii(Descriptor<Voting, Parts...>) noexcept {
  return (Parts::Scale::is_linear && ...);
}

/// Are a descriptor's votes added up in quads? Those of compact ones, if there are not too many.
template <class D>
constexpr bool is_soft() noexcept {
  constexpr bool is_compact = std::is_same<typename D::Voting, MultilinearVoting>::value && !D::is_plain &&
                              std::is_same<typename D::Cells, HeightCells>::value && has_linear_radii(D{});
  if constexpr (is_compact) return soft_quads(D{}, D::parts) <= most_quads;
  return false;
}

template <class D>
constexpr int quads_of() noexcept {
  if constexpr (is_soft<D>()) return soft_quads(D{}, D::parts);
  return 1;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_LAYOUT_HPP
