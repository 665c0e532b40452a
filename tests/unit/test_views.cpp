// Views borrow the user's own memory: whatever its layout, the same points and colours, and nothing copied.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "fixtures.hpp"

namespace {

using namespace unit;
using ss::Status;

constexpr std::size_t count = 400;

TestCloud sample() { return curved_surface(1, count); }

/// Reads every point and colour through the view, and describes one, and expects the sample's own bits.
void check_reads_as_sample(const ss::CloudView& view, bool colors = true) {
  const TestCloud cloud = sample();
  REQUIRE(ss::check(view) == Status::ok);
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

struct Padded {  // colours as PCL orders them, padding, and members that nobody asked for
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
    if constexpr (!std::is_same<P, Colorless>::value) {
      const ss::Rgb c = cloud.color_at(i);
      points[i].r = c.r;
      points[i].g = c.g;
      points[i].b = c.b;
    }
  }
  return points;
}

template <class T, class = void>
struct CanView : std::false_type {};
template <class T>
struct CanView<T, std::void_t<decltype(ss::view_of(std::declval<T>()))>> : std::true_type {};

using Points = std::vector<Padded>;
static_assert(CanView<Points&>::value && CanView<const Points&>::value, "containers that live on can be viewed");
static_assert(!CanView<Points>::value && !CanView<const Points>::value, "containers that die cannot");
static_assert(CanView<PclCloud&>::value && !CanView<PclCloud>::value, "neither can clouds");

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

TEST_CASE("views: clouds shaped as PCL's, organised or not") {
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

TEST_CASE("views: empty containers are empty clouds") {
  const Points empty;
  CHECK(ss::check(ss::view_of(empty)) == Status::empty_cloud);
  CHECK(ss::check(ss::view_of(static_cast<const Padded*>(nullptr), 0)) == Status::empty_cloud);
  const PclCloud none;
  CHECK(ss::check(ss::view_of(none)) == Status::empty_cloud);
}

TEST_CASE("views: structs at a null pointer are a bad view") {
  const Padded* nowhere = nullptr;
  CHECK(ss::check(ss::view_of(nowhere, 5)) == Status::bad_view);
}

TEST_CASE("views: organized() only names another width and height") {
  const TestCloud cloud = sample();
  const ss::CloudView view = ss::organized(cloud.view(), 20, 20);
  CHECK(view.width == 20);
  CHECK(view.height == 20);
  check_reads_as_sample(view);
}
