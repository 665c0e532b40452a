// Views of Eigen matrices and maps, whatever their storage order and strides.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "fixtures.hpp"

namespace test_views_eigen {
namespace {

using namespace unit;
using ss::Status;

constexpr Eigen::Index count = 50;

TestCloud sample() { return curved_surface(1, static_cast<std::size_t>(count)); }

void check_reads_as_sample(const ss::CloudView& view, bool colors) {
  const TestCloud cloud = sample();
  REQUIRE(ss::validate(view) == Status::ok);
  REQUIRE(view.size == cloud.size());
  REQUIRE(view.width == cloud.size());
  REQUIRE(view.height == 1);
  REQUIRE(ss::has_colors(view) == colors);
  require_same_points(view, cloud, colors);
}

using ColumnPoints = Eigen::Matrix3Xf;
using RowPoints = Eigen::MatrixX3f;
using ColumnPointsByRow = Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::RowMajor>;
using RowPointsByRow = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using ColumnColors = Eigen::Matrix<std::uint8_t, 3, Eigen::Dynamic>;
using RowColorsByRow = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

ColumnPoints sample_points() {
  const TestCloud cloud = sample();
  return Eigen::Map<const ColumnPoints>(cloud.xyz.data(), 3, count);
}

ColumnColors sample_colors() {
  const TestCloud cloud = sample();
  return Eigen::Map<const ColumnColors>(cloud.rgb.data(), 3, count);
}

template <class Arguments, class = void>
struct CanViewAll : std::false_type {};
template <class... Arguments>
struct CanViewAll<void(Arguments...), std::void_t<decltype(ss::view_eigen(std::declval<Arguments>()...))>>
    : std::true_type {};
template <class... Arguments>
using CanView = CanViewAll<void(Arguments...)>;

}  // namespace

TEST_CASE("eigen views: points as columns and as rows, column- and row-major") {
  const ColumnPoints columns = sample_points();
  const RowPoints rows = sample_points().transpose();
  const ColumnPointsByRow columns_by_row = sample_points();
  const RowPointsByRow rows_by_row = sample_points().transpose();
  check_reads_as_sample(ss::view_eigen(columns), false);
  check_reads_as_sample(ss::view_eigen(rows), false);
  check_reads_as_sample(ss::view_eigen(columns_by_row), false);
  check_reads_as_sample(ss::view_eigen(rows_by_row), false);
  CHECK(ss::view_eigen(rows).points.y == reinterpret_cast<const unsigned char*>(&rows(0, 1)));
}

TEST_CASE("eigen views: points and colors in different layouts") {
  const RowPoints rows = sample_points().transpose();
  const ColumnColors colors = sample_colors();
  const RowColorsByRow colors_by_row = sample_colors().transpose();
  check_reads_as_sample(ss::view_eigen(rows, colors), true);
  check_reads_as_sample(ss::view_eigen(rows, colors_by_row), true);
  CHECK(ss::view_eigen(rows, colors).colors.g == &colors(1, 0));
}

TEST_CASE("eigen views: maps with inner and outer strides") {
  const TestCloud cloud = sample();
  std::vector<float> spread(static_cast<std::size_t>(count) * 8, not_a_number);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) spread[8 * i + 2 * k] = cloud.xyz[3 * i + k];
  }
  using Strides = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::Map<const ColumnPoints, 0, Strides> columns(spread.data(), 3, count, Strides(8, 2));
  const Eigen::Map<const RowPoints, 0, Strides> rows(spread.data(), count, 3, Strides(2, 8));
  check_reads_as_sample(ss::view_eigen(columns), false);
  check_reads_as_sample(ss::view_eigen(rows), false);
  CHECK(ss::view_eigen(columns).points.x == reinterpret_cast<const unsigned char*>(spread.data()));
}

TEST_CASE("eigen views: three points are columns; an empty matrix is an empty cloud") {
  Eigen::Matrix3f square;
  square << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const ss::Point second = ss::point(ss::view_eigen(square), 1);
  CHECK(second.x == 2.0f);
  CHECK(second.y == 5.0f);
  CHECK(second.z == 8.0f);
  const ColumnPoints none(3, 0);
  CHECK(ss::validate(ss::view_eigen(none)) == Status::empty_cloud);
}

TEST_CASE("eigen views: colors for another number of points are refused") {
  const ColumnPoints points = sample_points();
  const ColumnColors too_few = sample_colors().leftCols(count - 1);
  CHECK(ss::validate(ss::view_eigen(points, too_few)) != Status::ok);
}

TEST_CASE("eigen views: a matrix of floats beside the points holds normals, with colors or without") {
  const RowPoints rows = sample_points().transpose();
  const ColumnPoints normals = -sample_points();
  const RowPointsByRow normals_by_row = normals.transpose();
  const ColumnColors colors = sample_colors();
  const auto check_normals = [&](const ss::CloudView& view, bool with_colors) {
    check_reads_as_sample(view, with_colors);
    REQUIRE(ss::has_normals(view));
    for (Eigen::Index i = 0; i < count; ++i) {
      const ss::Point n = ss::extend::read(view.normals, static_cast<std::size_t>(i));
      REQUIRE((n.x == normals(0, i) && n.y == normals(1, i) && n.z == normals(2, i)));
    }
  };
  check_normals(ss::view_eigen(rows, normals), false);
  check_normals(ss::view_eigen(rows, normals_by_row), false);
  check_normals(ss::view_eigen(rows, colors, normals), true);
  check_normals(ss::view_eigen(rows, normals, colors), true);
  CHECK_FALSE(ss::has_normals(ss::view_eigen(rows, colors)));
  const ColumnPoints too_few = normals.leftCols(1), none(3, 0);
  CHECK(ss::validate(ss::view_eigen(rows, too_few)) == Status::sizes_differ);
  CHECK(ss::validate(ss::view_eigen(rows, colors, none)) == Status::sizes_differ);
  CHECK(ss::validate(ss::view_eigen(rows, none, too_few)) ==
        Status::sizes_differ);  // not even as one point with one normal
}

TEST_CASE("eigen views: a matrix that dies at the end of the statement cannot be viewed, a map can") {
  CHECK(CanView<ColumnPoints&>::value);
  CHECK(CanView<const ColumnPoints&>::value);
  CHECK(CanView<Eigen::Map<const ColumnPoints>>::value);
  CHECK_FALSE(CanView<ColumnPoints>::value);
  CHECK_FALSE(CanView<const ColumnPoints>::value);
  CHECK(CanView<ColumnPoints&, const ColumnColors&, Eigen::Map<const ColumnPoints>>::value);
  CHECK_FALSE(CanView<ColumnPoints&, ColumnColors>::value);
  CHECK_FALSE(CanView<ColumnPoints&, ColumnColors&, ColumnPoints>::value);
  CHECK_FALSE(CanView<ColumnPoints, ColumnColors>::value);
}

}  // namespace test_views_eigen
