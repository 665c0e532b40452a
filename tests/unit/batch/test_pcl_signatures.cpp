// Features as clouds of PCL's signatures; the structs here have PCL's members. tests/pcl does it with PCL itself.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fixtures.hpp"

namespace test_pcl_signatures {
namespace {

using namespace unit;
using ss::Status;

template <int Size>
struct Signature {
  float descriptor[Size];
  float rf[9];
};

template <int Size>
struct SignatureCloud {
  std::vector<Signature<Size>> points;
  std::uint32_t width = 7;
  std::uint32_t height = 7;
  bool is_dense = false;
};

template <class D>
ss::Features<D> describe(const TestCloud& cloud, const std::vector<int>& keypoints) {
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), ss::GridSearch(cloud.view(), 0.1f), keypoints, 0.1f, features) == Status::ok);
  return features;
}

}  // namespace

TEST_CASE("PCL signatures: rows and frames are copied") {
  const TestCloud cloud = curved_surface(1, 400);
  const auto features = describe<ss::Scsh336>(cloud, {3, 100, 399});
  SignatureCloud<336> rows;
  rows.points.resize(9);
  ss::to_pcl(features, rows);
  REQUIRE(rows.points.size() == 3);
  CHECK(rows.width == 3);
  CHECK(rows.height == 1);
  CHECK(rows.is_dense);
  for (std::size_t i = 0; i < 3; ++i) {
    REQUIRE(features.status[i] == Status::ok);
    CHECK(std::memcmp(rows.points[i].descriptor, features[i], sizeof rows.points[i].descriptor) == 0);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(rows.points[i].rf[k] == features.frames[i].x[k]);
      CHECK(rows.points[i].rf[3 + k] == features.frames[i].y[k]);
      CHECK(rows.points[i].rf[6 + k] == features.frames[i].z[k]);
    }
  }
}

TEST_CASE("PCL signatures: a key point without descriptor is not a number, and the cloud not dense") {
  TestCloud cloud = curved_surface(1, 400);
  cloud.add(9.0f, 9.0f, 9.0f);
  const auto features = describe<ss::Ssh32>(cloud, {400, 5, -1});
  SignatureCloud<32> rows;
  ss::to_pcl(features, rows);
  CHECK_FALSE(rows.is_dense);
  for (const std::size_t i : {0u, 2u}) {
    REQUIRE(features.status[i] != Status::ok);
    for (const float value : rows.points[i].descriptor) CHECK(std::isnan(value));
    for (const float value : rows.points[i].rf) CHECK(std::isnan(value));
  }
  CHECK(std::memcmp(rows.points[1].descriptor, features[1], sizeof rows.points[1].descriptor) == 0);
  ss::to_pcl(ss::Features<ss::Ssh32>{}, rows);
  CHECK(rows.points.empty());
  CHECK(rows.width == 0);
  CHECK(rows.is_dense);
}

}  // namespace test_pcl_signatures
