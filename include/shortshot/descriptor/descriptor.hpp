// shortshot/descriptor/descriptor.hpp: what a descriptor is made of. Pure types: sizes, offsets and layout are
// compile-time facts.
#ifndef SHORTSHOT_DESCRIPTOR_DESCRIPTOR_HPP
#define SHORTSHOT_DESCRIPTOR_DESCRIPTOR_HPP

#include <cstddef>
#include <type_traits>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "axis.hpp"
#include "concepts.hpp"
#include "conventions.hpp"
#include "exact_shells.hpp"
#include "finish_rules.hpp"
#include "signals.hpp"
#include "source_set.hpp"
#include "spherical_grid.hpp"
#include "voting.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The largest e such that positions up to any of these numbers of cells, times 2^e, are at most 2^30.
template <class... Cells>
[[gnu::always_inline]] constexpr int position_bits(Cells... cells) noexcept {
  int bits = 30;
  for (int covered = 1; ((covered < cells) || ...); covered *= 2) --bits;
  return bits;
}

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A spherical grid with a histogram of one signal in every cell.
/// Layout: histogram bin fastest, then radius, elevation, azimuth (PublishedCells) or elevation, radius, azimuth
/// (ShotCells).
template <class GridType, class SignalType, class RadiusScale = LinearRadius, class CellConvention = PublishedCells,
          class FinishRule = PlainSums>
struct Part {
  static_assert(
      detail::IsSignal<SignalType>::value,
      "Part<Grid, Signal> supports Occupancy, or a signal derived from extend::Signal<Bins, Kinds...> with "
      "`static extend::simd::F32 measure(at, sources...)`, one source of each kind. See 'How to add a signal' "
      "in include/shortshot/README.md");
  /// How the sphere is divided, what histograms are of, how wide shells are, the convention of cells, how sums become
  /// values; what is measured, and the sources that are read, each once.
  using Grid = GridType;
  using Signal = std::conditional_t<detail::IsSignal<SignalType>::value, SignalType, Occupancy>;  // one error is enough
  using Scale = RadiusScale;
  using Cells = CellConvention;
  using Finish = FinishRule;
  using Signals = typename detail::Distinct<detail::SignalList<>, Signal>::type;
  using Sources = typename Signal::Sources;
  static constexpr bool has_histogram = Signal::has_histogram;                    ///< else a plain sum
  static constexpr int values = has_histogram ? Cells::values(Signal::bins) : 1;  ///< of one cell
  static constexpr int size = Grid::cells * values;                               ///< of all cells
  static constexpr int weight_cells = 0;    ///< sums of votes that are kept besides
  static constexpr bool has_signs = false;  ///< values may be below 0

  /// Position of one value within the part.
  [[nodiscard, gnu::always_inline]] static constexpr int index(int r, int e, int a, int bin = 0) noexcept {
    constexpr extend::CellStrides cells = Cells::template strides<Grid>;
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
  static constexpr extend::Axis axes[4] = {
      {Grid::radial, Values* Cells::template strides<Grid>.radial, extend::Beyond::nothing, Scale::below_zero,
       grid_bits, Cells::reaches_end},
      {Grid::elevation, Values* Cells::template strides<Grid>.elevation, extend::Beyond::nothing,
       extend::BelowZero::never, grid_bits, Cells::reaches_end},
      {Grid::azimuth, Values* Cells::template strides<Grid>.azimuth, extend::Beyond::first_cell,
       Cells::azimuth_below_zero, grid_bits, Cells::reaches_end},
      {values, 1, extend::Beyond::nothing, extend::BelowZero::never, bits, Cells::reaches_end}};
};

/// A spherical grid with the means of some signed signals in every cell, drawn towards 0 where few points are: the sum
/// of votes times values, over the sum of votes and `ShrinkPercent` / 100 of what a cell has on average. Layout: signal
/// fastest, then radius, elevation, azimuth (as the convention lays out cells).
template <class GridType, class CellConvention, class FinishRule, int ShrinkPercent, class... SignedSignals>
struct CellMeans {
  static_assert(sizeof...(SignedSignals) >= 1 && ((SignedSignals::is_signed) && ...),
                "CellMeans<Grid, Cells, Finish, Shrink, Signals...> supports one or more signals with is_signed");
  static_assert(ShrinkPercent >= 1, "CellMeans supports shrinkage of 1 percent or more: a cell may be empty");
  /// As those of a Part.
  using Grid = GridType;
  using Scale = LinearRadius;
  using Cells = CellConvention;
  using Finish = FinishRule;
  using Counts = Part<Grid, Occupancy, Scale, Cells>;     ///< the votes themselves
  using Averaged = detail::SignalList<SignedSignals...>;  ///< in the order of the layout
  using Signals = typename detail::Distinct<detail::SignalList<>, SignedSignals...>::type;
  using Sources = typename detail::DistinctKinds<extend::SourceKinds<>, typename SignedSignals::Sources...>::type;
  static constexpr int values = static_cast<int>(sizeof...(SignedSignals));  ///< of one cell
  static constexpr int size = Grid::cells * values;                          ///< of all cells
  static constexpr int weight_cells = Grid::cells;                           ///< sums of votes that are kept besides
  static constexpr int shrink_percent = ShrinkPercent;                       ///< see above
  static constexpr bool has_signs = (SignedSignals::has_signs || ...);       ///< values may be below 0
  static constexpr int bits = Counts::bits;                                  ///< of positions behind the point

  /// Position of the mean of signal `k` of one cell within the part.
  [[nodiscard, gnu::always_inline]] static constexpr int index(int r, int e, int a, int k = 0) noexcept {
    return k + values * Counts::index(r, e, a);
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The rule by which all of a descriptor's color parts convert colors; void if it has none.
template <class SignalList>
struct LabRuleOf {
  using type = void;
};
template <class Signal, class... Others>
struct LabRuleOf<SignalList<Signal, Others...>> {
  using Mine = typename Signal::Rule;
  using Next = typename LabRuleOf<SignalList<Others...>>::type;
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

/// Do the color signals of a list compare with the mean color? None may if others do not.
template <class... Signals>
constexpr bool compare_with_mean(SignalList<Signals...>) noexcept {
  constexpr bool mean = (std::is_same<typename Signals::Reference, MeanColor>::value || ...);
  constexpr bool own = (std::is_same<typename Signals::Reference, KeyPointColor>::value || ...);
  static_assert(!(mean && own),
                "Descriptor supports one reference for all its color signals: KeyPointColor or MeanColor");
  return mean;
}

/// The first of some types.
template <class First, class...>
struct FirstOf {
  using type = First;
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor: its parts one after the other, filled by one voting rule and normalized together to L2 norm 1.
template <class VotingRule, class... Parts>
struct Descriptor {
  static_assert(
      detail::IsVotingRule<VotingRule>::value,
      "Descriptor<Voting, Parts...> supports a voting rule with weight_bits, votes<Axes>, split(axis, position, "
      "unit) and combine<Axes>(axes, shares, unit). See 'How to add a voting rule' in "
      "include/shortshot/README.md");
  /// How a point is shared among cells.
  using Voting = std::conditional_t<detail::IsVotingRule<VotingRule>::value, VotingRule, HardVoting>;
  static_assert(sizeof...(Parts) >= 1, "Descriptor<Voting, Parts...> supports one or more parts");

  /// Number of floats, and of bytes when stored as floats.
  static constexpr int size = (Parts::size + ...);
  static constexpr std::size_t size_bytes = sizeof(float) * static_cast<std::size_t>(size);
  static_assert(size <= 65536, "Descriptor supports up to 65536 values");

  /// The kinds of sources that its signals read, each once, and whether a channel of the cloud is among them.
  using Sources = typename detail::DistinctKinds<extend::SourceKinds<>, typename Parts::Sources...>::type;
  [[nodiscard, gnu::always_inline]] static constexpr bool needs(Channel channel) noexcept {
    return detail::reads_channel(Sources{}, channel);
  }
  static constexpr bool needs_colors = needs(Channel::colors);
  static constexpr bool needs_normals = needs(Channel::normals);
  static constexpr bool needs_intensities = needs(Channel::intensities);

  /// The signals that are measured, each once.
  using Signals = typename detail::DistinctOf<detail::SignalList<>, typename Parts::Signals...>::type;
  using LabRule = typename detail::LabRuleOf<Signals>::type;  ///< by which colors are converted; void: none
  /// Are colors compared with the neighborhood's mean? Then key points need none.
  static constexpr bool compares_with_mean = detail::compare_with_mean(Signals{});

  using Cells = typename detail::FirstOf<typename Parts::Cells...>::type;  ///< cell convention of all parts
  static_assert((std::is_same<typename Parts::Cells, Cells>::value && ...),
                "Descriptor supports one cell convention for all its parts");

  /// Meant for frames that are turned to the camera: tools that know where it was tell support's viewpoint.
  static constexpr bool wants_viewpoint = Cells::wants_viewpoint;

  /// Do its values depend on the frame? If not, describe_at() and extract() estimate none.
  static constexpr bool needs_frame =
      (Cells::template needs_frame<typename Parts::Grid> || ...) || detail::look_at_places(Signals{});

  /// Fewest bits behind the point of positions along its axes.
  static constexpr int position_bits = [] {
    int bits = 30;
    ((bits = Parts::bits < bits ? Parts::bits : bits), ...);
    return bits;
  }();

  /// Where its votes jump from shell to shell, and a float's own rounding might decide on which side.
  static constexpr int shell_multiples =
      Cells::exact_borders(detail::common_multiple(Parts::Scale::borders(Parts::Grid::radial)...));
  using ShellBorders = std::conditional_t<
      shell_multiples == 1, extend::ShellBorders<1>,
      extend::ShellBorders<shell_multiples,
                           detail::step_between(shell_multiples, Parts::Scale::borders(Parts::Grid::radial))...>>;

  /// Do sums become values as they are?
  static constexpr bool is_plain = (std::is_same<typename Parts::Finish, PlainSums>::value && ...);
  /// Sums of votes that its CellMeans keep besides the values.
  static constexpr int weight_cells = (Parts::weight_cells + ...);

  /// First value of part `i` (of `parts` ones), and the end of the last part.
  static constexpr int parts = static_cast<int>(sizeof...(Parts));
  [[nodiscard, gnu::always_inline]] static constexpr int offset(int i) noexcept {
    constexpr int sizes[] = {Parts::size...};
    int sum = 0;
    for (int k = 0; k < i && k < parts; ++k) sum += sizes[k];
    return sum;
  }
  /// The same of its sums of votes.
  [[nodiscard, gnu::always_inline]] static constexpr int weight_offset(int i) noexcept {
    constexpr int sizes[] = {Parts::weight_cells...};
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

/// How echoes of a lidar or a time-of-flight camera differ from the key point's, beside where points are: SSH on one
/// grid, histograms of Intensity on another, as SCSH has them of color. Needs points and intensities.
template <class ShapeGrid, class IntensityGrid, int Bins, class Voting = PublishedVoting,
          class RadiusScale = LinearRadius>
using IntensityShape =
    Descriptor<Voting, Part<ShapeGrid, Occupancy, RadiusScale>, Part<IntensityGrid, Intensity<Bins>, RadiusScale>>;

/// SHOT: histograms of how normals lean against the frame's z axis. Needs points and normals. `Bins` as PCL counts
/// them: a histogram has one value more.
template <class Grid, int Bins, class Voting = ShotVoting, class RadiusScale = LinearRadius>
using Shot = Descriptor<Voting, Part<Grid, NormalCosine<Bins>, RadiusScale, ShotCells>>;

/// CSHOT: SHOT, and histograms of color distance on the same grid. Needs points, normals and colors.
template <class Grid, int ShapeBins, int ColorBins, class Voting = ShotVoting, class LabRule = CshotLab,
          class RadiusScale = LinearRadius>
using Cshot = Descriptor<Voting, Part<Grid, NormalCosine<ShapeBins>, RadiusScale, ShotCells>,
                         Part<Grid, ColorDistance<ColorBins, LabRule>, RadiusScale, ShotCells>>;

using Ssh32 = Ssh<SphericalGrid<2, 2, 8>>;                                 ///< of points, 32 values
using Ssh96 = Ssh<SphericalGrid<3, 4, 8>>;                                 ///< of points, 96 values
using Scsh336 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 4>, 15>;  ///< with colors, 336 values
using Scsh696 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 6>, 25>;  ///< with colors, 696 values
using IntensityShape336 = IntensityShape<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 4>, 15>;  ///< with intensities

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

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_DESCRIPTOR_HPP
