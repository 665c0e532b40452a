// Views of PointCloud2-shaped messages: fields at any offset of any step, and everything that cannot be read refused.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "point_cloud2_message.hpp"

namespace test_views_point_cloud2 {
namespace {

using namespace unit;
using ss::Status;

using Message = CloudMessage;
using Field = CloudMessage::Field;

constexpr std::uint32_t count = 60;

TestCloud sample() { return curved_surface(1, count); }

/// The sample with its fields at odd places: most floats are not aligned.
Message message(const std::string& color = "rgb", std::uint8_t color_type = float32) {
  const TestCloud cloud = sample();
  Message m;
  m.width = count;
  m.point_step = 23;
  m.row_step = m.width * m.point_step;
  m.fields = {{"intensity", 0, uint8, 1},
              {"y", 1, float32, 1},
              {"x", 7, float32, 1},
              {color, 12, color_type, 1},
              {"z", 19, float32, 1}};
  m.data.assign(m.row_step, 0xEE);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t* at = m.data.data() + i * m.point_step;
    const ss::Point p = cloud.at(i);
    const ss::Rgb c = cloud.color_at(i);
    const std::uint32_t packed = 0xFF000000u | std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b;
    std::memcpy(at + 1, &p.y, 4);
    std::memcpy(at + 7, &p.x, 4);
    std::memcpy(at + 12, &packed, 4);
    std::memcpy(at + 19, &p.z, 4);
  }
  return m;
}

/// Refused, with nothing left of what was in the view, or ok.
Status view_of(const Message& m) {
  ss::CloudView view = sample().view();  // something that must not survive a refusal
  const Status status = ss::view_point_cloud2(m, view);
  if (status != Status::ok) CHECK(view.points.x == nullptr);
  if (status != Status::ok) CHECK(view.size == 0);
  return status;
}

void check_reads_as_sample(const Message& m, bool colors = true, Status status = Status::ok) {
  const TestCloud cloud = sample();
  ss::CloudView view{};
  REQUIRE(ss::view_point_cloud2(m, view) == status);
  REQUIRE(ss::validate(view) == Status::ok);
  REQUIRE(view.size == cloud.size());
  REQUIRE(ss::has_colors(view) == colors);
  CHECK(view.width == m.width);
  CHECK(view.height == m.height);
  CHECK(view.points.x == m.data.data() + 7);  // nothing is copied
  require_same_points(view, cloud, colors);
  std::vector<float> out = garbage<ss::Ssh32>(), expected = garbage<ss::Ssh32>();
  static ss::Workspace<count> workspace;
  REQUIRE(ss::describe_at<ss::Ssh32>(view, ss::BruteSearch{view}, 3, 1.0f, workspace, out.data()) == Status::ok);
  REQUIRE(ss::describe_at<ss::Ssh32>(cloud.view(), ss::BruteSearch{cloud.view()}, 3, 1.0f, workspace,
                                     expected.data()) == Status::ok);
  CHECK(same_bits(out, expected));
}

}  // namespace

TEST_CASE("PointCloud2: unaligned fields in any order, colors packed into a float or an integer") {
  check_reads_as_sample(message());
  check_reads_as_sample(message("rgba", uint32));
  check_reads_as_sample(message("rgb", uint32));
}

TEST_CASE("PointCloud2: an image keeps its width and height") {
  Message image = message();
  image.width = 12;
  image.height = 5;
  image.row_step = image.width * image.point_step;
  check_reads_as_sample(image);
}

TEST_CASE("PointCloud2: a cloud without colors, or with colors of another type, has points only") {
  check_reads_as_sample(message("temperature"), false);
  Message m = message("rgb", uint8);
  check_reads_as_sample(m, false, Status::unread_channel);
  CHECK(ss::point_cloud2_channels(m).colors == Status::unread_channel);
}

TEST_CASE("PointCloud2: coordinates of another type, missing ones and fields outside the point are refused") {
  for (const std::size_t field : {1u, 2u, 4u}) {
    Message m = message();
    m.fields[field].datatype = uint32;
    CHECK(view_of(m) == Status::needs_conversion);
    m.fields[field].datatype = 9;
    CHECK(view_of(m) == Status::bad_field);
    m = message();
    m.fields[field].count = 0;
    check_reads_as_sample(m);  // it means 1
    m = message();
    m.fields[field].name = "w";
    CHECK(view_of(m) == Status::no_coordinates);
    for (const std::uint32_t offset : {20u, 23u, 0xFFFFFFFCu, 0xFFFFFFFFu}) {
      m = message();
      m.fields[field].offset = offset;
      CHECK(view_of(m) == Status::field_outside);
    }
  }
  CHECK(view_of(Message{}) == Status::no_coordinates);
}

TEST_CASE("PointCloud2: a message whose colors lie outside the point is refused") {
  Message m = message();
  m.fields[3].offset = 20;
  CHECK(view_of(m) == Status::field_outside);
  CHECK(ss::point_cloud2_channels(m).colors == Status::field_outside);
  m.fields.push_back({"rgba", 12, float32, 1});
  CHECK(view_of(m) == Status::field_outside);
}

TEST_CASE("PointCloud2: normals are three fields of their own, or none") {
  Message m = message();
  m.fields.insert(m.fields.end(),
                  {{"normal_x", 1, float32, 1}, {"normal_z", 7, float32, 1}, {"normal_y", 19, float32, 1}});
  ss::CloudView view{};
  REQUIRE(ss::view_point_cloud2(m, view) == Status::ok);
  REQUIRE(ss::has_normals(view));
  for (std::size_t i = 0; i < count; ++i) {
    const ss::Point n = ss::extend::read(view.normals, i);
    const ss::Point p = sample().at(i);
    REQUIRE((n.x == p.y && n.y == p.z && n.z == p.x));
  }
  check_reads_as_sample(m);
  for (const std::size_t field : {5u, 6u, 7u}) {
    Message other = m;
    for (const Field& broken : {Field{"normal", 1, float32, 1}, Field{m.fields[field].name, 1, float64, 1},
                                Field{m.fields[field].name, 1, float32, 2}}) {
      other.fields[field] = broken;
      REQUIRE(ss::view_point_cloud2(other, view) == Status::unread_channel);
      CHECK_FALSE(ss::has_normals(view));
    }
    other.fields[field] = {m.fields[field].name, 20, float32, 1};
    CHECK(view_of(other) == Status::field_outside);
  }
}

TEST_CASE("PointCloud2: intensities are floats, bytes or whole numbers of 16 bits, at any offset inside the point") {
  const TestCloud cloud = sample();
  Message m = message();
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t* at = m.data.data() + i * m.point_step;
    const auto word = static_cast<std::uint16_t>(1000 * i);
    at[0] = static_cast<std::uint8_t>(4 * i);
    std::memcpy(at + 5, &word, 2);
  }
  const auto read = [&](std::uint8_t type, std::uint32_t offset, std::size_t i) {
    m.fields[0] = {"intensity", offset, type, 1};
    ss::CloudView view{};
    REQUIRE(ss::view_point_cloud2(m, view) == Status::ok);
    REQUIRE(ss::has_intensities(view));
    CHECK(ss::validate(view) == Status::ok);
    return ss::intensity(view, i);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto word = static_cast<std::uint16_t>(1000 * i);
    CHECK(read(uint8, 0, i) == static_cast<float>(4 * i % 256));
    CHECK(read(uint8, 22, i) == static_cast<float>(m.data[i * m.point_step + 22]));  // the last byte of z
    CHECK(read(uint16, 5, i) == static_cast<float>(word));
    CHECK(read(float32, 7, i) == cloud.at(i).x);
    CHECK(read(float32, 19, i) == cloud.at(i).z);
  }
}

TEST_CASE("PointCloud2: a cloud without intensities, with ones of another type or outside the point, has none") {
  const auto reading = [](const Field& field) {
    Message m = message();
    m.fields[0] = field;
    ss::CloudView view{};
    const Status status = ss::view_point_cloud2(m, view);
    if (status == Status::field_outside) return status;
    const Status expected =
        ss::has_intensities(view) || field.name != "intensity" ? Status::ok : Status::unread_channel;
    CHECK(status == expected);
    if (!ss::has_intensities(view)) CHECK_FALSE(ss::keypoint(view, 0).has_intensity);
    check_reads_as_sample(m, true, status);  // the rest of the cloud is as good as ever
    return ss::has_intensities(view) ? Status::ok : ss::point_cloud2_channels(m).intensities;
  };
  CHECK(reading({"intensity", 0, uint8, 1}) == Status::ok);
  CHECK(reading({"i", 0, uint8, 1}) == Status::missing_intensities);
  CHECK(reading({"reflectivity", 0, uint16, 1}) == Status::missing_intensities);
  CHECK(reading({"intensity", 0, uint8, 2}) == Status::unread_channel);
  for (const int type : {0, 9, 255}) {
    CHECK(reading({"intensity", 0, static_cast<std::uint8_t>(type), 1}) == Status::unread_channel);
  }
  for (const int type : {1, 3, 5, 6, 8}) {
    CHECK(reading({"intensity", 0, static_cast<std::uint8_t>(type), 1}) == Status::needs_conversion);
  }
  for (const std::uint32_t beyond : {1u, 2u, 4u, 0xFFFFFFFFu - 22u}) {
    CAPTURE(beyond);
    CHECK(reading({"intensity", 22u + beyond, uint8, 1}) == Status::field_outside);
    CHECK(reading({"intensity", 21u + beyond, uint16, 1}) == Status::field_outside);
    CHECK(reading({"intensity", 19u + beyond, float32, 1}) == Status::field_outside);
  }
}

TEST_CASE("PointCloud2: a step of zero and steps shorter than the fields are refused") {
  for (const std::uint32_t step : {0u, 3u, 22u}) {
    Message m = message();
    m.point_step = step;
    m.row_step = step * m.width;
    CHECK(view_of(m) == (step == 0 ? Status::no_point_step : Status::field_outside));
  }
}

TEST_CASE("PointCloud2: data one byte short, or sizes whose product overflows, are refused") {
  Message m = message();
  m.data.pop_back();
  CHECK(view_of(m) == Status::short_data);
  m.data.clear();
  CHECK(view_of(m) == Status::short_data);
  m = message();
  m.width = 0xFFFFFFFFu;
  CHECK(view_of(m) == Status::short_data);
  m.height = 0xFFFFFFFFu;
  CHECK(view_of(m) == Status::too_many_points);
  m.row_step = 0xFFFFFFFFu;
  CHECK(view_of(m) == Status::too_many_points);
  m.width = m.height = 0x10000u;  // a product of 2^32
  CHECK(view_of(m) == Status::too_many_points);
}

TEST_CASE("PointCloud2: padded rows are refused, padding after the only row is not") {
  Message image = message();
  image.width = 12;
  image.height = 5;
  image.row_step = image.width * image.point_step + 1;
  image.data.resize(image.data.size() + 5);
  CHECK(view_of(image) == Status::padded_rows);
  Message row = message();
  row.row_step += 1;
  row.data.push_back(0);
  check_reads_as_sample(row);
}

TEST_CASE("PointCloud2: the other byte order is refused") {
  Message m = message();
  m.is_bigendian = true;  // (on a big-endian machine this whole file's messages would have to be)
  CHECK(view_of(m) == Status::other_byte_order);
}

TEST_CASE("PointCloud2: no points are an empty cloud") {
  Message m = message();
  m.width = 0;
  CHECK(view_of(m) == Status::empty_cloud);
  m = message();
  m.height = 0;
  CHECK(view_of(m) == Status::empty_cloud);
}

}  // namespace test_views_point_cloud2
