#include "tools/labels/csv_table.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>  // libfccp lacks it
#include <tuple>

#include "tools/io/byte_source.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wstringop-truncation"  // libfccp's cut of a long file name, inlined into read_csv()
#endif
#define CSV_IO_NO_THREAD  // libfccp would start a thread for each file
#include <libfccp/csv.h>

namespace shortshot_bench::datasets {

template <std::size_t Columns>
std::vector<CsvRow<Columns>> read_csv(const std::string& path, const std::array<const char*, Columns>& names) {
  const ByteSource source(path);
  std::string text(source.rest());
  if (text.empty() || text.back() != '\n') text += '\n';  // without it libfccp looks at a byte past the end
  io::CSVReader<Columns, io::trim_chars<' ', '\t'>, io::double_quote_escape<',', '"'>, io::throw_on_overflow,
                io::empty_line_comment>
      csv(std::filesystem::path(path).filename().string(), text.data(), text.data() + text.size());
  const auto error = [&](const std::string& what) {
    return InputError::at_line(path, std::max<std::uint64_t>(csv.get_file_line(), 1), what);
  };
  std::vector<CsvRow<Columns>> rows;
  try {
    std::apply([&](auto... name) { csv.read_header(io::ignore_extra_column, name...); }, names);
    CsvRow<Columns> row;
    while (std::apply([&](auto&... cell) { return csv.read_row(cell...); }, row.cells)) {
      for (std::size_t i = 0; i < Columns; ++i) {
        if (row.cells[i].empty()) throw error("expected text in column " + std::string(names[i]) + ", found none");
      }
      row.line = csv.get_file_line();
      rows.push_back(row);
    }
  } catch (const io::error::base& wrong) {
    throw error(wrong.what());
  }
  if (rows.empty()) throw error("expected one or more rows below the header, found none");
  return rows;
}

template std::vector<CsvRow<2>> read_csv(const std::string&, const std::array<const char*, 2>&);
template std::vector<CsvRow<3>> read_csv(const std::string&, const std::array<const char*, 3>&);
template std::vector<CsvRow<4>> read_csv(const std::string&, const std::array<const char*, 4>&);
template std::vector<CsvRow<5>> read_csv(const std::string&, const std::array<const char*, 5>&);

}  // namespace shortshot_bench::datasets
