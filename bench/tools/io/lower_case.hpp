// Letters of A to Z as small ones, in no locale.
#pragma once

#include <string>
#include <string_view>

namespace shortshot_bench {

inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

}  // namespace shortshot_bench
