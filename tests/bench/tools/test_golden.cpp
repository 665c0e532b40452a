// The golden tool: what it must accept, what it must call broken, and what it must refuse.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "cloud_file_samples.hpp"
#include "golden_case_copy.hpp"
#include "golden_outcome.hpp"
#include "tools/golden/case.hpp"
#include "tools/golden/compare.hpp"
#include "tools/golden/frames.hpp"
#include "tools/golden/tool.hpp"

namespace test_golden {
namespace {

using namespace shortshot_bench::golden;
using shortshot_bench::InputError;

using golden_test::broken_arrays;
using golden_test::CaseCopy;
using golden_test::contains;
using golden_test::Names;
using golden_test::Outcome;
using golden_test::run_tool;
using golden_test::test_data;

// Turns x and y of one row of lrf_pcl by an angle about z.
void turn_frame(const CaseCopy& copy, std::size_t row, double degrees) {
  std::vector<float> frames = copy.values<float>("lrf_pcl");
  float* x = frames.data() + 9 * row;
  float* y = x + 3;
  const double angle = degrees / 57.295779513082321;
  for (int k = 0; k < 3; ++k) {
    const double old_x = static_cast<double>(x[k]);
    const double old_y = static_cast<double>(y[k]);
    x[k] = static_cast<float>(std::cos(angle) * old_x + std::sin(angle) * old_y);
    y[k] = static_cast<float>(std::cos(angle) * old_y - std::sin(angle) * old_x);
  }
  copy.write_values("lrf_pcl", frames);
}

constexpr std::size_t sound_frame_row = 12;  // of edge: its neighborhood leaves no choice of a frame

void check_refused(const CaseCopy& copy, const std::string& file, const std::string& reason) {
  CAPTURE(reason);
  CHECK_THROWS_AS(read_case(copy.path()), InputError);
  const Outcome outcome = run_tool({copy.path()});
  CHECK(outcome.code == bad_input);
  CAPTURE(outcome.err);
  CHECK(contains(outcome.err, file));
  CHECK(contains(outcome.err, reason));
}

}  // namespace

TEST_CASE("golden: the library is within tolerance on the free cases") {
  const Outcome outcome =
      run_tool({test_data + "/README.md", test_data + "/cielab", test_data + "/edge/"}, /*verbose=*/true);
  CAPTURE(outcome.out);
  CHECK(outcome.code == within_tolerance);
  CHECK(outcome.err.empty());
  CHECK(contains(outcome.out, "README.md: not a folder, skipped\n"));
  CHECK(contains(outcome.out, "not checked yet: fpfh33\n"));
  CHECK(contains(outcome.out, "(lattice_face): angle 180 degrees: tie"));
  for (const char* array :
       {"neighbor_count", "lrf_pcl", "ssh32", "ssh64", "ssh96", "scsh336", "scsh696", "scsh_32_8_10", "scsh_128_32_30",
        "shot352", "cshot1344", "bshot", "lab_pcl", "lab_authors"}) {
    CHECK(contains(outcome.out, array));
  }
}

TEST_CASE("golden: one wrong bit of B-SHOT is reported") {
  const CaseCopy copy("edge");
  std::vector<std::uint8_t> bits = copy.values<std::uint8_t>("bshot");
  bits[44 * 8 + 3] ^= 4;
  copy.write_values("bshot", bits);
  CHECK(broken_arrays(copy) == Names{"bshot"});
}

TEST_CASE("golden: rows without numbers on one side only are beyond tolerance") {
  const CaseCopy copy("edge");
  std::vector<float> ssh64 = copy.values<float>("ssh64");
  std::fill_n(ssh64.begin() + 64 * 12, 64, std::numeric_limits<float>::quiet_NaN());
  copy.write_values("ssh64", ssh64);
  std::vector<float> ssh96 = copy.values<float>("ssh96");
  const std::size_t nan_frame_row = 9;
  REQUIRE(std::isnan(ssh96[96 * nan_frame_row]));
  std::fill_n(ssh96.begin() + 96 * nan_frame_row, 96, 0.1F);
  copy.write_values("ssh96", ssh96);
  CHECK(broken_arrays(copy) == Names{"ssh64", "ssh96"});
}

TEST_CASE("golden: one wrong neighbor count, color or frame is reported by its array") {
  const CaseCopy edge("edge");
  std::vector<std::int32_t> counts = edge.values<std::int32_t>("neighbor_count");
  ++counts[5];
  edge.write_values("neighbor_count", counts);
  turn_frame(edge, sound_frame_row, 1.0);
  CHECK(broken_arrays(edge) == Names{"neighbor_count", "lrf_pcl"});

  const CaseCopy cielab("cielab");
  std::vector<float> lab = cielab.values<float>("lab_authors");
  lab[1000] += 0.01F;
  cielab.write_values("lab_authors", lab);
  CHECK(broken_arrays(cielab) == Names{"lab_authors"});
}

TEST_CASE("golden: a frame's explanation covers nothing but what the neighborhood leaves open") {
  for (const double degrees : {0.05, 0.2, 180.0}) {  // 180: the signs of x and y
    const CaseCopy copy("edge");
    turn_frame(copy, sound_frame_row, degrees);
    CHECK(broken_arrays(copy) == (degrees < 0.1 ? Names{} : Names{"lrf_pcl"}));
  }
  const CaseCopy tie("edge");
  turn_frame(tie, 8, 1.0);  // the tie is over the sign of z
  CHECK(broken_arrays(tie) == Names{"lrf_pcl"});
  const CaseCopy planar("edge");
  turn_frame(planar, 22, 180.0);
  CHECK(broken_arrays(planar) == Names{"lrf_pcl"});

  const CaseCopy left_handed("edge");
  std::vector<float> frames = left_handed.values<float>("lrf_pcl");
  for (std::size_t k = 0; k < 3; ++k) frames[9 * 22 + 6 + k] *= -1.0F;  // z of a planar neighborhood, and y not
  left_handed.write_values("lrf_pcl", frames);
  CHECK(broken_arrays(left_handed) == Names{"lrf_pcl"});
  for (std::size_t k = 0; k < 3; ++k) frames[9 * 22 + 3 + k] *= -1.0F;
  left_handed.write_values("lrf_pcl", frames);
  CHECK(broken_arrays(left_handed).empty());
}

TEST_CASE("golden: a refusal to give a frame is no excuse where there is one") {
  std::vector<float> v[3] = {{0.5F, -0.4F, 0.1F, 0.2F, 0.3F, 0.1F},
                             {0.1F, 0.2F, 0.3F, -0.2F, 0.1F, 0.0F},
                             {0.0F, 0.1F, 0.0F, 0.1F, -0.1F, 0.2F}};
  std::vector<float> d2(6);
  std::vector<std::uint32_t> index = {0, 1, 2, 3, 4, 5};
  for (std::size_t i = 0; i < 6; ++i) d2[i] = (v[0][i] * v[0][i] + v[1][i] * v[1][i]) + v[2][i] * v[2][i];
  const shortshot::Neighborhood n{v[0].data(), v[1].data(), v[2].data(), d2.data(), index.data(), 6, 6, 6, {}};
  shortshot::Frame frame;
  REQUIRE(shortshot::estimate_frame(n, 1.0F, frame) == shortshot::Status::ok);
  float reference[9];
  std::memcpy(reference, &frame, sizeof reference);
  CHECK(compare_frames(n, 1.0F, shortshot::Status::ok, frame, reference).agrees);

  const shortshot::Frame none{};
  const FrameComparison refused = compare_frames(n, 1.0F, shortshot::Status::ambiguous_frame, none, reference);
  CHECK_FALSE(refused.agrees);
  CHECK(refused.cause == Cause::none);
  std::fill_n(reference, 9, std::numeric_limits<float>::quiet_NaN());
  CHECK(compare_frames(n, 1.0F, shortshot::Status::too_few_neighbors, none, reference).agrees);
  CHECK_FALSE(compare_frames(n, 1.0F, shortshot::Status::too_few_neighbors, frame, reference).agrees);  // not zeroed
  CHECK(compare_frames(n, 1.0F, shortshot::Status::ok, frame, reference).cause == Cause::none);
}

TEST_CASE("golden: broken folders are refused with the file and the reason") {
  struct Edit {
    const char *from, *to, *reason;
  };
  const Edit edits[] = {
      {"\"name\": \"edge\",", "\"name\": \"edge\" \"", "parse error"},
      {"\"radius\": 0.25", "\"radius\": -0.25", "radius: "},
      {"\"radius\": 0.25", "\"radius\": \"0.25\"", "expected a number"},
      {"\"radius\": 0.25", "\"radius\": 1e-30", "radius: "},
      {"\"radius\": 0.25", "\"radius\": 1e999", "number overflow"},
      {"\"lrf_radius\": 0.25", "\"lrf_radius\": 0", "lrf_radius: "},
      {"\"frames_are_pcl_lrf\": false", "\"frames_are_pcl_lrf\": 0", "true or false"},
      {"\"nan_frame\", ", "", "35 words for 36 key points"},
      {"\"dtype\": \"u1\", \"shape\": [2426", "\"dtype\": \"<f8\", \"shape\": [2426", "case.json:17: rgb: dtype u1"},
      {"\"dtype\": \"<f4\", \"shape\": [36, 32]", "\"dtype\": \"<i4\", \"shape\": [36, 32]", "ssh32: dtype <f4"},
      {"[2426, 3]", "[4611686018427387904, 3]", "more than 2^64 bytes"},
      {"[2426, 3]", "[3, 2426]", "points: shape [3, 3] expected"},
      {"[2426, 3]", "[2426, -3]", "whole numbers"},
      {"[36, 32]", "[72, 16]", "ssh32: shape [36, 32] expected"},
      {"[36, 32]", "[37, 32]", "needs 4736 bytes"},
      {"\"shot352.bin\"", "\"no_such.bin\"", "there is no file"},
      {"\"name\": \"ssh64\"", "\"name\": \"ssh32\"", "ssh32: "},
      {"\"arrays\"", "\"array\"", "expected a list of arrays"},
  };
  for (const Edit& edit : edits) {
    const CaseCopy copy("edge");
    copy.replace_in_json(edit.from, edit.to);
    check_refused(copy, "case.json", edit.reason);
  }
}

TEST_CASE("golden: broken files are refused with the file and the reason") {
  const CaseCopy missing("edge");
  std::filesystem::remove(missing.file("frames.bin"));
  check_refused(missing, "frames.bin", "there is no file");
  const CaseCopy truncated("edge");
  std::filesystem::resize_file(truncated.file("ssh64.bin"), 9000);
  check_refused(truncated, "ssh64.bin", "has 9000");
  for (const std::int32_t index : {2426, -1}) {
    const CaseCopy copy("edge");
    std::vector<std::int32_t> keypoints = copy.values<std::int32_t>("keypoints");
    keypoints[7] = index;
    copy.write_values("keypoints", keypoints);
    check_refused(copy, "keypoints.bin: byte 28", "there are 2426 points");
  }
  const CaseCopy empty("edge");
  std::filesystem::remove(empty.file("case.json"));
  check_refused(empty, "case.json", "no such file");
}

TEST_CASE("golden: a bad folder hides no other, arrays may be missing, nothing to check is an error") {
  const Outcome mixed = run_tool({test_data + "/no_such_case", test_data + "/cielab"});
  CHECK(mixed.code == bad_input);
  CHECK(contains(mixed.err, "no_such_case: there is no such folder"));
  CHECK(contains(mixed.out, "lab_authors"));

  const CaseCopy partial("edge");
  partial.replace_in_json("\"name\": \"rgb\"", "\"name\": \"other\"");
  const Outcome outcome = run_tool({partial.path()});
  CHECK(outcome.code == within_tolerance);
  CHECK(contains(outcome.out, "not checked: no rgb"));
  CHECK(contains(outcome.out, "not checked yet: other, "));
  partial.replace_in_json("\"name\": \"keypoints\"", "\"name\": \"another\"");
  CHECK(contains(run_tool({partial.path()}).err, "nothing to check"));
  CHECK(run_tool({partial.path()}).code == bad_input);
  CHECK(run_tool({test_data + "/README.md"}).code == bad_input);
}

}  // namespace test_golden
