// shortshot/descriptor/signals.hpp: what a cell's histogram is about. A signal is one struct: its name, its bins, where
// its values come from, and how a register of neighbors is measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../base/simd.hpp"
#include "../cloud/intensity_source.hpp"
#include "../cloud/normal_source.hpp"
#include "../cloud/point_lanes.hpp"
#include "../color/color_source.hpp"
#include "../color/lab.hpp"
#include "../config.hpp"
#include "source_set.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// What every signal with a histogram of `Bins` bins is derived from. `Kinds`: the sources that it reads; one that the
/// caller does not give is made by Kind::at(cloud, key point). A signal adds
///
///     static constexpr const char* name = "...";  // for layout_of(): tells it from all others
///     template <class At>
///     static extend::simd::F32 measure(const At& at, const Source&... one_of_each_kind) noexcept;
///
/// measure() gives the place of each neighbor of a register in the histogram, from 0 (the first bin's beginning) to 1
/// (the last one's end); the kernel cuts off what lies beyond. NaN: this neighbor has no value and is left out of the
/// whole descriptor. `at` is a NeighborsAt, or where reads_index_only is set an IndicesAt.
template <int Bins, class... Kinds>
struct Signal {
  static constexpr bool has_histogram = true;
  static constexpr int bins = Bins;
  using Sources = SourceKinds<Kinds...>;
  /// Signals that are Measured alike have the same values: they are measured once. Set it to the signal of one bin.
  using Measured = void;
  /// Set where measure() looks at nothing but the index, and every point has a value: fewer registers to go through.
  static constexpr bool reads_index_only = false;
  /// The rule by which colors are converted; void: there are none.
  using Rule = void;
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Where the neighbors of one register are.
template <class FrameAxes>
struct NeighborsAt {
  const std::uint32_t* index;  ///< simd::lanes of them, in the cloud
  const PointLanes& offset;    ///< from the key point, in the cloud's coordinates
  const PointLanes& local;     ///< from the key point, in the frame's coordinates
  const FrameAxes& frame;      ///< x, y and z, for along()
};

struct IndicesAt {
  const std::uint32_t* index;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Signal of SSH: none. Every point counts as one, a cell holds a plain sum.
struct Occupancy : extend::Signal<1> {
  static constexpr const char* name = "occupancy";  ///< for layout_of()
  static constexpr bool has_histogram = false;
};

/// Signal of SHOT: the cosine of the angle between a point's normal and the frame's z axis, -1 to 1, over `Bins` bins.
template <int Bins>
struct NormalCosine : extend::Signal<Bins, CloudNormals> {
  static_assert(Bins >= 1 && Bins <= 1023, "NormalCosine<Bins> supports 1 to 1023 histogram bins");
  static constexpr const char* name = "normal cosine";
  using Measured = NormalCosine<1>;
  template <class At, class Normals>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Normals& normals) noexcept {
    return extend::along(at.frame.z, normals(at.index)) * extend::simd::all(0.5f) + extend::simd::all(0.5f);
  }
};

/// Signal of CSHOT and SCSH: the CIELAB distance between a point's color and the key point's, over `Bins` bins of
/// equal width. `LabRule` is the color conversion (PublishedLab, CshotLab or PclLab).
template <int Bins, class LabRule = PublishedLab>
struct ColorDistance : extend::Signal<Bins, RgbColors<LabRule>> {
  static_assert(Bins >= 1 && Bins <= 1024, "ColorDistance<Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = "color distance";
  using Measured = ColorDistance<1, LabRule>;
  static constexpr bool reads_index_only = true;
  using Rule = LabRule;
  template <class At, class Colors>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Colors& colors) noexcept {
    return extend::color_distances(extend::colors_at(colors, at.index), extend::in_all_lanes(colors.reference));
  }
};

/// For lidars and time-of-flight cameras: how bright a point's echo is beside the key point's, i / (i + k): 0 (black
/// beside bright) to 1/2 (as bright) to 1, over `Bins` bins. Free of any unit, and of whatever a sensor or its distance
/// multiplies all intensities with. Two echoes of 0 are as bright; what is negative counts as 0. A point without a
/// finite intensity is left out.
template <int Bins>
struct Intensity : extend::Signal<Bins, CloudIntensities> {
  static_assert(Bins >= 1 && Bins <= 1024, "Intensity<Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = "intensity";
  using Measured = Intensity<1>;
  template <class At, class Intensities>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at,
                                                                  const Intensities& intensities) noexcept {
    const extend::simd::F32 zero = extend::simd::all(0.0f);
    const extend::simd::F32 echo = extend::simd::max(zero, intensities(at.index));  // of NaN and 0: the second, NaN
    const extend::simd::F32 sum = echo + extend::simd::max(zero, extend::simd::all(intensities.reference));
    return select(zero >= sum, extend::simd::all(0.5f), echo / sum);
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The distinct ones of some signals with histograms: those that are measured, once each.
template <class... Signals>
struct SignalList {
  static constexpr int size = sizeof...(Signals);
};

template <class Signal>
using MeasuredAs =
    std::conditional_t<std::is_void<typename Signal::Measured>::value, Signal, typename Signal::Measured>;

template <class List, class... More>
struct Distinct {
  using type = List;
};
template <class... Have, class Next, class... More>
struct Distinct<SignalList<Have...>, Next, More...>
    : Distinct<std::conditional_t<!Next::has_histogram || (std::is_same<Have, MeasuredAs<Next>>::value || ...),
                                  SignalList<Have...>, SignalList<Have..., MeasuredAs<Next>>>,
               More...> {};

/// The place of a signal in the list of them.
template <class Signal, class... Signals>
[[gnu::always_inline]] constexpr int place_in(SignalList<Signals...>) noexcept {
  constexpr bool same[] = {std::is_same<MeasuredAs<Signal>, Signals>::value...};
  int place = 0;
  while (!same[place]) ++place;
  return place;
}

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail
