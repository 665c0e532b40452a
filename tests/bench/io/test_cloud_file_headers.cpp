// Headers as editors, scanners and other programs leave them.
#include <doctest/doctest.h>

#include <cmath>

#include "cloud_file_samples.hpp"
#include "note_of.hpp"

namespace test_cloud_file_headers {

using cloud_file_test::cell;
using cloud_file_test::error_of;
using cloud_file_test::note_of;
using cloud_file_test::read_from_bytes;
using cloud_file_test::sample_pcd;
using cloud_file_test::sample_ply;
using shortshot_bench::RgbdCloud;
using Strings = std::vector<std::string>;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// A file's header with other line ends, and its body as it is.
std::string with_header_line_ends(const std::string& bytes, const std::string& last_line, const std::string& line_end) {
  const std::size_t body = bytes.find('\n', bytes.find(last_line)) + 1;
  return replaced(bytes.substr(0, body), "\n", line_end) + bytes.substr(body);
}

const std::string ply_header =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

}  // namespace

TEST_CASE("cloud headers: behind every line end the bytes begin where they should") {
  // Both kinds of first bytes that could be taken for a line end.
  for (const float x : {0.0F, -0.08F}) {
    const std::string body =
        (x == 0.0F ? std::string("\r\n\r?", 4) : cell(x).bytes) + cell(2.0F).bytes + cell(3.0F).bytes;
    float first = 0;
    std::memcpy(&first, body.data(), sizeof first);
    const std::string pcd = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA binary\n" + body;
    const std::string ply =
        replaced(replaced(ply_header, "vertex 3", "vertex 1"), "ascii", "binary_little_endian") + "end_header\n" + body;
    for (const char* line_end : {"\n", "\r\n", "\r", "\n\r", " \n", "\t\r\n", "\r\r\n"}) {
      CAPTURE(line_end);
      CHECK(read_from_bytes(with_header_line_ends(pcd, "DATA", line_end)).xyz == std::vector<float>{first, 2, 3});
      CHECK(read_from_bytes(with_header_line_ends(ply, "end_header", line_end)).xyz == std::vector<float>{first, 2, 3});
    }
  }
  for (const char* line_end : {"\r", "\n\r", "\r\r\n"}) {
    CHECK(read_from_bytes(replaced(sample_pcd("ascii", 'U'), "\n", line_end)).size() == 6);
    CHECK(read_from_bytes(replaced(sample_ply("ascii"), "\n", line_end)).size() == 6);
  }
}

TEST_CASE("cloud headers: byte order marks") {
  const std::string mark = "\xef\xbb\xbf";
  CHECK(read_from_bytes(mark + sample_pcd("binary", 'U')).size() == 6);
  CHECK(read_from_bytes(mark + sample_ply("binary_big_endian")).size() == 6);
  CHECK(error_of("\xff\xfep\0l\0y\0") ==
        "FILE: byte 0: expected ASCII or UTF-8, found the byte order mark of UTF-16: save the text anew");
}

TEST_CASE("cloud headers: words in any case") {
  std::string pcd = sample_pcd("binary", 'F');
  for (const char* word : {"VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS"}) {
    std::string lower = word;
    for (char& c : lower) c = static_cast<char>(c - 'A' + 'a');
    pcd = replaced(pcd, std::string("\n") + word, "\n" + lower);
  }
  CHECK(read_from_bytes(replaced(pcd, "DATA binary", "Data Binary")).rgb == read_from_bytes(pcd).rgb);
  CHECK(read_from_bytes(replaced(pcd, "U F F U F F I F F", "u f f u f f i f f")).size() == 6);
  const std::string ply = sample_ply("binary_little_endian");
  std::string shouted = replaced(replaced(ply, "property", "PROPERTY"), "element vertex", "Element Vertex");
  shouted = replaced(replaced(shouted, " float ", " Float32 "), " uchar ", " UINT8 ");
  shouted = replaced(replaced(shouted, "end_header", "END_HEADER"), "ply\nformat b", "PLY\nFormat B");
  CHECK(read_from_bytes(shouted).rgb == read_from_bytes(ply).rgb);
}

TEST_CASE("cloud headers: what is not used is said") {
  CHECK(note_of(read_from_bytes(sample_ply("ascii")), "ignored") ==
        "ignored: label, links (a list), last; elements camera (2), face (1)");
  CHECK(note_of(read_from_bytes(sample_pcd("binary", 'F') + "more bytes"), "ignored") ==
        "ignored: label, imX, histogram (COUNT 2); 10 bytes behind the last point");
  CHECK(read_from_bytes("FIELDS x y z x\nSIZE 4 4 4 4\nTYPE F F F F\nPOINTS 1\nDATA ascii\n1 2 3 4\n").notes ==
        Strings{"ignored: x (x counts)"});
}

TEST_CASE("cloud headers: range grids") {
  const std::string grid =
      "comment a\nobj_info num_cols 3\nobj_info is_mesh 0\nobj_info num_rows 2\nelement range_grid 6\n"
      "property list uchar int vertex_indices\nproperty_end";
  const std::string begin =
      replaced(ply_header, "float z\n", "float z\nproperty uchar r\nproperty uchar g\nproperty uchar b\n");
  const std::string header = replaced(begin + grid, "property_end", "end_header\n");
  const std::string rows = "0 0 1 1 1 1\n0 1 1 2 2 2\n1 0 1 3 3 3\n";
  const RgbdCloud cloud = read_from_bytes(header + rows + "1 2\n0\n1 0\n0\n0\n0\n");
  CHECK(cloud.width == 3);
  CHECK(cloud.height == 2);
  REQUIRE(cloud.xyz.size() == 18);
  CHECK(cloud.xyz[0] == 1.0F);
  CHECK(std::isnan(cloud.xyz[3]));
  CHECK(cloud.xyz[7] == 0.0F);
  CHECK(cloud.rgb == std::vector<std::uint8_t>{3, 3, 3, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  CHECK(note_of(cloud, "organized") == "organized by its range grid, 3 x 2, which leaves out 1 vertices");
  CHECK(error_of(header + rows + "1 2\n0\n1 3\n0\n0\n0\n") ==
        "FILE:22: expected the index of one of 3 vertices in the range grid, found 3.000000");
  CHECK(error_of(header + rows + "2 1 2\n0\n0\n0\n0\n0\n") ==
        "FILE:20: expected a list of one vertex or none for a cell of the range grid");
  const RgbdCloud flat =
      read_from_bytes(replaced(header, "num_cols 3", "num_cols 4") + rows + "1 2\n0\n1 0\n0\n0\n0\n");
  CHECK(flat.height == 1);
  CHECK(note_of(flat, "its range grid of 6 cells is ignored") != "");
  const RgbdCloud plain =
      read_from_bytes(replaced(ply_header, "vertex 3", "vertex 4") +
                      "obj_info num_cols 2\nobj_info num_rows 2\nend_header\n1 2 3\n1 2 4\n1 2 5\n1 2 6\n");
  CHECK(plain.height == 2);
}

}  // namespace test_cloud_file_headers
