// shortshot/dispatch/twins.hpp: what is called what in the kernel for AVX2. Hosted only.
#pragma once

#include <cstdint>
#include <type_traits>

#include "../base/same_bits.hpp"
#include "../config.hpp"
#include "kernel_for_avx2.hpp"

#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The type of the same name in shortshot_avx2; none for one that is not the library's, like a signal of the caller's.
template <class T, class = void>
struct Twin {};
template <class T>
using TwinOf = typename Twin<T>::type;

template <class T, class = void>
struct HasTwin : std::false_type {};
template <class T>
struct HasTwin<T, std::void_t<TwinOf<T>>> : std::true_type {};
template <class... T>
using IfTwins = std::enable_if_t<std::conjunction<HasTwin<T>...>::value>;

#define SHORTSHOT_TWIN(name)             \
  template <>                            \
  struct Twin<shortshot::name> {         \
    using type = ::shortshot_avx2::name; \
  };
#define SHORTSHOT_TWIN_OF_NUMBERS(name)        \
  template <auto... N>                         \
  struct Twin<shortshot::name<N...>> {         \
    using type = ::shortshot_avx2::name<N...>; \
  };
SHORTSHOT_TWIN(CloudIntensities)
SHORTSHOT_TWIN(CloudNormals)
SHORTSHOT_TWIN(CloudView)
SHORTSHOT_TWIN(CshotLab)
SHORTSHOT_TWIN(Frame)
SHORTSHOT_TWIN(FrameConfidence)
SHORTSHOT_TWIN(GridMemory<std::uint32_t>)
SHORTSHOT_TWIN(HardVoting)
SHORTSHOT_TWIN(HeightCells)
SHORTSHOT_TWIN(KeyPointColor)
SHORTSHOT_TWIN(LabColors)
SHORTSHOT_TWIN(LinearRadius)
SHORTSHOT_TWIN(MeanColor)
SHORTSHOT_TWIN(MultilinearVoting)
SHORTSHOT_TWIN(Neighborhood)
SHORTSHOT_TWIN(Occupancy)
SHORTSHOT_TWIN(PclLab)
SHORTSHOT_TWIN(PlainSums)
SHORTSHOT_TWIN(Point)
SHORTSHOT_TWIN(PublishedCells)
SHORTSHOT_TWIN(PublishedLab)
SHORTSHOT_TWIN(Radius)
SHORTSHOT_TWIN(ShotCells)
SHORTSHOT_TWIN(Support)
SHORTSHOT_TWIN(Viewpoint)
SHORTSHOT_TWIN(detail::Grid<std::uint32_t>)
SHORTSHOT_TWIN(detail::GridContents<std::uint32_t>)
SHORTSHOT_TWIN(detail::PlaceGroup)
SHORTSHOT_TWIN_OF_NUMBERS(AdditiveVoting)
SHORTSHOT_TWIN_OF_NUMBERS(SeparateVoting)
SHORTSHOT_TWIN_OF_NUMBERS(Intensity)
SHORTSHOT_TWIN_OF_NUMBERS(LogRadius)
SHORTSHOT_TWIN_OF_NUMBERS(NormalCosine)
SHORTSHOT_TWIN_OF_NUMBERS(RootOfShares)
SHORTSHOT_TWIN_OF_NUMBERS(SignedRoots)
SHORTSHOT_TWIN_OF_NUMBERS(SphericalGrid)
#undef SHORTSHOT_TWIN
#undef SHORTSHOT_TWIN_OF_NUMBERS

template <int Bins, class... Colors>
struct Twin<ColorDistance<Bins, Colors...>, IfTwins<Colors...>> {
  using type = ::shortshot_avx2::ColorDistance<Bins, TwinOf<Colors>...>;
};
template <LabAxis Axis, int Number, class Rule>
struct Twin<ColorOffset<Axis, Number, Rule>, IfTwins<Rule>> {
  using type = ::shortshot_avx2::ColorOffset<static_cast<::shortshot_avx2::LabAxis>(Axis), Number, TwinOf<Rule>>;
};
template <LabAxis Axis, int Number, class Rule>
struct Twin<ColorExcess<Axis, Number, Rule>, IfTwins<Rule>> {
  using type = ::shortshot_avx2::ColorExcess<static_cast<::shortshot_avx2::LabAxis>(Axis), Number, TwinOf<Rule>>;
};
template <class... Rules>
struct Twin<Part<Rules...>, IfTwins<Rules...>> {
  using type = ::shortshot_avx2::Part<TwinOf<Rules>...>;
};
template <class Grid, class Cells, class Finish, int ShrinkPercent, class... Signals>
struct Twin<CellMeans<Grid, Cells, Finish, ShrinkPercent, Signals...>, IfTwins<Grid, Cells, Finish, Signals...>> {
  using type =
      ::shortshot_avx2::CellMeans<TwinOf<Grid>, TwinOf<Cells>, TwinOf<Finish>, ShrinkPercent, TwinOf<Signals>...>;
};
template <class... Rules>
struct Twin<Descriptor<Rules...>, IfTwins<Rules...>> {
  using type = ::shortshot_avx2::Descriptor<TwinOf<Rules>...>;
};

template <class... Sources>
struct Twin<extend::SourceSet<Sources...>, IfTwins<Sources...>> {
  using type = ::shortshot_avx2::extend::SourceSet<TwinOf<Sources>...>;
};

/// A value as its twin, and back: the same text made both types, so that they have the same bytes.
template <class T>
[[nodiscard]] inline TwinOf<T> twin_of(const T& value) noexcept {
  return same_bits<TwinOf<T>>(value);
}
template <class T>
inline void take_back(T& value, const TwinOf<T>& twin) noexcept {
  value = same_bits<T>(twin);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif
