#include "ply_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ply_header.hpp"
#include "ply_values.hpp"
#include "scalar_type.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

// What a vertex property is to the cloud: x y z red green blue intensity, or nothing.
constexpr std::size_t role_count = 7;
constexpr std::size_t first_color_role = 3;
constexpr std::size_t intensity_role = 6;
constexpr std::size_t no_role = role_count;

struct VertexLayout {
  std::vector<std::size_t> roles;  // of each property
  std::array<bool, role_count> is_given{};
  bool has_color = false;

  bool has_intensity() const { return is_given[intensity_role]; }
};

std::size_t role_of_name(std::string_view name) {
  constexpr std::string_view diffuse = "diffuse_";
  constexpr std::array<std::string_view, intensity_role> names{"x", "y", "z", "red", "green", "blue"};
  constexpr std::array<std::string_view, 3> short_names{"r", "g", "b"};
  // CloudCompare puts "scalar_" before the names of its fields, and calls this one "Intensity".
  for (const char* const intensity : {"intensity", "scalar_intensity", "scalar_Intensity"}) {
    if (name == intensity) return intensity_role;
  }
  if (name.substr(0, diffuse.size()) == diffuse) name.remove_prefix(diffuse.size());
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const auto color = std::find(short_names.begin(), short_names.end(), name);
  if (color == short_names.end()) return no_role;
  return first_color_role + static_cast<std::size_t>(color - short_names.begin());
}

VertexLayout find_layout(const ByteSource& source, const PlyElement& vertices) {
  VertexLayout layout;
  for (const PlyProperty& property : vertices.properties) {
    std::size_t role = property.is_list ? no_role : role_of_name(property.name);
    if (role != no_role && layout.is_given[role]) role = no_role;  // of two of a name the first counts
    if (role != no_role) layout.is_given[role] = true;
    if (role < first_color_role && property.type.kind != ScalarKind::floating) {
      throw InputError::at_line(source.path(), vertices.line,
                                "expected type float or double for property " + quoted(property.name) +
                                    " of element 'vertex', found a whole number type");
    }
    layout.roles.push_back(role);
  }
  for (std::size_t axis = 0; axis < first_color_role; ++axis) {
    if (!layout.is_given[axis]) {
      throw InputError::at_line(source.path(), vertices.line,
                                std::string("expected a property ") + "xyz"[axis] + " in element 'vertex', found none");
    }
  }
  layout.has_color = std::all_of(layout.is_given.begin(), layout.is_given.begin() + intensity_role,
                                 [](bool is_given) { return is_given; });
  return layout;
}

// Floats are 0 to 1, 16-bit values 0 to 65535, all others 0 to 255; what is outside is clamped.
std::uint8_t to_color(double value, ScalarType type) {
  const bool is_wide = type.kind == ScalarKind::unsigned_integer && type.size_bytes == 2;
  if (type.kind == ScalarKind::floating) value *= 255;
  if (is_wide) value /= 257;   // 65535 / 255
  if (!(value > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
}

template <typename Values>
void skip_element(Values& values, const PlyElement& element) {
  if (element.properties.empty()) return;  // no bytes, however many rows it claims
  values.expect_room_for_rows(element);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    values.begin_row(element, row);
    for (const PlyProperty& property : element.properties) values.skip(property);
    values.end_row();
  }
}

template <typename Values>
RgbdCloud read_vertices(Values& values, const PlyElement& vertices, const VertexLayout& layout) {
  values.expect_room_for_rows(vertices);
  RgbdCloud cloud;
  cloud.width = static_cast<std::size_t>(vertices.count);
  cloud.height = 1;
  cloud.xyz.resize(3 * cloud.width);
  if (layout.has_color) cloud.rgb.resize(3 * cloud.width);
  if (layout.has_intensity()) cloud.intensity.resize(cloud.width);
  for (std::size_t point = 0; point < cloud.width; ++point) {
    values.begin_row(vertices, point);
    for (std::size_t i = 0; i < vertices.properties.size(); ++i) {
      const PlyProperty& property = vertices.properties[i];
      const std::size_t role = layout.roles[i];
      if (role < first_color_role) {
        cloud.xyz[3 * point + role] = to_float(values.read(property));
      } else if (role == intensity_role) {
        cloud.intensity[point] = to_float(values.read(property));
      } else if (role != no_role && layout.has_color) {
        cloud.rgb[3 * point + role - first_color_role] = to_color(values.read(property), property.type);
      } else {
        values.skip(property);
      }
    }
    values.end_row();
  }
  return cloud;
}

template <typename Values>
RgbdCloud read_body(Values values, const ByteSource& source, const PlyHeader& header) {
  const auto vertices = std::find_if(header.elements.begin(), header.elements.end(),
                                     [](const PlyElement& element) { return element.name == "vertex"; });
  if (vertices == header.elements.end()) {
    throw source.line_error("expected an element 'vertex' before end_header, found none");
  }
  const VertexLayout layout = find_layout(source, *vertices);
  for (auto element = header.elements.begin(); element != vertices; ++element) {
    skip_element(values, *element);
  }
  return read_vertices(values, *vertices, layout);
}

}  // namespace

RgbdCloud read_ply(ByteSource& source) {
  const PlyHeader header = read_ply_header(source);
  switch (header.format) {
    case PlyFormat::ascii: return read_body(PlyTextValues(source), source, header);
    case PlyFormat::binary_little_endian:
      return read_body(PlyBinaryValues(source, ByteOrder::little_endian), source, header);
    case PlyFormat::binary_big_endian: break;
  }
  return read_body(PlyBinaryValues(source, ByteOrder::big_endian), source, header);
}

}  // namespace shortshot_bench
