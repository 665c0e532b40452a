// Recognizer: what bad input gives, and mean shift next to a plain one in double precision.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "synthetic_objects.hpp"

namespace test_recognizer_input {
namespace {

using namespace unit;
using ss::Status;
using ss::detail::Vote;

constexpr ss::Point origin{0.0f, 0.0f, 0.0f};
const View object = synthetic_object(5, 20);

/// Both refuse the rows, and nothing comes of it.
void check_refused(const ss::FeatureRows& rows, Status expected) {
  ss::Recognizer recognizer;
  REQUIRE(ss::train(recognizer, object.rows(), synthetic_layout, origin, "class", "instance") == Status::ok);
  CHECK(ss::train(recognizer, rows, synthetic_layout, origin, "new", "new") == expected);
  CHECK(recognizer.class_count() == 1);
  CHECK(recognizer.instance_count() == 1);
  CHECK(recognizer.codeword_count() == 20);
  std::vector<ss::Hypothesis> found(1);
  CHECK(ss::recognize(recognizer, rows, synthetic_layout, found) == expected);
  CHECK(found.empty());
}

template <class Change>
void check_refused_after(const Change& change, Status expected) {
  View view = object;
  change(view);
  check_refused(view.rows(), expected);
  view.status[7] = Status::too_few_neighbors;  // nobody looks at that row now
  ss::Recognizer recognizer;
  CHECK(ss::train(recognizer, view.rows(), synthetic_layout, origin, "class", "instance") == Status::ok);
}

double density_at(const std::vector<Vote>& votes, const double (&at)[3], double bandwidth, double (&mean)[3]) {
  double density = 0.0;
  double sums[3] = {};
  for (const Vote& vote : votes) {
    double d2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = static_cast<double>(ss::extend::coordinate(vote.center, k)) - at[k];
      d2 += d * d;
    }
    const double w = std::exp(-d2 / (2.0 * bandwidth * bandwidth));
    density += w;
    for (std::size_t k = 0; k < 3; ++k) sums[k] += w * static_cast<double>(ss::extend::coordinate(vote.center, k));
  }
  for (std::size_t k = 0; k < 3; ++k) mean[k] = sums[k] / density;
  return density;
}

}  // namespace

TEST_CASE("recognizer: rows that cannot be used") {
  const ss::FeatureRows rows = object.rows();
  const ss::DescriptorRows& d = rows.descriptors;
  check_refused({{nullptr, d.count, d.size, d.status}, rows.keypoints, rows.frames}, Status::bad_rows);
  check_refused({{d.values, d.count, 0, d.status}, rows.keypoints, rows.frames}, Status::bad_rows);
  check_refused({d, nullptr, rows.frames}, Status::bad_rows);
  check_refused({d, rows.keypoints, nullptr}, Status::bad_rows);
  check_refused({{d.values, d.count, d.size - 1, d.status}, rows.keypoints, rows.frames}, Status::other_descriptor);
  check_refused_after([](View& v) { v.values[7 * synthetic_size + 3] = not_a_number; }, Status::bad_rows);
  check_refused_after([](View& v) { v.values[7 * synthetic_size + 3] = -infinity; }, Status::bad_rows);
  check_refused_after([](View& v) { v.keypoints[7].position.y = not_a_number; }, Status::invalid_keypoint);
  check_refused_after([](View& v) { v.frames[7].x[0] = not_a_number; }, Status::bad_frame);
  check_refused_after([](View& v) { v.frames[7] = {}; }, Status::bad_frame);
}

TEST_CASE("recognizer: descriptors of another layout, centers that are none, options out of range") {
  ss::Recognizer recognizer;
  CHECK(ss::train(recognizer, object.rows(), synthetic_layout, {0.0f, infinity, 0.0f}, "c", "i") ==
        Status::invalid_keypoint);
  CHECK(recognizer.codeword_count() == 0);
  REQUIRE(ss::train(recognizer, object.rows(), synthetic_layout, origin, "c", "i") == Status::ok);
  CHECK(ss::train(recognizer, object.rows(), "synthetic, other", origin, "c", "i") == Status::other_descriptor);
  std::vector<ss::Hypothesis> found(1);
  CHECK(ss::recognize(recognizer, object.rows(), "synthetic, other", found) == Status::other_descriptor);
  CHECK(found.empty());

  const std::vector<ss::RecognizerOptions> wrong{{0.0f, 1, 8},     {-0.03f, 1, 8},   {not_a_number, 1, 8},
                                                 {infinity, 1, 8}, {1e-7f, 1, 8},    {1e7f, 1, 8},
                                                 {0.03f, 0, 8},    {0.03f, 1025, 8}, {0.03f, 1, 0}};
  for (const ss::RecognizerOptions& options : wrong) {
    recognizer.set_options(options);
    found.resize(1);
    CHECK(ss::recognize(recognizer, object.rows(), synthetic_layout, found) == Status::bad_option);
    CHECK(found.empty());
  }
}

TEST_CASE("recognizer: places at the ends of float's range give no infinity") {
  const auto far_away = [](float x) {
    View view = object;
    for (ss::KeyPoint& key : view.keypoints) key.position = {x, x, x};
    return view;
  };
  ss::Recognizer recognizer;
  CHECK(ss::train(recognizer, far_away(3e38f).rows(), synthetic_layout, {-3e38f, 0.0f, 0.0f}, "c", "i") ==
        Status::invalid_keypoint);
  CHECK(recognizer.codeword_count() == 0);
  REQUIRE(ss::train(recognizer, object.rows(), synthetic_layout, {1e38f, 0.0f, 0.0f}, "c", "i") == Status::ok);
  std::vector<ss::Hypothesis> found;
  for (const float x : {0.0f, 1e20f, 3.4e38f}) {
    REQUIRE(ss::recognize(recognizer, far_away(x).rows(), synthetic_layout, found) == Status::ok);
    for (const ss::Hypothesis& hypothesis : found) {
      CHECK(ss::is_finite(hypothesis.center));
      CHECK(hypothesis.score >= 1.0f);
      CHECK(hypothesis.score <= 20.0f);
    }
  }
}

TEST_CASE("mean shift: e^-t") {
  double worst = 0.0;
  for (int i = 0; i <= 80000; ++i) {
    const float t = 0.001f * static_cast<float>(i);
    const double expected = std::exp(-static_cast<double>(t));
    worst = std::max(worst, std::fabs(static_cast<double>(ss::detail::exp_minus(t)) / expected - 1.0));
  }
  MESSAGE("largest relative error: ", worst);
  CHECK(worst < 3e-7);
  CHECK(ss::detail::exp_minus(0.0f) == 1.0f);
}

TEST_CASE("mean shift: climbs to where the density in double precision has its maxima") {
  Random random(11);
  constexpr float bandwidth = 0.03f;
  constexpr double h = 0.03;
  std::vector<Vote> votes;
  for (int i = 0; i < 300; ++i) {
    const float at = i % 3 == 0 ? 0.2f : 0.0f;  // two heaps, and votes all over the place
    const float spread = i % 5 == 0 ? 0.3f : 0.04f;
    votes.push_back({{at + random.between(-spread, spread), random.between(-spread, spread),
                      5.0f + random.between(-spread, spread)},
                     0,
                     0});
  }
  const ss::detail::MeanShift shift(votes.data(), votes.data() + votes.size(), bandwidth);
  ss::detail::MeanShift::Memory memory(votes.size());
  for (const Vote& vote : votes) {
    const ss::detail::Peak peak = shift.climb(vote, memory);
    const double at[3] = {static_cast<double>(peak.at.x), static_cast<double>(peak.at.y),
                          static_cast<double>(peak.at.z)};
    double mean[3];
    CHECK(static_cast<double>(peak.density) == doctest::Approx(density_at(votes, at, h, mean)).epsilon(1e-5));
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::fabs(mean[k] - at[k]) < 2e-3 * h);
    const double start[3] = {static_cast<double>(vote.center.x), static_cast<double>(vote.center.y),
                             static_cast<double>(vote.center.z)};
    CHECK(static_cast<double>(peak.density) > density_at(votes, start, h, mean) - 1e-4);
  }
}

TEST_CASE("mean shift: never down, even where coordinates are coarser than the bandwidth") {
  Random random(13);
  const float step = 1.0f / 16384.0f;  // the distance of floats at 1000
  std::vector<Vote> votes;
  const auto coarse = [&] { return 1000.0f + step * static_cast<float>(random.below(20)); };
  for (int i = 0; i < 300; ++i) votes.push_back({{coarse(), coarse(), coarse()}, 0, 0});
  for (const float bandwidth : {0.2f * step, 0.5f * step, step, 2.0f * step}) {
    const ss::detail::VoteDensity density(bandwidth);
    const ss::detail::MeanShift shift(votes.data(), votes.data() + votes.size(), bandwidth);
    ss::detail::MeanShift::Memory memory(votes.size());
    for (const Vote& vote : votes) {
      float at_vote = 0.0f;
      for (const Vote& other : votes) at_vote += density.weight(other, vote.center);
      CHECK(shift.climb(vote, memory).density >= at_vote);
    }
  }
}

}  // namespace test_recognizer_input
