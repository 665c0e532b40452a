// Small matrices in text files: poses and camera parameters.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace shortshot_bench {

/// The numbers row by row; `what` names the matrix in messages. One row to a line, white space between the numbers,
/// blank lines skipped. Throws InputError for any other number of rows or columns and for what is no finite number.
std::vector<double> read_matrix(const std::string& path, std::size_t rows, std::size_t columns,
                                const std::string& what);

}  // namespace shortshot_bench
