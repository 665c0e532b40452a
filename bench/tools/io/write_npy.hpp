// Writes a matrix as a NumPy file.
#pragma once

#include <cstddef>
#include <string>

namespace shortshot_bench {

// `data` holds rows * columns floats, row by row. Throws InputError if the file cannot be written.
void write_npy(const std::string& path, const float* data, std::size_t rows, std::size_t columns);

}  // namespace shortshot_bench
