// shortshot/descriptor/signals.hpp: what a cell's histogram is about. A signal is one struct: its name, its bins, where
// its values come from, and how a register of neighbors is measured.
#ifndef SHORTSHOT_DESCRIPTOR_SIGNALS_HPP
#define SHORTSHOT_DESCRIPTOR_SIGNALS_HPP

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "../base/math.hpp"
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
  static constexpr bool has_histogram = true;  ///< else a cell holds a plain sum
  static constexpr int bins = Bins;            ///< of its histogram
  using Sources = SourceKinds<Kinds...>;       ///< kinds of sources that it reads
  /// Signals that are Measured alike have the same values: they are measured once. Set it to the signal of one bin.
  using Measured = void;
  /// Set where measure() looks at nothing but the index, and every point has a value: fewer registers to go through.
  static constexpr bool reads_index_only = false;
  /// How many values measure() gives for each neighbor, as Values<components>, and which of those of the signal that it
  /// is Measured as is this one.
  static constexpr int components = 1;
  static constexpr int component = 0;
  /// The rule by which colors are converted; void: there are none.
  using Rule = void;
  /// What colors are compared with: KeyPointColor or MeanColor, the same for all signals of a descriptor; void:
  /// nothing.
  using Reference = void;
  /// Set where measure() gives values with signs, -4 to 4. Such a signal adds value(), of which a part's means are, and
  /// for histograms place(): both take what was measured.
  static constexpr bool is_signed = false;
  static constexpr bool has_signs = false;  ///< value() may be below 0
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// What is measured at once.
template <int Components>
struct Values {
  simd::F32 of[static_cast<std::size_t>(Components)];  ///< one register for each
};

/// Where the neighbors of one register are.
template <class FrameAxes>
struct NeighborsAt {
  const std::uint32_t* index;  ///< simd::lanes of them, in the cloud
  const PointLanes& offset;    ///< from the key point, in the cloud's coordinates
  const PointLanes& local;     ///< from the key point, in the frame's coordinates
  const FrameAxes& frame;      ///< x, y and z, for along()
};

/// Which neighbors are in one register, for signals that look at nothing else.
struct IndicesAt {
  const std::uint32_t* index;  ///< simd::lanes of them, in the cloud
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What a color signal compares neighbors' colors with: the key point's own, or the mean of all within the radius, the
/// key point included. (One point's color is noise: the mean finds a third more.)
struct KeyPointColor {
  static constexpr const char* name = "key point's color";  ///< for layout_of()
};
struct MeanColor {
  static constexpr const char* name = "mean color";  ///< for layout_of()
};

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
  /// The places of a register of neighbors in the histogram, 0 to 1; see extend::Signal.
  template <class At, class Normals>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Normals& normals) noexcept {
    return extend::along(at.frame.z, normals(at.index)) * extend::simd::all(0.5f) + extend::simd::all(0.5f);
  }
};

/// Signal of CSHOT and SCSH: the CIELAB distance between a point's color and the key point's (or the MeanColor), over
/// `Bins` bins of equal width. `LabRule` is the color conversion (PublishedLab, CshotLab or PclLab).
template <int Bins, class LabRule = PublishedLab, class ReferenceColor = KeyPointColor>
struct ColorDistance : extend::Signal<Bins, RgbColors<LabRule>> {
  static_assert(Bins >= 1 && Bins <= 1024, "ColorDistance<Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = "color distance";
  using Measured = ColorDistance<1, LabRule, ReferenceColor>;
  static constexpr bool reads_index_only = true;
  using Rule = LabRule;
  using Reference = ReferenceColor;
  template <class At, class Colors>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Colors& colors) noexcept {
    return extend::color_distances(extend::colors_at(colors, at.index), extend::in_all_lanes(colors.reference));
  }
};

/// The axes of CIELAB: lightness, green to red, blue to yellow.
enum class LabAxis : std::uint8_t { L, a, b };

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// How a point's color differs from the mean of the neighborhood's, along all axes of CIELAB: dL / 100, da / 60, db
/// / 60.
template <class LabRule = PublishedLab>
struct LabOffset : Signal<1, RgbColors<LabRule>> {
  static constexpr const char* name = "Lab offset";
  static constexpr bool reads_index_only = true;
  static constexpr int components = 3;
  using Rule = LabRule;
  using Reference = MeanColor;
  template <class At, class Colors>
  [[nodiscard]] SHORTSHOT_INLINE static Values<3> measure(const At& at, const Colors& colors) noexcept {
    using simd::all;
    const LabLanes own = colors_at(colors, at.index);
    const LabLanes mean = in_all_lanes(colors.reference);
    return {{(own.L - mean.L) * all(1.0f / 100.0f), (own.a - mean.a) * all(1.0f / 60.0f),
             (own.b - mean.b) * all(1.0f / 60.0f)}};
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// How a point's color differs from the mean of the neighborhood's along one axis of CIELAB, with its sign: dL / 100,
/// da / 60 or db / 60. As a histogram over `Bins` bins: dL from -40 to 40, da and db from -30 to 30; what lies beyond
/// is in the outermost bins.
template <LabAxis Axis, int Bins = 1, class LabRule = PublishedLab>
struct ColorOffset : extend::Signal<Bins, RgbColors<LabRule>> {
  static_assert(Bins >= 1 && Bins <= 1024, "ColorOffset<Axis, Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = Axis == LabAxis::L   ? "lightness offset"
                                      : Axis == LabAxis::a ? "a offset"
                                                           : "b offset";
  using Measured = extend::LabOffset<LabRule>;
  static constexpr bool reads_index_only = true;
  static constexpr int component = static_cast<int>(Axis);
  using Rule = LabRule;
  using Reference = MeanColor;
  static constexpr bool is_signed = true;
  static constexpr bool has_signs = true;
  template <class At, class Colors>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Colors& colors) noexcept {
    return Measured::measure(at, colors).of[component];
  }
  /// What the means of a part are of, from what measure() gave.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 value(extend::simd::F32 offset) noexcept { return offset; }
  /// The place in the histogram, from what measure() gave.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 place(extend::simd::F32 offset) noexcept {
    return offset * extend::simd::all(Axis == LabAxis::L ? 1.25f : 1.0f) + extend::simd::all(0.5f);
  }
};

/// How far it lies above the mean (`Sign` 1) or below it (-1); 0 on the other side. For means alone.
template <LabAxis Axis, int Sign, class LabRule = PublishedLab>
struct ColorExcess : ColorOffset<Axis, 1, LabRule> {
  static_assert(Sign == 1 || Sign == -1, "ColorExcess<Axis, Sign> supports 1 (above the mean) and -1 (below)");
  static constexpr bool has_signs = false;
  static constexpr const char* name = Axis == LabAxis::L   ? (Sign > 0 ? "lightness above" : "lightness below")
                                      : Axis == LabAxis::a ? (Sign > 0 ? "a above" : "a below")
                                                           : (Sign > 0 ? "b above" : "b below");
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 value(extend::simd::F32 offset) noexcept {
    const extend::simd::F32 zero = extend::simd::all(0.0f);
    return extend::simd::max(Sign > 0 ? offset : zero - offset, zero);
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
    const extend::simd::F32 own = intensities(at.index);
    const extend::simd::Mask known = extend::simd::all_int(0x7F800000) > bits_of(extend::simd::abs(own));  // finite
    const extend::simd::F32 echo = extend::simd::max(zero, keep(known, own));
    const extend::simd::F32 sum = echo + extend::simd::max(zero, extend::simd::all(intensities.reference));
    const extend::simd::F32 share = echo / extend::simd::max(sum, extend::simd::all(extend::math::least_normal));
    const extend::simd::F32 value = select(zero >= sum, extend::simd::all(0.5f), share);
    return select(known, value, extend::simd::all(std::numeric_limits<float>::quiet_NaN()));
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The distinct ones of some signals with histograms: those that are measured, once each. `size`: their values.
template <class... Signals>
struct SignalList {
  static constexpr int size = (Signals::components + ... + 0);
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

/// The distinct ones of several lists.
template <class List, class... Lists>
struct DistinctOf {
  using type = List;
};
template <class List, class... Signals, class... Others>
struct DistinctOf<List, SignalList<Signals...>, Others...>
    : DistinctOf<typename Distinct<List, Signals...>::type, Others...> {};

/// Do some of them look at where a neighbor is?
template <class... Signals>
[[gnu::always_inline]] constexpr bool look_at_places(SignalList<Signals...>) noexcept {
  return (!Signals::reads_index_only || ...);
}

/// The place of a signal's value among those of a list.
template <class Signal, class... Signals>
[[gnu::always_inline]] constexpr int place_in(SignalList<Signals...>) noexcept {
  constexpr bool same[] = {std::is_same<MeasuredAs<Signal>, Signals>::value...};
  constexpr int components[] = {Signals::components...};
  int place = Signal::component;
  for (int k = 0; !same[k]; ++k) place += components[k];
  return place;
}

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_SIGNALS_HPP
