// The figures as text for a terminal, and as JSON.
#pragma once

#include <string>
#include <vector>

#include "firmware/report/figures.hpp"
#include "firmware/report/promises.hpp"

namespace shortshot_bench::firmware {

/// One table for each configuration.
std::string tables(const Measured& measured);

std::string to_json(const Measured& measured, const std::vector<Budget>& budgets,
                    const std::vector<std::string>& broken);

}  // namespace shortshot_bench::firmware
