// shortshot/adapters/eigen.hpp: views of Eigen matrices and maps, points as columns or as rows. Works with Eigen 3.4
// to 5.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../cloud.hpp"
#include "../config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// Where component `c` of point 0 lies in a matrix whose points are its columns (3xN) or its rows (Nx3).
template <class Matrix>
struct EigenPoints {
  static constexpr bool columns = Matrix::RowsAtCompileTime == 3;
  static_assert(columns || Matrix::ColsAtCompileTime == 3, "Eigen views support 3 x N and N x 3 matrices and maps");

  [[nodiscard]] static std::size_t count(const Matrix& m) noexcept {
    return static_cast<std::size_t>(columns ? m.cols() : m.rows());
  }
  /// Elements from one component, or one point, to the next.
  [[nodiscard]] static std::size_t component_step(const Matrix& m) noexcept {
    return static_cast<std::size_t>(columns != static_cast<bool>(Matrix::IsRowMajor) ? m.innerStride()
                                                                                     : m.outerStride());
  }
  [[nodiscard]] static std::size_t point_step(const Matrix& m) noexcept {
    return static_cast<std::size_t>(columns != static_cast<bool>(Matrix::IsRowMajor) ? m.outerStride()
                                                                                     : m.innerStride());
  }
};

/// Matrices own their memory; maps and blocks borrow it.
template <class Matrix>
using IfOwning = std::enable_if_t<std::is_base_of<Eigen::PlainObjectBase<Matrix>, Matrix>::value>;

}  // namespace detail

/// View of float points: Matrix3Xf, MatrixX3f, row- or column-major, or a Map of them with any strides. Borrowed.
template <class Matrix>
[[nodiscard]] CloudView view_eigen(const Matrix& xyz) noexcept {
  static_assert(std::is_same<typename Matrix::Scalar, float>::value, "view_eigen() supports float coordinates");
  using Points = detail::EigenPoints<Matrix>;
  CloudView view{};
  view.size = Points::count(xyz);
  view.width = view.size;
  view.height = 1;
  view.points = detail::float3_channel(xyz.data(), Points::component_step(xyz) * sizeof(float),
                                       Points::point_step(xyz) * sizeof(float));
  return view;
}

/// The same with colours: a matrix of bytes r g b of either shape. bad_view if the numbers of points differ.
template <class Matrix, class Colors>
[[nodiscard]] CloudView view_eigen(const Matrix& xyz, const Colors& rgb) noexcept {
  static_assert(sizeof(typename Colors::Scalar) == 1, "view_eigen() supports colours of one byte each");
  using Points = detail::EigenPoints<Colors>;
  CloudView view = view_eigen(xyz);
  const auto* first = reinterpret_cast<const unsigned char*>(rgb.data());
  view.colors = detail::color_channel(first, Points::component_step(rgb), Points::point_step(rgb));
  if (Points::count(rgb) != view.size) {  // a view of nothing, and of more than nothing: bad_view everywhere
    view.points = {};
    view.size = 1;
  }
  return view;
}

/// A matrix (not a map) that dies at the end of the statement cannot be viewed.
template <class Matrix, class = detail::IfOwning<Matrix>>
CloudView view_eigen(const Matrix&& xyz) = delete;
template <class Matrix, class Colors, class = detail::IfOwning<Matrix>>
CloudView view_eigen(const Matrix&& xyz, const Colors& rgb) = delete;
template <class Matrix, class Colors, class = detail::IfOwning<Colors>>
CloudView view_eigen(const Matrix& xyz, const Colors&& rgb) = delete;

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
