#include "compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <limits>

#include "frames.hpp"
#include "known_arrays.hpp"
#include "neighbors.hpp"
#include "shortshot/color/lab.hpp"
#include "shortshot/descriptor/descriptor.hpp"
#include "shortshot/search/brute.hpp"
#include "shortshot/search/grid_search.hpp"
#include "shortshot/store/binary.hpp"

namespace shortshot_bench::golden {
namespace {

// A descriptor row is within tolerance up to row_l2. A few rows of a case may be beyond, since a point that
// crosses a cell's border moves its votes at once, but none beyond jump_l2: more than one such jump was ever
// seen to make.
constexpr double row_l2 = 1e-5;
constexpr double jump_l2 = 0.15;
constexpr double lab_tolerance = 1e-3;

// Percentages of rows that may be beyond. A synthetic case has its points on the borders and its
// neighborhoods degenerate on purpose.
constexpr std::size_t real_descriptor_percent = 1;
constexpr std::size_t synthetic_descriptor_percent = 10;
constexpr std::size_t real_frame_percent = 2;

bool is_more_than(std::size_t part, std::size_t percent, std::size_t whole) { return 100 * part > percent * whole; }

std::size_t allowed_percent(const Case& c) {
  return c.frames_are_pcl_lrf ? real_descriptor_percent : synthetic_descriptor_percent;
}

std::string number_text(const char* before, double value, const char* after = "") {
  char text[64];
  std::snprintf(text, sizeof text, "%s%.3g%s", before, value, after);
  return text;
}

// Absolute and L2 difference of one row; infinite where one side is not a number.
struct Difference {
  double largest = 0.0;
  double l2 = 0.0;
};

Difference difference_of(const float* ours, const float* reference, std::size_t size) {
  Difference difference;
  for (std::size_t i = 0; i < size; ++i) {
    const double d = std::fabs(static_cast<double>(ours[i]) - static_cast<double>(reference[i]));
    const double distance = std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
    difference.largest = std::max(difference.largest, distance);
    difference.l2 += distance * distance;
  }
  difference.l2 = std::sqrt(difference.l2);
  return difference;
}

bool is_all_nan(const float* values, std::size_t size) {
  return std::all_of(values, values + size, [](float v) { return std::isnan(v); });
}

bool is_all_zero(const float* values, std::size_t size) {
  return std::all_of(values, values + size, [](float v) { return v >= 0.0F && v <= 0.0F; });
}

// What the inputs of a case lack for an array; empty if it can be checked.
std::string lacking(const Case& c, std::initializer_list<const char*> needed) {
  for (const std::string need : needed) {
    const bool has = need == "radius"       ? c.radius.has_value()
                     : need == "lrf_radius" ? c.lrf_radius.has_value()
                                            : c.find(need) != nullptr;
    if (!has) return "no " + need;
  }
  return {};
}

shortshot::Point center_of(const Case& c, std::size_t row) { return shortshot::point(c.cloud(), c.keypoints[row]); }

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

// One descriptor row: the status and the values that the library gives, against the reference's.
void compare_row(std::size_t row, shortshot::Status status, const std::vector<float>& ours, const float* reference,
                 Result& result) {
  const bool none_expected = is_all_nan(reference, ours.size());
  if (none_expected && status != shortshot::Status::ok && is_all_zero(ours.data(), ours.size())) return;
  const Difference difference = difference_of(ours.data(), reference, ours.size());
  result.add_difference(difference.largest, difference.l2);
  result.broken = result.broken || !(difference.l2 <= jump_l2) || status != shortshot::Status::ok;
  if (status == shortshot::Status::ok && difference.l2 <= row_l2) return;
  const std::string expected = none_expected ? ", the reference has no descriptor" : "";
  const std::string got = status == shortshot::Status::ok ? "" : std::string(", ") + shortshot::message(status);
  result.add_deviation(row, number_text("L2 ", difference.l2) + expected + got);
}

std::string lacking_for(const Case& c, const DescriptorOutput& descriptor) {
  std::string missing = lacking(c, {"points", "keypoints", "frames", "radius"});
  if (missing.empty() && descriptor.needs_colors) missing = lacking(c, {"rgb"});
  if (missing.empty() && descriptor.needs_normals) missing = lacking(c, {"normals"});
  return missing;
}

// Describes all key points in the given frames; for_row(row, status, values) gets what comes of each.
template <class ForRow>
void describe_rows(const Case& c, const DescriptorOutput& descriptor, ForRow for_row) {
  const auto radius = shortshot::Radius::from_double(*c.radius);
  const shortshot::CloudView cloud = c.cloud();
  const shortshot::BruteSearch search{cloud};
  std::vector<float> ours(static_cast<std::size_t>(descriptor.size));
  Neighbors neighbors;
  for (std::size_t row = 0; row < c.keypoints.size(); ++row) {
    const shortshot::Neighborhood& n = neighbors.gather(search, center_of(c, row), radius);
    shortshot::Frame frame;
    static_assert(sizeof frame == 9 * sizeof(float), "a frame is its three axes");
    std::memcpy(&frame, c.frames.data() + 9 * row, sizeof frame);
    const shortshot::Rgb key_color =
        descriptor.needs_colors ? shortshot::color(cloud, c.keypoints[row]) : shortshot::Rgb{};
    const shortshot::Status status = descriptor.describe(n, cloud, key_color, frame, radius, ours.data());
    for_row(row, status, ours);
  }
}

void compare_descriptor(const Case& c, const Array& array, const DescriptorOutput& descriptor, Result& result) {
  result.note = lacking_for(c, descriptor);
  if (!result.note.empty()) return;
  const std::vector<float> expected = floats_of(array);
  describe_rows(c, descriptor, [&](std::size_t row, shortshot::Status status, const std::vector<float>& ours) {
    compare_row(row, status, ours, expected.data() + ours.size() * row, result);
  });
  result.rows = c.keypoints.size();
  result.broken = result.broken || is_more_than(result.beyond, allowed_percent(c), result.rows);
}

// The bits of the reference's own SHOT must be equal. Those of our SHOT may differ in a few rows, where a sum is 90 %
// of its group but for rounding.
void compare_bits(const Case& c, const Array& array, Result& result) {
  const DescriptorOutput& shot = *find_descriptor("shot352");
  result.note = lacking_for(c, shot);
  if (result.note.empty()) result.note = lacking(c, {"shot352"});
  if (!result.note.empty()) return;
  using Bits = shortshot::BinaryDescriptor<shortshot::PclShot352>;
  const std::vector<std::uint8_t> expected = bytes_of(array);
  const std::vector<float> references = floats_of(*c.find("shot352"));
  describe_rows(c, shot, [&](std::size_t row, shortshot::Status status, const std::vector<float>& ours) {
    const float* reference = references.data() + ours.size() * row;
    const std::uint8_t* bits = expected.data() + Bits::size_bytes * row;
    Bits of_reference, of_ours;
    shortshot::binarize(reference, of_reference);
    shortshot::binarize(status == shortshot::Status::ok ? ours.data() : reference, of_ours);
    const int off = shortshot::hamming_distance(of_reference.bytes, bits, Bits::size_bytes);
    const int ours_off = shortshot::hamming_distance(of_ours.bytes, bits, Bits::size_bytes);
    result.add_difference(std::max(off, ours_off), std::max(off, ours_off));
    result.broken = result.broken || off > 0;
    if (off == 0 && ours_off == 0) return;
    result.add_deviation(
        row, std::to_string(off) + " bits differ for the reference's SHOT, " + std::to_string(ours_off) + " for ours");
  });
  result.rows = c.keypoints.size();
  result.broken = result.broken || is_more_than(result.beyond, allowed_percent(c), result.rows);
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
