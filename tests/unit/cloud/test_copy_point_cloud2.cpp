// PointCloud2 as drivers send it: what is viewed, what is copied, what is refused, and what is said of it.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "point_cloud2_message.hpp"

namespace test_copy_point_cloud2 {
namespace {

using namespace unit;
using ss::Status;
using Fields = std::vector<CloudMessage::Field>;

struct Expected {
  Status viewed = Status::ok;
  Status copied = Status::ok;
  bool colors = false;
  bool normals = false;
  bool intensities = false;
};

/// Is the view all of what message_of() put into the message, and organized as it?
void check_contents(const ss::CloudView& view, const CloudMessage& m, const Expected& expected, Status channels) {
  const bool has_all = channels == Status::ok;
  REQUIRE(ss::validate(view) == Status::ok);
  REQUIRE(view.size == std::size_t{m.width} * m.height);
  CHECK(view.width == m.width);
  CHECK(view.height == m.height);
  CHECK(ss::has_colors(view) == expected.colors);
  if (has_all) CHECK(ss::has_normals(view) == expected.normals);
  if (has_all) CHECK(ss::has_intensities(view) == expected.intensities);
  for (std::size_t i = 0; i < view.size; ++i) {
    const std::size_t column = i % m.width;
    const ss::Point p = ss::point(view, i);
    REQUIRE(p.x == static_cast<float>(column));
    REQUIRE(p.y == static_cast<float>(i / m.width));
    REQUIRE(p.z == 1.0f);
    if (ss::has_colors(view)) {
      const ss::Rgb c = ss::color(view, i);
      REQUIRE((c.r == red_at(column) && c.g == green_at(column) && c.b == blue));
    }
    if (ss::has_normals(view)) REQUIRE((ss::normal(view, i).x == 0.0f && ss::normal(view, i).z == 1.0f));
    if (ss::has_intensities(view)) REQUIRE(ss::intensity(view, i) == static_cast<float>(column));
  }
}

ss::CloudView something() {  // must not survive
  static const float xyz[3] = {};
  return ss::view_xyz_rgb(xyz, reinterpret_cast<const std::uint8_t*>(xyz), 1);
}

void check(const char* name, const CloudMessage& m, const Expected& expected) {
  CAPTURE(name);
  ss::CloudView view = something();
  CHECK(ss::view_point_cloud2(m, view) == expected.viewed);
  const bool viewed = expected.viewed == Status::ok || expected.viewed == Status::unread_channel;
  if (viewed) check_contents(view, m, expected, expected.viewed);
  if (!viewed) CHECK((view.size == 0 && view.points.x == nullptr && !ss::has_colors(view)));
  static ss::CloudCopy copy;  // with whatever the message before has left
  view = something();
  CHECK(ss::copy_point_cloud2(m, copy, view) == expected.copied);
  const bool copied = expected.copied == Status::ok || expected.copied == Status::unread_channel;
  if (copied) check_contents(view, m, expected, expected.copied);
  if (!copied) CHECK((view.size == 0 && view.points.x == nullptr && copy.xyz.empty() && copy.rgb.empty()));
}

CloudMessage changed(CloudMessage m, void (*change)(CloudMessage&)) {
  change(m);
  return m;
}

const Fields rgb_at_16 = floats_xyz_and({{"rgb", 16, float32, 1}});
const Fields normals_at_16 =
    floats_xyz_and({{"normal_x", 16, float32, 1}, {"normal_y", 20, float32, 1}, {"normal_z", 24, float32, 1}});

}  // namespace

TEST_CASE("PointCloud2 of drivers: read in place") {
  const Expected colored{Status::ok, Status::ok, true};
  const Expected plain;
  check("depth_image_proc: a step of 32 bytes", message_of(rgb_at_16, 32, 40, 30), colored);
  check("a simulator's camera: a step of 24", message_of(rgb_at_16, 24, 40, 30), colored);
  check("a step of 16", message_of(floats_xyz_and({{"rgb", 12, float32, 1}}), 16, 120, 1), colored);
  check("rgba in a float, and a field that nobody knows",
        message_of(floats_xyz_and({{"rgba", 12, float32, 1}, {"snr", 16, float32, 1}}), 20, 40, 30), colored);
  check("a lidar's unaligned step",
        message_of(floats_xyz_and({{"intensity", 12, float32, 1}, {"ring", 16, uint16, 1}, {"time", 18, float32, 1}}),
                   22, 45, 1),
        {Status::ok, Status::ok, false, false, true});
  constexpr const char* separate[][3] = {
      {"r", "g", "b"}, {"red", "green", "blue"}, {"R", "G", "B"}, {"Red", "Green", "Blue"}};
  for (const auto& names : separate) {
    check(names[0],
          message_of(floats_xyz_and({{names[0], 12, uint8, 1}, {names[1], 13, uint8, 1}, {names[2], 14, uint8, 1}}), 16,
                     100, 1),
          colored);
  }
  check("rgb of three bytes", message_of(floats_xyz_and({{"rgb", 12, uint8, 3}}), 16, 100, 1), colored);
  for (const std::uint8_t type : {int32, uint32, float32}) {
    check("rgb in 32 bits", message_of(floats_xyz_and({{"rgb", 12, type, 1}}), 16, 100, 1), colored);
    check("rgba in 32 bits", message_of(floats_xyz_and({{"rgba", 12, type, 1}}), 16, 100, 1), colored);
  }
  check("row_step 0", changed(message_of(rgb_at_16, 32, 40, 30), [](auto& m) { m.row_step = 0; }), colored);
  check("row_step 0 of one row", changed(message_of(floats_xyz, 16, 120, 1), [](auto& m) { m.row_step = 0; }), plain);
  check("row_step of all data", changed(message_of(floats_xyz, 16, 40, 30), [](auto& m) { m.row_step *= 30; }), plain);
  check("row_step of width alone", changed(message_of(floats_xyz, 16, 40, 30), [](auto& m) { m.row_step = 40; }),
        plain);
  check("fields in another order",
        message_of({{"x", 0, float32, 1}, {"z", 8, float32, 1}, {"y", 4, float32, 1}}, 16, 40, 30), plain);
  check("X Y Z", message_of({{"X", 0, float32, 1}, {"Y", 4, float32, 1}, {"Z", 8, float32, 1}}, 16, 40, 30), plain);
  const Expected with_normals{Status::ok, Status::ok, false, true};
  check("PointNormal", message_of(normals_at_16, 32, 40, 30), with_normals);
  check(
      "nx ny nz",
      message_of(floats_xyz_and({{"nx", 16, float32, 1}, {"ny", 20, float32, 1}, {"nz", 24, float32, 1}}), 32, 40, 30),
      with_normals);
}

TEST_CASE("PointCloud2 of drivers: copied") {
  const Expected doubles{Status::needs_conversion, Status::ok};
  for (const std::uint8_t type : {int8, uint8, int16, uint16, int32, uint32, float64}) {
    check("coordinates of another type",
          message_of({{"x", 0, type, 1}, {"y", 8, type, 1}, {"z", 16, type, 1}}, 24, 100, 2), doubles);
  }
  check("padded rows", message_of(rgb_at_16, 32, 40, 30, 1400), {Status::padded_rows, Status::ok, true});
  check("the last row is not padded",
        changed(message_of(floats_xyz, 16, 40, 30, 704), [](auto& m) { m.data.resize(29 * 704 + 640); }),
        {Status::padded_rows, Status::ok});
  const Expected swapped{Status::other_byte_order, Status::ok, true, true, true};
  const auto fields = [](std::uint8_t type) {
    return floats_xyz_and({{"rgb", 12, type, 1},
                           {"nx", 16, float32, 1},
                           {"ny", 20, float32, 1},
                           {"nz", 24, float32, 1},
                           {"intensity", 28, uint16, 1}});
  };
  for (const std::uint8_t type : {int32, uint32, float32}) {
    check("the other byte order", message_of(fields(type), 30, 40, 30, 0, true), swapped);
    check("padded and the other byte order", message_of(fields(type), 30, 40, 30, 1201, true), swapped);
  }
  check("the other byte order of doubles",
        message_of({{"x", 1, float64, 1},
                    {"y", 9, float64, 1},
                    {"z", 17, float64, 1},
                    {"r", 25, uint8, 1},
                    {"g", 26, uint8, 1},
                    {"b", 0, uint8, 1}},
                   27, 9, 5, 0, true),
        {Status::other_byte_order, Status::ok, true});
  for (const std::uint8_t type : {int8, int16, int32, uint32, float64}) {
    check("an intensity of another type", message_of(floats_xyz_and({{"intensity", 13, type, 1}}), 21, 40, 2),
          {Status::unread_channel, Status::ok, false, false, true});
  }
  check("normals of doubles",
        message_of(floats_xyz_and({{"nx", 12, float64, 1}, {"ny", 20, float64, 1}, {"nz", 28, float64, 1}}), 36, 40, 2),
        {Status::unread_channel, Status::ok, false, true});
}

TEST_CASE("PointCloud2 of drivers: a channel that nobody reads is said, and the rest is there") {
  const auto fields = [](const char* r, const char* g, const char* b, std::uint8_t type) {
    return floats_xyz_and({{r, 12, type, 1}, {g, 20, type, 1}, {b, 28, type, 1}});
  };
  const Expected unread{Status::unread_channel, Status::unread_channel};
  const std::vector<Fields> cases{fields("r", "g", "b", uint16),
                                  fields("red", "green", "blue", float32),
                                  fields("r", "g", "blue", uint8),
                                  floats_xyz_and({{"rgb", 12, float64, 1}}),
                                  floats_xyz_and({{"rgb", 12, uint8, 1}}),
                                  floats_xyz_and({{"rgba", 12, uint8, 4}}),
                                  floats_xyz_and({{"rgb", 12, float32, 3}})};
  for (const Fields& f : cases) {
    const CloudMessage m = message_of(f, 36, 20, 3);
    check(f[3].name.c_str(), m, unread);
    CHECK(ss::point_cloud2_channels(m).coordinates == Status::ok);
    CHECK(ss::point_cloud2_channels(m).colors == Status::unread_channel);
    CHECK(ss::point_cloud2_channels(m).normals == Status::missing_normals);
    CHECK(ss::point_cloud2_channels(m).intensities == Status::missing_intensities);
  }
  const CloudMessage m =
      message_of(floats_xyz_and({{"nx", 12, int8, 1}, {"ny", 13, int8, 1}, {"nz", 14, int8, 1}}), 16, 9, 3);
  check("normals of bytes", m, unread);
  CHECK(ss::point_cloud2_channels(m).normals == Status::unread_channel);
  const Fields both =
      floats_xyz_and({{"rgb", 12, float64, 1}, {"r", 20, uint8, 1}, {"g", 21, uint8, 1}, {"b", 22, uint8, 1}});
  check("colors twice, one of them readable", message_of(both, 24, 20, 3), {Status::ok, Status::ok, true});
}

TEST_CASE("PointCloud2 of drivers: refused, each for a cause of its own") {
  const CloudMessage m = message_of(rgb_at_16, 32, 40, 30);
  const auto refused = [&](Status why, void (*change)(CloudMessage&)) {
    check(ss::message(why), changed(m, change), {why, why});
  };
  refused(Status::short_data, [](auto& c) { c.data.resize(100); });
  refused(Status::short_data, [](auto& c) { c.data.pop_back(); });
  refused(Status::short_data, [](auto& c) { c.row_step = 1400, c.data.resize(29 * 1400 + 1279); });
  refused(Status::empty_cloud, [](auto& c) { c.width = c.height = 0; });
  refused(Status::empty_cloud, [](auto& c) { c.width = c.point_step = 0, c.data.clear(); });
  refused(Status::no_point_step, [](auto& c) { c.point_step = 0; });
  refused(Status::short_rows, [](auto& c) { c.row_step = 1279, c.data.push_back(0); });
  refused(Status::too_many_points, [](auto& c) { c.width = c.height = 0xFFFFFFFFu; });
  refused(Status::no_coordinates, [](auto& c) { c.fields[2].name = "depth"; });
  refused(Status::bad_field, [](auto& c) { c.fields[0].count = 3; });
  for (const std::size_t field : {0u, 3u}) {
    for (const std::uint32_t offset : {29u, 0x7FFFFFFFu, 0xFFFFFFFCu, 0xFFFFFFFFu}) {
      CloudMessage other = m;
      other.fields[field].offset = offset;
      check("outside", other, {Status::field_outside, Status::field_outside});
    }
    CloudMessage other = m;
    other.fields[field].count = 0;
    check("count 0 means 1", other, {Status::ok, Status::ok, true});
    other.fields[field].count = 0xFFFFFFFFu;
    check("count 2^32 - 1", other, {Status::field_outside, Status::field_outside});
  }
}

TEST_CASE("PointCloud2 of drivers: numbers that no float has are NaN, others are rounded") {
  CloudMessage m = message_of({{"x", 0, float64, 1}, {"y", 8, float64, 1}, {"z", 16, float64, 1}}, 24, 1, 1);
  const auto read = [&](double x) {
    put(m, 0, x);
    ss::CloudCopy copy;
    ss::CloudView view{};
    REQUIRE(ss::copy_point_cloud2(m, copy, view) == Status::ok);
    return ss::point(view, 0).x;
  };
  constexpr double most = static_cast<double>(std::numeric_limits<float>::max());
  CHECK(read(0.1) == 0.1f);
  CHECK(read(16777217.0) == 16777216.0f);  // between two: the even one
  CHECK(read(16777219.0) == 16777220.0f);
  CHECK(read(1e-46) == 0.0f);
  Random random(8);
  for (int round = 0; round < 100000; ++round) {  // as the CPU rounds, down to the smallest
    const double x = std::ldexp(static_cast<double>(random.bits()) * 4294967296.0 + static_cast<double>(random.bits()),
                                static_cast<int>(random.below(300)) - 220);
    const float expected = static_cast<float>(x);
    if (!ss::extend::math::is_finite(expected)) continue;
    REQUIRE(read(x) == expected);
    REQUIRE(read(-x) == -expected);
  }
  CHECK(read(-most) == -std::numeric_limits<float>::max());
  for (const double x : {2.0 * most, -1e300, static_cast<double>(infinity), static_cast<double>(not_a_number)}) {
    CHECK_FALSE(ss::extend::math::is_finite(read(x)));
  }
}

TEST_CASE("PointCloud2 of anybody: whatever its numbers, nothing is read outside of its data") {
  // Messages whose sizes lie about 0 and about powers of 2, with data that is as long as they say or is not there.
  const std::uint32_t sizes[] = {0,      1,       2,          3,           12,          16,
                                 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000u, 0xFFFFFFFEu, 0xFFFFFFFFu};
  Random random(7);
  const auto any = [&] { return sizes[random.below(sizeof sizes / sizeof *sizes)]; };
  for (int round = 0; round < 20000; ++round) {
    CloudMessage m = message_of(rgb_at_16, 20, 3, 2);
    m.is_bigendian = random.below(2) == 1;
    for (std::uint32_t* const number : {&m.width, &m.height, &m.point_step, &m.row_step}) {
      if (random.below(3) == 0) *number = any();
    }
    for (CloudMessage::Field& field : m.fields) {
      if (random.below(6) == 0) field.offset = any();
      if (random.below(6) == 0) field.datatype = static_cast<std::uint8_t>(random.below(10));
      if (random.below(6) == 0) field.count = any();
    }
    m.data.resize(random.below(200));
    m.data.shrink_to_fit();
    ss::CloudView view{};
    ss::CloudCopy copy;
    static_cast<void>(static_cast<int>(ss::view_point_cloud2(m, view)));
    for (std::size_t i = 0; i < view.size; ++i) {
      if (ss::has_colors(view)) static_cast<void>(ss::color(view, i));
      const unsigned char* const end = m.data.data() + m.data.size();
      for (const unsigned char* at : {view.points.x, view.points.y, view.points.z}) {
        REQUIRE(at + i * view.points.stride_bytes + sizeof(float) <= end);
      }
    }
    static_cast<void>(static_cast<int>(ss::copy_point_cloud2(m, copy, view)));
    REQUIRE(copy.xyz.size() == 3 * view.size);
  }
}

}  // namespace test_copy_point_cloud2
