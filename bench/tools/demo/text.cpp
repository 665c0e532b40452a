#include "tools/demo/text.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace shortshot_bench {

std::string text(const char* format, ...) {
  std::array<char, 400> line{};
  va_list values;
  va_start(values, format);
  std::vsnprintf(line.data(), line.size(), format, values);
  va_end(values);
  return line.data();
}

}  // namespace shortshot_bench
