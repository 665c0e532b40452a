// shortshot/base/symmetric_eigen.hpp: eigenvectors of symmetric 3x3 matrices, in float, with the same bits everywhere.
//
// Cyclic Jacobi rotations: accurate to a few float epsilons whatever the spacing of the eigenvalues, no libm call but
// the exactly rounded square root. Eigen's solvers are as good on a PC, but the direct one calls atan2, cos and sin
// (other bits with every libm) and both cost more flash than the rest of the frame. Rotations take the same steps for
// every matrix, so a register's lanes hold as many matrices, each with the bits that it would have alone.
#pragma once

#include "../config.hpp"
#include "simd.hpp"
#include "unroll.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The upper triangle of a symmetric matrix in each lane: xx, xy, xz, yy, yz, zz.
struct SymmetricLanes {
  simd::F32 entry[6];
};

/// Eigenvectors of unit length, each followed by its eigenvalue, which ascend. Signs are the solver's.
struct EigenLanes {
  simd::F32 of[3][4];

  [[nodiscard]] simd::F32 value(int i) const noexcept { return of[i][3]; }
  [[nodiscard]] simd::F32 vector(int i, int k) const noexcept { return of[i][k]; }
};

/// One Jacobi rotation in the plane (p, q), in those lanes where it is worth while: it makes zero what couples the two
/// axes. off[k] is the entry outside of the diagonal that is in neither row nor column k. Entries are at most 2.
/// Returns whether it was worth while anywhere.
SHORTSHOT_INLINE bool rotate(EigenLanes& e, simd::F32 (&off)[3], int p, int q) noexcept {
  using simd::all;
  using simd::F32;
  F32& coupling = off[3 - p - q];
  F32& value_p = e.of[p][3];
  F32& value_q = e.of[q][3];
  // The tangent of an angle of at most an eighth of a turn.
  const F32 gap = value_q - value_p;
  const F32 wide = simd::abs(gap);
  const F32 high = simd::abs(coupling);
  const simd::Mask turns = high - all(1e-12f) > wide * all(7e-9f);  // else no component moves by half its last bit
  if (!any(turns)) return false;
  const F32 root = simd::sqrt(gap * gap + all(4.0f) * (coupling * coupling));
  const F32 sum = gap + simd::negate(gap < all(0.0f), root);
  const F32 t = keep(turns, (coupling + coupling) / sum);
  const F32 c = all(1.0f) / simd::sqrt(t * t + all(1.0f));
  const F32 s = t * c;

  const F32 moved = t * coupling;
  value_p = value_p - moved;
  value_q = value_q + moved;
  coupling = select(turns, all(0.0f), coupling);
  F32* first = off + q;
  F32* second = off + p;
  each<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    const F32 at_p = *first;
    const F32 at_q = *second;
    *first = c * at_p - s * at_q;
    *second = s * at_p + c * at_q;
    first = &e.of[p][k];
    second = &e.of[q][k];
  });
  return true;
}

/// Eigen-decompositions. They converge quadratically: six sweeps are twice what any float matrix was seen to need.
[[nodiscard]] inline EigenLanes decompose(const SymmetricLanes& m) noexcept {
  using simd::all;
  using simd::F32;
  F32 largest = all(1.17549435e-38f);
  for (const F32& entry : m.entry) largest = simd::max(simd::abs(entry), largest);
  const F32 scale = from_bits(bits_of(largest) & simd::all_int(0x7F800000));  // the power of two below it
  const F32 unit = all(1.0f) / scale;
  EigenLanes e;
  F32 off[3];
  const F32* entry = m.entry;
  each<3>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
    each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      e.of[i][k] = all(i == k ? 1.0f : 0.0f);
      if (k >= i) (k == i ? e.of[i][3] : off[3 - i - k]) = *entry++ * unit;
    });
  });
  bool turned = true;
  for (int sweep = 0; sweep < 6 && turned; ++sweep) {
    turned = false;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) turned = rotate(e, off, p, q) || turned;
    }
  }

  each<3>([&](auto step) SHORTSHOT_INLINE_LAMBDA {  // sort: exchange 0 and 1, 1 and 2, 0 and 1
    F32(&first)[4] = e.of[step % 2];
    F32(&second)[4] = e.of[step % 2 + 1];
    const simd::Mask swap = second[3] < first[3];
    if (!any(swap)) return;
    each<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      const F32 before = first[k];
      first[k] = select(swap, second[k], before);
      second[k] = select(swap, before, second[k]);
    });
  });
  each<3>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
    F32(&v)[4] = e.of[i];
    const F32 length = simd::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    each<3>([&](auto k) { v[k] = v[k] / length; });
    v[3] = v[3] * scale;
  });
  return e;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
