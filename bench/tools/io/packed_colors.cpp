#include "packed_colors.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shortshot_bench {
namespace {

void store_color(std::uint32_t packed, std::uint8_t* rgb) {
  rgb[0] = static_cast<std::uint8_t>(packed >> 16);
  rgb[1] = static_cast<std::uint8_t>(packed >> 8);
  rgb[2] = static_cast<std::uint8_t>(packed);
}

std::uint32_t bits_of_float(double value) {
  const float narrow = to_float(value);
  std::uint32_t bits = 0;
  static_assert(sizeof bits == sizeof narrow, "a packed color is a 4-byte float");
  std::memcpy(&bits, &narrow, sizeof bits);
  return bits;
}

bool is_float(const Channel& channel) { return channel.type.kind == ScalarKind::floating; }

/// The four bytes of a point. Bits and never a float's value where there are bits: many packed colors are NaNs, which a
/// conversion may change. Of a NaN in text they are lost: 0.
std::uint32_t packed_bits(const Channel& channel, std::size_t point) {
  if (!channel.is_text && channel.type.size_bytes == 4) return channel.values.bits32(point);
  if (!channel.is_text && !is_float(channel)) {
    return static_cast<std::uint32_t>(channel.values.bits(point));
  }
  const double value = channel.values.at(point);
  if (!is_float(channel)) return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  return std::isnan(value) ? 0 : bits_of_float(value);
}

/// What is to be known of all values before one is believed. Numbers of 4 bytes in binary are always colors; floats
/// among them may be meant in two ways, which a sample tells apart.
struct Facts {
  bool fit_32_bits = true;      // as whole numbers
  bool are_denormals = true;    // floats of colors with alpha 0
  bool are_rgb_numbers = true;  // whole, 0 to 0xffffff
  bool have_one_alpha = true;   // as bits
  std::size_t not_a_number = 0;
};

Facts facts_of(const Channel& channel, std::size_t points) {
  Facts facts;
  const bool is_plain = !channel.is_text && channel.type.size_bytes == 4;
  const std::size_t step = is_plain ? points / 4096 + 1 : 1;
  const std::uint32_t first_alpha = points == 0 ? 0 : packed_bits(channel, 0) >> 24;
  for (std::size_t point = 0; point < points; point += step) {
    const double value = channel.values.at(point);
    facts.not_a_number += std::isnan(value) ? 1 : 0;
    facts.fit_32_bits = facts.fit_32_bits && value >= -2147483648.0 && value <= 4294967295.0;
    facts.are_denormals =
        facts.are_denormals && value >= 0 && value < static_cast<double>(std::numeric_limits<float>::min());
    facts.are_rgb_numbers =
        facts.are_rgb_numbers && value >= 0 && value <= double{0xffffff} && value == std::floor(value);
    facts.have_one_alpha = facts.have_one_alpha && packed_bits(channel, point) >> 24 == first_alpha;
  }
  return facts;
}

/// Why the channel is of no use, or nothing.
std::string problem_with(const Channel& channel, const Facts& facts) {
  const std::string type = type_name(channel.type) + ": ";
  if (channel.type.size_bytes < 4) return type + "a packed color has 4 bytes";
  if (channel.type.size_bytes == 4) return {};
  if (!is_float(channel)) return facts.fit_32_bits ? "" : type + "values that are no packed color of 4 bytes";
  return facts.are_denormals
             ? ""
             : type + "a packed color has 4 bytes, and its bits do not survive in a double; write SIZE 4";
}

}  // namespace

void read_packed_colors(const Channel& channel, RgbdCloud& cloud, std::vector<std::string>& ignored) {
  const std::size_t points = cloud.size();
  const Facts facts = facts_of(channel, points);
  const std::string problem = problem_with(channel, facts);
  if (!problem.empty()) {
    ignored.push_back(channel.name + " (" + problem + ")");
    return;
  }
  // The bits of floats that are whole numbers have an alpha that says how large they are: nobody's alpha.
  const bool is_number = is_float(channel) && facts.are_rgb_numbers && !facts.have_one_alpha;
  cloud.rgb.resize(3 * points);
  for (std::size_t point = 0; point < points; ++point) {
    const std::uint32_t packed =
        is_number ? static_cast<std::uint32_t>(channel.values.at(point)) : packed_bits(channel, point);
    store_color(packed, &cloud.rgb[3 * point]);
  }
  const std::string what = "colors are " + channel.name + ", " + type_name(channel.type) + ": ";
  if (is_number) cloud.notes.push_back(what + "taken as whole numbers 0xRRGGBB, and not as the bits of floats");
  if (channel.type.size_bytes == 8) {
    cloud.notes.push_back(what + (is_float(channel) ? "taken as the bits of 4-byte floats" : "taken as 0xAARRGGBB"));
  }
  if (is_float(channel) && channel.is_text && facts.not_a_number > 0) {
    cloud.notes.push_back(what + std::to_string(facts.not_a_number) +
                          " are nan in text, which has lost them: black (alpha 255 does that; write DATA binary)");
  }
}

}  // namespace shortshot_bench
