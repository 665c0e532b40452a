// The kinds behind the cases: names, types, ranges, far coordinates, headers; the same for PCD and for PLY.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "cloud_file_samples.hpp"
#include "note_of.hpp"
#include "tools/io/repeated_points.hpp"

namespace test_cloud_file_kinds {

using cloud_file_test::cell;
using cloud_file_test::error_of;
using cloud_file_test::note_of;
using cloud_file_test::read_from_bytes;
using shortshot_bench::RgbdCloud;
using Rgb = std::vector<std::uint8_t>;
using Strings = std::vector<std::string>;

namespace {

struct Field {
  std::string name, pcd_type, ply_type;
};

/// Text of points "x y z" and these fields behind them.
std::string pcd_of(const std::vector<Field>& fields, const Strings& rows) {
  std::string names = "FIELDS x y z", sizes = "SIZE 4 4 4", types = "TYPE F F F";
  for (const Field& field : fields) {
    names += " " + field.name;
    sizes += " " + field.pcd_type.substr(1);
    types += " " + field.pcd_type.substr(0, 1);
  }
  std::string text = names + "\n" + sizes + "\n" + types + "\nPOINTS " + std::to_string(rows.size()) + "\nDATA ascii\n";
  for (std::size_t i = 0; i < rows.size(); ++i) text += std::to_string(i + 1) + " 2 3 " + rows[i] + "\n";
  return text;
}

std::string ply_of(const std::vector<Field>& fields, const Strings& rows) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(rows.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  for (const Field& field : fields) text += "property " + field.ply_type + " " + field.name + "\n";
  text += "end_header\n";
  for (std::size_t i = 0; i < rows.size(); ++i) text += std::to_string(i + 1) + " 2 3 " + rows[i] + "\n";
  return text;
}

std::vector<Field> fields_of(const Strings& names, const std::string& pcd_type, const std::string& ply_type) {
  std::vector<Field> fields;
  for (const std::string& name : names) fields.push_back({name, pcd_type, ply_type});
  return fields;
}

void check_colors(const std::string& pcd_type, const std::string& ply_type, const Strings& rows, const Rgb& expected,
                  const std::string& note, const Strings& names = {"red", "green", "blue"}) {
  CAPTURE(pcd_type);
  CAPTURE(names[0]);
  const std::vector<Field> fields = fields_of(names, pcd_type, ply_type);
  for (const std::string& bytes : {pcd_of(fields, rows), ply_of(fields, rows)}) {
    const RgbdCloud cloud = read_from_bytes(bytes);
    CHECK(cloud.size() == rows.size());
    CHECK(cloud.rgb == expected);
    const std::string all = cloud.notes.empty() ? "" : cloud.notes.front();
    CHECK((note.empty() ? all.empty() : all.find(note) != std::string::npos));
  }
}

const std::string xyz_header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\n";

}  // namespace

TEST_CASE("cloud kinds: colors under every name") {
  for (const Strings& names : {Strings{"red", "green", "blue"},
                               {"r", "g", "b"},
                               {"R", "G", "B"},
                               {"Red", "Green", "Blue"},
                               {"diffuse_red", "diffuse_green", "diffuse_blue"},
                               {"Diffuse_R", "Diffuse_G", "Diffuse_B"},
                               {"scalar_red", "scalar_green", "scalar_blue"},
                               {"color_red", "color_green", "color_blue"}}) {
    check_colors("U1", "uchar", {"1 2 3", "4 5 255"}, {1, 2, 3, 4, 5, 255}, "", names);
  }
  check_colors("U1", "uchar", {"1 2 3"}, {},
               "ignored: green, blue (a color needs all of red, green and blue), ambient_red",
               {"ambient_red", "green", "blue"});
  check_colors("U1", "uchar", {"1 2"}, {}, "ignored: red, green (a color needs all of red, green and blue)",
               {"red", "green"});
}

TEST_CASE("cloud kinds: the range of colors is told apart by the data") {
  check_colors("F4", "float", {"0.5 nan 1", "0 1.01 0"}, {128, 0, 255, 0, 255, 0},
               "F4: taken as 0 to 1, as the largest is 1.01, 1 values beyond that clamped, 1 values not finite: 0");
  check_colors("F8", "double", {"51 0 255"}, {51, 0, 255}, "F8: taken as 0 to 255");
  check_colors("F8", "double", {"65535 257 0"}, {255, 1, 0}, "F8: taken as 0 to 65535");
  check_colors("U2", "ushort", {"65535 257 0"}, {255, 1, 0}, "U2: taken as 0 to 65535");
  check_colors("U2", "ushort", {"250 25 0"}, {250, 25, 0}, "U2: taken as 0 to 255");
  check_colors("I4", "int", {"-5 300 9"}, {0, 255, 9}, "I4: taken as 0 to 255");
  check_colors("U4", "uint", {"65280 0 514"}, {254, 0, 2}, "U4: taken as 0 to 65535");
  check_colors("I2", "short", {"1 2 3"}, {1, 2, 3}, "I2: taken as 0 to 255, as the largest is 3");
  check_colors("I1", "char", {"-1 -128 127"}, {255, 128, 127}, "as below 0 for 128 to 255");
  check_colors("F4", "float", {"1e6 1 1"}, {},
               "ignored: red green blue (F4 up to 1e+06: colors are 0 to 1, 255 or 65535)");
}

TEST_CASE("cloud kinds: what text says counts more than the type before it, and a channel of one value is named") {
  const std::vector<Field> fields = fields_of({"red", "green", "blue"}, "U1", "uchar");
  const RgbdCloud fractions = read_from_bytes(ply_of(fields, {"0.2 1 0", "1 0 0.6"}));
  CHECK(fractions.rgb == Rgb{51, 255, 0, 255, 0, 153});
  CHECK(read_from_bytes(ply_of(fields, {"1 2 3", "1 2 3"})).notes == Strings{"all points have one color, 1 2 3"});
  CHECK(read_from_bytes(ply_of({{"i", "", "float"}}, {"7", "7"})).notes ==
        Strings{"intensities are i", "all points have one intensity"});
}

TEST_CASE("cloud kinds: packed colors of every type, or why not") {
  const Strings one{"rgb"};
  check_colors("U4", "uint", {"16909060"}, {2, 3, 4}, "", one);
  check_colors("U4", "uint", {"16909060"}, {2, 3, 4}, "", {"rgba"});
  check_colors("F4", "float", {"3.5733111e-43"}, {0, 0, 255}, "", {"RGB"});
  check_colors("U8", "uint64", {"16909060"}, {2, 3, 4}, "rgb, U8: taken as 0xAARRGGBB", one);
  check_colors("F8", "double", {"3.5733111e-43"}, {0, 0, 255}, "taken as the bits of 4-byte floats", one);
  check_colors("F8", "double", {"4.2108e+06"}, {}, "ignored: rgb (F8: a packed color has 4 bytes", one);
  check_colors("U2", "ushort", {"7"}, {}, "ignored: rgb (U2: a packed color has 4 bytes)", one);
  check_colors("F4", "float", {"255", "16711680"}, {0, 0, 255, 255, 0, 0}, "taken as whole numbers 0xRRGGBB", one);
  check_colors("F4", "float", {"nan", "3.5733111e-43"}, {0, 0, 0, 0, 0, 255}, "1 are nan in text", one);
  const RgbdCloud triple = read_from_bytes(
      "FIELDS x y z rgb _ t\nSIZE 4 4 4 1 1 4\nTYPE F F F U U F\nCOUNT 1 1 1 3 5 2\nPOINTS 1\nDATA ascii\n"
      "1 2 3 7 8 9 0 0 0 0 0 5 5\n");
  CHECK(triple.rgb == Rgb{7, 8, 9});
  const RgbdCloud triples = read_from_bytes(
      "FIELDS normal rgba xyz\nSIZE 4 1 8\nTYPE F U F\nCOUNT 3 4 3\nPOINTS 1\nDATA binary\n" + cell(0.0F).bytes +
      cell(1.0F).bytes + cell(0.0F).bytes + "abcd" + cell(5.0).bytes + cell(6.0).bytes + cell(7.0).bytes);
  CHECK(triples.xyz == std::vector<float>{5, 6, 7});
  CHECK(triples.rgb == Rgb{'a', 'b', 'c'});
  CHECK(triples.normals == std::vector<float>{0, 1, 0});
  CHECK(triple.notes == Strings{"ignored: t (COUNT 2)"});
}

TEST_CASE("cloud kinds: normals under several names, and those that are none") {
  for (const Strings& names : {Strings{"normal_x", "normal_y", "normal_z"},
                               {"nx", "ny", "nz"},
                               {"NormalX", "NormalY", "NormalZ"},
                               {"scalar_Nx", "scalar_Ny", "scalar_Nz"}}) {
    const std::vector<Field> fields = fields_of(names, "F4", "float");
    const Strings rows{"0 0 1", "0 -3 4", "0 0 0", "nan 0 1"};
    for (const std::string& bytes : {pcd_of(fields, rows), ply_of(fields, rows)}) {
      const RgbdCloud cloud = read_from_bytes(bytes);
      REQUIRE(cloud.normals.size() == 12);
      CHECK(cloud.normals[2] == 1.0F);
      CHECK(cloud.normals[4] == -0.6F);
      CHECK(std::isnan(cloud.normals[6]));
      CHECK(std::isnan(cloud.normals[11]));
      CHECK(note_of(cloud, "normals") == "normals are " + names[0] + " " + names[1] + " " + names[2] +
                                             ", 1 of them made unit length (they are 1 to 5 long), 2 of 4 missing "
                                             "(zero or not finite)");
    }
  }
  const auto note_with = [](const Strings& names, const std::string& type, const std::string& row) {
    const RgbdCloud cloud = read_from_bytes(pcd_of(fields_of(names, type, ""), {row}));
    CHECK_FALSE(cloud.has_normals());
    return note_of(cloud, "ignored");
  };
  const Strings names{"nx", "ny", "nz"};
  CHECK(note_with(names, "F4", "0 0 0") == "ignored: nx ny nz (all zero or not finite)");
  CHECK(note_with(names, "U1", "0 0 255") == "ignored: nx ny nz (a normal needs signs)");
  CHECK(note_with({"nx", "ny"}, "F4", "0 1") == "ignored: nx ny (a normal needs all of x, y and z)");
}

TEST_CASE("cloud kinds: whole-number coordinates") {
  const RgbdCloud cloud =
      read_from_bytes("FIELDS X Y Z\nSIZE 2 2 2\nTYPE I I I\nPOINTS 2\nDATA binary\n" + cell(std::int16_t{-7}).bytes +
                      cell(std::int16_t{300}).bytes + cell(std::int16_t{2}).bytes + std::string(6, '\1'));
  CHECK(cloud.xyz == std::vector<float>{-7, 300, 2, 257, 257, 257});
  CHECK(note_of(cloud, "coordinates are whole numbers (I2)") != "");
}

TEST_CASE("cloud kinds: coordinates far away keep what floats would lose, in text as in doubles") {
  const std::string rows = "4000000.25 700000.5 12.125\n4000003.5 700000.75 11.5\n0 0 0\n4000001 700001 12\nnan 1 2\n";
  const std::string header = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 5\nVIEWPOINT 4000000 700000 9 1 0 0 0\n";
  for (const char* size : {"SIZE 8 8 8", "SIZE 4 4 4"}) {
    std::string text = header;
    text.replace(text.find("SIZE 8 8 8"), 10, size);
    RgbdCloud cloud = read_from_bytes(text + "DATA ascii\n" + rows);
    CHECK(cloud.origin == std::array<double, 3>{4000000, 700000, 0});
    CHECK(cloud.viewpoint == std::array<float, 3>{0, 0, 9});
    CHECK(note_of(cloud, "the viewpoint") == "");
    CHECK(cloud.xyz[0] == 0.25F);
    CHECK(cloud.xyz[4] == 0.75F);
    CHECK(note_of(cloud, "1 of 5 points (20 %) are 0 0 0") != "");
    CHECK(shortshot_bench::drop_zeros(cloud) == 1);
    CHECK(std::isnan(cloud.xyz[6]));
  }
  const std::string one = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 1\nDATA ascii\n";
  CHECK(read_from_bytes(one + "465123.125 5412345.5 3\n").is_shifted());
  CHECK_FALSE(read_from_bytes(one + "1 2 3\n").is_shifted());
  const RgbdCloud lost = read_from_bytes(xyz_header + "DATA binary\n" + cell(4e6F).bytes + cell(7e5F).bytes +
                                         cell(1.0F).bytes + cell(4e6F + 1).bytes + cell(7e5F).bytes + cell(1.0F).bytes);
  CHECK_FALSE(lost.is_shifted());
  CHECK(note_of(lost, "coordinates are 4-byte floats, 0.25 apart so far from the origin") != "");
  CHECK(read_from_bytes(xyz_header + "DATA ascii\n-9 0 1\n30 40.5 2\n").notes == Strings{});
}

TEST_CASE("cloud kinds: every spelling of what is not finite") {
  for (const char* nan : {"nan", "NaN", "NAN", "-nan", "nan(ind)", "-nan(ind)", "nan(snan)", "1.#QNAN", "-1.#IND",
                          "1.#QNAN0", "-1.#IND00", "1.#SNAN", "1.#R", "-1.#J"}) {
    CAPTURE(nan);
    CHECK(std::isnan(read_from_bytes(xyz_header + "DATA ascii\n1 2 3\n4 " + nan + " 5\n").xyz[4]));
  }
  for (const char* inf : {"inf", "INF", "Infinity", "1.#INF", "1.#INF000", "+1.#INF"}) {
    CHECK(read_from_bytes(xyz_header + "DATA ascii\n1 2 3\n4 " + inf + " 5\n").xyz[4] ==
          std::numeric_limits<float>::infinity());
  }
  CHECK(read_from_bytes(xyz_header + "DATA ascii\n1 2 3\n4 -1.#INF 5\n").xyz[4] < 0);
  CHECK(error_of(xyz_header + "DATA ascii\n1 2 3\n4 0,5 5\n") == "FILE:7: expected a number for y, found '0,5'");
  CHECK(error_of(xyz_header + "DATA ascii\n1 2 3\n4 1.# 5\n") == "FILE:7: expected a number for y, found '1.#'");
}

TEST_CASE("cloud kinds: points in one place") {
  const std::string header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 4\nDATA ascii\n";
  CHECK(read_from_bytes(header + "1 2 3\n1 2 3\n1 2 3\n4 5 6\n").notes ==
        Strings{"50 % of the points are in the very place of another one: duplicates, or too few digits"});
  CHECK(read_from_bytes(header + "nan nan nan\nnan nan nan\n1 2 3\n4 5 6\n").notes == Strings{});
}

}  // namespace test_cloud_file_kinds
