// Private to the readers: which number of a color channel means full brightness.
#pragma once

#include <cstdint>

#include "scalar_type.hpp"

namespace shortshot_bench {

/// 1, 255 or 65535, told apart by the largest of all values, up to twice of which counts as noise of an interpolation;
/// 0 where it is none of them. Whole numbers are never 0 to 1, bytes always 0 to 255.
double full_brightness(const ScalarType& type, double largest);

/// A value as a byte; what is outside of 0 to `full` is clamped, NaN is 0.
std::uint8_t to_color_byte(double value, double full);

}  // namespace shortshot_bench
