// shortshot/recognition/products.hpp: products of the rows of one matrix with those of another, for match.hpp.
//
// The order of each sum is fixed: one sum for each pair of rows, over their values in ascending order, each product
// rounded by itself. Lanes hold sums of different rows, so neither their number nor the place of a tile, nor threads,
// nor a fused multiply-add change a bit. Blocked for registers and caches it is as fast as Eigen's product (SSE2,
// AVX2).
#pragma once

#include <cstddef>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Twelve sums, the two registers of the panel, one for a value of the other matrix and one for a product: the 16
/// registers that SSE2 and AVX2 have.
inline constexpr int tile_rows = 6;
inline constexpr int panel_registers = 2;
inline constexpr std::size_t panel_rows = panel_registers * simd::lanes;

/// The products of one row with those of a panel, in their order.
struct PanelProducts {
  simd::F32 of[panel_registers];
};

/// Puts rows side by side: value 0 of all of them, then value 1, and so on.
[[gnu::noinline]] inline void pack(const float* const (&rows)[panel_rows], std::size_t size, float* panel) noexcept {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < panel_rows; k += simd::lanes) {
      simd::store(panel, simd::from_lanes([&](std::size_t lane) { return rows[k + lane][i]; }));
      panel += simd::lanes;
    }
  }
}

[[gnu::noinline]] inline void multiply(const float* panel, const float* const (&rows)[tile_rows], std::size_t size,
                                       PanelProducts (&products)[tile_rows]) noexcept {
  simd::F32 sums[tile_rows][panel_registers];
  const float* row[tile_rows];
  unroll<tile_rows>([&](auto r) {
    row[r] = rows[r];
    unroll<panel_registers>([&](auto k) { sums[r][k] = simd::all(0.0f); });
  });
  for (std::size_t i = 0; i < size; ++i) {
    unroll<tile_rows>([&](auto r) SHORTSHOT_INLINE_LAMBDA {
      const simd::F32 value = simd::all(row[r][i]);
      unroll<panel_registers>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
        sums[r][k] = sums[r][k] + value * simd::load(panel + k * simd::lanes);
      });
    });
    panel += panel_rows;
  }
  unroll<tile_rows>([&](auto r) { unroll<panel_registers>([&](auto k) { products[r].of[k] = sums[r][k]; }); });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
