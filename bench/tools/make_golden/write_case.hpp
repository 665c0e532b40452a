// A cloud and what was made of it, as a folder of golden vectors.
#pragma once

#include <string>
#include <vector>

#include "clouds.hpp"
#include "rows.hpp"

namespace shortshot_bench::make_golden {

// Makes the folder and its files, or writes over them. Throws InputError if one cannot be written.
void write_case(const std::string& folder, const Cloud& cloud, const Frames& frames, const std::vector<Rows>& rows);

}  // namespace shortshot_bench::make_golden
