// What ByteDescriptor costs in accuracy on a generated scene that is seen twice: as its comment states it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <shortshot/shortshot.hpp>
#include <vector>

#include "tools/scene/tabletop.hpp"

namespace test_byte_descriptors {
namespace {

template <class D>
struct View {
  std::vector<std::vector<float>> floats;
  std::vector<shortshot::ByteDescriptor<D>> bytes;
};

/// The same objects in every size, with other pixels and other noise.
template <class D>
View<D> view_of_scene(std::size_t width, std::size_t height) {
  shortshot_bench::TabletopOptions options;
  options.width = width;
  options.height = height;
  const shortshot_bench::RgbdCloud scene = shortshot_bench::make_tabletop(options);
  const shortshot::CloudView cloud = shortshot::view_xyz_rgb(scene.xyz.data(), scene.rgb.data(), scene.size());
  const shortshot::GridSearch search(cloud, 0.04f);
  std::vector<std::uint32_t> keypoints;
  shortshot::Features<D> features;
  REQUIRE(shortshot::sample_uniform(cloud, 0.06f, keypoints) == shortshot::Status::ok);
  REQUIRE(shortshot::extract(cloud, search, keypoints, 0.04f, features) == shortshot::Status::ok);
  View<D> view;
  for (std::size_t row = 0; row < features.size(); ++row) {
    if (features.status[row] != shortshot::Status::ok) continue;
    view.floats.emplace_back(features[row], features[row] + D::size);
    view.bytes.emplace_back();
    shortshot::quantize(features[row], view.bytes.back());
  }
  return view;
}

double distance(const std::vector<float>& a, const std::vector<float>& b) {
  double squared = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    squared += difference * difference;
  }
  return std::sqrt(squared);
}

/// The place of what is nearest to `query`.
template <class Descriptor, class Distance>
std::size_t nearest(const Descriptor& query, const std::vector<Descriptor>& all, const Distance& distance_of) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (distance_of(query, all[i]) < distance_of(query, all[best])) best = i;
  }
  return best;
}

template <class D>
void check_neighbors(double same_at_least, double error_at_most, double farther_at_most) {
  using Bytes = shortshot::ByteDescriptor<D>;
  const View<D> queries = view_of_scene<D>(640, 480), others = view_of_scene<D>(600, 450);
  REQUIRE(queries.floats.size() > 500);
  REQUIRE(others.floats.size() > 500);
  double same = 0.0, squared_error = 0.0, farther = 1.0;
  for (std::size_t i = 0; i < queries.floats.size(); ++i) {
    const std::size_t expected = nearest(queries.floats[i], others.floats, distance);
    const std::size_t found = nearest(queries.bytes[i], others.bytes, shortshot::squared_distance<D, 8, 512>);
    const double truth = distance(queries.floats[i], others.floats[found]);
    const double measured = static_cast<double>(Bytes::step) *
                            std::sqrt(shortshot::squared_distance(queries.bytes[i], others.bytes[found]));
    same += found == expected ? 1.0 : 0.0;
    squared_error += (measured - truth) * (measured - truth);
    farther = std::max(farther, truth / distance(queries.floats[i], others.floats[expected]));
  }
  const auto count = static_cast<double>(queries.floats.size());
  const double share = same / count, error = std::sqrt(squared_error / count);
  CAPTURE(share);
  CAPTURE(error);
  CAPTURE(farther);
  CHECK(share >= same_at_least);
  CHECK(share < 1.0);  // else nothing is measured
  CHECK(error <= error_at_most);
  CHECK(farther <= farther_at_most);
}

}  // namespace

TEST_CASE("byte descriptors: nearest neighbors in another view of the generated scene are as stated") {
  check_neighbors<shortshot::Ssh32>(0.92, 0.0015, 1.11);
  check_neighbors<shortshot::Scsh336>(0.94, 0.0015, 1.11);
}

}  // namespace test_byte_descriptors
