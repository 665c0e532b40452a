// shortshot/symmetric_eigen.hpp: eigenvectors of symmetric 3x3 matrices, in float, with the same bits everywhere.
//
// Cyclic Jacobi rotations: accurate to a few float epsilons whatever the spacing of the eigenvalues, no libm call but
// the exactly rounded square root. Eigen's solvers are as good on a PC, but the direct one calls atan2, cos and sin
// (other bits with every libm) and both cost more flash than the rest of the frame. Rotations take the same steps for
// every matrix, so a register's lanes hold as many matrices, each with the bits that it would have alone.
#pragma once

#include <initializer_list>

#include "config.hpp"
#include "simd.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// Upper triangle of a symmetric matrix.
struct Symmetric3 {
  float xx, xy, xz, yy, yz, zz;
};

/// Eigenvalues in ascending order; vectors[i] belongs to values[i] and has unit length. Signs are the solver's.
struct Eigen3 {
  float values[3];
  float vectors[3][3];
};

/// The same of one matrix in each lane.
struct SymmetricLanes {
  simd::F32 xx, xy, xz, yy, yz, zz;
};
struct EigenLanes {
  simd::F32 values[3];
  simd::F32 vectors[3][3];
};

/// One Jacobi rotation in the plane (p, q) that makes a[p][q] zero, in those lanes where that is worth while; the
/// columns of v collect the rotations. Entries are at most 2. Returns whether it was worth while anywhere.
inline bool rotate(simd::F32 (&a)[3][3], simd::F32 (&v)[3][3], int p, int q) noexcept {
  using simd::all;
  using simd::F32;
  // The tangent of an angle of at most an eighth of a turn.
  const F32 off = a[p][q];
  const F32 gap = a[q][q] - a[p][p];
  const F32 wide = simd::abs(gap);
  const F32 high = simd::abs(off);
  const simd::Mask turns = high - all(1e-12f) > wide * all(7e-9f);  // else no component moves by half its last bit
  if (!any(turns)) return false;
  const simd::Mask slight = all(8192.0f) * high < wide;  // float knows no better; most rotations but the first few
  const F32 root = simd::sqrt(gap * gap + all(4.0f) * (off * off));
  const F32 sum = gap + simd::negate(gap < all(0.0f), root);
  const F32 t = keep(turns, select(slight, off, off + off) / select(slight, gap, sum));
  const F32 c = all(1.0f) / simd::sqrt(t * t + all(1.0f));
  const F32 s = t * c;
  const int r = 3 - p - q;  // the row that is not rotated

  const F32 moved = t * off;
  a[p][p] = a[p][p] - moved;
  a[q][q] = a[q][q] + moved;
  a[p][q] = a[q][p] = select(turns, all(0.0f), off);
  const F32 rp = a[r][p];
  const F32 rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  for (int k = 0; k < 3; ++k) {
    const F32 vp = v[k][p];
    const F32 vq = v[k][q];
    v[k][p] = c * vp - s * vq;
    v[k][q] = s * vp + c * vq;
  }
  return true;
}

/// The largest power of two not above the largest entry.
[[nodiscard]] inline simd::F32 scale_of(const SymmetricLanes& m) noexcept {
  simd::F32 largest = simd::all(1.17549435e-38f);
  for (const simd::F32* entry : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) {
    largest = simd::max(simd::abs(*entry), largest);
  }
  return from_bits(bits_of(largest) & simd::all_int(0x7F800000));
}

/// Eigen-decompositions. They converge quadratically: six sweeps are twice what any float matrix was seen to need.
[[nodiscard]] inline EigenLanes decompose_lanes(const SymmetricLanes& m) noexcept {
  using simd::all;
  using simd::F32;
  const F32 scale = scale_of(m);
  const F32 unit = all(1.0f) / scale;
  const F32 zero = all(0.0f);
  const F32 one = all(1.0f);
  F32 a[3][3] = {{m.xx * unit, m.xy * unit, m.xz * unit},
                 {m.xy * unit, m.yy * unit, m.yz * unit},
                 {m.xz * unit, m.yz * unit, m.zz * unit}};
  F32 v[3][3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  bool turned = true;
  for (int sweep = 0; sweep < 6 && turned; ++sweep) {
    turned = rotate(a, v, 0, 1);
    turned = rotate(a, v, 0, 2) || turned;
    turned = rotate(a, v, 1, 2) || turned;
  }

  const auto sort_pair = [&](int i, int j) {
    const simd::Mask swap = a[j][j] < a[i][i];
    const auto exchange = [&](F32& first, F32& second) {
      const F32 before = first;
      first = select(swap, second, first);
      second = select(swap, before, second);
    };
    exchange(a[i][i], a[j][j]);
    for (F32(&row)[3] : v) exchange(row[i], row[j]);
  };
  sort_pair(0, 1);
  sort_pair(1, 2);
  sort_pair(0, 1);

  EigenLanes result;
  for (int i = 0; i < 3; ++i) {
    const F32 length = simd::sqrt(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i]);
    result.values[i] = a[i][i] * scale;
    for (int k = 0; k < 3; ++k) result.vectors[i][k] = v[k][i] / length;
  }
  return result;
}

/// Eigen-decomposition of one matrix.
[[nodiscard]] inline Eigen3 decompose(const Symmetric3& m) noexcept {
  using simd::all;
  const EigenLanes lanes = decompose_lanes({all(m.xx), all(m.xy), all(m.xz), all(m.yy), all(m.yz), all(m.zz)});
  const auto first = [](simd::F32 number) {
    float values[simd::lanes];
    simd::store(values, number);
    return values[0];
  };
  Eigen3 result;
  for (int i = 0; i < 3; ++i) {
    result.values[i] = first(lanes.values[i]);
    for (int k = 0; k < 3; ++k) result.vectors[i][k] = first(lanes.vectors[i][k]);
  }
  return result;
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
