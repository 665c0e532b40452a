// shortshot/descriptor/descriptor.hpp: what a descriptor is made of. Pure types: sizes, offsets and layout are
// compile-time facts.
#pragma once

#include <cstddef>
#include <type_traits>

#include "../color/lab.hpp"
#include "../config.hpp"
#include "axis.hpp"
#include "conventions.hpp"
#include "spherical_grid.hpp"
#include "voting.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// Signal of SSH: none. Every point counts as one, a cell holds a plain sum.
struct Occupancy {
  static constexpr const char* name = "occupancy";  ///< for layout_of()
  static constexpr bool has_histogram = false;
  static constexpr int bins = 1;
  static constexpr bool needs_colors = false;
  static constexpr bool needs_normals = false;
  using Rule = void;  // no colors, no rule to convert them
};

/// Signal of SHOT: the cosine of the angle between a point's normal and the frame's z axis, -1 to 1, over `Bins` bins.
template <int Bins>
struct NormalCosine {
  static_assert(Bins >= 1 && Bins <= 1023, "NormalCosine<Bins> supports 1 to 1023 histogram bins");
  static constexpr const char* name = "normal cosine";
  static constexpr bool has_histogram = true;
  static constexpr int bins = Bins;
  static constexpr bool needs_colors = false;
  static constexpr bool needs_normals = true;
  using Rule = void;
};

/// Signal of CSHOT and SCSH: the CIELAB distance between a point's color and the key point's, over `Bins` bins of
/// equal width. `LabRule` is the color conversion (PublishedLab, CshotLab or PclLab).
template <int Bins, class LabRule = PublishedLab>
struct ColorDistance {
  static_assert(Bins >= 1 && Bins <= 1024, "ColorDistance<Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = "color distance";
  static constexpr bool has_histogram = true;
  static constexpr int bins = Bins;
  static constexpr bool needs_colors = true;
  static constexpr bool needs_normals = false;
  using Rule = LabRule;
};

namespace detail {

/// The largest e such that positions up to any of these numbers of cells, times 2^e, are at most 2^30.
template <class... Cells>
constexpr int position_bits(Cells... cells) noexcept {
  int bits = 30;
  for (int covered = 1; ((covered < cells) || ...); covered *= 2) --bits;
  return bits;
}

}  // namespace detail

/// A spherical grid with a histogram of one signal in every cell.
/// Layout: histogram bin fastest, then radius, elevation, azimuth (PublishedCells) or elevation, radius, azimuth
/// (ShotCells).
template <class GridType, class SignalType, class RadiusScale = LinearRadius, class CellConvention = PublishedCells>
struct Part {
  using Grid = GridType;
  using Signal = SignalType;
  using Scale = RadiusScale;
  using Cells = CellConvention;
  static constexpr bool has_histogram = Signal::has_histogram;
  static constexpr int values = has_histogram ? Cells::values(Signal::bins) : 1;  ///< of one cell
  static constexpr int size = Grid::cells * values;

  /// Position of one value within the part.
  [[nodiscard]] static constexpr int index(int r, int e, int a, int bin = 0) noexcept {
    constexpr CellStrides cells = Cells::template strides<Grid>;
    return bin + values * (r * cells.radial + e * cells.elevation + a * cells.azimuth);
  }

  /// Bits of positions behind the point: what int32 has room for on the finest axis. No bit of a float is lost that
  /// could matter.
  static constexpr int grid_bits = detail::position_bits(Grid::radial, Grid::elevation, Grid::azimuth);
  static constexpr int bits = detail::position_bits(1 << (30 - grid_bits), values);

  /// The axes if every cell of the grid had `Values` values: radius, elevation, azimuth, and the histogram's where
  /// there is one.
  static constexpr int axis_count = has_histogram ? 4 : 3;
  template <int Values>
  static constexpr Axis axes[4] = {
      {Grid::radial, Values* Cells::template strides<Grid>.radial, Beyond::nothing, Scale::below_zero, grid_bits},
      {Grid::elevation, Values* Cells::template strides<Grid>.elevation, Beyond::nothing, BelowZero::never, grid_bits},
      {Grid::azimuth, Values* Cells::template strides<Grid>.azimuth, Beyond::first_cell,
       Cells::has_poles ? BelowZero::nowhere : BelowZero::never, grid_bits},
      {values, 1, Beyond::nothing, BelowZero::never, bits}};
};

namespace detail {

/// The rule by which all of a descriptor's color parts convert colors; void if it has none.
template <class... Signals>
struct LabRuleOf {
  using type = void;
};
template <class Signal, class... Others>
struct LabRuleOf<Signal, Others...> {
  using Mine = typename Signal::Rule;
  using Next = typename LabRuleOf<Others...>::type;
  static_assert(std::is_void<Mine>::value || std::is_void<Next>::value || std::is_same<Mine, Next>::value,
                "Descriptor supports one color conversion for all its parts");
  using type = std::conditional_t<std::is_void<Mine>::value, Next, Mine>;
};

/// Do all of these parts share their points among the same cells?
template <class... Parts>
struct HaveOneGrid : std::false_type {};
template <class First, class... Others>
struct HaveOneGrid<First, Others...>
    : std::bool_constant<((std::is_same<typename First::Grid, typename Others::Grid>::value &&
                           std::is_same<typename First::Scale, typename Others::Scale>::value) &&
                          ...)> {};

/// The first of some types.
template <class First, class...>
struct FirstOf {
  using type = First;
};

/// The smallest common multiple, up to 2^20: as far as floats tell multiples of its inverse apart.
constexpr int common_multiple(int a, int b) noexcept {
  constexpr int most = 1 << 20;
  int multiple = a;
  while (multiple % b != 0 && multiple < most - a) multiple += a;
  return multiple % b == 0 ? multiple : most;
}

}  // namespace detail

/// A descriptor: its parts one after the other, filled by one voting rule and normalized together to L2 norm 1.
template <class VotingRule, class... Parts>
struct Descriptor {
  using Voting = VotingRule;
  static_assert(sizeof...(Parts) >= 1, "Descriptor<Voting, Parts...> supports one or more parts");

  /// Number of floats, and of bytes when stored as floats.
  static constexpr int size = (Parts::size + ...);
  static constexpr std::size_t size_bytes = sizeof(float) * static_cast<std::size_t>(size);
  static_assert(size <= 65536, "Descriptor supports up to 65536 values");

  static constexpr bool needs_colors = (Parts::Signal::needs_colors || ...);
  static constexpr bool needs_normals = (Parts::Signal::needs_normals || ...);
  using LabRule = typename detail::LabRuleOf<typename Parts::Signal...>::type;

  using Cells = typename detail::FirstOf<typename Parts::Cells...>::type;
  static_assert((std::is_same<typename Parts::Cells, Cells>::value && ...),
                "Descriptor supports one cell convention for all its parts");

  /// Fewest bits behind the point of positions along its axes.
  static constexpr int position_bits = [] {
    int bits = 30;
    ((bits = Parts::bits < bits ? Parts::bits : bits), ...);
    return bits;
  }();

  /// All borders and middles of its shells are multiples of R / shell_borders; 1: none that need more than a float's
  /// bits.
  static constexpr int shell_borders = [] {
    int borders = 1;
    ((borders = detail::common_multiple(borders, Parts::Scale::borders(Parts::Grid::radial))), ...);
    return Cells::has_exact_shells ? borders : 1;
  }();

  /// First value of part `i` (of `parts` ones), and the end of the last part.
  static constexpr int parts = static_cast<int>(sizeof...(Parts));
  [[nodiscard]] static constexpr int offset(int i) noexcept {
    constexpr int sizes[] = {Parts::size...};
    int sum = 0;
    for (int k = 0; k < i && k < parts; ++k) sum += sizes[k];
    return sum;
  }
};

/// SSH (equation 4): how many points lie in each cell. Needs points only.
template <class Grid, class Voting = PublishedVoting, class RadiusScale = LinearRadius>
using Ssh = Descriptor<Voting, Part<Grid, Occupancy, RadiusScale>>;

/// SCSH (equations 6 and 7): SSH on one grid, histograms of color distance on another. Needs points and colors.
template <class ShapeGrid, class ColorGrid, int Bins, class Voting = PublishedVoting, class RadiusScale = LinearRadius,
          class LabRule = PublishedLab>
using Scsh = Descriptor<Voting, Part<ShapeGrid, Occupancy, RadiusScale>,
                        Part<ColorGrid, ColorDistance<Bins, LabRule>, RadiusScale>>;

/// SHOT: histograms of how normals lean against the frame's z axis. Needs points and normals. `Bins` as PCL counts
/// them: a histogram has one value more.
template <class Grid, int Bins, class Voting = ShotVoting, class RadiusScale = LinearRadius>
using Shot = Descriptor<Voting, Part<Grid, NormalCosine<Bins>, RadiusScale, ShotCells>>;

/// CSHOT: SHOT, and histograms of color distance on the same grid. Needs points, normals and colors.
template <class Grid, int ShapeBins, int ColorBins, class Voting = ShotVoting, class LabRule = CshotLab,
          class RadiusScale = LinearRadius>
using Cshot = Descriptor<Voting, Part<Grid, NormalCosine<ShapeBins>, RadiusScale, ShotCells>,
                         Part<Grid, ColorDistance<ColorBins, LabRule>, RadiusScale, ShotCells>>;

using Ssh32 = Ssh<SphericalGrid<2, 2, 8>>;
using Ssh96 = Ssh<SphericalGrid<3, 4, 8>>;
using Scsh336 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 4>, 15>;
using Scsh696 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 6>, 25>;

/// SHOT and CSHOT in PCL's sizes and layout, without its two defects: the last bin of a histogram gets its neighbor's
/// votes (PclVoting says what PCL does), and white has a color of its own (PclLab).
using Shot352 = Shot<SphericalGrid<2, 2, 8>, 10>;
using Cshot1344 = Cshot<SphericalGrid<2, 2, 8>, 10, 30>;

/// The same as PCL 1.13 computes them, defects included: for what is compared with descriptors that PCL has made.
using PclShot352 = Shot<SphericalGrid<2, 2, 8>, 10, PclVoting>;
using PclCshot1344 = Cshot<SphericalGrid<2, 2, 8>, 10, 30, PclVoting, PclLab>;

static_assert(Ssh32::size == 32 && Ssh96::size == 96 && Scsh336::size == 336 && Scsh696::size == 696 &&
                  Shot352::size == 352 && Cshot1344::size == 1344,
              "the published sizes");

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
