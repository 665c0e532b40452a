#include "paper/campaign/shard.hpp"

#include <charconv>
#include <stdexcept>
#include <system_error>

namespace shortshot_bench::campaign {

Shard parse_shard(const std::string& text) {
  Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto k = std::from_chars(text.data(), end, shard.k);
  if (k.ec == std::errc() && k.ptr != end && *k.ptr == '/') {
    const auto n = std::from_chars(k.ptr + 1, end, shard.n);
    if (n.ec == std::errc() && n.ptr == end && shard.k >= 1 && shard.k <= shard.n) return shard;
  }
  throw std::runtime_error("'" + text + "' is no shard: expected K/N with 1 <= K <= N, such as 2/5");
}

std::string refusal_of_shard(const std::string& text) {
  try {
    static_cast<void>(parse_shard(text));
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace shortshot_bench::campaign
