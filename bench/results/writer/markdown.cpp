#include "results/writer/markdown.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace shortshot_bench::results {
namespace {

std::string line_of(std::vector<std::string> cells, std::size_t columns) {
  cells.resize(columns);
  std::string line = "|";
  for (const std::string& cell : cells) line += cell.empty() ? " |" : " " + cell + " |";
  return line + "\n";
}

std::string printed(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string Table::markdown() const {
  std::string text = line_of(header_, header_.size()) + "|---|";
  for (std::size_t column = 1; column < header_.size(); ++column) text += "---:|";
  text += "\n";
  for (const std::vector<std::string>& row : rows_) text += line_of(row, header_.size());
  return text;
}

std::string digits(double value) {
  constexpr int significant = 3;
  if (value == 0.0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::fabs(value))));
  char text[400];
  if (exponent < -3) {
    std::snprintf(text, sizeof text, "%.*e", significant - 1, value);
  } else {
    std::snprintf(text, sizeof text, "%.*f", std::max(0, significant - 1 - exponent), value);
  }
  return text;
}

std::string whole(double value) { return printed("%.0f", value); }

std::string times(double ratio) { return printed(ratio < 10.0 ? "%.1fx" : "%.0fx", ratio); }

std::string megabytes(double bytes) {
  if (bytes == 0.0) return "0";
  return bytes < 1e6 ? printed("%.3g KB", 1e-3 * bytes) : printed("%.1f MB", 1e-6 * bytes);
}

std::string with_block(const std::string& document, const std::string& name, const std::string& content,
                       const std::string& path) {
  const std::string begin = "<!-- generated: " + name + " -->\n";
  const std::string end = "<!-- end -->";
  const std::size_t at = document.find(begin);
  if (at == std::string::npos)
    throw std::runtime_error(path + ": there is no line '" + begin.substr(0, begin.size() - 1) + "'");
  const std::size_t first = at + begin.size();
  if (document.find(begin, first) != std::string::npos) {
    throw std::runtime_error(path + ": the block '" + name + "' is there twice");
  }
  const std::size_t last = document.find(end, first);
  const std::size_t next = document.find("<!-- generated: ", first);
  if (last == std::string::npos || next < last) {
    throw std::runtime_error(path + ": the block '" + name + "' has no line '" + end + "'");
  }
  return document.substr(0, first) + content + document.substr(last);
}

}  // namespace shortshot_bench::results
