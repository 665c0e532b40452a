// The eigenvectors of symmetric 3x3 and 4x4 matrices, against Eigen's solver in double.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "fixtures.hpp"

namespace test_symmetric_eigen {
namespace {

using namespace unit;

// Jacobi rotations are backward stable: a few roundings of the largest entry, here at most 16 ulps of it.
constexpr double tolerance = 16.0 * 1.2e-7;

/// Upper triangle of a symmetric matrix, row by row.
template <std::size_t N>
struct Symmetric {
  float entry[N * (N + 1) / 2];
};

template <std::size_t N>
struct Decomposition {
  float values[N];
  float vectors[N][N];
};

template <std::size_t N>
using Matrix = Eigen::Matrix<double, static_cast<int>(N), static_cast<int>(N)>;
template <std::size_t N>
using Vector = Eigen::Matrix<double, static_cast<int>(N), 1>;

/// One matrix's eigenvectors, from the last lane; the others hold another matrix.
template <std::size_t N>
Decomposition<N> decompose(const Symmetric<N>& m) {
  const auto last_of = [](ss::extend::simd::F32 lanes) {
    float numbers[ss::extend::simd::lanes];
    ss::extend::simd::store(numbers, lanes);
    return numbers[ss::extend::simd::lanes - 1];
  };
  constexpr float other[] = {3.0f, 0.125f, 0.25f, 2.0f, 0.5f, 1.0f, 0.75f, -1.0f, 0.375f, 4.0f};
  ss::detail::SymmetricMatrices<static_cast<int>(N)> lanes{};
  for (std::size_t i = 0; i < std::size(m.entry); ++i) {
    float numbers[ss::extend::simd::lanes];
    std::fill(std::begin(numbers), std::end(numbers), other[i]);
    numbers[ss::extend::simd::lanes - 1] = m.entry[i];
    lanes.entry[i] = ss::extend::simd::load(numbers);
  }
  const auto eigen = ss::detail::decompose(lanes);
  Decomposition<N> result{};
  for (std::size_t i = 0; i < N; ++i) {
    result.values[i] = last_of(eigen.value(static_cast<int>(i)));
    for (std::size_t k = 0; k < N; ++k) {
      result.vectors[i][k] = last_of(eigen.vector(static_cast<int>(i), static_cast<int>(k)));
    }
  }
  return result;
}

template <std::size_t N>
Matrix<N> to_double(const Symmetric<N>& m) {
  Matrix<N> a;
  const float* entry = m.entry;
  for (int i = 0; i < static_cast<int>(N); ++i) {
    for (int k = i; k < static_cast<int>(N); ++k) a(i, k) = a(k, i) = static_cast<double>(*entry++);
  }
  return a;
}

template <std::size_t N>
Vector<N> vector_of(const Decomposition<N>& eigen, std::size_t i) {
  Vector<N> v;
  for (std::size_t k = 0; k < N; ++k) v[static_cast<int>(k)] = static_cast<double>(eigen.vectors[i][k]);
  return v;
}

template <std::size_t N>
void check_decomposition(const Symmetric<N>& m) {
  const Matrix<N> a = to_double(m);
  const double scale = a.cwiseAbs().maxCoeff();
  const Decomposition<N> ours = decompose(m);
  const Eigen::SelfAdjointEigenSolver<Matrix<N>> expected(a);
  for (std::size_t i = 0; i < N; ++i) {
    const Vector<N> v = vector_of(ours, i);
    const auto value = static_cast<double>(ours.values[i]);
    REQUIRE(std::abs(value - expected.eigenvalues()[static_cast<int>(i)]) <= tolerance * scale);
    REQUIRE((a * v - value * v).norm() <= 2.0 * tolerance * scale);
    REQUIRE(std::abs(v.norm() - 1.0) <= tolerance);
    for (std::size_t k = 0; k < i; ++k) REQUIRE(std::abs(v.dot(vector_of(ours, k))) <= tolerance);
  }
}

template <std::size_t N>
Symmetric<N> random_matrix(Random& random) {
  Symmetric<N> m{};
  for (float& entry : m.entry) entry = random.between(-1.0f, 1.0f);
  return m;
}

template <std::size_t N>
Symmetric<N> scaled(Symmetric<N> m, float by) {
  for (float& entry : m.entry) entry *= by;
  return m;
}

/// The sum of v v^T and w w^T.
template <std::size_t N>
Symmetric<N> squared(const float (&v)[N], const float (&w)[N]) {
  Symmetric<N> m{};
  float* entry = m.entry;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = i; k < N; ++k) *entry++ = v[i] * v[k] + w[i] * w[k];
  }
  return m;
}

template <std::size_t N>
void add_to_diagonal(Symmetric<N>& m, std::size_t i, float value) {
  m.entry[i * N - i * (i + 1) / 2 + i] += value;
}

template <std::size_t N>
void check_random() {
  Random random(1);
  for (int k = 0; k < 5000; ++k) check_decomposition(random_matrix<N>(random));
}

template <std::size_t N>
void check_nearly_equal_values() {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const float noise = k % 2 == 0 ? 1e-3f : 1e-6f;
    Symmetric<N> m = scaled(random_matrix<N>(random), noise);
    for (std::size_t i = 0; i < N; ++i) add_to_diagonal(m, i, i < 2 || k % 3 == 0 ? 1.0f : 0.25f);
    check_decomposition(m);
  }
}

template <std::size_t N>
void check_low_ranks() {
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    float v[N];
    float unit[N] = {};
    Symmetric<N> diagonal{};
    for (std::size_t i = 0; i < N; ++i) {
      v[i] = random.between(-1.0f, 1.0f);
      add_to_diagonal(diagonal, i, v[i]);
    }
    check_decomposition(diagonal);
    check_decomposition(squared(v, unit));
    unit[0] = 1.0f;
    v[N - 1] = 0.0f;
    check_decomposition(squared(v, unit));
  }
  for (const float value : decompose(Symmetric<N>{}).values) CHECK(value == 0.0f);
}

template <std::size_t N>
void check_entries_of_different_size() {
  Random random(4);
  for (int k = 0; k < 2000; ++k) {
    Symmetric<N> m = random_matrix<N>(random);
    for (std::size_t i = 1; i < std::size(m.entry); i += 2) {
      m.entry[i] *= std::ldexp(1.0f, -static_cast<int>(random.below(60)));
    }
    check_decomposition(m);
  }
}

template <std::size_t N>
void check_powers_of_two() {
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    const Symmetric<N> m = random_matrix<N>(random);
    const Decomposition<N> plain = decompose(m);
    for (const int exponent : {-50, 100}) {  // below, rotations' last corrections would become denormal
      const Decomposition<N> other = decompose(scaled(m, std::ldexp(1.0f, exponent)));
      REQUIRE(std::memcmp(plain.vectors, other.vectors, sizeof plain.vectors) == 0);
    }
  }
}

template <std::size_t N>
void check_huge_and_tiny() {
  Random random(6);
  for (int k = 0; k < 500; ++k) {
    for (const float scale : {1e37f, 1e-30f, 1e-37f, 1e-44f}) {
      const Decomposition<N> eigen = decompose(scaled(random_matrix<N>(random), scale));
      for (std::size_t i = 0; i < N; ++i) REQUIRE(std::abs(vector_of(eigen, i).norm() - 1.0) <= tolerance);
    }
  }
}

}  // namespace

TEST_CASE("symmetric eigen: random matrices") {
  check_random<3>();
  check_random<4>();
}

TEST_CASE("symmetric eigen: eigenvalues that are nearly equal") {
  check_nearly_equal_values<3>();
  check_nearly_equal_values<4>();
}

TEST_CASE("symmetric eigen: matrices of rank one, two and zero, and diagonal ones") {
  check_low_ranks<3>();
  check_low_ranks<4>();
}

TEST_CASE("symmetric eigen: entries of very different size") {
  check_entries_of_different_size<3>();
  check_entries_of_different_size<4>();
}

TEST_CASE("symmetric eigen: a power of two times the matrix has the same eigenvectors to the bit") {
  check_powers_of_two<3>();
  check_powers_of_two<4>();
}

TEST_CASE("symmetric eigen: huge and tiny matrices give finite unit vectors") {
  check_huge_and_tiny<3>();
  check_huge_and_tiny<4>();
}

}  // namespace test_symmetric_eigen
