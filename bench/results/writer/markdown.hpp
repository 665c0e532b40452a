// Tables in Markdown, and the blocks of a document that are generated.
#pragma once

#include <string>
#include <vector>

namespace shortshot_bench::results {

/// A table of text. The first column is aligned to the left, the others to the right.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : header_(std::move(header)) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string markdown() const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;  // shorter ones are filled up with empty cells
};

/// A number with three significant digits, but never fewer than stand before the point: 0.302, 8.31, 359, 1240;
/// below a thousandth as 3.10e-07.
std::string digits(double value);

/// Rounded to a whole number: 170000.
std::string whole(double value);

/// "25x"; one digit after the point below 10.
std::string times(double ratio);

/// Bytes as "5.2 MB" (of 10^6 bytes), or "38 KB" below a megabyte.
std::string megabytes(double bytes);

/// The document with everything between the lines "<!-- generated: NAME -->" and "<!-- end -->" replaced by `content`.
/// Throws std::runtime_error, which names `path`, unless there is exactly one such block.
std::string with_block(const std::string& document, const std::string& name, const std::string& content,
                       const std::string& path);

}  // namespace shortshot_bench::results
