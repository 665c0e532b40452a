// shortshot/symmetric_eigen.hpp: eigenvectors of a symmetric 3x3 matrix, in float, with the same bits everywhere.
//
// Cyclic Jacobi rotations: accurate to a few float epsilons whatever the spacing of the eigenvalues, no libm call but
// the exactly rounded square root, 192 bytes of stack on a Cortex-M7. Eigen's solvers are as good on a PC, but the
// direct one calls atan2, cos and sin (other bits with every libm) and both cost more flash than the rest of the frame.
#pragma once

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

/// One Jacobi rotation in the plane (p, q) that makes a[p][q] zero; the columns of v collect the rotations.
inline void rotate(float (&a)[3][3], float (&v)[3][3], int p, int q) noexcept {
  if (a[p][q] == 0.0f) return;
  const float theta = (a[q][q] - a[p][p]) / (2.0f * a[p][q]);
  const float magnitude = theta < 0.0f ? -theta : theta;
  if (magnitude > 1e18f) return;  // turns by less than any component's last bit; half of all rotations, at the end
  // tan of the rotation angle; theta squared would overflow where the angle is below float resolution anyway.
  const float tangent =
      magnitude > 1e9f ? 0.5f / magnitude : 1.0f / (magnitude + simd::root(magnitude * magnitude + 1.0f));
  const float t = theta < 0.0f ? -tangent : tangent;
  const float c = 1.0f / simd::root(t * t + 1.0f);
  const float s = t * c;
  const int r = 3 - p - q;  // the row that is not rotated

  a[p][p] = a[p][p] - t * a[p][q];
  a[q][q] = a[q][q] + t * a[p][q];
  a[p][q] = a[q][p] = 0.0f;
  const float rp = a[r][p];
  const float rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  for (int k = 0; k < 3; ++k) {
    const float vp = v[k][p];
    const float vq = v[k][q];
    v[k][p] = c * vp - s * vq;
    v[k][q] = s * vp + c * vq;
  }
}

/// Eigen-decomposition of m. Converges quadratically: six sweeps are twice what any float matrix was seen to need.
[[nodiscard]] inline Eigen3 decompose(const Symmetric3& m) noexcept {
  float a[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  float v[3][3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  for (int sweep = 0; sweep < 6; ++sweep) {
    rotate(a, v, 0, 1);
    rotate(a, v, 0, 2);
    rotate(a, v, 1, 2);
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
    const float length =
        simd::root(v[0][column] * v[0][column] + v[1][column] * v[1][column] + v[2][column] * v[2][column]);
    result.values[i] = a[column][column];
    for (int k = 0; k < 3; ++k) result.vectors[i][k] = v[k][column] / length;
  }
  return result;
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
