// shortshot/dispatch/twins.hpp: what is called what in the kernel for AVX2. Hosted only.
#pragma once

#include <cstring>
#include <type_traits>

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
SHORTSHOT_TWIN(CshotLab)
SHORTSHOT_TWIN(HardVoting)
SHORTSHOT_TWIN(HeightCells)
SHORTSHOT_TWIN(KeyPointColor)
SHORTSHOT_TWIN(LabColors)
SHORTSHOT_TWIN(LinearRadius)
SHORTSHOT_TWIN(MeanColor)
SHORTSHOT_TWIN(MultilinearVoting)
SHORTSHOT_TWIN(Occupancy)
SHORTSHOT_TWIN(PclLab)
SHORTSHOT_TWIN(PlainSums)
SHORTSHOT_TWIN(PublishedCells)
SHORTSHOT_TWIN(PublishedLab)
SHORTSHOT_TWIN(ShotCells)
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

/// A value as its twin: the same text made both types, so that they have the same bytes.
template <class To, class From>
[[nodiscard]] inline To as_twin(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From) && std::is_trivially_copyable<To>::value &&
                    std::is_trivially_copyable<From>::value,
                "twins are plain data of one size");
  union Uninitialized {
    Uninitialized() noexcept {}
    To value;
  } to;
  std::memcpy(static_cast<void*>(&to.value), &from, sizeof from);
  return to.value;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif
