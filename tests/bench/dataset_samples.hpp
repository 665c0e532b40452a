// For the tests of the data sets: small folders of their layouts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "cloud_file_samples.hpp"
#include "tools/io/input_error.hpp"

namespace dataset_test {

// A temporary folder to which files are added, in folders that come with them.
class Folder {
 public:
  void add(const std::string& file, const std::string& bytes) const {
    std::filesystem::create_directories(std::filesystem::path(path(file)).parent_path());
    cloud_file_test::write_bytes(path(file), bytes);
  }
  void remove(const std::string& file) const { std::filesystem::remove(path(file)); }
  std::string path() const { return directory_.file("set"); }
  std::string path(const std::string& file) const { return path() + "/" + file; }

 private:
  cloud_file_test::TemporaryDirectory directory_;
};

// A point on the x axis, to tell the clouds apart.
inline std::string pcd_at(float x, bool has_color = true) {
  const std::string header = "VERSION 0.7\nFIELDS x y z" + std::string(has_color ? " rgb" : "") + "\nSIZE 4 4 4" +
                             (has_color ? " 4" : "") + "\nTYPE F F F" + (has_color ? " U" : "") + "\nCOUNT 1 1 1" +
                             (has_color ? " 1" : "") + "\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n";
  return header + std::to_string(x) + " 0 1" + (has_color ? " 66051" : "") + "\n";  // 0x010203
}

inline std::string no_motion() { return "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"; }

// A quarter turn about z and a step along x.
inline std::string quarter_turn() { return "0 -1 0 0.5\r\n1 0 0 0\r\n0 0 1 0\r\n0 0 0 1\r\n"; }

// What an InputError says, with SET for the folder's path; anything else is no answer.
template <class Work>
std::string error_in(const Folder& folder, const Work& work) {
  try {
    work();
  } catch (const shortshot_bench::InputError& error) {
    const std::string message = error.what();
    return message.rfind(folder.path(), 0) == 0 ? "SET" + message.substr(folder.path().size()) : message;
  } catch (const std::exception& error) {
    return std::string("no InputError: ") + error.what();
  }
  return "no error";
}

inline std::string big_endian(std::uint32_t value) { return cloud_file_test::cell(value, true).bytes; }

enum class PngColor : char { gray = 0, rgb = 2 };

// The images are written here: stb_image_write has no PNG of 16 bits, and its JPEG shifts integers too far for the
// sanitizers.

// A PNG of these samples, not compressed. stb_image asks for no checksums: they are 0.
inline std::string png(const std::string& samples, std::size_t width, std::size_t height, char bits, PngColor color) {
  const auto chunk = [](const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(0);
  };
  const std::size_t row_bytes = samples.size() / height;
  std::string rows;
  for (std::size_t row = 0; row < height; ++row) {
    rows += '\0' + samples.substr(row * row_bytes, row_bytes);  // not filtered
  }
  std::string stored("\x78\x01", 2);
  constexpr std::size_t most = 65535;  // of a block that is not compressed
  for (std::size_t at = 0; at < rows.size(); at += most) {
    const std::string block = rows.substr(at, most);
    const auto length = static_cast<std::uint16_t>(block.size());
    const auto inverse = static_cast<std::uint16_t>(~length);
    stored += at + most < rows.size() ? '\0' : '\1';  // is it the last one?
    stored += cloud_file_test::cell(length).bytes + cloud_file_test::cell(inverse).bytes + block;
  }
  stored += big_endian(0);
  const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                             big_endian(static_cast<std::uint32_t>(height)) + bits + static_cast<char>(color) +
                             std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", stored) + chunk("IEND", "");
}

// As depth cameras write it: one channel of 16 bits.
inline std::string depth_png(const std::vector<std::uint16_t>& pixels, std::size_t width) {
  std::string samples;
  for (const std::uint16_t pixel : pixels) samples += cloud_file_test::cell(pixel, true).bytes;
  return png(samples, width, pixels.size() / width, 16, PngColor::gray);
}

// A JPEG of up to 8 x 8 pixels, all of gray 128: one block, whose coefficients are all 0.
inline std::string gray_jpeg(int width, int height) {
  const auto segment = [](char marker, const std::string& data) {
    const auto length = static_cast<std::uint16_t>(data.size() + 2);
    return std::string("\xff") + marker + cloud_file_test::cell(length, true).bytes + data;
  };
  const auto bytes = [](std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
  };
  const std::string only_zero = '\1' + std::string(16, '\0');  // a Huffman table: one code of one bit, for 0
  return "\xff\xd8" + segment('\xdb', '\0' + std::string(64, '\1')) +
         segment('\xc0', bytes({8, 0, height, 0, width, 1, 1, 0x11, 0})) + segment('\xc4', '\0' + only_zero) +
         segment('\xc4', '\x10' + only_zero) + segment('\xda', bytes({1, 1, 0, 0, 63, 0})) + "\x3f\xff\xd9";
}

}  // namespace dataset_test
