// The columns of a CSV file that are asked for, as text.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace shortshot_bench::datasets {

template <std::size_t Columns>
struct CsvRow {
  std::array<std::string, Columns> cells;  // in the order asked for
  std::uint64_t line = 0;                  // of the file, from 1
};

/// All rows below the header line; columns of other names are skipped, and so are blank lines. Cells may be quoted.
/// Throws InputError with the line: a column that is missing or there twice, a row of another length, an empty cell, no
/// row at all. For 2 to 5 columns: the reader's machinery is in csv_table.cpp.
template <std::size_t Columns>
std::vector<CsvRow<Columns>> read_csv(const std::string& path, const std::array<const char*, Columns>& names);

extern template std::vector<CsvRow<2>> read_csv(const std::string&, const std::array<const char*, 2>&);
extern template std::vector<CsvRow<3>> read_csv(const std::string&, const std::array<const char*, 3>&);
extern template std::vector<CsvRow<4>> read_csv(const std::string&, const std::array<const char*, 4>&);
extern template std::vector<CsvRow<5>> read_csv(const std::string&, const std::array<const char*, 5>&);

}  // namespace shortshot_bench::datasets
