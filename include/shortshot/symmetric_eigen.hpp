// shortshot/symmetric_eigen.hpp: eigenvectors of a symmetric 3x3 matrix, in float, with the same bits everywhere.
//
// Cyclic Jacobi rotations: accurate to a few float epsilons whatever the spacing of the eigenvalues, no libm call but
// the exactly rounded square root, 192 bytes of stack on a Cortex-M7. Eigen's solvers are as good on a PC, but the
// direct one calls atan2, cos and sin (other bits with every libm) and both cost more flash than the rest of the frame.
#pragma once

#include <initializer_list>

#include "config.hpp"
#include "math.hpp"
#include "rounded.hpp"
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

/// Tangent of the angle, at most an eighth of a turn, by which the plane of two diagonal entries `gap` apart turns to
/// make the entry `off` between them zero; 0 if that is not worth while: it moves no component by half its last bit.
[[nodiscard]] inline float tangent(float gap, float off) noexcept {
  const float wide = gap < 0.0f ? 0.0f - gap : gap;
  const float high = off < 0.0f ? 0.0f - off : off;
  if (high - 1e-12f <= rounded(wide * 7e-9f)) return 0.0f;
  if (high * 8192.0f < wide) return off / gap;  // float knows no better; most rotations but the first few
  const float root = simd::root(rounded(gap * gap) + rounded(4.0f * (off * off)));
  return (off + off) / (gap < 0.0f ? gap - root : gap + root);
}

/// One Jacobi rotation in the plane (p, q) that makes a[p][q] zero; the columns of v collect the rotations. Entries are
/// at most 2. Returns whether it was worth while.
inline bool rotate(float (&a)[3][3], float (&v)[3][3], int p, int q) noexcept {
  const float t = tangent(a[q][q] - a[p][p], a[p][q]);
  if (t == 0.0f) return false;
  const float square = rounded(t * t) + 1.0f;
  const float c = square == 1.0f ? 1.0f : 1.0f / simd::root(square);
  const float s = t * c;
  const int r = 3 - p - q;  // the row that is not rotated

  const float moved = rounded(t * a[p][q]);
  a[p][p] = a[p][p] - moved;
  a[q][q] = a[q][q] + moved;
  a[p][q] = a[q][p] = 0.0f;
  const float rp = a[r][p];
  const float rq = a[r][q];
  a[r][p] = a[p][r] = rounded(c * rp) - rounded(s * rq);
  a[r][q] = a[q][r] = rounded(s * rp) + rounded(c * rq);
  for (int k = 0; k < 3; ++k) {
    const float vp = v[k][p];
    const float vq = v[k][q];
    v[k][p] = rounded(c * vp) - rounded(s * vq);
    v[k][q] = rounded(s * vp) + rounded(c * vq);
  }
  return true;
}

/// The largest power of two not above the largest entry.
[[nodiscard]] inline float scale_of(const Symmetric3& m) noexcept {
  float largest = 1.17549435e-38f;
  for (const float entry : {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz}) {
    const float size = entry < 0.0f ? 0.0f - entry : entry;
    largest = size > largest ? size : largest;
  }
  return math::power_of_two_below(largest);
}

/// Eigen-decomposition of m. Converges quadratically: six sweeps are twice what any float matrix was seen to need.
[[nodiscard]] inline Eigen3 decompose(const Symmetric3& m) noexcept {
  const float scale = scale_of(m);
  const float unit = 1.0f / scale;
  float a[3][3] = {{m.xx * unit, m.xy * unit, m.xz * unit},
                   {m.xy * unit, m.yy * unit, m.yz * unit},
                   {m.xz * unit, m.yz * unit, m.zz * unit}};
  float v[3][3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  bool turned = true;
  for (int sweep = 0; sweep < 6 && turned; ++sweep) {
    turned = rotate(a, v, 0, 1);
    turned = rotate(a, v, 0, 2) || turned;
    turned = rotate(a, v, 1, 2) || turned;
  }

  int order[3] = {0, 1, 2};
  const auto sort_pair = [&](int i, int j) {
    if (a[order[j]][order[j]] >= a[order[i]][order[i]]) return;
    const int swapped = order[i];
    order[i] = order[j];
    order[j] = swapped;
  };
  sort_pair(0, 1);
  sort_pair(1, 2);
  sort_pair(0, 1);

  Eigen3 result;
  for (int i = 0; i < 3; ++i) {
    const int column = order[i];
    const auto square = [&](int k) { return rounded(v[k][column] * v[k][column]); };
    const float length = simd::root(square(0) + square(1) + square(2));
    result.values[i] = a[column][column] * scale;
    for (int k = 0; k < 3; ++k) result.vectors[i][k] = v[k][column] / length;
  }
  return result;
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
