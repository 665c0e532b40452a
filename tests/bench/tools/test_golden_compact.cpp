// The golden tool on descriptors whose parts take roots and whose votes do not jump, and on their nibbles.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "golden_case_copy.hpp"
#include "golden_outcome.hpp"
#include "tools/golden/case.hpp"
#include "tools/golden/compare.hpp"
#include "tools/golden/descriptors.hpp"
#include "tools/golden/tool.hpp"

namespace test_golden_compact {
namespace {

using namespace shortshot_bench::golden;
using golden_test::broken_arrays;
using golden_test::CaseCopy;
using golden_test::Names;
using golden_test::test_data;

}  // namespace

TEST_CASE("golden: the compact descriptors are within tolerance, nibbles too") {
  std::vector<std::string> folders;
  for (const char* name : {"relief", "edge", "noise", "bare"}) folders.push_back(test_data + "/compact_" + name);
  std::ostringstream out, err;
  const ExitCode code = run(folders, /*verbose=*/true, out, err);
  CAPTURE(out.str());
  CHECK(code == within_tolerance);
  CHECK(err.str().empty());
  for (const char* name : {"shape_color95", "shape_color32", "room_color95", "height_shape96", "color_rings27"}) {
    CHECK(out.str().find(std::string(name) + "_nibbles") != std::string::npos);
  }
}

TEST_CASE("golden: rows with roots have ten times the room that sums have, and no row may jump") {
  CHECK(find_descriptor("scsh336")->row_l2 == 1e-5);
  CHECK(find_descriptor("scsh336")->sharing == Sharing::published);
  for (const char* name : {"shape_color95", "shape_color32", "room_color95", "height_shape96", "color_rings27"}) {
    CHECK(find_descriptor(name)->row_l2 == 1e-4);
    CHECK(find_descriptor(name)->sharing == Sharing::continuous);
  }
  for (const float change : {2e-5F, 2e-4F}) {
    const CaseCopy copy("compact_relief");
    std::vector<float> rows = copy.values<float>("height_shape96");
    std::size_t full = 192 * 5;
    while (rows[full] < 0.05F) ++full;
    rows[full] += change;
    copy.write_values("height_shape96", rows);
    CHECK(broken_arrays(copy) == (change < 1e-4F ? Names{} : Names{"height_shape96"}));
  }
}

TEST_CASE("golden: a nibble may be one step off where its value is on the border between both") {
  for (const float distance : {0.5e-4F, 2e-4F}) {
    const CaseCopy copy("compact_noise");
    std::vector<float> rows = copy.values<float>("room_color95");
    std::vector<std::uint8_t> nibbles = copy.values<std::uint8_t>("room_color95_nibbles");
    std::size_t i = 190 * 3;  // the low half of a byte; value and code moved to either side of a border
    while ((nibbles[i / 2] & 15) < 2 || (nibbles[i / 2] & 15) > 13) i += 2;
    const int code = nibbles[i / 2] & 15;
    rows[i] = (static_cast<float>(code) + 0.5F) / 50.0F + distance;
    nibbles[i / 2] = static_cast<std::uint8_t>(nibbles[i / 2] + 1);
    copy.write_values("room_color95", rows);
    copy.write_values("room_color95_nibbles", nibbles);
    CHECK(broken_arrays(copy) ==
          (distance < 1e-4F ? Names{"room_color95"} : Names{"room_color95", "room_color95_nibbles"}));
    nibbles[i / 2] = static_cast<std::uint8_t>(nibbles[i / 2] + 1);  // two steps
    copy.write_values("room_color95_nibbles", nibbles);
    CHECK(broken_arrays(copy) == Names{"room_color95", "room_color95_nibbles"});
  }
}

}  // namespace test_golden_compact
