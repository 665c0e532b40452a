// shortshot/base/products.hpp: products of the rows of one matrix with those of another, for recognition/match.hpp.
//
// The order of each sum is fixed: one sum for each pair of rows, over their values in ascending order, each product
// rounded by itself. Lanes hold sums of different rows, so neither their number nor the place of a tile, nor threads,
// nor a fused multiply-add change a bit. Blocked for registers and caches it is as fast as Eigen's product (SSE2,
// AVX2).
#ifndef SHORTSHOT_BASE_PRODUCTS_HPP
#define SHORTSHOT_BASE_PRODUCTS_HPP

#include <cstddef>

#include "../config.hpp"
#include "simd.hpp"
#include "unroll.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Rows that lie side by side.
inline constexpr std::size_t panel_rows = 16;

/// Rows that meet a panel at once: twelve registers of sums, and four for a panel's values, a row's and a product are
/// the 16 that SSE2 and AVX2 have.
inline constexpr std::size_t tile_rows = simd::lanes > 4 ? 6 : 3;

/// Puts rows side by side: value 0 of all of them, then value 1, and so on.
[[gnu::noinline]] inline void pack(const float* const (&rows)[panel_rows], std::size_t size, float* panel) noexcept {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < panel_rows; k += simd::lanes) {
      simd::store(panel, simd::from_lanes([&](std::size_t lane) { return rows[k + lane][i]; }));
      panel += simd::lanes;
    }
  }
}

/// The products of each row of a tile with those of a panel, in their order.
template <std::size_t Rows>
[[gnu::noinline]] void multiply(const float* panel, const float* const (&rows)[Rows], std::size_t size,
                                float (&products)[Rows][panel_rows]) noexcept {
  constexpr std::size_t registers = panel_rows / simd::lanes;
  simd::F32 sums[Rows][registers];
  const float* row[Rows];
  unroll<int{Rows}>([&](auto r) {
    row[r] = rows[r];
    unroll<int{registers}>([&](auto k) { sums[r][k] = simd::all(0.0f); });
  });
  for (std::size_t i = 0; i < size; ++i) {
    unroll<int{Rows}>([&](auto r) SHORTSHOT_INLINE_LAMBDA {
      const simd::F32 value = simd::all(row[r][i]);
      unroll<int{registers}>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
        sums[r][k] = sums[r][k] + value * simd::load(panel + k * simd::lanes);
      });
    });
    panel += panel_rows;
  }
  unroll<int{Rows}>(
      [&](auto r) { unroll<int{registers}>([&](auto k) { simd::store(products[r] + k * simd::lanes, sums[r][k]); }); });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_PRODUCTS_HPP
