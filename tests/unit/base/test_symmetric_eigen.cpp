// The eigenvectors of symmetric 3x3 matrices, against Eigen's solver in double.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "fixtures.hpp"

namespace {

using namespace unit;

// Jacobi rotations are backward stable: a few roundings of the largest entry, here at most 16 ulps of it.
constexpr double tolerance = 16.0 * 1.2e-7;

/// Upper triangle of a symmetric matrix.
struct Symmetric3 {
  float xx, xy, xz, yy, yz, zz;
};

struct Eigen3 {
  float values[3];
  float vectors[3][3];
};

/// One matrix's eigenvectors, from the last lane; the others hold another matrix.
Eigen3 decompose(const Symmetric3& m) {
  const auto lanes_of = [](float last, float other) {
    float numbers[ss::extend::simd::lanes];
    std::fill(std::begin(numbers), std::end(numbers), other);
    numbers[ss::extend::simd::lanes - 1] = last;
    return ss::extend::simd::load(numbers);
  };
  const auto last_of = [](ss::extend::simd::F32 lanes) {
    float numbers[ss::extend::simd::lanes];
    ss::extend::simd::store(numbers, lanes);
    return numbers[ss::extend::simd::lanes - 1];
  };
  const ss::detail::EigenLanes lanes =
      ss::detail::decompose({{lanes_of(m.xx, 3.0f), lanes_of(m.xy, 0.125f), lanes_of(m.xz, 0.25f), lanes_of(m.yy, 2.0f),
                              lanes_of(m.yz, 0.5f), lanes_of(m.zz, 1.0f)}});
  Eigen3 result{};
  for (int i = 0; i < 3; ++i) {
    result.values[i] = last_of(lanes.value(i));
    for (int k = 0; k < 3; ++k) result.vectors[i][k] = last_of(lanes.vector(i, k));
  }
  return result;
}

Eigen::Matrix3d to_double(const Symmetric3& m) {
  Eigen::Matrix3f a;
  a << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return a.cast<double>();
}

Eigen::Vector3d vector_of(const Eigen3& eigen, int i) {
  const auto& v = eigen.vectors[i];
  return Eigen::Vector3f(v[0], v[1], v[2]).cast<double>();
}

void check_decomposition(const Symmetric3& m) {
  const Eigen::Matrix3d a = to_double(m);
  const double scale = a.cwiseAbs().maxCoeff();
  const Eigen3 ours = decompose(m);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> expected(a);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d v = vector_of(ours, i);
    const auto value = static_cast<double>(ours.values[i]);
    REQUIRE(std::abs(value - expected.eigenvalues()[i]) <= tolerance * scale);
    REQUIRE((a * v - value * v).norm() <= 2.0 * tolerance * scale);
    REQUIRE(std::abs(v.norm() - 1.0) <= tolerance);
    REQUIRE(std::abs(v.dot(vector_of(ours, (i + 1) % 3))) <= tolerance);
  }
}

Symmetric3 random_matrix(Random& random) {
  const auto entry = [&random] { return random.between(-1.0f, 1.0f); };
  const float xx = entry(), xy = entry(), xz = entry(), yy = entry(), yz = entry(), zz = entry();
  return {xx, xy, xz, yy, yz, zz};
}

Symmetric3 scaled(const Symmetric3& m, float by) {
  return {m.xx * by, m.xy * by, m.xz * by, m.yy * by, m.yz * by, m.zz * by};
}

}  // namespace

TEST_CASE("symmetric eigen: random matrices") {
  Random random(1);
  for (int k = 0; k < 5000; ++k) check_decomposition(random_matrix(random));
}

TEST_CASE("symmetric eigen: eigenvalues that are nearly equal") {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const float noise = k % 2 == 0 ? 1e-3f : 1e-6f;
    Symmetric3 m = scaled(random_matrix(random), noise);
    m.xx += 1.0f;
    m.yy += 1.0f;
    m.zz += k % 3 == 0 ? 1.0f : 0.25f;
    check_decomposition(m);
  }
}

TEST_CASE("symmetric eigen: matrices of rank one, two and zero, and diagonal ones") {
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    const float a = random.between(-1.0f, 1.0f), b = random.between(-1.0f, 1.0f), c = random.between(-1.0f, 1.0f);
    check_decomposition({a * a, a * b, a * c, b * b, b * c, c * c});
    check_decomposition({a * a + 1.0f, a * b, 0.0f, b * b, 0.0f, 0.0f});
    check_decomposition({a, 0.0f, 0.0f, b, 0.0f, c});
  }
  const Eigen3 zero = decompose({0, 0, 0, 0, 0, 0});
  for (const float value : zero.values) CHECK(value == 0.0f);
}

TEST_CASE("symmetric eigen: entries of very different size") {
  Random random(4);
  for (int k = 0; k < 2000; ++k) {
    Symmetric3 m = random_matrix(random);
    const float tiny = std::ldexp(1.0f, -static_cast<int>(random.below(60)));
    m.xy *= tiny;
    m.yy *= tiny;
    m.yz *= tiny * tiny;
    check_decomposition(m);
  }
}

TEST_CASE("symmetric eigen: a power of two times the matrix has the same eigenvectors to the bit") {
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    const Symmetric3 m = random_matrix(random);
    const Eigen3 plain = decompose(m);
    for (const int exponent : {-50, 100}) {  // below, rotations' last corrections would become denormal
      const Eigen3 other = decompose(scaled(m, std::ldexp(1.0f, exponent)));
      REQUIRE(std::memcmp(plain.vectors, other.vectors, sizeof plain.vectors) == 0);
    }
  }
}

TEST_CASE("symmetric eigen: huge and tiny matrices give finite unit vectors") {
  Random random(6);
  for (int k = 0; k < 500; ++k) {
    for (const float scale : {1e37f, 1e-30f, 1e-37f, 1e-44f}) {
      const Eigen3 eigen = decompose(scaled(random_matrix(random), scale));
      for (int i = 0; i < 3; ++i) REQUIRE(std::abs(vector_of(eigen, i).norm() - 1.0) <= tolerance);
    }
  }
}
