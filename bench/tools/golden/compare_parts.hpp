// What the comparisons of all kinds of arrays share.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>

#include "case.hpp"
#include "shortshot/cloud/cloud.hpp"

namespace shortshot_bench::golden {

// Is `part` more than that many percent of the whole?
bool is_more_than(std::size_t part, std::size_t percent, std::size_t whole);

std::string number_text(const char* before, double value, const char* after = "");

// Absolute and L2 difference of one row; infinite where one side is not a number.
struct Difference {
  double largest = 0.0;
  double l2 = 0.0;
};

Difference difference_of(const float* ours, const float* reference, std::size_t size);

// What the inputs of a case lack for an array; empty if it can be checked.
std::string lacking(const Case& c, std::initializer_list<const char*> needed);

shortshot::Point center_of(const Case& c, std::size_t row);

}  // namespace shortshot_bench::golden
