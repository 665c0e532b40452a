#include "paper/campaign/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <set>
#include <stdexcept>

namespace shortshot_bench::campaign {
namespace {

/// How many characters UTF-8 text shows: bytes that continue one do not count.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string fill(width - width_of(text), ' ');
  return right ? fill + text : text + fill;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// A bar would end the cell, a new line the row.
std::string markdown_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? "\\|" : std::string(1, c == '\n' ? ' ' : c);
  return cell.empty() ? " |" : " " + cell + " |";
}

std::string joined(const std::vector<std::string>& cells, const char* between) {
  std::string line;
  for (const std::string& cell : cells) line += (&cell == &cells.front() ? "" : between) + cell;
  return line;
}

}  // namespace

bool Cell::has_value() const { return is_number_ ? std::isfinite(value_) : !text_.empty(); }

std::string Cell::text() const {
  if (!is_number_) return text_;
  if (!has_value()) return "-";
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", digits_, value_);
  return text;
}

nlohmann::ordered_json Cell::json() const {
  if (!is_number_) return text_;
  if (!has_value()) return nullptr;
  if (digits_ == 0 && std::fabs(value_) < 9e15 && value_ == std::trunc(value_)) return static_cast<long long>(value_);
  return value_;
}

Table::Table(std::string title, std::vector<std::string> columns)
    : title_(std::move(title)), columns_(std::move(columns)) {
  if (columns_.empty()) throw std::invalid_argument("table '" + title_ + "' has no columns");
  if (std::set<std::string>(columns_.begin(), columns_.end()).size() != columns_.size()) {
    throw std::invalid_argument("table '" + title_ + "' has two columns of one name");
  }
}

void Table::add(std::vector<Cell> row) {
  if (row.size() != columns_.size()) {
    throw std::invalid_argument("table '" + title_ + "' has " + std::to_string(columns_.size()) + " columns, not " +
                                std::to_string(row.size()));
  }
  rows_.push_back(std::move(row));
}

bool Table::is_right_aligned(std::size_t column) const {
  return !rows_.empty() &&
         std::all_of(rows_.begin(), rows_.end(), [&](const std::vector<Cell>& row) { return row[column].is_number(); });
}

std::vector<std::vector<std::string>> Table::lines() const {
  std::vector<std::vector<std::string>> lines{columns_};
  for (const std::vector<Cell>& row : rows_) {
    std::vector<std::string>& line = lines.emplace_back();
    for (const Cell& cell : row) line.push_back(cell.text());
  }
  return lines;
}

std::string Table::text() const {
  std::vector<std::vector<std::string>> all = lines();
  std::vector<std::string>& rule = *all.emplace(all.begin() + 1, columns_.size());
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    std::size_t width = 0;
    for (const auto& line : all) width = std::max(width, width_of(line[column]));
    rule[column] = std::string(width, '-');
    for (auto& line : all) line[column] = padded(line[column], width, is_right_aligned(column));
  }
  std::string text = title_ + "\n";
  for (const auto& line : all) {
    const std::string padded_line = joined(line, "  ");
    text += padded_line.substr(0, padded_line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string Table::csv() const {
  std::vector<std::string> line;
  for (const std::string& column : columns_) line.push_back(csv_field(column));
  std::string text = joined(line, ",") + "\n";
  for (const std::vector<Cell>& row : rows_) {
    line.clear();
    for (const Cell& cell : row) line.push_back(cell.has_value() ? csv_field(cell.text()) : "");
    text += joined(line, ",") + "\n";
  }
  return text;
}

std::string Table::markdown() const {
  std::vector<std::string> rows;
  for (const std::vector<std::string>& line : lines()) {
    std::string& row = rows.emplace_back("|");
    for (const std::string& cell : line) row += markdown_cell(cell);
  }
  std::string& alignment = *rows.emplace(rows.begin() + 1, "|");
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    alignment += is_right_aligned(column) ? "---:|" : "---|";
  }
  return joined(rows, "\n") + "\n";
}

nlohmann::ordered_json Table::json() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::vector<Cell>& row : rows_) {
    nlohmann::ordered_json object;
    for (std::size_t column = 0; column < columns_.size(); ++column) object[columns_[column]] = row[column].json();
    list.push_back(object);
  }
  return list;
}

}  // namespace shortshot_bench::campaign
