// Every search against the loop over all points: the same neighbors, the same statuses, the same bits of descriptors.
#include <algorithm>
#include <nanoflann.hpp>
#include <shortshot/batch/grid_search.hpp>
#include <shortshot/descriptor/compact.hpp>
#include <shortshot/frame/fixed_lamp_frame.hpp>
#include <shortshot/kernel.hpp>
#include <shortshot/search/nanoflann.hpp>

#include "made_cloud.hpp"

namespace {

namespace ss = shortshot;
using fuzz::require;
using ss::Status;

constexpr std::size_t most_points = 128;
ss::Workspace<most_points> workspace;

/// Ordered by index, with all that is said of each.
struct Found {
  Status status;
  std::vector<std::uint32_t> bits;
};

template <class Search>
Found found_by(const Search& search, const ss::Point& center, ss::Radius radius) {
  ss::Neighborhood n = ss::neighborhood_in(workspace);
  const Status status = search.gather(center, radius, n);
  require(n.size <= n.found, "no more neighbors than were found");
  std::vector<std::uint32_t> order(n.size);
  for (std::uint32_t i = 0; i < n.size; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return n.index[a] < n.index[b]; });
  Found found{status, {n.found}};
  for (const std::uint32_t i : order) {
    found.bits.push_back(n.index[i]);
    for (const float value : {n.dx[i], n.dy[i], n.dz[i], n.d2[i]}) {
      found.bits.push_back(ss::extend::math::bits_of(value));
    }
  }
  return found;
}

/// A row's status, then its bits.
template <class D, class Search>
std::vector<std::uint32_t> row_of(const ss::CloudView& cloud, const Search& search, std::size_t key, float radius) {
  static float row[D::size];
  const Status status = ss::describe_at<D>(cloud, search, key, radius, workspace, row);
  std::vector<std::uint32_t> bits{static_cast<std::uint32_t>(status)};
  float norm = 0.0f;
  for (const float value : row) {
    bits.push_back(ss::extend::math::bits_of(value));
    norm += value * value;
  }
  // of length 1, or nothing
  require(status == Status::ok ? std::abs(norm - 1.0f) < 1e-3f : norm == 0.0f, "ok and length 1, or not and zeros");
  return bits;
}

template <class Search>
struct Answers {
  std::vector<Found> found;
  std::vector<std::vector<std::uint32_t>> rows;

  Answers(const Search& search, const ss::CloudView& cloud, float radius, const std::vector<ss::Point>& places,
          std::size_t key) {
    for (const ss::Point& place : places) found.push_back(found_by(search, place, radius));
    rows.push_back(row_of<ss::Scsh336>(cloud, search, key, radius));
    rows.push_back(row_of<ss::ShapeColor32>(cloud, search, key, radius));
  }
};

/// What is asked of all searches, and what the loop over all points says.
struct Question {
  Question(const ss::CloudView& asked, float r, const std::vector<ss::Point>& p, std::size_t k)
      : cloud(asked), radius(r), places(p), key(k), expected(ss::BruteSearch(asked), asked, r, p, k) {}

  const ss::CloudView cloud;
  const float radius;
  const std::vector<ss::Point> places;
  const std::size_t key;
  const Answers<ss::BruteSearch> expected;
};

template <class Search>
void compare(const Question& q, const Search& search) {
  if (search.status() != Status::ok) return;
  require(search.cloud_size() == q.cloud.size, "a search knows its cloud");
  const Answers<Search> answers(search, q.cloud, q.radius, q.places, q.key);
  for (std::size_t i = 0; i < q.places.size(); ++i) {
    require(answers.found[i].status == q.expected.found[i].status, "the status of all points' loop");
    require(answers.found[i].bits == q.expected.found[i].bits, "the neighbors of all points' loop");
  }
  require(answers.rows == q.expected.rows, "the descriptors of all points' loop");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes from(data, size);
  const ss::Point elsewhere{from.real(), from.real(), from.real()};
  const std::size_t which = from.byte();
  const float cell_factor = 0.25f + static_cast<float>(from.below(16)) / 4.0f;
  const fuzz::MadeCloud made = fuzz::made_cloud(from, most_points);
  if (made.size() == 0 || ss::validate(ss::Radius(made.radius)) != Status::ok) return 0;
  const ss::CloudView cloud =
      ss::organized(ss::view_xyz_rgb(made.xyz.data(), made.rgb.data(), made.size()), made.width, made.height);

  std::vector<ss::Point> places;
  if (ss::is_finite(elsewhere)) places.push_back(elsewhere);
  for (std::size_t i = which % 3; i < made.size(); i += 1 + made.size() / 4) {
    const ss::Point p = ss::point(cloud, i);
    if (!ss::is_finite(p)) continue;
    places.push_back(p);
    places.push_back({p.x + 0.75f * made.radius, p.y - 0.5f * made.radius, p.z});
    if (!ss::is_finite(places.back())) places.pop_back();
  }
  const Question q(cloud, made.radius, places, which % made.size());
  bool any_valid = false;
  for (std::size_t i = 0; i < made.size(); ++i) any_valid = any_valid || ss::is_finite(ss::point(cloud, i));

  const ss::GridSearch grid(cloud, made.radius);
  require((grid.status() == Status::ok) == any_valid, "a grid of every cloud with a valid point");
  compare(q, grid);
  compare(q, ss::GridSearch(cloud, cell_factor * made.radius));
  compare(q, ss::NanoflannSearch(cloud, 1 + which % 12));
  static ss::StaticGrid<most_points, 64> fixed;
  static_cast<void>(fixed.build(cloud, made.radius));
  compare(q, fixed);
  ss::OrganizedSearch image{};
  static_cast<void>(image.build(cloud));
  compare(q, image);
  return 0;
}
