// The statuses of views that cannot be made.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "fixtures.hpp"

namespace unit {

struct TinyMessage {
  struct Field {
    std::string name;
    std::uint32_t offset;
    std::uint8_t datatype;
    std::uint32_t count = 1;
  };
  std::vector<Field> fields{{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}};
  std::vector<std::uint8_t> data = std::vector<std::uint8_t>(24);
  std::uint32_t width = 1, height = 2, point_step = 12, row_step = 12;
  bool is_bigendian = false;
};

inline std::set<ss::Status> reached_by_views() {
  const auto status_of = [](auto change) {
    TinyMessage message;
    change(message);
    ss::CloudView view{};
    return ss::view_point_cloud2(message, view);
  };
  struct PointOfFloats {
    float x, y, z;
  };
  struct NormalOfFloats {
    float normal_x, normal_y, normal_z;
  };
  const std::vector<PointOfFloats> points(2);
  const std::vector<NormalOfFloats> normals(1);
  return {status_of([](TinyMessage&) {}),
          status_of([](TinyMessage& m) { m.fields[1].name = "w"; }),
          status_of([](TinyMessage& m) { m.fields[1].offset = 9; }),
          status_of([](TinyMessage& m) { m.data.pop_back(); }),
          status_of([](TinyMessage& m) { m.row_step = 16, m.data.resize(28); }),
          status_of([](TinyMessage& m) { m.is_bigendian = true; }),
          status_of([](TinyMessage& m) { m.fields[0].datatype = 5; }),
          status_of([](TinyMessage& m) {
            m.fields.push_back({"rgb", 0, 8}), m.point_step = 12;
          }),
          status_of([](TinyMessage& m) { m.fields[0].datatype = 9; }),
          status_of([](TinyMessage& m) { m.fields[0].count = 0; }),
          status_of([](TinyMessage& m) { m.point_step = 0; }),
          status_of([](TinyMessage& m) { m.width = 0xFFFFFFFFu; }),
          status_of([](TinyMessage& m) { m.row_step = 11, m.data.push_back(0); }),
          ss::validate(ss::view_of(points, normals))};
}

}  // namespace unit
