// What Extractor<D, PackedLab> costs in accuracy on the generated scene: as PackedLab's comment states it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <shortshot/shortshot.hpp>
#include <vector>

#include "tools/scene/tabletop.hpp"

namespace test_packed_colors {
namespace {

struct Difference {
  double largest_l2 = 0.0;  // of one descriptor
  double mean_l2 = 0.0;
};

template <class D>
Difference difference_by_packing() {
  const shortshot_bench::RgbdCloud scene = shortshot_bench::make_tabletop();
  const shortshot::CloudView cloud = shortshot::view_xyz_rgb(scene.xyz.data(), scene.rgb.data(), scene.size());
  const shortshot::GridSearch search(cloud, 0.04f);
  std::vector<std::uint32_t> keypoints;
  REQUIRE(shortshot::sample_uniform(cloud, 0.04f, keypoints) == shortshot::Status::ok);
  shortshot::Features<D> exact;
  shortshot::Extractor<D, shortshot::PackedLab> extractor;
  shortshot::Features<D> packed;
  REQUIRE(shortshot::extract(cloud, search, keypoints, 0.04f, exact) == shortshot::Status::ok);
  REQUIRE(extractor.extract(cloud, search, keypoints, 0.04f, packed) == shortshot::Status::ok);
  REQUIRE(exact.status == packed.status);
  Difference result;
  std::size_t described = 0;
  for (std::size_t row = 0; row < exact.size(); ++row) {
    if (exact.status[row] != shortshot::Status::ok) continue;
    ++described;
    double squared = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(D::size); ++i) {
      const double d = static_cast<double>(exact[row][i]) - static_cast<double>(packed[row][i]);
      squared += d * d;
    }
    result.largest_l2 = std::max(result.largest_l2, std::sqrt(squared));
    result.mean_l2 += std::sqrt(squared);
  }
  REQUIRE(described > 500);
  result.mean_l2 /= static_cast<double>(described);
  return result;
}

template <class D>
void check_difference(double mean_l2, double largest_l2) {
  const Difference d = difference_by_packing<D>();
  CHECK(d.mean_l2 > 0.0);
  CHECK(d.mean_l2 <= mean_l2);
  CHECK(d.largest_l2 <= largest_l2);
}

}  // namespace

TEST_CASE("packed colors: descriptors of the generated scene differ by no more than stated") {
  check_difference<shortshot::Scsh336>(0.001, 0.016);
  check_difference<shortshot::Scsh696>(0.003, 0.027);
}

}  // namespace test_packed_colors
