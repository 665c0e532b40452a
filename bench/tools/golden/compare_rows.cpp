#include "compare_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "compare_parts.hpp"
#include "neighbors.hpp"
#include "row_analysis.hpp"
#include "shortshot/descriptor/descriptor.hpp"
#include "shortshot/search/brute.hpp"
#include "shortshot/store/binary.hpp"

namespace shortshot_bench::golden {
namespace {

// Rows of a real case that may be beyond tolerance, for a reason. A synthetic case has its points on borders and its
// neighborhoods degenerate on purpose.
constexpr std::size_t real_descriptor_percent = 1;
constexpr std::size_t synthetic_bits_percent = 10;

bool is_all_nan(const float* values, std::size_t size) {
  return std::all_of(values, values + size, [](float v) { return std::isnan(v); });
}

bool is_all_zero(const float* values, std::size_t size) {
  return std::all_of(values, values + size, [](float v) { return v >= 0.0F && v <= 0.0F; });
}

// One descriptor row: the status and the values that the library gives, against the reference's.
void compare_row(const Case& c, std::size_t row, shortshot::Status status, const std::vector<float>& ours,
                 const float* reference, const DescriptorOutput& descriptor, BorderCounts& counts, Result& result) {
  const bool none_expected = is_all_nan(reference, ours.size());
  if (none_expected && status != shortshot::Status::ok && is_all_zero(ours.data(), ours.size())) return;
  const Difference difference = difference_of(ours.data(), reference, ours.size());
  result.add_difference(difference.largest, difference.l2);
  if (status == shortshot::Status::ok && difference.l2 <= descriptor.row_l2) return;
  RowAnalysis analysis;
  std::string why;
  if (status != shortshot::Status::ok) {
    why = std::string(", ") + shortshot::message(status);
  } else if (none_expected) {
    why = ", the reference has no descriptor";
  } else if (descriptor.sharing != Sharing::continuous) {
    analysis = analyze_row(c, row, descriptor, ours.data(), reference);
    why = analysis.explains ? ", " + analysis.at_border.text() : ", unexplained";
  }
  counts.add(analysis.at_border);
  result.broken = result.broken || !analysis.explains;
  result.add_deviation(row, number_text("L2 ", difference.l2) + why);
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

// Nibble i of a row.
int nibble_at(const std::uint8_t* bytes, std::size_t i) { return i % 2 == 0 ? bytes[i / 2] & 15 : bytes[i / 2] >> 4; }

// How far a value is from the middle between two steps, where its code changes.
double distance_from_border(double value, double scale) {
  const double steps = value * scale;
  return std::fabs(steps - (std::floor(steps) + 0.5)) / scale;
}

}  // namespace

void compare_descriptor(const Case& c, const Array& array, const DescriptorOutput& descriptor, Result& result) {
  result.note = lacking_for(c, descriptor);
  if (!result.note.empty()) return;
  const std::vector<float> expected = floats_of(array);
  BorderCounts counts;
  describe_rows(c, descriptor, [&](std::size_t row, shortshot::Status status, const std::vector<float>& ours) {
    compare_row(c, row, status, ours, expected.data() + ours.size() * row, descriptor, counts, result);
  });
  result.rows = c.keypoints.size();
  result.note = counts.text();
  result.explained = result.beyond > 0;
  result.broken =
      result.broken || (c.frames_are_pcl_lrf && is_more_than(result.beyond, real_descriptor_percent, result.rows));
}

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
  const std::size_t percent = c.frames_are_pcl_lrf ? real_descriptor_percent : synthetic_bits_percent;
  result.broken = result.broken || is_more_than(result.beyond, percent, result.rows);
}

void compare_nibbles(const Case& c, const Array& array, const DescriptorOutput& descriptor, Result& result) {
  constexpr double open = 1e-4;  // what a value with a root may be off
  result.note = lacking_for(c, descriptor);
  if (result.note.empty()) result.note = lacking(c, {descriptor.name});
  if (!result.note.empty()) return;
  const std::vector<std::uint8_t> expected = bytes_of(array);
  const std::vector<float> values = floats_of(*c.find(descriptor.name));
  const auto size = static_cast<std::size_t>(descriptor.size);
  std::vector<std::uint8_t> codes((size + 1) / 2);
  std::size_t at_border = 0;
  describe_rows(c, descriptor, [&](std::size_t row, shortshot::Status status, const std::vector<float>& ours) {
    const float* reference = values.data() + size * row;
    if (status != shortshot::Status::ok && is_all_nan(reference, size)) return;
    descriptor.to_nibbles(ours.data(), codes.data());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const int off = std::abs(nibble_at(codes.data(), i) - nibble_at(expected.data() + codes.size() * row, i));
      if (off == 0) continue;
      const double distance = distance_from_border(static_cast<double>(reference[i]), descriptor.nibble_scale);
      result.add_difference(off, off);
      ++(off == 1 && distance <= open ? at_border : wrong);
    }
    if (wrong > 0) result.add_deviation(row, std::to_string(wrong) + " codes differ");
  });
  result.rows = c.keypoints.size();
  result.broken = result.beyond > 0;
  if (at_border > 0) result.note = std::to_string(at_border) + " codes differ within 1e-4 of a border";
}

}  // namespace shortshot_bench::golden
