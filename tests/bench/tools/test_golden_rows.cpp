// The golden tool on rows of descriptors: which differences borders between cells explain, and which nothing does.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "golden_outcome.hpp"
#include "unit/oracle.hpp"

namespace test_golden_rows {
namespace {

using namespace shortshot_bench::golden;
using golden_test::broken_arrays;
using golden_test::CaseCopy;
using golden_test::contains;
using golden_test::Names;
using golden_test::run_tool;
using golden_test::test_data;

// Adds `change` to one value of a row of edge's ssh32 that has a descriptor, and no neighbor at a border.
void tamper_ssh32(const CaseCopy& copy, float change) {
  std::vector<float> ssh32 = copy.values<float>("ssh32");
  ssh32[32 * 18 + 3] += change;
  copy.write_values("ssh32", ssh32);
}

// Replaces scsh_32_8_10's rows by those that have neighbors closer than 1e-6 cells to a place where votes jump along
// this axis on its other side: what another rounding of positions may do.
void write_scsh_with_other_sides(const CaseCopy& copy, int moved_axis) {
  const Case edge = read_case(copy.path());
  const auto radius = static_cast<float>(*edge.radius);
  std::vector<float> rows = copy.values<float>("scsh_32_8_10");
  constexpr std::size_t size = 112;
  for (std::size_t row = 0; row < edge.keypoints.size(); ++row) {
    if (std::isnan(rows[size * row])) continue;
    const std::size_t key = edge.keypoints[row];
    const float* axes = edge.frames.data() + 9 * row;
    const auto neighbors = oracle::neighbors(
        edge.points, {edge.points[3 * key], edge.points[3 * key + 1], edge.points[3 * key + 2]}, radius * radius);
    const std::vector<double> votes =
        oracle::votes(neighbors, edge.rgb, {edge.rgb[3 * key], edge.rgb[3 * key + 1], edge.rgb[3 * key + 2]},
                      oracle::given_frame(axes, axes + 3, axes + 6), radius,
                      {oracle::Voting::published, {{2, 2, 8}, {1, 1, 8, 10}}},
                      [&](int axis, double raw) {
                        const double border = std::round(2.0 * raw) / 2.0;
                        if (axis != moved_axis || std::fabs(raw - border) > 1e-6) return raw;
                        const bool is_middle = border > std::floor(border);  // and belongs to what lies below it
                        return border + ((is_middle ? raw <= border : raw < border) ? 1e-7 : -1e-7);
                      })
            .values;
    const double norm = std::sqrt(oracle::squared_norm(votes));
    if (norm == 0.0) continue;
    for (std::size_t i = 0; i < size; ++i) rows[size * row + i] = static_cast<float>(votes[i] / norm);
  }
  copy.write_values("scsh_32_8_10", rows);
}

}  // namespace

TEST_CASE("golden: a descriptor row that no border explains is broken, be it ever so close") {
  for (const float change : {2e-5F, 1e-3F, 0.2F}) {
    const CaseCopy copy("edge");
    tamper_ssh32(copy, change);
    CHECK(broken_arrays(copy) == Names{"ssh32"});
  }
  const CaseCopy copy("edge");
  tamper_ssh32(copy, 0.2F);
  CHECK(contains(run_tool({copy.path(), test_data + "/cielab"}).out, "tolerance broken: edge/ssh32\n"));
  CHECK(run_tool({copy.path(), test_data + "/cielab"}, /*verbose=*/true).code == beyond_tolerance);
  CHECK(contains(run_tool({copy.path()}, /*verbose=*/true).out, "unexplained"));
}

TEST_CASE("golden: rows with neighbors on the other side of a border are explained by its kind") {
  constexpr const char* names[] = {"shell", "elevation", "azimuth"};
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    const CaseCopy copy("edge");
    write_scsh_with_other_sides(copy, axis);
    const Report report = compare(read_case(copy.path()));
    const Result& result = *std::find_if(report.results.begin(), report.results.end(),
                                         [](const Result& r) { return r.array == "scsh_32_8_10"; });
    CAPTURE(result.note);
    CHECK_FALSE(result.broken);
    CHECK(result.explained);
    CHECK(result.beyond > 0);
    CHECK(contains(result.note, std::string(" ") + names[axis]));
  }
}

TEST_CASE("golden: a case with PCL's frames is judged more strictly") {
  const CaseCopy copy("edge");
  copy.replace_in_json("\"frames_are_pcl_lrf\": false", "\"frames_are_pcl_lrf\": true");
  tamper_ssh32(copy, 1e-3F);
  CHECK(broken_arrays(copy) ==
        Names{"lrf_pcl", "bshot", "ssh32"});  // most frames of `edge` are explained, which is too many
}

}  // namespace test_golden_rows
