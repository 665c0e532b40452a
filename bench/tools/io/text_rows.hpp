// Words and numbers in the text lines of PCD and PLY files; every error names the file and the line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "byte_source.hpp"

namespace shortshot_bench {

// A word of a header or data row with the line it stands on, so that a later check can point back to it.
struct Word {
  std::string_view text;
  std::uint64_t line = 0;
};

// The text in quotes for a message: clipped, control and non-ASCII characters replaced.
std::string quoted(std::string_view text);

// The line as a row of words separated by white space.
std::vector<std::string_view> split_words(std::string_view line);

// Splits the next line that is not blank into words; false at the end of the file.
bool next_row(ByteSource& source, std::vector<std::string_view>& words);

// Throw InputError unless the whole word is such a number; `what` names it in the message.
// Numbers: "nan", "inf" in every spelling that C libraries print, denormals and values beyond the range (they become
// infinite) are allowed.
double expect_number(const ByteSource& source, Word word, std::string_view what);
std::int64_t expect_integer(const ByteSource& source, Word word, std::string_view what, std::int64_t lowest,
                            std::int64_t highest);
std::uint64_t expect_count(const ByteSource& source, Word word, std::string_view what, std::uint64_t lowest,
                           std::uint64_t highest);

// Throws InputError when the rest of the file cannot hold so many rows of so many words even if each word
// had one character: called before memory for the rows is allocated.
void expect_room_for_rows(const ByteSource& source, std::uint64_t rows, std::uint64_t words_per_row);

}  // namespace shortshot_bench
