// Intensities of every type, by the names that PCD and PLY files give them, reach the library's view.
#include <doctest/doctest.h>

#include <cmath>

#include "cloud_file_samples.hpp"
#include "shortshot/cloud/read.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace test_cloud_file_intensities {

using cloud_file_test::Cell;
using cloud_file_test::cell;
using cloud_file_test::pcd_body;
using cloud_file_test::read_from_bytes;
using cloud_file_test::Row;
using shortshot_bench::RgbdCloud;

namespace {

using Floats = std::vector<float>;

// One point after the other, each with one of these values in a field of this name.
std::string pcd_with(const std::string& name, const std::string& size_and_type, const std::vector<Cell>& values,
                     const std::string& data) {
  std::vector<Row> rows;
  for (const Cell& value : values) rows.push_back({cell(1.0F), value, cell(2.0F), cell(3.0F)});
  return "FIELDS x " + name + " y z\nSIZE 4 " + size_and_type.substr(1) + " 4 4\nTYPE F " + size_and_type[0] +
         " F F\nPOINTS " + std::to_string(values.size()) + "\nDATA " + data + "\n" + pcd_body(rows, data);
}

void check_pcd(const std::string& size_and_type, const std::vector<Cell>& values, const Floats& expected) {
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    CAPTURE(size_and_type);
    CAPTURE(data);
    const RgbdCloud cloud = read_from_bytes(pcd_with("intensity", size_and_type, values, data));
    CHECK(cloud.intensity == expected);
    CHECK(cloud.xyz[3 * cloud.size() - 2] == 2.0F);
  }
}

std::string ply_with(const std::string& properties, const std::string& format, const std::vector<Cell>& values) {
  std::vector<Row> rows;
  const bool big = format == "binary_big_endian";
  for (const Cell& value : values) rows.push_back({cell(1.0F, big), value, cell(2.0F, big), cell(3.0F, big)});
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(values.size()) + "\nproperty float x\n" +
         properties + "property float y\nproperty float z\nend_header\n" +
         (format == "ascii" ? cloud_file_test::joined_text(rows) : cloud_file_test::joined_bytes(rows));
}

template <typename Value>
void check_ply(const std::string& type, const std::vector<Value>& values, const Floats& expected) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CAPTURE(type);
    CAPTURE(format);
    std::vector<Cell> cells;
    for (const Value value : values) cells.push_back(cell(value, std::string(format) == "binary_big_endian"));
    CHECK(read_from_bytes(ply_with("property " + type + " intensity\n", format, cells)).intensity == expected);
  }
}

Floats ply_intensity(const std::string& properties, const std::vector<Cell>& values) {
  return read_from_bytes(ply_with(properties, "ascii", values)).intensity;
}

}  // namespace

TEST_CASE("cloud intensities: PCD fields of every type become floats") {
  check_pcd("F4", {cell(0.25F), cell(-1e30F)}, {0.25F, -1e30F});
  check_pcd("F8", {cell(0.1), cell(1e300)}, {0.1F, std::numeric_limits<float>::infinity()});
  check_pcd("U1", {cell(std::uint8_t{0}), cell(std::uint8_t{255})}, {0.0F, 255.0F});
  check_pcd("U2", {cell(std::uint16_t{1}), cell(std::uint16_t{65535})}, {1.0F, 65535.0F});
  check_pcd("U4", {cell(std::uint32_t{16777216}), cell(std::uint32_t{0xffffffff})}, {16777216.0F, 4294967296.0F});
  check_pcd("U8", {cell(~std::uint64_t{0})}, {18446744073709551616.0F});
  check_pcd("I1", {cell(std::int8_t{-128}), cell(std::int8_t{127})}, {-128.0F, 127.0F});
  check_pcd("I2", {cell(std::int16_t{-32768}), cell(std::int16_t{32767})}, {-32768.0F, 32767.0F});
  check_pcd("I4", {cell(std::int32_t{-7}), cell(std::int32_t{7})}, {-7.0F, 7.0F});
  check_pcd("I8", {cell(std::numeric_limits<std::int64_t>::min())}, {-9223372036854775808.0F});
}

TEST_CASE("cloud intensities: PLY properties of every type become floats") {
  check_ply<float>("float", {0.25F, -1e30F}, {0.25F, -1e30F});
  check_ply<double>("double", {0.1, 1e300}, {0.1F, std::numeric_limits<float>::infinity()});
  check_ply<std::uint8_t>("uchar", {0, 255}, {0.0F, 255.0F});
  check_ply<std::uint16_t>("ushort", {1, 65535}, {1.0F, 65535.0F});
  check_ply<std::uint32_t>("uint", {16777216}, {16777216.0F});
  check_ply<std::int8_t>("char", {-128, 127}, {-128.0F, 127.0F});
  check_ply<std::int16_t>("short", {-32768, 32767}, {-32768.0F, 32767.0F});
  check_ply<std::int32_t>("int", {-7, 7}, {-7.0F, 7.0F});
}

TEST_CASE("cloud intensities: NaN is a value like any other") {
  const std::vector<Cell> values{cell(std::numeric_limits<float>::quiet_NaN()), cell(2.0F)};
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    const Floats read = read_from_bytes(pcd_with("intensity", "F4", values, data)).intensity;
    REQUIRE(read.size() == 2);
    CHECK(std::isnan(read[0]));
    CHECK(read[1] == 2.0F);
  }
  const Floats read = ply_intensity("property float intensity\n", values);
  REQUIRE(read.size() == 2);
  CHECK(std::isnan(read[0]));
}

TEST_CASE("cloud intensities: names that mean them, and names that do not") {
  const std::vector<Cell> values{cell(5.0F), cell(6.0F)};
  for (const char* name : {"intensity", "Intensity", "intensities", "scalar_intensity", "scalar_Intensity", "i", "I",
                           "reflectivity", "Reflectance", "remission"}) {
    CAPTURE(name);
    CHECK(read_from_bytes(pcd_with(name, "F4", values, "binary")).intensity == Floats{5.0F, 6.0F});
    CHECK(ply_intensity(std::string("property float ") + name + "\n", values) == Floats{5.0F, 6.0F});
  }
  for (const char* name : {"diffuse_intensity", "scalar_other", "scalar_x", "ring", "t"}) {
    CAPTURE(name);
    CHECK_FALSE(read_from_bytes(pcd_with(name, "F4", values, "binary")).has_intensities());
    CHECK(ply_intensity(std::string("property float ") + name + "\n", values).empty());
  }
  const Cell one = cell(std::uint8_t{1});
  CHECK(ply_intensity("property list uchar uchar intensity\n", {one + one, one + one}).empty());
}

TEST_CASE("cloud intensities: of two the first counts, and colors are read beside them") {
  const std::vector<Cell> two{cell(5.0F) + cell(6.0F)};
  CHECK(ply_intensity("property float scalar_intensity\nproperty float intensity\n", two) == Floats{5.0F});
  const Cell bytes = cell(std::uint8_t{1}) + cell(std::uint8_t{2}) + cell(std::uint8_t{3});
  const RgbdCloud cloud = read_from_bytes(
      ply_with("property uchar red\nproperty float intensity\nproperty uchar green\nproperty uchar blue\n", "ascii",
               {cell(std::uint8_t{9}) + cell(0.5F) + cell(std::uint8_t{8}) + cell(std::uint8_t{7})}));
  CHECK(cloud.intensity == Floats{0.5F});
  CHECK(cloud.rgb == std::vector<std::uint8_t>{9, 8, 7});
  const std::string no_intensity = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  CHECK(read_from_bytes(ply_with(no_intensity, "ascii", {bytes})).rgb == std::vector<std::uint8_t>{1, 2, 3});
}

TEST_CASE("cloud intensities: the library's view has those of the cloud, or none") {
  RgbdCloud cloud = read_from_bytes(cloud_file_test::sample_pcd("binary", 'U'));
  const shortshot::CloudView view = shortshot_bench::view_of_cloud(cloud);
  REQUIRE(shortshot::has_intensities(view));
  CHECK(shortshot::has_colors(view));
  CHECK(view.width == 3);
  for (std::size_t i = 0; i < cloud.size(); ++i) CHECK(shortshot::intensity(view, i) == cloud.intensity[i]);
  cloud.intensity.clear();
  CHECK_FALSE(shortshot::has_intensities(shortshot_bench::view_of_cloud(cloud)));
}

}  // namespace test_cloud_file_intensities
