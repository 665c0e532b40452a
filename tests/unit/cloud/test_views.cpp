// Views borrow the user's own memory: whatever its layout, the same points and colors, and nothing copied.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "fixtures.hpp"

namespace test_views {
namespace {

using namespace unit;
using ss::Status;

constexpr std::size_t count = 400;

TestCloud sample() { return curved_surface(1, count); }

/// Reads every point and color through the view, and describes one, and expects the sample's own bits.
void check_reads_as_sample(const ss::CloudView& view, bool colors = true) {
  const TestCloud cloud = sample();
  REQUIRE(ss::validate(view) == Status::ok);
  REQUIRE(view.size == count);
  REQUIRE(ss::has_colors(view) == colors);
  CHECK(view.width * view.height == count);
  require_same_points(view, cloud, colors);
  static ss::Workspace<count> workspace;
  const auto describe = [&](const ss::CloudView& v, auto descriptor) {
    using D = decltype(descriptor);
    std::vector<float> out = garbage<D>();
    REQUIRE(ss::describe_at<D>(v, ss::GridSearch(v, 0.1f), 7, 0.1f, workspace, out.data()) == Status::ok);
    return out;
  };
  CHECK(same_bits(describe(view, ss::Ssh96{}), describe(cloud.view(), ss::Ssh96{})));
  if (colors) CHECK(same_bits(describe(view, ss::Scsh336{}), describe(cloud.view(), ss::Scsh336{})));
}

bool within(const void* p, const void* begin, std::size_t bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(p);
  const auto first = reinterpret_cast<std::uintptr_t>(begin);
  return address >= first && address < first + bytes;
}

struct Padded {  // colors as PCL orders them, padding, and members that nobody asked for
  double stamp;
  float z, y, x;
  std::uint8_t b, g, r, a;
  std::uint16_t ring;
};

struct Colorless {
  float x, y, z, intensity;
};

struct alignas(16) PclPoint {  // as pcl::PointXYZRGB: 32 bytes
  float x, y, z, one;
  union {
    struct {
      std::uint8_t b, g, r, a;
    };
    float rgb;
  };
};
static_assert(sizeof(PclPoint) == 32, "the layout of PCL");

struct PclCloud {
  std::vector<PclPoint> points;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

template <class P>
std::vector<P> sample_as() {
  const TestCloud cloud = sample();
  std::vector<P> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ss::Point p = cloud.at(i);
    points[i].x = p.x;
    points[i].y = p.y;
    points[i].z = p.z;
    if constexpr (std::is_same<P, Padded>::value || std::is_same<P, PclPoint>::value) {
      const ss::Rgb c = cloud.color_at(i);
      points[i].r = c.r;
      points[i].g = c.g;
      points[i].b = c.b;
    }
  }
  return points;
}

struct alignas(16) PclNormal {  // as pcl::Normal: 32 bytes
  union {
    float data_n[4];
    struct {
      float normal_x, normal_y, normal_z;
    };
  };
  float curvature;
};
static_assert(sizeof(PclNormal) == 32, "the layout of PCL");

struct PclNormals {
  std::vector<PclNormal> points;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

struct PointNormal {  // in no particular order
  float normal_z, x, y, z, normal_x, normal_y;
};

struct DoubleNormal {
  float x, y, z;
  double normal_x, normal_y, normal_z;
};

ss::Point normal_at(std::size_t i) { return {static_cast<float>(i), 0.5f, -static_cast<float>(i)}; }

template <class N>
void set_normals(std::vector<N>& structs) {
  for (std::size_t i = 0; i < structs.size(); ++i) {
    structs[i].normal_x = normal_at(i).x;
    structs[i].normal_y = normal_at(i).y;
    structs[i].normal_z = normal_at(i).z;
  }
}

void check_normals(const ss::CloudView& view) {
  REQUIRE(ss::validate(view) == Status::ok);
  REQUIRE(ss::has_normals(view));
  REQUIRE(view.size == count);
  for (std::size_t i = 0; i < count; ++i) {
    const ss::Point n = ss::extend::read(view.normals, i);
    REQUIRE((n.x == normal_at(i).x && n.y == normal_at(i).y && n.z == normal_at(i).z));
  }
}

template <class Arguments, class = void>
struct CanViewAll : std::false_type {};
template <class... Arguments>
struct CanViewAll<void(Arguments...), std::void_t<decltype(ss::view_of(std::declval<Arguments>()...))>>
    : std::true_type {};
template <class... Arguments>
using CanView = CanViewAll<void(Arguments...)>;

using Points = std::vector<Padded>;
static_assert(CanView<Points&>::value && CanView<const Points&>::value, "containers that live on can be viewed");
static_assert(!CanView<Points>::value && !CanView<const Points>::value, "containers that die cannot");
static_assert(CanView<PclCloud&>::value && !CanView<PclCloud>::value, "neither can clouds");
static_assert(CanView<PclCloud&, const PclNormals&>::value && CanView<Points&, PclNormals&>::value,
              "with normals, too");
static_assert(!CanView<PclCloud, PclNormals&>::value && !CanView<PclCloud&, PclNormals>::value &&
                  !CanView<const PclCloud, const PclNormals>::value,
              "and neither can normals");
static_assert(CanView<Padded*, int>::value, "a count of any type is no container");

}  // namespace

TEST_CASE("views: bare arrays, tightly packed, strided, and one after the other") {
  const TestCloud cloud = sample();
  check_reads_as_sample(cloud.view());
  check_reads_as_sample(ss::view_xyz(cloud.xyz.data(), count), false);
  CHECK(cloud.view().points.x == reinterpret_cast<const unsigned char*>(cloud.xyz.data()));
  CHECK(cloud.view().colors.b == cloud.rgb.data() + 2);

  std::vector<float> wide(count * 5, not_a_number);
  std::vector<std::uint8_t> wide_colors(count * 4, 77);
  std::vector<float> planes(count * 3);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      wide[5 * i + k] = cloud.xyz[3 * i + k];
      wide_colors[4 * i + k] = cloud.rgb[3 * i + k];
      planes[k * count + i] = cloud.xyz[3 * i + k];
    }
  }
  check_reads_as_sample(ss::view_xyz_rgb(wide.data(), wide_colors.data(), count, 20, 4));

  ss::CloudView separate = cloud.view();
  const auto* bytes = reinterpret_cast<const unsigned char*>(planes.data());
  separate.points = {bytes, bytes + 4 * count, bytes + 8 * count, 4};
  check_reads_as_sample(separate);
}

TEST_CASE("views: vectors, arrays and pointers of structs, members in any order") {
  const Points points = sample_as<Padded>();
  check_reads_as_sample(ss::view_of(points));
  check_reads_as_sample(ss::view_of(points.data(), points.size()));
  const ss::CloudView view = ss::view_of(points);
  CHECK(view.points.x == reinterpret_cast<const unsigned char*>(&points[0].x));
  CHECK(view.points.z == reinterpret_cast<const unsigned char*>(&points[0].z));
  CHECK(view.colors.r == &points[0].r);
  CHECK(view.points.stride_bytes == sizeof(Padded));
  CHECK(view.height == 1);

  const std::vector<Colorless> colorless = sample_as<Colorless>();
  check_reads_as_sample(ss::view_of(colorless), false);
  std::array<Padded, count> array{};
  std::copy(points.begin(), points.end(), array.begin());
  check_reads_as_sample(ss::view_of(array));
}

TEST_CASE("views: clouds shaped as PCL's, organized or not") {
  PclCloud cloud{sample_as<PclPoint>(), count, 1};
  check_reads_as_sample(ss::view_of(cloud));
  CHECK(ss::view_of(cloud).height == 1);
  cloud.width = 25;
  cloud.height = 16;
  check_reads_as_sample(ss::view_of(cloud));
  CHECK(ss::view_of(cloud).width == 25);
  CHECK(ss::view_of(cloud).height == 16);
  CHECK(within(ss::view_of(cloud).colors.r, cloud.points.data(), sizeof(PclPoint)));
  cloud.height = 17;  // no image: a plain list of points
  check_reads_as_sample(ss::view_of(cloud));
  CHECK(ss::view_of(cloud).height == 1);
}

TEST_CASE("views: normals among the members of a point, of type float") {
  std::vector<PointNormal> points = sample_as<PointNormal>();
  set_normals(points);
  check_normals(ss::view_of(points));
  check_reads_as_sample(ss::view_of(points), false);
  const std::vector<DoubleNormal> doubles = sample_as<DoubleNormal>();
  CHECK_FALSE(ss::has_normals(ss::view_of(doubles)));
  CHECK_FALSE(ss::has_normals(ss::view_of(sample_as<Padded>().data(), count)));
}

TEST_CASE("views: normals in a container of their own, shaped as PCL's cloud or not") {
  PclCloud cloud{sample_as<PclPoint>(), 25, 16};
  PclNormals normals{std::vector<PclNormal>(count), count, 1};  // an image's normals may be listed in one row
  set_normals(normals.points);
  check_normals(ss::view_of(cloud, normals));
  check_reads_as_sample(ss::view_of(cloud, normals));
  CHECK(ss::view_of(cloud, normals).height == 16);
  check_normals(ss::view_of(cloud, normals.points));
  std::vector<PointNormal> points = sample_as<PointNormal>();  // whose own normals are all zero
  check_normals(ss::view_of(points, normals));
}

TEST_CASE("views: normals for another number of points are refused") {
  const Points points = sample_as<Padded>(), one(1), none;
  const auto refused = [](const Points& p, std::size_t normals) {
    const std::vector<PclNormal> n(normals);
    return ss::validate(ss::view_of(p, n));
  };
  CHECK(refused(points, count) == Status::ok);
  CHECK(refused(points, count - 1) == Status::sizes_differ);
  CHECK(refused(points, 0) == Status::sizes_differ);
  CHECK(refused(one, 2) == Status::sizes_differ);
  CHECK(refused(none, 3) == Status::sizes_differ);
  CHECK(refused(none, 0) == Status::empty_cloud);
}

TEST_CASE("views: empty containers are empty clouds") {
  const Points empty;
  CHECK(ss::validate(ss::view_of(empty)) == Status::empty_cloud);
  CHECK(ss::validate(ss::view_of(static_cast<const Padded*>(nullptr), 0)) == Status::empty_cloud);
  const PclCloud none;
  CHECK(ss::validate(ss::view_of(none)) == Status::empty_cloud);
}

TEST_CASE("views: structs at a null pointer are a bad view") {
  const Padded* nowhere = nullptr;
  CHECK(ss::validate(ss::view_of(nowhere, 5)) == Status::bad_view);
}

TEST_CASE("views: organized() only names another width and height") {
  const TestCloud cloud = sample();
  const ss::CloudView view = ss::organized(cloud.view(), 20, 20);
  CHECK(view.width == 20);
  CHECK(view.height == 20);
  check_reads_as_sample(view);
}

}  // namespace test_views
