// The table of how far normals of depth images are from the exact ones.

#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/image_normals/normal_errors.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_normal_errors {
namespace {

using namespace shortshot_bench;

double median(std::vector<double> errors) {
  REQUIRE(errors.size() > 200);
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() / 2];
}

std::size_t columns_of(const std::string& row) {
  return static_cast<std::size_t>(std::count(row.begin(), row.end(), '|')) - 1;
}

}  // namespace

TEST_CASE("normals of the image are near the exact ones where there is no edge, and fewer than 3 % are missing") {
  const RgbdCloud scene = make_tabletop({1, 320, 240, 0.5f});
  NormalErrors errors;
  add_errors(scene, 0.03f, errors);
  CHECK(errors.exact == errors.all.size() + errors.missing);
  CHECK(errors.missing * 100 < errors.exact * 3);
  std::size_t sum = 0;
  for (const std::vector<double>& range : errors.by_edge_distance) sum += range.size();
  CHECK(sum == errors.all.size());
  CHECK(median(errors.all) < 1.5);
  CHECK(median(errors.by_depth[0]) < 0.7);
  CHECK(median(errors.by_depth[0]) < median(errors.by_edge_distance[0]));

  const std::string row = row_of_errors("scene", 0.03f, errors), heading = heading_of_errors();
  CHECK(row.rfind("| scene | 30 | ", 0) == 0);
  CHECK(row.back() == '\n');
  CHECK(columns_of(row) == columns_of(heading.substr(0, heading.find('\n'))));
  CHECK(row_of_errors("", 0.0f, {}).find("nan") == std::string::npos);
}

TEST_CASE("a cloud without rows has no table, and says why") {
  RgbdCloud scene = make_tabletop({1, 64, 48, 1.0f});
  scene.width = scene.size();
  scene.height = 1;
  NormalErrors errors;
  CHECK_THROWS_AS(add_errors(scene, 0.03f, errors), std::runtime_error);
}

}  // namespace test_normal_errors
