// Private to the PLY reader: clouds that are organized like the scanner's image, by an element "range_grid".
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ply_header.hpp"
#include "rgbd_cloud.hpp"

namespace shortshot_bench {

/// For each cell, row by row, the vertex measured there, or no_vertex.
using RangeGrid = std::vector<std::size_t>;
constexpr std::size_t no_vertex = ~std::size_t{0};

/// Reads the rows of the element, whose one property is a list: of one vertex, or of none where nothing was measured.
/// Values is a class of ply_values.hpp. Throws InputError.
template <typename Values>
RangeGrid read_range_grid(Values& values, const PlyElement& element, std::size_t vertices) {
  values.expect_room_for_rows(element);
  const PlyProperty& list = element.properties.front();
  RangeGrid grid(static_cast<std::size_t>(element.count), no_vertex);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    values.begin_row(element, cell);
    const std::uint64_t length = values.read_length(list);
    if (length > 1) throw values.error("expected a list of one vertex or none for a cell of the range grid");
    if (length == 1) {
      const double vertex = values.read(list);
      if (!(vertex >= 0 && vertex < static_cast<double>(vertices))) {
        throw values.error("expected the index of one of " + std::to_string(vertices) +
                           " vertices in the range grid, found " + std::to_string(vertex));
      }
      grid[cell] = static_cast<std::size_t>(vertex);
    }
    values.end_row();
  }
  return grid;
}

/// The cloud with a point for each cell, NaN where nothing was measured. The grid has width * height cells.
RgbdCloud arranged(const RgbdCloud& cloud, const RangeGrid& grid, std::size_t width, std::size_t height);

}  // namespace shortshot_bench
