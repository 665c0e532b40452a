// Every format variant gives back the values that were written.
#include <doctest/doctest.h>

#include <cmath>

#include "cloud_file_samples.hpp"
#include "tools/io/write_descriptor_pcd.hpp"
#include "tools/io/write_npy.hpp"

namespace test_cloud_files {

using cloud_file_test::cell;
using cloud_file_test::read_bytes;
using cloud_file_test::read_from_bytes;
using cloud_file_test::sample_pcd;
using cloud_file_test::sample_ply;
using cloud_file_test::sample_points;
using cloud_file_test::TemporaryDirectory;
using shortshot_bench::InputError;
using shortshot_bench::RgbdCloud;

namespace {

void check_sample(const RgbdCloud& cloud) {
  const auto points = sample_points();
  REQUIRE(cloud.size() == points.size());
  REQUIRE(cloud.rgb.size() == 3 * points.size());
  REQUIRE(cloud.intensity.size() == points.size());
  CHECK(cloud.has_colors());
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(cloud.intensity[i] == static_cast<float>(points[i].intensity));
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(i);
      CAPTURE(k);
      const float value = cloud.xyz[3 * i + k];
      CHECK((value == points[i].xyz[k] || (std::isnan(value) && std::isnan(points[i].xyz[k]))));
      CHECK(int{cloud.rgb[3 * i + k]} == int{points[i].rgb[k]});
    }
  }
}

const std::string xyz_header =
    "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n";

std::string with_line_ends(std::string text, const std::string& line_end) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + line_end.size())) {
    text.replace(at, 1, line_end);
  }
  return text;
}

}  // namespace

TEST_CASE("cloud files: PCD of every DATA and color type") {
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    for (const char color_type : {'F', 'U', 'I'}) {
      CAPTURE(data);
      CAPTURE(color_type);
      const RgbdCloud cloud = read_from_bytes(sample_pcd(data, color_type));
      check_sample(cloud);
      CHECK(cloud.width == 3);
      CHECK(cloud.height == 2);
      CHECK(cloud.is_organized());
      CHECK(cloud.viewpoint == std::array<float, 3>{0.5F, -1.0F, 2.0F});
    }
  }
}

TEST_CASE("cloud files: bytes in memory are read as a file is") {
  for (const std::string& bytes : {sample_pcd("binary", 'F'), sample_ply("ascii")}) {
    check_sample(shortshot_bench::read_cloud("memory", bytes));
    CHECK_THROWS_WITH_AS(shortshot_bench::read_cloud("memory", bytes.substr(0, bytes.size() / 2)),
                         doctest::Contains("memory:"), InputError);
  }
}

TEST_CASE("cloud files: PLY of every format") {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CAPTURE(format);
    const RgbdCloud cloud = read_from_bytes(sample_ply(format));
    check_sample(cloud);
    CHECK(cloud.width == 6);
    CHECK(cloud.height == 1);
    CHECK_FALSE(cloud.is_organized());
  }
}

TEST_CASE("cloud files: line ends, blank lines, comments and trailing bytes do not matter") {
  check_sample(read_from_bytes(with_line_ends(sample_pcd("ascii", 'U'), "\r\n")));
  check_sample(read_from_bytes(with_line_ends(sample_ply("ascii"), "\r\n")));
  check_sample(read_from_bytes(with_line_ends(sample_pcd("ascii", 'F'), " \t\n\n")));
  check_sample(read_from_bytes("\n# first\n# .PCD\n\n" + sample_pcd("binary", 'F')));
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    check_sample(read_from_bytes(sample_pcd(data, 'F') + "more bytes"));
  }
  check_sample(read_from_bytes(sample_ply("binary_little_endian") + "more bytes"));
}

TEST_CASE("cloud files: PCD without color, VERSION and COUNT, with values that are not finite") {
  const std::string rows = "1 2 3\nnan inf -inf";
  const RgbdCloud cloud = read_from_bytes("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n" + rows);
  CHECK(cloud.size() == 2);
  CHECK(cloud.width == 2);
  CHECK(cloud.height == 1);
  CHECK_FALSE(cloud.has_colors());
  CHECK_FALSE(cloud.has_intensities());
  CHECK(std::isnan(cloud.xyz[3]));
  CHECK(std::isinf(cloud.xyz[4]));
  CHECK(cloud.xyz[5] < 0);
  CHECK(read_from_bytes(xyz_header + "DATA ascii\n1 2 3\n4 5 1e99\n").xyz[4] == 5.0F);
}

TEST_CASE("cloud files: colors of the W-RGB-D data set, floats printed as denormals") {
  const RgbdCloud cloud = read_from_bytes(
      "# .PCD v.7 - Point Cloud Data file format\nFIELDS x y z rgb imX imY\nSIZE 4 4 4 4 4 4\n"
      "TYPE F F F F F F\nCOUNT 1 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
      "-0.0077637597 0.73799998 0.028467119 4.5107335e-39 314 218\n1 2 3 nan 315 218\n");
  CHECK(cloud.xyz[0] == -0.0077637597F);
  CHECK(cloud.rgb == std::vector<std::uint8_t>{49, 30, 23, 0, 0, 0});
}

TEST_CASE("cloud files: clouds of no points") {
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    const std::string header = "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nWIDTH 0\nHEIGHT 1\nDATA ";
    const RgbdCloud cloud = read_from_bytes(header + data + "\n" + std::string(8, '\0'));
    CHECK(cloud.size() == 0);
  }
  CHECK(read_from_bytes("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n")
            .size() == 0);
}

TEST_CASE("cloud files: PLY colors of other types and names") {
  const std::string begin =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n";
  const auto color_of = [&](const std::string& properties, const std::string& values) {
    return read_from_bytes(begin + properties + "end_header\n1 2 3 " + values + "\n").rgb;
  };
  using Rgb = std::vector<std::uint8_t>;
  CHECK(color_of("property uchar b\nproperty uchar g\nproperty uchar r\n", "1 2 3") == Rgb{3, 2, 1});
  CHECK(color_of("property uint8 diffuse_red\nproperty uint8 diffuse_green\nproperty uint8 diffuse_blue\n", "1 2 3") ==
        Rgb{1, 2, 3});
  CHECK(color_of("property float red\nproperty float green\nproperty float blue\n", "0.5 nan 1") == Rgb{128, 0, 255});
  CHECK(color_of("property ushort red\nproperty ushort green\nproperty ushort blue\n", "65535 257 0") ==
        Rgb{255, 1, 0});
  CHECK(color_of("property int red\nproperty int green\nproperty int blue\n", "-5 300 9") == Rgb{0, 255, 9});
  CHECK(color_of("property uchar red\nproperty uchar green\n", "1 2").empty());
}

TEST_CASE("cloud files: doubles beyond the float range become infinite") {
  const std::string header =
      "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n";
  const RgbdCloud cloud = read_from_bytes(header + cell(1e300).bytes + cell(-1e300).bytes + cell(0.1).bytes);
  CHECK(cloud.xyz[0] == std::numeric_limits<float>::infinity());
  CHECK(cloud.xyz[1] == -std::numeric_limits<float>::infinity());
  CHECK(cloud.xyz[2] == 0.1F);
}

TEST_CASE("cloud files: descriptor PCD") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("descriptors.pcd");
  const std::vector<float> descriptors{0.5F, 0.25F, 1.0F, 2.0F};
  shortshot_bench::write_descriptor_pcd(path, {{1, 2, 3}, {4, 5, 6}}, descriptors.data(), 2,
                                        {"layout: a b", "two\nlines\r"});
  const RgbdCloud cloud = shortshot_bench::read_cloud(path);
  CHECK(cloud.xyz == std::vector<float>{1, 2, 3, 4, 5, 6});
  CHECK_FALSE(cloud.has_colors());
  const std::string bytes = read_bytes(path);
  CHECK(bytes.find("\n# layout: a b\n# two lines \nVERSION 0.7\nFIELDS x y z descriptor\n") != std::string::npos);
  CHECK(bytes.find("COUNT 1 1 1 2\n") != std::string::npos);
  CHECK(bytes.substr(bytes.size() - 8) == cell(1.0F).bytes + cell(2.0F).bytes);
  CHECK_THROWS_AS(shortshot_bench::write_descriptor_pcd(path, {}, nullptr, 0, {}), std::invalid_argument);
}

TEST_CASE("cloud files: NumPy") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("matrix.npy");
  std::vector<float> data(3000);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<float>(i) / 4;
  shortshot_bench::write_npy(path, data.data(), 1000, 3);
  const std::string bytes = read_bytes(path);
  REQUIRE(bytes.size() == 128 + 4 * data.size());
  CHECK(bytes.substr(0, 10) == std::string("\x93NUMPY\x01\x00\x76\x00", 10));
  CHECK(bytes.substr(10, 62) == "{'descr': '<f4', 'fortran_order': False, 'shape': (1000, 3), }");
  CHECK(bytes[127] == '\n');
  for (std::size_t i = 0; i < data.size(); ++i) {
    REQUIRE(bytes.substr(128 + 4 * i, 4) == cell(data[i]).bytes);
  }
}

TEST_CASE("cloud files: a file that cannot be written is an error") {
  const TemporaryDirectory directory;
  const float value = 1;
  const std::string path = directory.file("missing_directory/a.npy");
  CHECK_THROWS_AS(shortshot_bench::write_npy(path, &value, 1, 1), InputError);
  CHECK_THROWS_AS(shortshot_bench::write_descriptor_pcd(path, {{1, 2, 3}}, &value, 1, {}), InputError);
  if (std::filesystem::exists("/dev/full")) {  // a disk without space, on Linux
    CHECK_THROWS_AS(shortshot_bench::write_npy("/dev/full", &value, 1, 1), InputError);
  }
}

}  // namespace test_cloud_files
