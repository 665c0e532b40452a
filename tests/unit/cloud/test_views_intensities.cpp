// Views with intensities: of arrays, beside the points or apart from them, and among the members of structs.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fixtures.hpp"

namespace test_views_intensities {
namespace {

using namespace unit;
using ss::Status;

constexpr std::size_t count = 300;

TestCloud sample() { return curved_surface(1, count); }

/// From 0 to what the type holds; floats have a fraction.
template <class Scalar>
Scalar intensity_at(std::size_t i) {
  const std::size_t whole = i * 219 % 65536;
  return std::is_same<Scalar, float>::value ? static_cast<Scalar>(0.25 * static_cast<double>(whole))
                                            : static_cast<Scalar>(whole);
}

template <class Scalar>
std::vector<Scalar> intensities_as() {
  std::vector<Scalar> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i] = intensity_at<Scalar>(i);
  return all;
}

template <class Scalar>
void check_intensities(const ss::CloudView& view) {
  REQUIRE(ss::validate(view) == Status::ok);
  REQUIRE(view.size == count);
  REQUIRE(ss::has_intensities(view));
  require_same_points(view, sample(), ss::has_colors(view));
  for (std::size_t i = 0; i < count; ++i) {
    const auto expected = static_cast<float>(intensity_at<Scalar>(i));
    REQUIRE(ss::intensity(view, i) == expected);
    const ss::KeyPoint key = ss::keypoint(view, i);
    REQUIRE((key.has_intensity && key.intensity == expected));
    REQUIRE(key.has_color == ss::has_colors(view));
  }
}

struct alignas(16) PclPoint {  // as pcl::PointXYZI: 32 bytes
  float x, y, z, one;
  union {
    struct {
      float intensity;
    };
    float data_c[4];
  };
};
static_assert(sizeof(PclPoint) == 32, "the layout of PCL");

struct PclCloud {
  std::vector<PclPoint> points;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

struct VelodynePoint {  // in no particular order
  std::uint8_t intensity;
  float z, x, y;
  double stamp;
};

struct OusterPoint {
  float x, y, z;
  std::uint16_t ring;
  std::uint16_t intensity;
};

struct ColoredEcho {
  float normal_x, normal_y, normal_z, x, y, z, intensity;
  std::uint8_t b, g, r, a;
};

struct DoubleEcho {  // a type that no channel has
  float x, y, z;
  double intensity;
};

struct SignedEcho {
  float x, y, z;
  std::int16_t intensity;
};

struct NoEcho {
  float x, y, z;
};

template <class P>
std::vector<P> sample_as() {
  const TestCloud cloud = sample();
  std::vector<P> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i].x = cloud.at(i).x;
    points[i].y = cloud.at(i).y;
    points[i].z = cloud.at(i).z;
  }
  return points;
}

template <class P, class Scalar>
std::vector<P> sample_with() {
  std::vector<P> points = sample_as<P>();
  for (std::size_t i = 0; i < count; ++i) points[i].intensity = intensity_at<Scalar>(i);
  return points;
}

}  // namespace

TEST_CASE("intensities: arrays of their own, of every type, packed and strided") {
  const TestCloud cloud = sample();
  const auto floats = intensities_as<float>();
  check_intensities<float>(ss::with_intensities(cloud.view(), floats.data()));
  const auto bytes = intensities_as<std::uint8_t>();
  check_intensities<std::uint8_t>(ss::with_intensities(cloud.view(), bytes.data()));
  const auto words = intensities_as<std::uint16_t>();
  check_intensities<std::uint16_t>(ss::with_intensities(cloud.view(), words.data()));
  const ss::CloudView colorless = ss::with_intensities(ss::view_xyz(cloud.xyz.data(), count), words.data());
  check_intensities<std::uint16_t>(colorless);
  CHECK(colorless.intensities.value == reinterpret_cast<const unsigned char*>(words.data()));  // nothing is copied

  std::vector<float> rows;  // x y z intensity, as files of KITTI have them
  for (std::size_t i = 0; i < count; ++i) {
    rows.insert(rows.end(), {cloud.at(i).x, cloud.at(i).y, cloud.at(i).z, floats[i]});
  }
  check_intensities<float>(ss::with_intensities(ss::view_xyz(rows.data(), count, 16), rows.data() + 3, 16));
}

TEST_CASE("intensities: a null pointer is no channel, and takes one away") {
  const TestCloud cloud = sample();
  const auto bytes = intensities_as<std::uint8_t>();
  CHECK_FALSE(ss::has_intensities(cloud.view()));
  const ss::CloudView with = ss::with_intensities(cloud.view(), bytes.data());
  const ss::CloudView without = ss::with_intensities(with, static_cast<const float*>(nullptr));
  CHECK(ss::has_intensities(with));
  CHECK_FALSE(ss::has_intensities(without));
  CHECK(ss::validate(without) == Status::ok);
  CHECK_FALSE(ss::keypoint(without, 0).has_intensity);
}

TEST_CASE("intensities: members of structs, shaped as those of PCL and of drivers of lidars") {
  const auto velodyne = sample_with<VelodynePoint, std::uint8_t>();
  check_intensities<std::uint8_t>(ss::view_of(velodyne.data(), count));
  const auto ouster = sample_with<OusterPoint, std::uint16_t>();
  check_intensities<std::uint16_t>(ss::view_of(ouster));
  CHECK(ss::view_of(ouster).intensities.stride_bytes == sizeof(OusterPoint));

  PclCloud cloud{sample_with<PclPoint, float>(), 25, 12};
  check_intensities<float>(ss::view_of(cloud));
  CHECK(ss::view_of(cloud).height == 12);
  CHECK_FALSE(ss::has_colors(ss::view_of(cloud)));
}

TEST_CASE("intensities: beside colors and normals") {
  std::vector<ColoredEcho> points = sample_with<ColoredEcho, float>();
  const TestCloud cloud = sample();
  for (std::size_t i = 0; i < count; ++i) {
    points[i].r = cloud.color_at(i).r;
    points[i].g = cloud.color_at(i).g;
    points[i].b = cloud.color_at(i).b;
    points[i].normal_x = static_cast<float>(i);
  }
  const ss::CloudView view = ss::view_of(points);
  check_intensities<float>(view);
  REQUIRE(ss::has_colors(view));
  REQUIRE(ss::has_normals(view));
  CHECK(ss::normal(view, 7).x == 7.0f);
  PclCloud unlit{sample_with<PclPoint, float>(), count, 1};
  check_intensities<float>(ss::view_of(unlit, points));  // normals in a container of their own
}

TEST_CASE("intensities: members of another type are none, and so are those at a null pointer") {
  CHECK_FALSE(ss::has_intensities(ss::view_of(sample_as<DoubleEcho>().data(), count)));
  CHECK_FALSE(ss::has_intensities(ss::view_of(sample_as<SignedEcho>().data(), count)));
  CHECK_FALSE(ss::has_intensities(ss::view_of(sample_as<NoEcho>().data(), count)));
  const PclPoint* nowhere = nullptr;
  CHECK_FALSE(ss::has_intensities(ss::view_of(nowhere, 5)));
  CHECK(ss::validate(ss::view_of(nowhere, 5)) == Status::bad_view);
}

}  // namespace test_views_intensities
