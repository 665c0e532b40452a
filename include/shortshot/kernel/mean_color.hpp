// shortshot/kernel/mean_color.hpp: the mean of a neighborhood's colors, with which signals of MeanColor compare.
#ifndef SHORTSHOT_KERNEL_MEAN_COLOR_HPP
#define SHORTSHOT_KERNEL_MEAN_COLOR_HPP

#include <cstddef>
#include <cstdint>

#include "../base/fixed_point.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../color/color_source.hpp"
#include "../config.hpp"
#include "../descriptor/source_set.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Have all neighbors within the radius the same color? It is in `color` then. Seldom more than a look at two of them.
template <class Neighbors, class Colors>
[[nodiscard]] inline bool have_one_color(const Neighbors& n, const Colors& colors, Radius radius, Lab& color) noexcept {
  Lab* next = &color;
  Lab other;
  for (std::uint32_t i = 0; i < n.size; ++i) {
    const extend::Neighbor v = extend::neighbor_at(n, i);
    if (!(v.d2 < radius.squared)) continue;
    *next = colors(v.index);
    if (!(next->L == color.L && next->a == color.a && next->b == color.b)) return false;
    next = &other;
  }
  return next == &other;
}

/// The mean color of all neighbors within the radius, the key point and its copies included; black if there is none.
/// Where all are alike it is theirs without rounding: nothing differs from it, and no root makes something of it.
template <class Neighbors, class Colors>
[[nodiscard]] inline Lab mean_color(const Neighbors& n, const Colors& colors, Radius radius) noexcept {
  Lab same{};
  if (have_one_color(n, colors, radius, same)) return same;
  const int exponent = fixed_point_exponent(n.size, 7);  // L, a and b are below 128
  const simd::F32 scale = simd::all(static_cast<float>(1 << exponent));
  simd::I32 sums[3] = {simd::all_int(0), simd::all_int(0), simd::all_int(0)};
  simd::I32 counts = simd::all_int(0);
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const extend::NeighborLanes v = extend::load_neighbors(n, i);
    std::uint32_t index[simd::lanes];
    simd::store(index, v.index);
    simd::Mask within = v.d2 < simd::all(radius.squared);
    if (n.size - i < simd::lanes) within = within & simd::first(n.size - i);
    const extend::LabLanes lab = extend::colors_at(colors, index);
    sums[0] = sums[0] + keep(within, round_to_int(lab.L * scale));
    sums[1] = sums[1] + keep(within, round_to_int(lab.a * scale));
    sums[2] = sums[2] + keep(within, round_to_int(lab.b * scale));
    counts = increment(within, counts);
  }
  const std::int32_t count = sum(counts);
  if (count == 0) return {0.0f, 0.0f, 0.0f};
  const float inverse = 1.0f / static_cast<float>(count) / static_cast<float>(1 << exponent);
  const auto mean = [&](simd::I32 lanes) { return unfused(static_cast<float>(sum(lanes)) * inverse); };
  return {mean(sums[0]), mean(sums[1]), mean(sums[2])};
}

/// Sources with the mean color of the neighborhood as the colors' reference.
template <class LabRule, class Neighbors>
[[nodiscard]] inline extend::SourceSet<> with_mean_color(const extend::SourceSet<>&, const Neighbors&,
                                                         Radius) noexcept {
  return {};
}
template <class LabRule, class Neighbors, class First, class... Others>
[[nodiscard]] inline extend::SourceSet<First, Others...> with_mean_color(
    const extend::SourceSet<First, Others...>& sources, const Neighbors& n, Radius radius) noexcept {
  extend::SourceSet<First, Others...> result{sources.first, sources.others};
  if constexpr (StandsFor<RgbColors<LabRule>, First>::value) {
    result.first.reference = mean_color(n, sources.first, radius);
  } else {
    result.others = with_mean_color<LabRule>(sources.others, n, radius);
  }
  return result;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_MEAN_COLOR_HPP
