#include "text_rows.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <system_error>

#include "lower_case.hpp"

namespace shortshot_bench {
namespace {

constexpr std::string_view white_space = " \t\r\v\f";

InputError unexpected(const ByteSource& source, Word word, const std::string& expected, std::string_view what) {
  return InputError::at_line(source.path(), word.line,
                             "expected " + expected + " for " + std::string(what) + ", found " + quoted(word.text));
}

template <typename Integer>
Integer expect_in_range(const ByteSource& source, Word word, std::string_view what, Integer lowest, Integer highest) {
  Integer value = 0;
  const char* const end = word.text.data() + word.text.size();
  const std::from_chars_result result = std::from_chars(word.text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || value < lowest || value > highest) {
    throw unexpected(source, word, "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest),
                     what);
  }
  return value;
}

// Visual C++ before 2015 printed what is not finite as 1.#QNAN, -1.#IND00, 1.#INF; rounded, as 1.#J and the like, which
// tells no infinity from a NaN.
bool is_of_old_windows(std::string_view text, double& value) {
  const bool is_negative = text.substr(0, 1) == "-";
  if (is_negative || text.substr(0, 1) == "+") text.remove_prefix(1);
  const auto is_letter_or_digit = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  };
  if (text.size() < 4 || text.substr(0, 3) != "1.#") return false;
  if (!std::all_of(text.begin() + 3, text.end(), is_letter_or_digit)) return false;
  value = std::numeric_limits<double>::quiet_NaN();
  if (lower_case(text.substr(3, 3)) == "inf") value = std::numeric_limits<double>::infinity();
  if (is_negative) value = -value;
  return true;
}

}  // namespace

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "'";
  for (const char c : text.substr(0, longest)) result += (c >= ' ' && c <= '~') ? c : '?';
  return result + (text.size() > longest ? "...'" : "'");
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(white_space); begin != std::string_view::npos;
       begin = line.find_first_not_of(white_space, begin)) {
    const std::size_t end = std::min(line.find_first_of(white_space, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

bool next_row(ByteSource& source, std::vector<std::string_view>& words) {
  std::string_view line;
  while (source.next_line(line)) {
    words = split_words(line);
    if (!words.empty()) return true;
  }
  return false;
}

double expect_number(const ByteSource& source, Word word, std::string_view what) {
  // strtod and not from_chars: GCC before 11 has no from_chars for floats. It reads up to a terminating
  // zero, so it gets a bounded copy. It follows the C locale's decimal point, which is "." unless a program
  // calls setlocale; if one did, "0.5" would be refused here and not misread.
  std::array<char, 128> copy{};
  const bool fits = word.text.size() < copy.size();
  if (fits) std::copy(word.text.begin(), word.text.end(), copy.begin());
  char* end = copy.data();
  // errno is not asked: ERANGE would refuse the denormals in which colors are packed.
  double value = std::strtod(copy.data(), &end);
  const bool is_all = fits && !word.text.empty() && end == copy.data() + word.text.size();
  if (!is_all && !is_of_old_windows(word.text, value)) throw unexpected(source, word, "a number", what);
  return value;
}

std::int64_t expect_integer(const ByteSource& source, Word word, std::string_view what, std::int64_t lowest,
                            std::int64_t highest) {
  return expect_in_range(source, word, what, lowest, highest);
}

std::uint64_t expect_count(const ByteSource& source, Word word, std::string_view what, std::uint64_t lowest,
                           std::uint64_t highest) {
  return expect_in_range(source, word, what, lowest, highest);
}

void expect_room_for_rows(const ByteSource& source, std::uint64_t rows, std::uint64_t words_per_row) {
  // A word and its separator are 2 bytes; the last row may lack its line end. Divided, for the product
  // could overflow.
  const std::uint64_t most_words = (std::uint64_t{source.remaining_bytes()} + 1) / 2;
  if (words_per_row != 0 && rows > most_words / words_per_row) {
    throw source.line_error("expected " + std::to_string(rows) + " rows of at least " + std::to_string(words_per_row) +
                            " values, found only " + std::to_string(source.remaining_bytes()) +
                            " bytes after this line");
  }
}

}  // namespace shortshot_bench
