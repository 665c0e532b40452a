// For the tests of the cloud files: a small known cloud and simple writers of every format for it.
#pragma once

#include <lzf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/io/input_error.hpp"
#include "tools/io/read_cloud.hpp"

namespace cloud_file_test {

// Made new and removed with all files in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::random_device random;
    do {
      path_ = std::filesystem::temp_directory_path() / ("shortshot_clouds_" + std::to_string(random()));
    } while (!std::filesystem::create_directory(path_));
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error("cannot write the test file " + path);
}

inline std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

inline shortshot_bench::RgbdCloud read_from_bytes(const std::string& bytes) {
  const TemporaryDirectory directory;
  write_bytes(directory.file("cloud"), bytes);
  return shortshot_bench::read_cloud(directory.file("cloud"));
}

// The message of reading these bytes, with FILE for the path; "no error" when they can be read.
inline std::string error_of(const std::string& bytes) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("cloud");
  write_bytes(path, bytes);
  try {
    shortshot_bench::read_cloud(path);
  } catch (const shortshot_bench::InputError& error) {
    const std::string message = error.what();
    return message.rfind(path, 0) == 0 ? "FILE" + message.substr(path.size()) : message;
  }
  return "no error";
}

struct SamplePoint {
  std::array<float, 3> xyz;
  std::array<std::uint8_t, 3> rgb;
  std::uint16_t intensity;
};

// 3 columns, 2 rows; the values are exact in text, float and double.
inline std::vector<SamplePoint> sample_points() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  return {{{0.5F, -0.25F, 1.0F}, {255, 0, 1}, 12},
          {{0.125F, 2.0F, 1.5F}, {49, 29, 136}, 0},
          {{nan, nan, nan}, {0, 0, 0}, 7},
          {{-3.0F, 0.75F, 8.0F}, {7, 255, 128}, 65535},
          {{1e-3F, 1024.0F, 0.0F}, {255, 255, 255}, 256},
          {{-0.5F, -0.5F, 0.625F}, {1, 2, 3}, 129}};
}

// One value in both its forms.
struct Cell {
  std::string bytes;
  std::string text;
};

template <typename Value>
Cell cell(Value value, bool big_endian = false) {
  std::uint64_t bits = 0;
  if constexpr (sizeof(Value) == 1) {
    bits = static_cast<std::uint8_t>(value);
  } else if constexpr (sizeof(Value) == 2) {
    bits = static_cast<std::uint16_t>(value);
  } else if constexpr (sizeof(Value) == 4) {
    std::uint32_t same_bits = 0;
    std::memcpy(&same_bits, &value, sizeof value);
    bits = same_bits;
  } else {
    std::memcpy(&bits, &value, sizeof value);
  }
  Cell result;
  for (std::size_t i = 0; i < sizeof(Value); ++i) {
    const std::size_t byte = big_endian ? sizeof(Value) - 1 - i : i;
    result.bytes += static_cast<char>((bits >> (8 * byte)) & 0xffU);
  }
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<Value>::max_digits10) << +value;
  result.text = text.str();
  return result;
}

using Row = std::vector<Cell>;

inline Cell operator+(const Cell& first, const Cell& second) {
  return {first.bytes + second.bytes, first.text + " " + second.text};
}

// `color_type` is F, U or I. As F the colors have alpha 0, which makes them denormals in text; as U and I
// alpha 255, which makes the bytes a NaN if they are taken for a float.
inline Cell packed_color(const SamplePoint& point, char color_type) {
  const std::uint32_t color = (std::uint32_t{point.rgb[0]} << 16) | (std::uint32_t{point.rgb[1]} << 8) | point.rgb[2];
  if (color_type == 'U') return cell(color | 0xff000000U);
  std::int32_t as_integer = 0;
  float as_float = 0;
  const std::uint32_t opaque = color | 0xff000000U;
  std::memcpy(&as_integer, &opaque, sizeof opaque);
  std::memcpy(&as_float, &color, sizeof color);
  return color_type == 'I' ? cell(as_integer) : cell(as_float);
}

// `type` is F, U or I: a float, or a whole number of 2 or of 4 bytes.
inline Cell intensity_cell(const SamplePoint& point, char type) {
  if (type == 'U') return cell(point.intensity);
  return type == 'I' ? cell(std::int32_t{point.intensity}) : cell(static_cast<float>(point.intensity));
}

inline std::string joined_text(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    for (const Cell& value : row) text += (&value == &row.front() ? "" : " ") + value.text;
    text += "\n";
  }
  return text;
}

inline std::string joined_bytes(const std::vector<Row>& rows) {
  std::string bytes;
  for (const Row& row : rows) {
    for (const Cell& value : row) bytes += value.bytes;
  }
  return bytes;
}

inline std::string lzf_block(const std::string& plain) {
  std::string compressed(plain.size() + plain.size() / 16 + 64, '\0');
  compressed.resize(lzf_compress(plain.data(), static_cast<unsigned int>(plain.size()), compressed.data(),
                                 static_cast<unsigned int>(compressed.size())));
  return cell(static_cast<std::uint32_t>(compressed.size())).bytes +
         cell(static_cast<std::uint32_t>(plain.size())).bytes + compressed;
}

// The rows of a PCD file as DATA ascii, binary or binary_compressed wants them.
inline std::string pcd_body(const std::vector<Row>& rows, const std::string& data) {
  if (data == "ascii") return joined_text(rows);
  if (data == "binary") return joined_bytes(rows);
  std::vector<Row> columns(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
  }
  return lzf_block(joined_bytes(columns));
}

// The sample with fields of many sizes in an unusual order. `type` is F, U or I: that of colors and intensities.
inline std::string sample_pcd(const std::string& data, char type) {
  const std::string header = std::string("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n") +
                             "FIELDS label y x _ z rgb imX histogram intensity\nSIZE 2 8 4 1 4 4 8 4 " +
                             (type == 'U' ? "2" : "4") + "\nTYPE U F F U F " + type + " I F " + type +
                             "\nCOUNT 1 1 1 3 1 1 1 2 1\nWIDTH 3\nHEIGHT 2\n" +
                             "VIEWPOINT 0.5 -1 2 1 0 0 0\nPOINTS 6\nDATA " + data + "\n";
  std::vector<Row> rows;
  for (const SamplePoint& point : sample_points()) {
    const Cell padding = cell(std::uint8_t{7}) + cell(std::uint8_t{8}) + cell(std::uint8_t{9});
    rows.push_back({cell(std::uint16_t{9}), cell(static_cast<double>(point.xyz[1])), cell(point.xyz[0]), padding,
                    cell(point.xyz[2]), packed_color(point, type), cell(std::int64_t{-314}), cell(0.5F) + cell(0.25F),
                    intensity_cell(point, type)});
  }
  return header + pcd_body(rows, data);
}

// The sample with elements and lists around the values that count.
inline std::string sample_ply(const std::string& format) {
  const bool big = format == "binary_big_endian";
  const std::string header =
      "ply\nformat " + format + " 1.0\ncomment element vertex 99\nobj_info made by a test\n" +
      "element camera 2\nproperty float fov\nproperty list uchar short ids\nelement nothing 4000000000\n" +
      "element vertex 6\nproperty int label\nproperty double y\nproperty list ushort uint links\n" +
      "property float x\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n" +
      "property short last\nproperty ushort scalar_Intensity\nelement face 1\nproperty list uchar int "
      "vertex_indices\nend_header\n";
  std::vector<Row> rows{
      {cell(1.5F, big), cell(std::uint8_t{2}), cell(std::int16_t{-1}, big), cell(std::int16_t{5}, big)},
      {cell(2.5F, big), cell(std::uint8_t{0})}};
  for (const SamplePoint& point : sample_points()) {
    rows.push_back({cell(std::int32_t{-4}, big), cell(static_cast<double>(point.xyz[1]), big),
                    cell(std::uint16_t{1}, big), cell(std::uint32_t{77}, big), cell(point.xyz[0], big),
                    cell(point.xyz[2], big), cell(point.rgb[0]), cell(point.rgb[1]), cell(point.rgb[2]),
                    cell(std::int16_t{-2}, big), cell(point.intensity, big)});
  }
  rows.push_back(
      {cell(std::uint8_t{3}), cell(std::int32_t{0}, big), cell(std::int32_t{1}, big), cell(std::int32_t{2}, big)});
  return header + (format == "ascii" ? joined_text(rows) : joined_bytes(rows));
}

}  // namespace cloud_file_test
