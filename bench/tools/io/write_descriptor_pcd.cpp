#include "write_descriptor_pcd.hpp"

#include <algorithm>
#include <stdexcept>

#include "binary_file.hpp"

namespace shortshot_bench {
namespace {

std::string pcd_header(std::size_t points, std::size_t size, const std::vector<std::string>& comments) {
  std::string header = "# .PCD v0.7 - Point Cloud Data file format\n";
  for (std::string comment : comments) {
    // A line break would end the comment and start a header entry.
    std::replace_if(
        comment.begin(), comment.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    header += "# " + comment + "\n";
  }
  const std::string point_count = std::to_string(points);
  return header + "VERSION 0.7\nFIELDS x y z descriptor\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 " +
         std::to_string(size) + "\nWIDTH " + point_count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         point_count + "\nDATA binary\n";
}

}  // namespace

void write_descriptor_pcd(const std::string& path, const std::vector<std::array<float, 3>>& positions,
                          const float* descriptors, std::size_t size, const std::vector<std::string>& comments) {
  if (size == 0) throw std::invalid_argument("write_descriptor_pcd: the descriptor size is 0");
  BinaryFile file(path);
  file.write(pcd_header(positions.size(), size, comments));
  for (std::size_t point = 0; point < positions.size(); ++point) {
    file.write_floats(positions[point].data(), 3);
    file.write_floats(descriptors + point * size, size);
  }
  file.close();
}

}  // namespace shortshot_bench
