// The naive transcription against the library and against the oracle: a baseline must compute the same descriptor.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "speed/peers/naive.hpp"
#include "speed/peers/oracle_difference.hpp"
#include "speed/peers/task.hpp"
#include "tools/golden/neighbors.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_peers_naive {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::peers;
namespace ss = shortshot;

Task small_task() {
  TabletopOptions options;
  options.width = 160;
  options.height = 120;
  return make_task("small", make_tabletop(options), 0.06f, 0.05f);
}

/// How many of two ascending lists are in both.
std::size_t common(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::vector<std::uint32_t> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both.size();
}

/// Describes every key point in the library's frames, by the library and naively, and compares the two with each other
/// and with the oracle.
template <class D>
void compare(const Task& task, const std::vector<NaivePart>& parts, OracleDescriptors::Kind kind) {
  constexpr auto size = static_cast<std::size_t>(D::size);
  const ss::CloudView view = view_of_cloud(task.points);
  const ss::GridSearch search(view, task.radius);
  Naive naive(task);
  naive.build_tree();
  naive.convert_colors();
  const OracleDescriptors oracle(task, kind);
  golden::Neighbors ours;
  Naive::Neighbors theirs;
  std::vector<float> our_rows(task.keypoints.size() * size), their_rows(task.keypoints.size() * size);
  std::size_t described = 0, alike = 0;
  for (std::size_t row = 0; row < task.keypoints.size(); ++row) {
    const std::uint32_t key = task.keypoints[row];
    const ss::Neighborhood& n = ours.gather(search, ss::point(view, key), task.radius);
    naive.find_neighbors(key, theirs);
    REQUIRE(theirs.size() == n.size);
    ss::Frame frame{}, their_frame{};
    if (ss::estimate_frame(n, task.radius, frame) != ss::Status::ok) continue;
    REQUIRE(naive.estimate_frame(key, theirs, their_frame));
    ++described;
    alike +=
        ss::extend::dot(frame.x, their_frame.x) > 0.999f && ss::extend::dot(frame.z, their_frame.z) > 0.999f ? 1 : 0;

    const auto sources = ss::detail::sources_at(typename D::Sources{}, view, ss::keypoint(view, key));
    REQUIRE(ss::describe<D>(n, sources, frame, task.radius, our_rows.data() + row * size) == ss::Status::ok);
    std::vector<double> descriptor;
    naive.describe(key, theirs, frame, parts, descriptor);
    REQUIRE(descriptor.size() == size);
    double squared = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      const double d = static_cast<double>(our_rows[row * size + i]) - descriptor[i];
      squared += d * d;
      their_rows[row * size + i] = static_cast<float>(descriptor[i]);
    }
    CAPTURE(row);
    if (oracle.is_clear(row)) CHECK(std::sqrt(squared) <= 1e-5);
  }
  CHECK(described > 100);
  CHECK(20 * alike >= 19 * described);  // frames of symmetric neighborhoods may differ
  CHECK(2 * oracle.clear_keypoints() > described);
  CHECK(oracle.largest_difference(our_rows.data()) <= 1e-6);
  CHECK(oracle.largest_difference(their_rows.data()) <= 1e-6);
  for (std::size_t row = 0; row < task.keypoints.size(); ++row) their_rows[row * size + 5] += 0.25f;
  CHECK(oracle.largest_difference(their_rows.data()) > 0.2);
}

}  // namespace

TEST_CASE("naive: key points are the library's, but for points at the borders of voxels and in their middles") {
  const Task task = small_task();
  const std::vector<std::uint32_t> keypoints = Naive(task).sample();
  CHECK(100 * common(keypoints, task.sampled) >= 99 * task.sampled.size());
  CHECK(100 * common(keypoints, task.sampled) >= 99 * keypoints.size());
}

TEST_CASE("peers: the naive transcription describes as the library and the oracle do") {
  const Task task = small_task();
  compare<ss::Ssh32>(task, {{2, 2, 8}}, OracleDescriptors::Kind::ssh32);
  compare<ss::Scsh336>(task, {{3, 4, 8}, {2, 2, 4, 15}}, OracleDescriptors::Kind::scsh336);
}

}  // namespace test_peers_naive
