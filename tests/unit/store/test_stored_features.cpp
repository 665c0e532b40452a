// Features in every storage: as bytes and back, in files, what they are refused as, and every byte damaged.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "temporary_folder.hpp"

namespace test_stored_features {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor32;

ss::Features<D> made_up(std::uint32_t seed, std::size_t count) {
  Random random(seed);
  ss::Features<D> features;
  for (std::size_t i = 0; i < count; ++i) {
    const bool ok = random.below(4) != 0;
    for (int v = 0; v < D::size; ++v) features.values.push_back(ok ? random.between(-0.3f, 0.5f) : 0.0f);
    features.status.push_back(ok ? Status::ok : Status::too_few_neighbors);
    ss::KeyPoint key{};
    key.position = {random.between(-1.0f, 1.0f), 2.0f, 3.0f};
    features.keypoints.push_back(key);
    features.frames.push_back(ss::Frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}});
    features.frame_confidence.push_back({random.between(0.0f, 1.0f), 0.5f, 0.25f});
    features.neighbors.push_back(static_cast<std::uint32_t>(random.below(100)));
  }
  return features;
}

template <class Stored>
bool same(const ss::StoredFeatures<Stored>& a, const ss::StoredFeatures<Stored>& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
  };
  bool positions = a.keypoints.size() == b.keypoints.size();
  for (std::size_t i = 0; positions && i < a.size(); ++i) {
    positions = a.keypoints[i].position.x == b.keypoints[i].position.x;
  }
  return equal(a.descriptors, b.descriptors) && a.status == b.status && positions && equal(a.frames, b.frames) &&
         equal(a.frame_confidence, b.frame_confidence) && a.neighbors == b.neighbors;
}

template <class Stored>
void check_storage() {
  const ss::Features<D> features = made_up(1, 20);
  ss::StoredFeatures<Stored> stored, back;
  REQUIRE(ss::store(features, stored) == Status::ok);
  REQUIRE((stored.size() == 20 && stored.descriptors.size() == 20));
  std::vector<std::uint8_t> bytes;
  REQUIRE(ss::save(stored, bytes) == Status::ok);
  REQUIRE(ss::load(bytes.data(), bytes.size(), back) == Status::ok);
  CHECK(same(stored, back));

  const ss::StoredFeatures<Stored> before = back;
  for (std::size_t i = 0; i < bytes.size(); i += 1 + i / 40) {
    bytes[i] ^= 0x10u;
    REQUIRE(ss::load(bytes.data(), bytes.size(), back) != Status::ok);
    bytes[i] ^= 0x10u;
    REQUIRE(ss::load(bytes.data(), i, back) != Status::ok);
  }
  CHECK(same(before, back));
  ss::Features<D> floats;
  CHECK(ss::load(bytes.data(), bytes.size(), floats) == Status::other_descriptor);
  REQUIRE(ss::save(features, bytes) == Status::ok);
  CHECK(ss::load(bytes.data(), bytes.size(), back) == Status::other_descriptor);

  stored.neighbors.pop_back();
  CHECK(ss::save(stored, bytes) == Status::bad_rows);
  CHECK(bytes.empty());
  ss::Features<D> broken = features;
  broken.values.pop_back();
  CHECK(ss::store(broken, stored) == Status::bad_rows);
  CHECK(stored.size() == 0);

  REQUIRE(ss::store(ss::Features<D>{}, stored) == Status::ok);
  REQUIRE(ss::save(stored, bytes) == Status::ok);
  CHECK(ss::load(bytes.data(), bytes.size(), back) == Status::ok);
  CHECK(back.size() == 0);
}

}  // namespace

TEST_CASE_TEMPLATE("stored features: as bytes and back; damage, and other storages, are refused", Stored,
                   ss::HalfDescriptor<D>, ss::ByteDescriptor<D>, ss::NibbleDescriptor<D>, ss::CodedDescriptor<D, 3>,
                   ss::BinaryDescriptor<D>, ss::SumBits<D>) {
  check_storage<Stored>();
}

TEST_CASE("stored features: another scale is another storage; in files") {
  const TemporaryFolder folder;
  const std::string path = folder / "features";
  ss::StoredFeatures<ss::NibbleDescriptor<D>> nibbles, back;
  ss::StoredFeatures<ss::NibbleDescriptor<D, 50>> finer;
  ss::StoredFeatures<ss::CodedDescriptor<D, 3>> thirds;
  CHECK(ss::load(path, back) == Status::no_file);
  REQUIRE(ss::store(made_up(2, 9), nibbles) == Status::ok);
  REQUIRE(ss::save(nibbles, path) == Status::ok);
  CHECK(ss::load(path, finer) == Status::other_descriptor);
  CHECK(ss::load(path, thirds) == Status::other_descriptor);
  REQUIRE(ss::load(path, back) == Status::ok);
  CHECK(same(nibbles, back));
}

TEST_CASE("stored features: halves that are no numbers are neither saved nor loaded") {
  ss::StoredFeatures<ss::HalfDescriptor<D>> halves;
  REQUIRE(ss::store(made_up(3, 2), halves) == Status::ok);
  halves.descriptors[1].values[5] = 0x7C00;
  std::vector<std::uint8_t> bytes;
  CHECK(ss::save(halves, bytes) == Status::bad_rows);
}

TEST_CASE("stored features: a whole cloud in one call is what its features are stored as") {
  const TestCloud cloud = curved_surface(4, 3000);
  const ss::CloudView view = cloud.view();
  ss::CloudOptions options;
  options.radius = 0.1f;
  options.leaf = 0.03f;
  ss::Features<D> features;
  REQUIRE(ss::describe_cloud(view, options, features) == Status::ok);
  REQUIRE(features.size() > 20);
  ss::StoredFeatures<ss::NibbleDescriptor<D>> one_by_one, at_once;
  REQUIRE(ss::store(features, one_by_one) == Status::ok);
  REQUIRE(ss::describe_cloud(view, options, at_once) == Status::ok);
  CHECK(same(one_by_one, at_once));
  const ss::NibbleRows rows = ss::rows_of(at_once);
  CHECK((rows.count == features.size() && rows.status == at_once.status.data()));
  options.radius = -1.0f;
  CHECK(ss::describe_cloud(view, options, at_once) == Status::bad_radius);
  CHECK(at_once.size() == 0);
}

}  // namespace test_stored_features
