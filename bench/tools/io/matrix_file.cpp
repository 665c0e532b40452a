#include "tools/io/matrix_file.hpp"

#include <cmath>
#include <string_view>

#include "tools/io/require_file.hpp"
#include "tools/io/scalar_type.hpp"
#include "tools/io/text_rows.hpp"

namespace shortshot_bench {

std::vector<double> read_matrix(const std::string& path, std::size_t rows, std::size_t columns,
                                const std::string& what) {
  require_file(path, what);
  ByteSource source(path);
  std::vector<double> values;
  std::vector<std::string_view> words;
  while (next_row(source, words)) {
    if (words.size() != columns || values.size() == rows * columns) {
      throw source.line_error("expected " + std::to_string(rows) + " rows of " + std::to_string(columns) +
                              " numbers for " + what + ", found another one of " + std::to_string(words.size()));
    }
    for (const std::string_view word : words) {
      const float value = to_float(expect_number(source, {word, source.line_number()}, what));
      if (!std::isfinite(value))
        throw source.line_error("expected finite numbers for " + what + ", found " + quoted(word));
      values.push_back(static_cast<double>(value));
    }
  }
  if (values.size() != rows * columns) {
    throw source.line_error("expected " + std::to_string(rows) + " rows for " + what + ", found only " +
                            std::to_string(values.size() / columns));
  }
  return values;
}

}  // namespace shortshot_bench
