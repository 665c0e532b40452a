// What is wrong with a file is said with the file, the line or byte, what was expected and what was found.
#include <doctest/doctest.h>

#include "cloud_file_samples.hpp"

namespace test_cloud_file_errors {

using cloud_file_test::cell;
using cloud_file_test::error_of;
using cloud_file_test::TemporaryDirectory;
using shortshot_bench::InputError;

namespace {

struct Change {
  std::string from;
  std::string to;
};

std::string changed(std::string text, const Change& change) {
  const std::size_t at = text.find(change.from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, change.from.size(), change.to);
}

struct BadInput {
  Change change;
  std::string message;
};

void check_messages(const std::string& good, const std::vector<BadInput>& bad_inputs) {
  REQUIRE(error_of(good) == "no error");
  for (const BadInput& bad : bad_inputs) {
    CAPTURE(bad.change.from);
    CAPTURE(bad.change.to);
    CHECK(error_of(changed(good, bad.change)) == "FILE" + bad.message);
  }
}

const std::string pcd_header =
    "VERSION 0.7\nFIELDS x y z rgb n\nSIZE 4 4 4 4 2\nTYPE F F F U I\nCOUNT 1 1 1 1 2\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
const std::string ascii_pcd = pcd_header + "DATA ascii\n1 2 3 4 5 6\n1 2 3 4 5 6\n";
const std::string binary_pcd = pcd_header + "DATA binary\n" + std::string(40, '\1');

const std::string ply_header =
    " 1.0\nelement edge 1\nproperty list char int ids\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n";
const std::string ascii_ply = "ply\nformat ascii" + ply_header + "2 7 8\n1 2 3\n4 5 6\n";
const std::string binary_ply = "ply\nformat binary_little_endian" + ply_header + '\1' + std::string(4 + 24, '\0');

std::string path_error(const std::string& path) {
  try {
    shortshot_bench::read_cloud(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("cloud file errors: no such file, a directory, an empty or a foreign file") {
  const TemporaryDirectory directory;
  const std::string missing = directory.file("missing");
  CHECK(path_error(missing) == missing + ": expected a point cloud file, found no file of this name");
  const std::string parent = directory.file("");
  CHECK(path_error(parent) == parent + ": expected a point cloud file, found a directory");
  if (std::filesystem::exists("/dev/zero")) {
    CHECK(path_error("/dev/zero") == "/dev/zero: expected a regular file, found something else");
  }
  const std::string expected = "FILE:1: expected a PLY file ('ply') or a PCD header ('VERSION', 'FIELDS'), ";
  CHECK(error_of("") == expected + "found an empty file");
  CHECK(error_of("\x89PNG\r\n") == expected + "found '?PNG'");
  CHECK(error_of("plywood\n") == expected + "found 'plywood'");
  CHECK(error_of(std::string(100, 'a')) == expected + "found '" + std::string(40, 'a') + "...'");
}

TEST_CASE("cloud file errors: PCD header lines") {
  check_messages(
      ascii_pcd,
      {{{"FIELDS x", "FIELDS a"}, ":2: expected a field x, found none"},
       {{"SIZE 4 4 4 4 2\n", ""}, ":9: expected a SIZE line before the DATA line, found none"},
       {{"SIZE 4 4", "SIZE 4"}, ":3: expected 5 values after SIZE, found 4"},
       {{"SIZE 4 4", "SIZE 4 2"}, ":3: expected SIZE 1, 2, 4 or 8 (4 or 8 for TYPE F), found '2' for TYPE F"},
       {{"4 2\n", "4 3\n"}, ":3: expected SIZE 1, 2, 4 or 8 (4 or 8 for TYPE F), found '3' for TYPE I"},
       {{"4 2\n", "4 16\n"}, ":3: expected a whole number from 1 to 8 for SIZE, found '16'"},
       {{"U I", "U Q"}, ":4: expected I, U or F as a TYPE, found 'Q'"},
       {{"COUNT 1", "COUNT 2"}, ":2: expected COUNT 1 for field x, found COUNT 2"},
       {{"COUNT 1", "COUNT -1"}, ":5: expected a whole number from 1 to 4294967295 for COUNT, found '-1'"},
       {{"COUNT 1", "COUNT 0"}, ":5: expected a whole number from 1 to 4294967295 for COUNT, found '0'"},
       {{"COUNT 1 1 1 1 2", "COUNT 1 1 1 1 4294967295"},
        ":5: expected at most 4294967295 values per point, found a larger sum of COUNT"},
       {{"COUNT 1 1 1 1 2", "COUNT 1 1 1 1 4294967000"},
        ":10: expected 2 rows of at least 4294967004 values, found only 24 bytes after this line"},
       {{"WIDTH 2", "WIDTH 4000000000"}, ":9: expected WIDTH * HEIGHT = 4000000000 POINTS, found 2"},
       {{"WIDTH 2", "WIDTH two"}, ":6: expected a whole number from 0 to 4294967295 for WIDTH, found 'two'"},
       {{"HEIGHT 1", "HEIGHT -1"}, ":7: expected a whole number from 0 to 4294967295 for HEIGHT, found '-1'"},
       {{"WIDTH 2\n", ""}, ":9: expected a WIDTH line before the DATA line, found none"},
       {{"WIDTH 2\nHEIGHT 1\n", "WIDTH 4294967295\nHEIGHT 4294967295\n#"},
        ":9: expected WIDTH * HEIGHT = 18446744065119617025 POINTS, found 2"},
       {{"VIEWPOINT 0 0", "VIEWPOINT 0"}, ":8: expected 7 values after VIEWPOINT, found 6"},
       {{"VIEWPOINT 0", "VIEWPOINT a"}, ":8: expected a number for VIEWPOINT, found 'a'"},
       {{"VIEWPOINT 0", "VIEWPOINT nan"}, ":8: expected a finite VIEWPOINT, found 'nan'"},
       {{"POINTS", "WIDTH"}, ":9: expected one WIDTH line, found a second one after line 6"},
       {{"DATA ascii", "DATA text"}, ":10: expected DATA ascii, binary or binary_compressed, found 'text'"},
       {{"DATA ascii\n", ""}, ":10: expected a PCD header entry or the DATA line, found '1'"},
       {{"DATA ascii\n1 2 3 4 5 6\n1 2 3 4 5 6\n", ""}, ":9: expected a DATA line, found the end of the file"}});
}

TEST_CASE("cloud file errors: PCD intensities") {
  const std::string good =
      "FIELDS x y z intensity\nSIZE 4 4 4 1\nTYPE F F F U\nPOINTS 2\nDATA ascii\n1 2 3 255\n1 2 3 0\n";
  check_messages(good,
                 {{{"3 0", "3 1.5"}, ":7: expected a whole number from 0 to 255 for intensity, found '1.5'"},
                  {{"3 255", "3 256"}, ":6: expected a whole number from 0 to 255 for intensity, found '256'"},
                  {{"3 255", "3 nan"}, ":6: expected a whole number from 0 to 255 for intensity, found 'nan'"},
                  {{"F U", "F I"}, ":6: expected a whole number from -128 to 127 for intensity, found '255'"},
                  {{"4 4 4 1", "4 4 4 3"}, ":2: expected SIZE 1, 2, 4 or 8 (4 or 8 for TYPE F), found '3' for TYPE U"},
                  {{"3 255", "3.000"}, ":6: expected 4 values for a point, found 3"}});
  const std::string floats = changed(changed(good, {"4 4 4 1", "4 4 4 4"}), {"F U", "F F"});
  check_messages(floats, {{{"255", "bright"}, ":6: expected a number for intensity, found 'bright'"}});
}

TEST_CASE("cloud file errors: PCD rows") {
  const std::string row = "1 2 3 4 5 6\n";
  const std::string two_rows = row + row;
  check_messages(
      ascii_pcd,
      {{{two_rows, row}, ":10: expected 2 rows of at least 6 values, found only 12 bytes after this line"},
       {{two_rows, "1.2500 2.2500 3.2500 4 5 6\n"}, ":11: expected 2 points, found only 1 before the end of the file"},
       {{two_rows, row + "1 2 3 4 5\n##"}, ":12: expected 6 values for a point, found 5"},
       {{two_rows, "1 2 3 4 5 6 7\n" + row}, ":11: expected 6 values for a point, found 7"},
       {{two_rows, row + "1 2 abc 4 5 6"}, ":12: expected a number for z, found 'abc'"},
       {{two_rows, row + "1 2 3 1.5 5 6"},
        ":12: expected a whole number from -2147483648 to 4294967295 for rgb, found '1.5'"},
       {{two_rows, "1 2 " + std::string(200, '3') + " 4 5 6\n" + row},
        ":11: expected a number for z, found '" + std::string(40, '3') + "...'"}});
}

TEST_CASE("cloud file errors: PCD binary data") {
  const auto byte = [](std::size_t header_bytes) { return ": byte " + std::to_string(header_bytes + 12); };
  const std::string body(40, '\1');
  const std::string size = "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
  const std::string large_size = "WIDTH 3\nHEIGHT 4000000000\nPOINTS 12000000000\n";
  check_messages(binary_pcd, {{{body, body.substr(1)},
                               byte(pcd_header.size()) + ": expected 2 points of 20 bytes, found only 39 bytes"},
                              {{size, large_size},
                               byte(pcd_header.size() - size.size() + large_size.size()) +
                                   ": expected 12000000000 points of 20 bytes, found only 40 bytes"}});
}

TEST_CASE("cloud file errors: PCD compressed data") {
  const std::string header = pcd_header + "DATA binary_compressed\n";
  const auto error_with = [&](std::uint32_t compressed_bytes, std::uint32_t plain_bytes, std::string bytes) {
    return error_of(header + cell(compressed_bytes).bytes + cell(plain_bytes).bytes + bytes);
  };
  const auto byte = [&](std::size_t offset) { return "FILE: byte " + std::to_string(header.size() + offset); };
  const std::string literals(15, '\0');  // LZF: a 0 is a run of one literal, the byte behind it
  CHECK(error_of(header + "12345") ==
        byte(0) + ": expected 8 bytes of the compressed and the uncompressed size, found only 5");
  CHECK(error_with(15, 41, literals) ==
        byte(4) + ": expected an uncompressed size of 2 points of 20 bytes, found 41 bytes");
  CHECK(error_with(0, 40, literals) ==
        byte(4) + ": expected an uncompressed size of at most 88 times the compressed 0 bytes, found 40 bytes");
  CHECK(error_with(4000000000U, 40, literals) ==
        byte(8) + ": expected 4000000000 bytes of compressed points, found only 15");
  const std::string broken = byte(8) + ": expected LZF data of 40 bytes, found broken or shorter data";
  CHECK(error_with(14, 40, literals) == broken);
  CHECK(error_with(15, 40, std::string(15, '\xff')) == broken);
}

TEST_CASE("cloud file errors: PLY header lines") {
  check_messages(
      ascii_ply,
      {{{"format ascii 1.0\n", ""}, ":8: expected a format line before end_header, found none"},
       {{"ascii", "text"}, ":2: expected the format ascii, binary_little_endian or binary_big_endian, found 'text'"},
       {{"ascii 1.0", "ascii"}, ":2: expected 'format FORMAT VERSION', found 2 words"},
       {{"element edge 1\n", ""}, ":3: expected an element before its first property"},
       {{"list char", "list float"}, ":4: expected a whole number type for a list count, found 'float'"},
       {{"list char int", "list char"}, ":4: expected 'property list COUNT_TYPE TYPE NAME', found 4 words"},
       {{"vertex", "vertices"}, ":9: expected an element 'vertex' before end_header, found none"},
       {{"vertex 2", "vertex -2"},
        ":5: expected a whole number from 0 to 18446744073709551615 for the element count, found '-2'"},
       {{"vertex 2", "vertex 99999999999999999999"},
        ":5: expected a whole number from 0 to 18446744073709551615 for the element count, found "
        "'99999999999999999999'"},
       {{"float y", "half y"}, ":7: expected a PLY type such as uchar or float, found 'half'"},
       {{"list char", "list int64"}, ":4: expected a type of at most 4 bytes for a list count, found 'int64'"},
       {{"float y", "float a"}, ":5: expected a property y in element 'vertex', found none"},
       {{"property float z", "z"}, ":8: expected a PLY header entry or end_header, found 'z'"},
       {{"end_header\n2 7 8\n1 2 3\n4 5 6\n", ""}, ":8: expected end_header, found the end of the file"}});
}

TEST_CASE("cloud file errors: PLY rows and bytes") {
  check_messages(
      ascii_ply,
      {{{"2 7", "9000000000 7"}, ":10: expected 9000000000 values in list 'ids', found only 2"},
       {{"2 7", "-1 7"}, ":10: expected a whole number from 0 to 18446744073709551615 for ids, found '-1'"},
       {{"2 7 8", "2 7 8 9"}, ":10: expected 3 values in this row, found 4"},
       {{"1 2 3", "1.0 2"}, ":11: expected a value for 'z', found the end of the line"},
       {{"1 2 3", "1 2b 3"}, ":11: expected a number for y, found '2b'"},
       {{"\n4 5 6\n", "00000\n"}, ":11: expected 2 rows of element 'vertex', found only 1 before the end of the file"},
       {{"vertex 2", "vertex 4000000000"},
        ":10: expected 4000000000 rows of at least 3 values, found only 12 bytes after this line"}});
  const Change with_intensity{"float z\n", "float z\nproperty uchar intensity\n"};
  CHECK(error_of(changed(changed(ascii_ply, with_intensity), {"1 2 3", "1 2 3.000"})) ==
        "FILE:12: expected a value for 'intensity', found the end of the line");
  const std::string dim = changed(changed(ascii_ply, with_intensity), {"1 2 3", "1 2 3 dim"});
  CHECK(error_of(dim) == "FILE:12: expected a number for intensity, found 'dim'");
  const std::string longer = changed(binary_ply, with_intensity);
  CHECK(error_of(longer) == "FILE: byte " + std::to_string(longer.size() - 24) +
                                ": expected 2 rows of element 'vertex' of at least 13 bytes, found only 24 bytes");
  const std::size_t begin = binary_ply.size() - 29;
  const auto byte = [&](std::size_t offset) { return ": byte " + std::to_string(begin + offset); };
  check_messages(
      binary_ply,
      {{{"header\n\1", "header\n\x7f"}, byte(1) + ": expected 508 bytes of list values, found only 28"},
       {{"header\n\1", "header\n\xff"}, byte(0) + ": expected a count of 0 or more for list 'ids', found -1"},
       {{"vertex 2", "vertex 4"},
        byte(5) + ": expected 4 rows of element 'vertex' of at least 12 bytes, found only 24 bytes"},
       {{"edge 1", "edge 29"}, byte(30) + ": expected 1 bytes of a list count, found only 0"}});
}

}  // namespace test_cloud_file_errors
