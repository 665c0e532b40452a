// shortshot/descriptor.hpp: what a descriptor is made of. Pure types: sizes, offsets and layout are compile-time facts.
#pragma once

#include <cstddef>
#include <type_traits>

#include "color.hpp"
#include "config.hpp"
#include "grid.hpp"
#include "voting.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// Signal of SSH: none. Every point counts as one, a cell holds a plain sum.
struct Occupancy {
  static constexpr int bins = 1;
  static constexpr bool needs_colors = false;
  using Rule = void;  // no colours, no rule to convert them
};

/// Signal of CSHOT and SCSH: the CIELAB distance between a point's colour and the key point's, over `Bins` bins of
/// equal width. `LabRule` is the colour conversion (PublishedLab or PclLab).
template <int Bins, class LabRule = PublishedLab>
struct ColorDistance {
  static_assert(Bins >= 1 && Bins <= 1024, "ColorDistance<Bins> supports 1 to 1024 histogram bins");
  static constexpr int bins = Bins;
  static constexpr bool needs_colors = true;
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
/// Layout: histogram bin fastest, then radius, elevation, azimuth.
template <class GridType, class SignalType, class RadiusScale = LinearRadius>
struct Part {
  using Grid = GridType;
  using Signal = SignalType;
  using Scale = RadiusScale;
  static constexpr int size = Grid::cells * Signal::bins;
  static constexpr bool has_histogram = Signal::bins > 1 || Signal::needs_colors;

  /// Position of one value within the part.
  [[nodiscard]] static constexpr int index(int r, int e, int a, int bin = 0) noexcept {
    return bin + Signal::bins * Grid::index(r, e, a);
  }

  /// Bits of positions behind the point: what int32 has room for on the finest axis. No bit of a float is lost that
  /// could matter.
  static constexpr int bits = detail::position_bits(Grid::radial, Grid::elevation, Grid::azimuth, Signal::bins);
  using RadialAxis = Axis<Grid::radial, Signal::bins, Beyond::nothing, bits, Scale::below_zero>;
  using ElevationAxis = Axis<Grid::elevation, Signal::bins * Grid::radial, Beyond::nothing, bits>;
  using AzimuthAxis = Axis<Grid::azimuth, Signal::bins * Grid::radial * Grid::elevation, Beyond::first_cell, bits>;
  using SignalAxis = Axis<Signal::bins, 1, Beyond::nothing, bits>;
};

namespace detail {

/// The rule by which all of a descriptor's colour parts convert colours; void if it has none.
template <class... Signals>
struct LabRuleOf {
  using type = void;
};
template <class Signal, class... Others>
struct LabRuleOf<Signal, Others...> {
  using Mine = typename Signal::Rule;
  using Next = typename LabRuleOf<Others...>::type;
  static_assert(std::is_void<Mine>::value || std::is_void<Next>::value || std::is_same<Mine, Next>::value,
                "Descriptor supports one colour conversion for all its parts");
  using type = std::conditional_t<std::is_void<Mine>::value, Next, Mine>;
};

/// The smallest common multiple, up to 2^20: as far as floats tell multiples of its inverse apart.
constexpr int common_multiple(int a, int b) noexcept {
  constexpr int most = 1 << 20;
  int multiple = a;
  while (multiple % b != 0 && multiple < most - a) multiple += a;
  return multiple % b == 0 ? multiple : most;
}

}  // namespace detail

/// A descriptor: its parts one after the other, filled by one voting rule and normalised together to L2 norm 1.
template <class VotingRule, class... Parts>
struct Descriptor {
  using Voting = VotingRule;
  static_assert(sizeof...(Parts) >= 1, "Descriptor<Voting, Parts...> supports one or more parts");

  /// Number of floats, and of bytes when stored as floats.
  static constexpr int size = (Parts::size + ...);
  static constexpr std::size_t size_bytes = sizeof(float) * static_cast<std::size_t>(size);
  static_assert(size <= 65536, "Descriptor supports up to 65536 values");

  static constexpr bool needs_colors = (Parts::Signal::needs_colors || ...);
  using LabRule = typename detail::LabRuleOf<typename Parts::Signal...>::type;

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
    return borders;
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

/// SCSH (equations 6 and 7): SSH on one grid, histograms of colour distance on another. Needs points and colours.
template <class ShapeGrid, class ColorGrid, int Bins, class Voting = PublishedVoting, class RadiusScale = LinearRadius,
          class LabRule = PublishedLab>
using Scsh = Descriptor<Voting, Part<ShapeGrid, Occupancy, RadiusScale>,
                        Part<ColorGrid, ColorDistance<Bins, LabRule>, RadiusScale>>;

using Ssh32 = Ssh<SphericalGrid<2, 2, 8>>;
using Ssh96 = Ssh<SphericalGrid<3, 4, 8>>;
using Scsh336 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 4>, 15>;
using Scsh696 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 6>, 25>;

static_assert(Ssh32::size == 32 && Ssh96::size == 96 && Scsh336::size == 336 && Scsh696::size == 696,
              "the published sizes");

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
