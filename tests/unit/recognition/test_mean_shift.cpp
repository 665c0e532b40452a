// Mean shift next to a plain one that looks at all votes for each step: the same bits, whatever the votes, the
// bandwidth and the order of climbs.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "synthetic_objects.hpp"

namespace test_mean_shift {
namespace {

using namespace unit;
using ss::detail::MeanShift;
using ss::detail::Peak;
using ss::detail::Vote;
using ss::extend::unfused;

float plain_exp_minus(float t) {
  const auto halvings = (static_cast<std::int32_t>(t * 2.88539008f) + 1) / 2;
  const auto n = static_cast<float>(halvings);
  const float r = (unfused(n * 0.693359375f) - t) - unfused(n * 2.12194440e-4f);
  float sum = 1.0f / 720.0f;
  for (const float c : {1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f}) sum = c + unfused(r * sum);
  return unfused(sum * ss::extend::math::float_of(static_cast<std::uint32_t>(127 - halvings) << 23));
}

Peak plain_climb(const Vote* begin, const Vote* end, float bandwidth, const Vote& vote) {
  const float reach_d2 = 6.0f * 6.0f * bandwidth * bandwidth;
  const float still_d2 = 1e-3f * 1e-3f * bandwidth * bandwidth;
  const float factor = 0.5f / (bandwidth * bandwidth);
  Peak peak{vote.center, 0.0f};
  ss::Point at = vote.center;
  for (int step = 0; step < 100; ++step) {
    float density = 0.0f;
    ss::Point shift{};
    for (const Vote* other = begin; other != end; ++other) {
      const float d2 = ss::squared_distance(other->center, at);
      if (!(d2 < reach_d2)) continue;
      const float w = plain_exp_minus(unfused(factor * d2));
      density += w;
      shift.x += unfused(w * (other->center.x - at.x));
      shift.y += unfused(w * (other->center.y - at.y));
      shift.z += unfused(w * (other->center.z - at.z));
    }
    if (!(density > peak.density)) break;
    peak = {at, density};
    at = {at.x + shift.x / density, at.y + shift.y / density, at.z + shift.z / density};
    if (!(ss::squared_distance(at, peak.at) > still_d2)) break;
  }
  return peak;
}

bool same_bits(const Peak& a, const Peak& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Climbs in the votes' order, cell by cell, and each with fresh memory.
void check_like_plain(const std::vector<Vote>& votes, float bandwidth) {
  const Vote* const begin = votes.data();
  const MeanShift shift(begin, begin + votes.size(), bandwidth);
  MeanShift::Memory memory(votes.size());
  std::vector<Peak> peaks;
  std::size_t others = 0;
  for (const Vote& vote : votes) {
    MeanShift::Memory fresh(votes.size());
    peaks.push_back(plain_climb(begin, begin + votes.size(), bandwidth, vote));
    others += same_bits(shift.climb(vote, memory), peaks.back()) ? 0u : 1u;
    others += same_bits(shift.climb(vote, fresh), peaks.back()) ? 0u : 1u;
  }
  std::size_t visited = 0;
  shift.for_each_vote([&](std::size_t i) {
    ++visited;
    others += same_bits(shift.climb(votes[i], memory), peaks[i]) ? 0u : 1u;
  });
  CHECK(visited == votes.size());
  CHECK(others == 0);
}

/// Where the hypotheses are: the densest peak, then the densest one that is not near it, and so on.
std::vector<std::size_t> plain_choice(const std::vector<Vote>& votes, const std::vector<Peak>& peaks, float bandwidth,
                                      std::size_t most) {
  std::vector<std::size_t> chosen;
  std::vector<bool> is_known(peaks.size());
  while (chosen.size() < most) {
    std::size_t densest = peaks.size();
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      if (!is_known[i] && (densest == peaks.size() || peaks[i].density > peaks[densest].density)) densest = i;
    }
    if (densest == peaks.size()) break;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      const bool close = ss::squared_distance(peaks[densest].at, peaks[i].at) <= bandwidth * bandwidth;
      if (close && votes[i].object_class == votes[densest].object_class) is_known[i] = true;
    }
    chosen.push_back(densest);
  }
  return chosen;
}

Vote vote_at(float x, float y, float z) { return {{x, y, z}, 0, 0}; }

/// Three heaps, and votes all over a cube, mixed.
std::vector<Vote> spread(std::uint32_t seed, std::size_t count, float cube, float heap, float offset) {
  Random random(seed);
  const auto in = [&](float half) { return random.between(-half, half); };
  std::vector<ss::Point> middles;
  for (int k = 0; k < 3; ++k) middles.push_back({in(cube), in(cube), in(cube)});
  std::vector<Vote> votes;
  while (votes.size() < count) {
    const bool heaped = random.below(2) == 0;
    const ss::Point m = heaped ? middles[random.below(3)] : ss::Point{};
    const float half = heaped ? heap : cube;
    votes.push_back(vote_at(m.x + in(half) + offset, m.y + in(half), m.z + in(half)-offset));
  }
  return votes;
}

}  // namespace

TEST_CASE("mean shift: the same bits as with a look at all votes") {
  std::uint32_t seed = 1;
  for (const float bandwidth : {0.002f, 0.03f, 0.2f, 5.0f}) {
    for (const float cube : {0.05f, 0.5f, 3.0f}) {
      for (const std::size_t count : {1u, 2u, 3u, 37u, 150u})
        check_like_plain(spread(seed++, count, cube, 0.02f, 0.0f), bandwidth);
    }
  }
}

TEST_CASE("mean shift: the same bits far from the origin, and at the ends of the bandwidth") {
  std::uint32_t seed = 100;
  for (const float offset : {1e3f, 1e5f, 1e8f, 1e19f})
    check_like_plain(spread(seed++, 100, 0.5f, 0.02f, offset), 0.03f);
  check_like_plain(spread(seed++, 100, 2e-5f, 2e-6f, 0.0f), 1e-6f);
  check_like_plain(spread(seed++, 100, 1e3f, 1e-5f, 1e2f), 1e-6f);
  check_like_plain(spread(seed++, 100, 2e7f, 1e6f, 0.0f), 1e6f);
  check_like_plain(spread(seed++, 100, 1.0f, 0.1f, 0.0f), 1e6f);
}

TEST_CASE("mean shift: the same bits where votes are degenerate") {
  check_like_plain({}, 0.03f);
  check_like_plain(std::vector<Vote>(77, vote_at(0.1f, 0.2f, 0.3f)), 0.03f);
  check_like_plain({vote_at(-3e38f, 3e38f, 0.0f), vote_at(3e38f, -3e38f, 0.0f)}, 0.03f);
  std::vector<Vote> line;  // on the cells' borders, and where coordinates are twice as far apart as the reach
  for (int i = -20; i <= 20; ++i) line.push_back(vote_at(0.0202702f * static_cast<float>(i), 0.0f, -0.0f));
  check_like_plain(line, 0.003f);
  std::vector<Vote> far_apart;
  for (const float x : {0.0f, 0.01f, -1e30f, 1e30f, 1e30f, -1e-30f, 1e-40f, 3.4e38f, -3.4e38f, 1.0f})
    for (const float y : {0.0f, -1e30f, 0.02f}) far_apart.push_back(vote_at(x, y, x));
  check_like_plain(far_apart, 0.03f);
  check_like_plain(far_apart, 1e6f);
}

TEST_CASE("mean shift: a look at few votes finds all that are close, in their order") {
  const std::vector<Vote> votes = spread(7, 4000, 2.0f, 0.3f, 0.0f);
  constexpr float distance = 0.2f;
  const ss::detail::VoteCells cells(votes.data(), votes.data() + votes.size(), distance);
  ss::detail::VoteCells::Memory memory(votes.size());
  Random random(8);
  std::size_t seen = 0;
  for (int k = 0; k < 400; ++k) {
    const ss::Point place{random.between(-2.3f, 2.3f), random.between(-2.3f, 2.3f), random.between(-2.3f, 2.3f)};
    const ss::detail::VoteCenters found = cells.around(place, memory);
    seen += found.padded;
    std::size_t i = 0;
    for (const Vote& vote : votes) {
      if (distance < unit::distance(vote.center, place)) continue;
      const auto is_vote = [&] {
        return found.x[i] == vote.center.x && found.y[i] == vote.center.y && found.z[i] == vote.center.z;
      };
      while (i < found.padded && !is_vote()) ++i;
    }
    CHECK((found.padded == 0 || i < found.padded));
  }
  CHECK(seen < 400 * votes.size() / 20);
}

TEST_CASE("mean shift: hypotheses are the densest peaks that are not near a denser one of their class") {
  ss::Recognizer recognizer;
  const View object = synthetic_object(3, 1);
  for (const char* name : {"a", "b", "c"})
    REQUIRE(ss::train(recognizer, object.rows(), synthetic_layout, {}, name, name) == ss::Status::ok);
  Random random(31);
  for (const std::size_t count : {0u, 1u, 20u, 300u}) {
    for (const std::uint32_t most : {1u, 8u, 1000u}) {
      std::vector<Vote> votes;
      std::vector<Peak> peaks;
      for (std::size_t i = 0; i < count; ++i) {
        const auto object_class = static_cast<std::uint32_t>(3 * i / count);
        const auto whole = [&] { return static_cast<float>(random.below(6)); };  // many are equal, or exactly as near
        peaks.push_back({{whole(), whole(), whole()}, whole()});
        votes.push_back({peaks.back().at, object_class, object_class});
      }
      recognizer.set_options({1.0f, 1, most});
      std::vector<ss::Hypothesis> found;
      ss::detail::choose(recognizer, votes, peaks, found);
      const std::vector<std::size_t> expected = plain_choice(votes, peaks, 1.0f, most);
      REQUIRE(found.size() == expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        CHECK(found[k].object_class == votes[expected[k]].object_class);
        CHECK(same_bits(Peak{found[k].center, found[k].score}, peaks[expected[k]]));
      }
    }
  }
}

TEST_CASE("mean shift: recognize() gives what a look at all votes of a class gives") {
  Random random(9);
  ss::Recognizer recognizer({0.03f, 3, 100});
  std::vector<View> objects;
  for (std::uint32_t k = 0; k < 5; ++k) {
    objects.push_back(synthetic_object(20 + k, 30));
    REQUIRE(ss::train(recognizer, objects.back().rows(), synthetic_layout, {},
                      k < 3    ? "a"
                      : k == 3 ? "b"
                               : "c",
                      std::string(1, static_cast<char>('0' + k))) == ss::Status::ok);
  }
  View scene;
  for (std::size_t k = 0; k < 8; ++k) scene.append(moved(objects[k % 5], random_motion(random), 0.3f, 5));
  std::vector<ss::Match> matches;
  unsigned threads = 1;
  const ss::FeatureRows rows = scene.rows();
  REQUIRE(ss::detail::activate(recognizer, rows.descriptors, synthetic_layout, matches, threads) == ss::Status::ok);
  const std::vector<Vote> votes = ss::detail::cast_votes(recognizer, rows.keypoints, rows.frames, matches);
  REQUIRE(votes.size() == 720);
  std::vector<Peak> peaks;
  for (const Vote& vote : votes) {
    const Vote* const begin = ss::detail::first_of_class(votes, vote.object_class);
    peaks.push_back(plain_climb(begin, ss::detail::first_of_class(votes, vote.object_class + 1), 0.03f, vote));
  }
  std::vector<ss::Hypothesis> expected;
  ss::detail::choose(recognizer, votes, peaks, expected);
  CHECK(expected.size() > 10);
  for (const unsigned number : {1u, 3u}) {
    std::vector<ss::Hypothesis> found;
    REQUIRE(ss::recognize(recognizer, rows, synthetic_layout, found, number) == ss::Status::ok);
    CHECK(unit::same_bits(found, expected));
  }
}

}  // namespace test_mean_shift
