// For test_status.cpp: calls of matching, poses and the recognizer that end in each of their own statuses.
#pragma once

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

#include "fixtures.hpp"

namespace unit {

/// A memory that takes nothing.
struct WornOut {
  static constexpr std::size_t unit_bytes = 1;
  std::uint8_t content[256];

  [[nodiscard]] const std::uint8_t* bytes() const { return content; }
  [[nodiscard]] std::size_t size_bytes() const { return sizeof content; }
  static bool write(std::size_t, const std::uint8_t*) { return true; }
};

/// What matching, poses and recognition can say besides.
inline std::set<ss::Status> reached_by_recognition(const ss::Frame& frame) {
  using ss::Status;
  const float value = 1.0f;
  const ss::KeyPoint origin{};
  const ss::FeatureRows row{{&value, 1, 1, nullptr}, &origin, &frame};
  std::vector<ss::Match> matches;
  std::vector<ss::Hypothesis> objects;
  std::vector<std::uint32_t> inliers;
  ss::Pose pose{};
  ss::Recognizer recognizer;
  std::set<Status> reached{ss::nearest(row.descriptors, {&value, 1, 0, nullptr}, 1, matches),
                           ss::nearest(row.descriptors, row.descriptors, 0, matches),
                           ss::estimate_pose(std::vector<ss::PointPair>(2), {}, pose, inliers),
                           ss::estimate_pose(std::vector<ss::PointPair>(3), {}, pose, inliers),
                           ss::recognize(recognizer, row, "a", objects)};
  REQUIRE(ss::train(recognizer, row, "a", {}, "class", "instance") == Status::ok);
  std::vector<std::uint8_t> model;
  REQUIRE(ss::save(recognizer, model) == Status::ok);
  const auto load = [&](std::size_t size, const char* layout) {
    return ss::load(model.data(), size, layout, recognizer);
  };
  reached.insert({load(model.size(), "b"), load(model.size() - 1, "a"), ss::load("/no/file", "a", recognizer)});
  model[8] ^= 0x80u;  // in the format's version, which follows the magic
  reached.insert(load(model.size(), "a"));
  model[0] = 0;
  reached.insert(load(model.size(), "a"));

  using Stored = ss::NibbleDescriptor<ss::ShapeColor32>;
  WornOut memory{};
  std::memset(memory.content, 0xFF, sizeof memory.content);
  ss::LearnedObjects<Stored, WornOut> learned;
  REQUIRE(learned.open(ss::ModelView<Stored>(ss::RecognizerOptions{}), memory) == Status::ok);
  reached.insert(learned.add({{}, {}, frame}, {}));
  return reached;
}

}  // namespace unit
