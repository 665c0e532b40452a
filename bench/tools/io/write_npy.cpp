#include "write_npy.hpp"

#include "binary_file.hpp"

namespace shortshot_bench {
namespace {

// Version 1.0 of the format; the spaces align the data to 64 bytes, for memory mapping.
std::string npy_header(std::size_t rows, std::size_t columns) {
  constexpr std::size_t alignment_bytes = 64;
  constexpr std::size_t preamble_bytes = 10;  // magic, version and the length below
  std::string text = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                     std::to_string(columns) + "), }";
  while ((preamble_bytes + text.size() + 1) % alignment_bytes != 0) text += ' ';
  text += '\n';
  std::string preamble("\x93NUMPY\x01\x00", 8);
  preamble += static_cast<char>(text.size() & 0xffU);
  preamble += static_cast<char>((text.size() >> 8) & 0xffU);
  return preamble + text;
}

}  // namespace

void write_npy(const std::string& path, const float* data, std::size_t rows, std::size_t columns) {
  BinaryFile file(path);
  file.write(npy_header(rows, columns));
  file.write_floats(data, rows * columns);
  file.close();
}

}  // namespace shortshot_bench
