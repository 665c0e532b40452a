// Lines of text with numbers in them.
#pragma once

#include <string>

namespace shortshot_bench {

/// As printf() prints it, up to 400 bytes.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

/// Of a share, 0 to 1.
inline double percent(float share) { return 100.0 * static_cast<double>(share); }

}  // namespace shortshot_bench
