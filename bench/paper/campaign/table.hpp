// Tables of results: for the terminal, as CSV, as Markdown and as JSON.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace shortshot_bench::campaign {

/// Text, or a number that is shown with so many digits after the point. A number that is not finite is no value: "-"
/// for people, empty in CSV, null in JSON.
class Cell {
 public:
  Cell(std::string text) : text_(std::move(text)) {}
  Cell(const char* text) : text_(text) {}
  Cell(double value, int digits) : is_number_(true), value_(value), digits_(digits) {}
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
  Cell(Integer count) : Cell(static_cast<double>(count), 0) {}

  bool is_number() const { return is_number_; }
  bool has_value() const;
  std::string text() const;             // as people see it
  nlohmann::ordered_json json() const;  // text, or the number with all its digits

 private:
  std::string text_;
  bool is_number_ = false;
  double value_ = 0.0;
  int digits_ = 0;
};

/// Columns in which every cell is a number are aligned to the right, others to the left.
class Table {
 public:
  /// Throws std::invalid_argument if there are no columns or two have one name.
  Table(std::string title, std::vector<std::string> columns);

  /// Throws std::invalid_argument unless there is one cell for each column.
  void add(std::vector<Cell> row);

  const std::string& title() const { return title_; }

  std::string text() const;             // title, columns, a line, rows; for a terminal (UTF-8)
  std::string csv() const;              // columns and rows, lines end in "\n", quoted as RFC 4180 says
  std::string markdown() const;         // columns and rows
  nlohmann::ordered_json json() const;  // a list of objects: {COLUMN: VALUE, ...}

 private:
  bool is_right_aligned(std::size_t column) const;
  std::vector<std::vector<std::string>> lines() const;  // columns and rows, as people see them

  std::string title_;
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace shortshot_bench::campaign
