// shortshot/batch/pixel_sums.hpp: sums over the pixels of a window, modulo 2^32. Hosted only.
//
// A window's sum is made of four sums over rectangles that begin at the image's corner. Those may be as large as they
// like: they wrap, and so do their differences, and what is left, which does not fit 32 bits only if the window's own
// sum does not, is exact. So is what comes of moving the origin of moments afterwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/quad.hpp"
#include "../base/same_bits.hpp"
#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Integers that may wrap: in each lane, and four side by side.
using WrappingLanes = std::uint32_t __attribute__((vector_size(4 * simd::lanes)));
inline constexpr int lane_count = static_cast<int>(simd::lanes);
using WrappingQuad = std::uint32_t __attribute__((vector_size(16)));

/// What pixels add up to.
struct PixelSums {
  static constexpr int quads = 3;
  static constexpr int kinds = 4 * quads;
  WrappingQuad places;   ///< count, x, y, z
  WrappingQuad squares;  ///< xx, xy, xz, yy
  WrappingQuad others;   ///< yz, zz, edges, xx + yy + zz

  [[nodiscard, gnu::always_inline]] WrappingQuad& quad(int k) noexcept {
    return k == 0 ? places : k == 1 ? squares : others;
  }
};

[[nodiscard, gnu::always_inline]] inline PixelSums operator+(const PixelSums& a, const PixelSums& b) noexcept {
  return {a.places + b.places, a.squares + b.squares, a.others + b.others};
}
[[nodiscard, gnu::always_inline]] inline PixelSums operator-(const PixelSums& a, const PixelSums& b) noexcept {
  return {a.places - b.places, a.squares - b.squares, a.others - b.others};
}

[[nodiscard, gnu::always_inline]] inline bool has_edges(const PixelSums& sums) noexcept { return sums.others[2] != 0; }

/// Points of a register in whole numbers, zeros where there is none.
struct PixelLanes {
  simd::Mask valid;
  simd::F32 x, y, z;
};

[[nodiscard, gnu::always_inline]] inline WrappingLanes wrapping(simd::F32 whole) noexcept {
  return same_bits<WrappingLanes>(round_to_int(whole));
}

/// The terms of each lane's pixel.
[[gnu::always_inline]] inline void terms_of(const PixelLanes& p, simd::Mask edges,
                                            PixelSums (&terms)[simd::lanes]) noexcept {
  const WrappingLanes x = wrapping(p.x);
  const WrappingLanes y = wrapping(p.y);
  const WrappingLanes z = wrapping(p.z);
  const WrappingLanes xx = x * x;
  const WrappingLanes yy = y * y;
  const WrappingLanes zz = z * z;
  const auto number = [](simd::Mask m) { return same_bits<WrappingLanes>(increment(m, simd::all_int(0))); };
  const WrappingLanes of[PixelSums::kinds] = {number(p.valid), x,           y, z, xx, x * y, x * z, yy, y * z, zz,
                                              number(edges),   xx + yy + zz};
  unroll<PixelSums::quads>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    const auto kind = [&](int i) { return same_bits<simd::I32>(of[4 * k + i]); };
    simd::Quad quads[simd::lanes];
    transpose(kind(0), kind(1), kind(2), kind(3), quads);
    unroll<lane_count>([&](auto lane)
                           SHORTSHOT_INLINE_LAMBDA { terms[lane].quad(k) = same_bits<WrappingQuad>(quads[lane]); });
  });
}

/// Each kind of sum in a register.
struct SumLanes {
  WrappingLanes of[PixelSums::kinds];
};

/// A template, so that the branch of several lanes is none of one lane's.
template <std::size_t Lanes>
[[nodiscard, gnu::always_inline]] inline SumLanes lanes_of(PixelSums* sums) noexcept {
  SumLanes result;
  if constexpr (Lanes == 1) {
    std::memcpy(&result, sums, sizeof result);
  } else {
    // In each part of four lanes, four of whose kinds become four registers' parts.
    constexpr int count = static_cast<int>(Lanes / 4);
    unroll<PixelSums::quads>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      struct Parts {
        WrappingQuad of[Lanes / 4];
      };
      const auto row = [&](int i) SHORTSHOT_INLINE_LAMBDA {
        Parts parts;
        unroll<count>([&](auto part) { parts.of[part] = sums[i + 4 * part].quad(k); });
        return same_bits<simd::I32>(parts);
      };
      simd::Quad quads[Lanes];
      transpose(row(0), row(1), row(2), row(3), quads);
      unroll<4>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
        Parts parts;
        unroll<count>([&](auto part) { parts.of[part] = same_bits<WrappingQuad>(quads[i + 4 * part]); });
        result.of[4 * k + i] = same_bits<WrappingLanes>(parts);
      });
    });
  }
  return result;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
