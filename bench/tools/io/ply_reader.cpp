#include "ply_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "lower_case.hpp"
#include "make_cloud.hpp"
#include "ply_header.hpp"
#include "ply_values.hpp"
#include "point_table.hpp"
#include "range_grid.hpp"
#include "scalar_type.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

bool is_called(const PlyElement& element, const char* name) { return lower_case(element.name) == name; }

bool is_range_grid(const PlyElement& element) {
  return is_called(element, "range_grid") && element.properties.size() == 1 && element.properties[0].is_list;
}

PointTable table_of(const ByteSource& source, const PlyElement& vertices, bool is_text) {
  PointTable table;
  table.width = static_cast<std::size_t>(vertices.count);
  for (const PlyProperty& property : vertices.properties) {
    Channel channel;
    channel.name = property.name;
    channel.type = property.type;
    channel.count = property.is_list ? 0 : 1;
    channel.is_text = is_text;
    table.channels.push_back(channel);
  }
  assign_roles(table, source.path(), vertices.line, "property", " in element 'vertex'");
  return table;
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

void read_vertices(PlyTextValues& values, ByteSource&, const PlyElement& vertices, PointTable& table) {
  std::vector<Channel*> used;
  for (Channel& channel : table.channels) {
    if (table.uses(channel)) used.push_back(&channel);
  }
  table.own_values.resize(used.size() * table.size());
  double* out = table.own_values.data();
  for (std::size_t point = 0; point < table.size(); ++point) {
    values.begin_row(vertices, point);
    for (std::size_t i = 0; i < table.channels.size(); ++i) {
      if (table.uses(table.channels[i])) {
        *out++ = values.read(vertices.properties[i]);
      } else {
        values.skip(vertices.properties[i]);
      }
    }
    values.end_row();
  }
  set_text_columns(table, used);
}

// With lists among them vertices are of many sizes: all but the lists is copied.
const char* bytes_without_lists(PlyBinaryValues& values, const PlyElement& vertices, PointTable& table) {
  for (std::size_t point = 0; point < table.size(); ++point) {
    for (const PlyProperty& property : vertices.properties) {
      if (property.is_list) {
        values.skip(property);
      } else {
        const std::string_view bytes = values.read_bytes(property);
        table.own_bytes.insert(table.own_bytes.end(), bytes.begin(), bytes.end());
      }
    }
  }
  return table.own_bytes.data();
}

void read_vertices(PlyBinaryValues& values, ByteSource& source, const PlyElement& vertices, PointTable& table) {
  bool has_lists = false;
  std::size_t row_bytes = 0;
  for (const PlyProperty& property : vertices.properties) {
    has_lists = has_lists || property.is_list;
    if (!property.is_list) row_bytes += property.type.size_bytes;
  }
  const char* const first = has_lists ? bytes_without_lists(values, vertices, table)
                                      : source.take(vertices.count * row_bytes, "vertices").data();
  std::size_t offset = 0;
  for (std::size_t i = 0; i < table.channels.size(); ++i) {
    const PlyProperty& property = vertices.properties[i];
    if (property.is_list) continue;
    table.channels[i].values = {first + offset, row_bytes, property.type, values.order()};
    offset += property.type.size_bytes;
  }
}

// Whether the file is organized like the scanner's image, and how.
struct Grid {
  RangeGrid cells;
  bool is_given = false;
};

RgbdCloud organized(RgbdCloud cloud, const PlyHeader& header, const Grid& grid) {
  const std::uint64_t cells = header.columns * header.rows;  // of 32 bits each
  const auto width = static_cast<std::size_t>(header.columns);
  const auto height = static_cast<std::size_t>(header.rows);
  if (grid.is_given && cells != 0 && cells == grid.cells.size()) return arranged(cloud, grid.cells, width, height);
  if (grid.is_given) {
    cloud.notes.push_back("its range grid of " + std::to_string(grid.cells.size()) +
                          " cells is ignored: obj_info num_cols and num_rows do not say that many");
  } else if (cells != 0 && cells == cloud.size() && height > 1) {
    cloud.width = width;
    cloud.height = height;
    cloud.notes.push_back("organized by obj_info, " + std::to_string(width) + " x " + std::to_string(height));
  }
  return cloud;
}

template <typename Values>
RgbdCloud read_body(Values values, ByteSource& source, const PlyHeader& header) {
  const auto vertices = std::find_if(header.elements.begin(), header.elements.end(),
                                     [](const PlyElement& element) { return is_called(element, "vertex"); });
  if (vertices == header.elements.end()) {
    throw source.line_error("expected an element 'vertex' before end_header, found none");
  }
  const auto range_grid = std::find_if(header.elements.begin(), header.elements.end(), is_range_grid);
  PointTable table = table_of(source, *vertices, std::is_same_v<Values, PlyTextValues>);
  Grid grid;
  std::string ignored;
  const auto last = range_grid == header.elements.end() ? vertices : std::max(vertices, range_grid);
  for (auto element = header.elements.begin(); element != header.elements.end(); ++element) {
    if (element == vertices) {
      values.expect_room_for_rows(*vertices);
      read_vertices(values, source, *vertices, table);
    } else if (element == range_grid) {
      grid = {read_range_grid(values, *element, static_cast<std::size_t>(vertices->count)), true};
    } else {
      if (element < last) skip_element(values, *element);
      if (element->count == 0 || element->properties.empty()) continue;
      ignored += ignored.empty() ? "elements " : ", ";
      ignored += std::string(element->name) + " (" + std::to_string(element->count) + ")";
    }
  }
  if (!ignored.empty()) table.unused.push_back(ignored);
  if (last + 1 == header.elements.end()) note_rest_of_file(source, table);
  return organized(make_cloud(table), header, grid);
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
