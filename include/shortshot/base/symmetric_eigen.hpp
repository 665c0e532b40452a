// shortshot/base/symmetric_eigen.hpp: eigenvectors of symmetric 3x3 and 4x4 matrices, in float, with the same bits
// everywhere.
//
// Cyclic Jacobi rotations: accurate to a few float epsilons whatever the spacing of the eigenvalues, no libm call but
// the exactly rounded square root. Eigen's solvers are as good on a PC, but the direct one calls atan2, cos and sin
// (other bits with every libm) and both cost more flash than the rest of the frame. Rotations take the same steps for
// every matrix, so a register's lanes hold as many matrices, each with the bits that it would have alone.
#ifndef SHORTSHOT_BASE_SYMMETRIC_EIGEN_HPP
#define SHORTSHOT_BASE_SYMMETRIC_EIGEN_HPP

#include <cstddef>

#include "../config.hpp"
#include "simd.hpp"
#include "unroll.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The upper triangle of a symmetric N x N matrix in each lane, row by row: xx, xy, xz, yy, yz, zz.
template <int N>
struct SymmetricMatrices {
  simd::F32 entry[static_cast<std::size_t>(N * (N + 1) / 2)];
};
using SymmetricLanes = SymmetricMatrices<3>;

/// Eigenvectors of unit length, each followed by its eigenvalue, which ascend. Signs are the solver's.
template <int N>
struct Eigenvectors {
  simd::F32 of[static_cast<std::size_t>(N)][static_cast<std::size_t>(N + 1)];

  [[nodiscard]] simd::F32 value(int i) const noexcept { return of[i][N]; }
  [[nodiscard]] simd::F32 vector(int i, int k) const noexcept { return of[i][k]; }
};
using EigenLanes = Eigenvectors<3>;

/// The entries outside of the diagonal, each once.
template <int N>
struct Couplings {
  static_assert(N == 3 || N == 4, "numbers of pairs of axes are known for these");
  simd::F32 of[static_cast<std::size_t>(N * (N - 1) / 2)];

  [[nodiscard]] simd::F32& between(int i, int k) noexcept {
    if constexpr (N == 3) return of[3 - i - k];  // has the number of the third axis: quickly found
    return of[i == 0 || k == 0 ? i + k - 1 : i + k];
  }
};

/// The axes that are neither p nor q > p, in ascending order.
template <int N>
[[nodiscard]] constexpr int other_axis(int i, int p, int q) noexcept {
  if constexpr (N == 3) return 3 - p - q;
  const int above_p = i < p ? i : i + 1;
  return above_p < q ? above_p : above_p + 1;
}

/// each() for the frames' 3x3 matrices; for others, which fewer wait for, a loop, which is compiled in less time.
template <int N, int Count, class Function>
[[gnu::always_inline]] inline void repeat(Function f) noexcept {
  if constexpr (N == 3) {
    each<Count>(f);
  } else {
    for (int i = 0; i < Count; ++i) f(i);
  }
}

/// One Jacobi rotation in the plane (p, q), q > p, in those lanes where it is worth while: it makes zero what couples
/// the two axes. Entries are at most 2. Returns whether it was worth while anywhere.
template <int N>
SHORTSHOT_INLINE bool rotate(Eigenvectors<N>& e, Couplings<N>& off, int p, int q) noexcept {
  using simd::all;
  using simd::F32;
  F32& coupling = off.between(p, q);
  F32& value_p = e.of[p][N];
  F32& value_q = e.of[q][N];
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
  F32* first = &off.between(p, other_axis<N>(0, p, q));
  F32* second = &off.between(q, other_axis<N>(0, p, q));
  repeat<N, N - 2 + N>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    const F32 at_p = *first;
    const F32 at_q = *second;
    *first = c * at_p - s * at_q;
    *second = s * at_p + c * at_q;
    const int next = k + 1;
    const bool couples = next < N - 2;
    first = couples ? &off.between(p, other_axis<N>(next, p, q)) : &e.of[p][next - (N - 2)];
    second = couples ? &off.between(q, other_axis<N>(next, p, q)) : &e.of[q][next - (N - 2)];
  });
  return true;
}

/// Eigen-decompositions. They converge quadratically: two sweeps for each axis are more than any float matrix was seen
/// to need (four of 3x3, five of 4x4 ones).
template <int N = 3>
[[nodiscard]] inline Eigenvectors<N> decompose(const SymmetricMatrices<N>& m) noexcept {
  using simd::all;
  using simd::F32;
  F32 largest = all(1.17549435e-38f);
  for (const F32& entry : m.entry) largest = simd::max(simd::abs(entry), largest);
  const F32 scale = from_bits(bits_of(largest) & simd::all_int(0x7F800000));  // the power of two below it
  const F32 unit = all(1.0f) / scale;
  Eigenvectors<N> e;
  Couplings<N> off;
  const F32* entry = m.entry;
  repeat<N, N>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
    repeat<N, N>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      e.of[i][k] = all(i == k ? 1.0f : 0.0f);
      if (k >= i) (k == i ? e.of[i][N] : off.between(i, k)) = *entry++ * unit;
    });
  });
  bool turned = true;
  for (int sweep = 0; sweep < 2 * N && turned; ++sweep) {
    turned = false;
    for (int p = 0; p < N - 1; ++p) {
      for (int q = p + 1; q < N; ++q) turned = rotate(e, off, p, q) || turned;
    }
  }

  // Sort: exchange neighbors, from 0 and 1 to the last ones, again and again; at last 0 and 1.
  repeat<N, (N - 1) * (N - 2) + 1>([&](auto step) SHORTSHOT_INLINE_LAMBDA {
    auto& first = e.of[step % (N - 1)];
    auto& second = e.of[step % (N - 1) + 1];
    const simd::Mask swap = second[N] < first[N];
    if (!any(swap)) return;
    repeat<N, N + 1>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      const F32 before = first[k];
      first[k] = select(swap, second[k], before);
      second[k] = select(swap, before, second[k]);
    });
  });
  repeat<N, N>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
    auto& v = e.of[i];
    F32 squares = v[0] * v[0];
    unroll<N - 1>([&](auto k) { squares = squares + v[k + 1] * v[k + 1]; });
    const F32 length = simd::sqrt(squares);
    repeat<N, N>([&](auto k) { v[k] = v[k] / length; });
    v[N] = v[N] * scale;
  });
  return e;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_SYMMETRIC_EIGEN_HPP
