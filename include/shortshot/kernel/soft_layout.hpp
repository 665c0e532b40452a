// shortshot/kernel/soft_layout.hpp: where the quads of a compact descriptor's parts are, see soft_votes.hpp; all of it
// known while compiling.
#pragma once

#include <type_traits>

#include "../config.hpp"
#include "../descriptor/conventions.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/voting.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// An axis with more than one cell. `row`: the coordinate, 3 for the signal. `stride`: in the descriptor, of its cells.
struct SoftAxis {
  int row, cells, stride;
  bool around;
  /// Places of the lower cell. Around the end, the upper cell of the last one is the first.
  [[nodiscard]] constexpr int lowers() const noexcept { return around ? cells : cells - 1; }
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

  constexpr void add(SoftAxis axis) noexcept {
    if (axis.cells > 1) axes[count++] = axis;
  }
  constexpr void lay_out(int axes_within) noexcept {
    within = count < axes_within ? count : axes_within;
    quads = of_cell;
    for (int i = 0; i < count; ++i) {
      strides[i] = quads;
      quads *= i < within ? axes[i].lowers() : axes[i].cells + (axes[i].around ? 1 : 0);
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
  if (!means) layout.add({3, Part::values, 1, false});
  layout.add({0, Part::Grid::radial, Part::values * cells.radial, false});
  layout.add({1, Part::Grid::elevation, Part::values * cells.elevation, false});
  layout.add({2, Part::Grid::azimuth, Part::values * cells.azimuth, true});
  layout.lay_out(means ? 0 : 2);
  return layout;
}();

/// All quads of a descriptor's parts before part `part`.
template <class Voting, class... Parts>
constexpr int soft_quads(Descriptor<Voting, Parts...>, int part) noexcept {
  constexpr int quads[] = {soft_layout<Parts>.quads...};
  int sum = 0;
  for (int k = 0; k < part; ++k) sum += quads[k];
  return sum;
}

/// Most quads on the stack: 8 KB.
inline constexpr int most_quads = 512;

/// Are a descriptor's votes added up in quads? Those of compact ones, if there are not too many.
template <class D>
constexpr bool is_soft() noexcept {
  constexpr bool is_compact = std::is_same<typename D::Voting, MultilinearVoting>::value && !D::is_plain &&
                              std::is_same<typename D::Cells, HeightCells>::value;
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
