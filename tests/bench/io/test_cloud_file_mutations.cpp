// Damaged files either load to a consistent cloud or give an InputError, whatever the damage.
#include <doctest/doctest.h>

#include <algorithm>

#include "cloud_file_samples.hpp"

namespace test_cloud_file_mutations {

using cloud_file_test::sample_pcd;
using cloud_file_test::sample_ply;
using cloud_file_test::TemporaryDirectory;
using cloud_file_test::write_bytes;
using shortshot_bench::RgbdCloud;

namespace {

// A vertex in every second cell of a range grid.
std::string range_grid_ply(const std::string& format) {
  using cloud_file_test::cell;
  std::vector<cloud_file_test::Row> rows;
  for (const double x : {1.0, 2e6, 3.0})
    rows.push_back({cell(x), cell(x), cell(0.5F), cell(0.25F), cell(0.0F), cell(2.0F)});
  for (std::int32_t i = 0; i < 3; ++i) {
    rows.push_back({cell(std::uint8_t{1}), cell(i)});
    rows.push_back({cell(std::uint8_t{0})});
  }
  return "ply\nformat " + format + " 1.0\nobj_info num_cols 2\nobj_info num_rows 3\nelement vertex 3\n" +
         "property double x\nproperty double y\nproperty float z\nproperty float nx\nproperty float ny\n" +
         "property float nz\nelement range_grid 6\nproperty list uchar int vertex_indices\nend_header\n" +
         (format == "ascii" ? cloud_file_test::joined_text(rows) : cloud_file_test::joined_bytes(rows));
}

std::vector<std::string> sample_files() {
  return {sample_pcd("ascii", 'F'),
          sample_pcd("ascii", 'I'),
          sample_pcd("binary", 'F'),
          sample_pcd("binary_compressed", 'U'),
          sample_ply("ascii"),
          sample_ply("binary_little_endian"),
          sample_ply("binary_big_endian"),
          range_grid_ply("ascii"),
          range_grid_ply("binary_little_endian")};
}

// Empty if all is well. The file is one path over and over: only its content matters.
std::string problem_with(const std::string& path, const std::string& bytes) {
  write_bytes(path, bytes);
  try {
    const RgbdCloud cloud = shortshot_bench::read_cloud(path);
    if (cloud.xyz.size() != 3 * cloud.width * cloud.height) return "xyz has another size than the cloud";
    if (!cloud.intensity.empty() && cloud.intensity.size() != cloud.size())
      return "intensity has another size than xyz";
    if (!cloud.normals.empty() && cloud.normals.size() != cloud.xyz.size()) return "normals have another size than xyz";
    if (!cloud.rgb.empty() && cloud.rgb.size() != cloud.xyz.size()) return "rgb has another size than xyz";
  } catch (const shortshot_bench::InputError& error) {
    if (std::string(error.what()).rfind(path + ":", 0) != 0) return "the message does not name the file";
  } catch (const std::exception& error) {
    return std::string("another exception: ") + error.what();
  }
  return {};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Numbers are what headers lie with: the digits at or after `begin` become nines, and more of them.
void exaggerate_number(std::string& bytes, std::size_t begin, std::size_t extra_digits) {
  const auto first = std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end(), is_digit);
  const auto last = std::find_if_not(first, bytes.end(), is_digit);
  std::fill(first, last, '9');
  bytes.insert(static_cast<std::size_t>(last - bytes.begin()), extra_digits, '9');
}

// engine() % n and not a distribution: the same mutations with every standard library.
void mutate_once(std::string& bytes, std::mt19937& engine) {
  if (bytes.empty()) return;
  // Drawn one by one: the order of calls among the arguments of a function differs between compilers.
  const std::size_t at = engine() % bytes.size();
  const std::size_t other = engine() % bytes.size();
  const auto value = static_cast<char>(engine() % 256);
  const std::size_t length = 1 + engine() % 64;
  switch (engine() % 7) {
    case 0: bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << (length % 8))); break;
    case 1: bytes.erase(at, 1 + length / 16); break;
    case 2: bytes.insert(at, 1 + length / 16, value); break;
    case 3: bytes.resize(at); break;
    case 4: bytes[at] = "\xff-9 \n\0"[length % 6]; break;
    case 5: bytes.insert(at, bytes.substr(other, length)); break;
    default: exaggerate_number(bytes, at, length % 12);
  }
}

}  // namespace

TEST_CASE("cloud files: damaged files") {
  constexpr int mutations_per_file = 2000;
  const TemporaryDirectory directory;
  const std::string path = directory.file("damaged");
  std::mt19937 engine(20240607);
  for (const std::string& original : sample_files()) {
    REQUIRE(problem_with(path, original).empty());
    for (int i = 0; i < mutations_per_file; ++i) {
      std::string bytes = original;
      const std::size_t damages = 1 + engine() % 3;
      for (std::size_t damage = 0; damage < damages; ++damage) mutate_once(bytes, engine);
      const std::string problem = problem_with(path, bytes);
      CAPTURE(i);
      CAPTURE(bytes);
      REQUIRE(problem == "");
    }
  }
}

TEST_CASE("cloud files: truncated files") {
  const TemporaryDirectory directory;
  const std::string path = directory.file("truncated");
  for (const std::string& original : sample_files()) {
    for (std::size_t length = 0; length < original.size(); ++length) {
      const std::string problem = problem_with(path, original.substr(0, length));
      CAPTURE(length);
      REQUIRE(problem == "");
    }
  }
}

}  // namespace test_cloud_file_mutations
