#include "compare.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "compare_parts.hpp"
#include "compare_rows.hpp"
#include "descriptors.hpp"
#include "frames.hpp"
#include "known_arrays.hpp"
#include "neighbors.hpp"
#include "shortshot/batch/grid_search.hpp"
#include "shortshot/color/lab.hpp"
#include "shortshot/search/brute.hpp"

namespace shortshot_bench::golden {
namespace {

constexpr double lab_tolerance = 1e-3;
constexpr std::size_t real_frame_percent = 2;  // frames beyond tolerance

void compare_counts(const Case& c, const Array& array, Result& result) {
  result.note = lacking(c, {"points", "keypoints", "radius"});
  if (!result.note.empty()) return;
  const auto radius = shortshot::Radius::from_double(*c.radius);
  const shortshot::BruteSearch brute{c.cloud()};
  const shortshot::GridSearch grid(c.cloud(), radius.value);
  const std::vector<std::int32_t> expected = ints_of(array);
  Neighbors neighbors;
  for (std::size_t row = 0; row < expected.size(); ++row) {
    const std::int64_t reference = expected[row];
    const std::int64_t by_brute = neighbors.gather(brute, center_of(c, row), radius).found;
    const std::int64_t by_grid = neighbors.gather(grid, center_of(c, row), radius).found;
    const auto off = static_cast<double>(std::max(std::abs(by_brute - reference), std::abs(by_grid - reference)));
    result.add_difference(off, off);
    if (by_brute == reference && by_grid == reference) continue;
    result.add_deviation(row, "brute force finds " + std::to_string(by_brute) + ", the grid " +
                                  std::to_string(by_grid) + " of " + std::to_string(reference) + " neighbors");
  }
  result.rows = expected.size();
  result.broken = result.beyond > 0;
}

// "1 tie, 10 near-equal eigenvalues"
std::string list_of(const std::array<std::size_t, cause_count>& counts) {
  std::string text;
  for (int i = 0; i < cause_count; ++i) {
    const std::size_t count = counts[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name_of(static_cast<Cause>(i));
  }
  return text;
}

// Explained rows have arbitrary axes: they count as beyond tolerance but not towards the largest differences.
void compare_lrfs(const Case& c, const Array& array, Result& result) {
  result.note = lacking(c, {"points", "keypoints", "lrf_radius"});
  if (!result.note.empty()) return;
  const auto radius = shortshot::Radius::from_double(*c.lrf_radius);
  const shortshot::BruteSearch search{c.cloud()};
  const std::vector<float> expected = floats_of(array);
  std::array<std::size_t, cause_count> causes{};
  double largest_angle = 0.0;
  Neighbors neighbors;
  for (std::size_t row = 0; row < c.keypoints.size(); ++row) {
    const shortshot::Neighborhood& n = neighbors.gather(search, center_of(c, row), radius);
    const float* reference = expected.data() + 9 * row;
    shortshot::Frame frame;
    const shortshot::Status status = shortshot::estimate_frame(n, radius, frame);
    const FrameComparison comparison = compare_frames(n, radius, status, frame, reference);
    if (!comparison.agrees) {
      ++causes[static_cast<std::size_t>(comparison.cause)];
      const std::string got = status == shortshot::Status::ok
                                  ? number_text("angle ", comparison.angle_degrees, " degrees")
                                  : std::string("no frame, ") + shortshot::message(status);
      result.add_deviation(row, got + ": " + name_of(comparison.cause));
      if (comparison.cause != Cause::none) continue;
    }
    largest_angle = std::max(largest_angle, comparison.angle_degrees);
    if (comparison.agrees && status != shortshot::Status::ok) continue;
    float ours[9];
    std::memcpy(ours, &frame, sizeof ours);
    const Difference difference = difference_of(ours, reference, 9);
    result.add_difference(difference.largest, difference.l2);
  }
  result.rows = c.keypoints.size();
  result.note = number_text("largest angle ", largest_angle, " degrees");
  if (result.beyond > 0) result.note += "; " + list_of(causes);
  result.explained = result.beyond > 0;
  const bool too_many = c.frames_are_pcl_lrf && is_more_than(result.beyond, real_frame_percent, result.rows);
  result.broken = causes[static_cast<std::size_t>(Cause::none)] > 0 || too_many;
}

template <class Rule>
void compare_lab(const Case& c, const Array& array, Result& result) {
  result.note = lacking(c, {"rgb"});
  if (!result.note.empty()) return;
  const std::vector<float> expected = floats_of(array);
  for (std::size_t row = 0; row < expected.size() / 3; ++row) {
    const std::uint8_t* rgb = c.rgb.data() + 3 * row;
    const shortshot::Lab lab = shortshot::to_lab<Rule>({rgb[0], rgb[1], rgb[2]});
    const float ours[3] = {lab.L, lab.a, lab.b};
    const Difference difference = difference_of(ours, expected.data() + 3 * row, 3);
    result.add_difference(difference.largest, difference.l2);
    if (!(difference.largest <= lab_tolerance)) result.add_deviation(row, number_text("off by ", difference.largest));
  }
  result.rows = expected.size() / 3;
  result.broken = result.beyond > 0;
}

Result result_of(const Case& c, const Array& array) {
  Result result;
  result.array = array.name;
  if (array.name == "neighbor_count") {
    compare_counts(c, array, result);
  } else if (array.name == "lrf_pcl") {
    compare_lrfs(c, array, result);
  } else if (array.name == "bshot") {
    compare_bits(c, array, result);
  } else if (const DescriptorOutput* stored = find_nibbles(array.name)) {
    compare_nibbles(c, array, *stored, result);
  } else if (array.name == "lab_pcl") {
    compare_lab<shortshot::PclLab>(c, array, result);
  } else if (array.name == "lab_authors") {
    compare_lab<shortshot::PublishedLab>(c, array, result);
  } else if (const DescriptorOutput* descriptor = find_descriptor(array.name)) {
    compare_descriptor(c, array, *descriptor, result);
  }
  return result;
}

}  // namespace

Report compare(const Case& c) {
  Report report;
  for (const Array& array : c.arrays) {
    const std::optional<KnownArray> known = find_known_array(array.name);
    if (!known || known->role == Role::later) {
      report.unchecked.push_back(array.name);
    } else if (known->role == Role::reference) {
      report.results.push_back(result_of(c, array));
    }
  }
  return report;
}

}  // namespace shortshot_bench::golden
