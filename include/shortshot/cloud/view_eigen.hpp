// shortshot/cloud/view_eigen.hpp: views of Eigen matrices and maps, points as columns or as rows. Works with Eigen 3.4
// to 5.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../config.hpp"
#include "cloud.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Where component `c` of point 0 lies in a matrix whose points are its columns (3xN) or its rows (Nx3).
template <class Matrix>
struct EigenPoints {
  static constexpr bool columns = Matrix::RowsAtCompileTime == 3;
  static_assert(columns || Matrix::ColsAtCompileTime == 3,
                "Eigen views support 3 x N and N x 3 matrices and maps, with the 3 in their types, as in Matrix3Xf");

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

/// Matrices own their memory; maps and blocks borrow it. Of arguments that a function takes as Argument&&: is this one
/// a matrix that dies at the end of the statement?
template <class Argument>
struct IsDyingMatrix : std::is_base_of<Eigen::PlainObjectBase<std::remove_cv_t<Argument>>, std::remove_cv_t<Argument>> {
};
template <class Argument>
struct IsDyingMatrix<Argument&> : std::false_type {};

/// Bytes are colors, floats are normals.
template <class Channel>
void add_channel(CloudView& view, const Channel& matrix) noexcept {
  using Scalar = typename Channel::Scalar;
  static_assert(sizeof(Scalar) == 1 || std::is_same<Scalar, float>::value,
                "view_eigen() supports colors of one byte each, and normals of floats");
  using Rows = EigenPoints<Channel>;
  const std::size_t step = Rows::component_step(matrix) * sizeof(Scalar);
  const std::size_t stride = Rows::point_step(matrix) * sizeof(Scalar);
  if constexpr (sizeof(Scalar) == 1) {
    view.colors = color_channel(reinterpret_cast<const unsigned char*>(matrix.data()), step, stride);
  } else {
    view.normals = float3_channel(matrix.data(), step, stride);
  }
  if (Rows::count(matrix) != view.size) view = unusable_view(Status::sizes_differ);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// View of float points: Matrix3Xf, MatrixX3f, row- or column-major, or a Map of them with any strides. Borrowed.
///
/// `channels`: a matrix of bytes r g b for colors, a matrix of floats for normals, or both, of either shape.
/// sizes_differ if the numbers of points do.
template <class Matrix, class... Channels>
[[nodiscard]] CloudView view_eigen(const Matrix& xyz, const Channels&... channels) noexcept {
  static_assert(std::is_same<typename Matrix::Scalar, float>::value, "view_eigen() supports float coordinates");
  using Points = detail::EigenPoints<Matrix>;
  CloudView view{};
  view.size = Points::count(xyz);
  view.width = view.size;
  view.height = 1;
  view.points = detail::float3_channel(xyz.data(), Points::component_step(xyz) * sizeof(float),
                                       Points::point_step(xyz) * sizeof(float));
  (detail::add_channel(view, channels), ...);
  return view;
}

/// A matrix (not a map) that dies at the end of the statement cannot be viewed.
template <class... Matrices, class = std::enable_if_t<(detail::IsDyingMatrix<Matrices>::value || ...)>>
CloudView view_eigen(Matrices&&... matrices) = delete;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
