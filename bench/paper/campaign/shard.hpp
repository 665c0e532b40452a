// Which share of a campaign's units a process does: a campaign can be spread over machines.
#pragma once

#include <cstddef>
#include <string>

namespace shortshot_bench::campaign {

/// The k-th of n shares: the units whose index % n is k - 1.
struct Shard {
  std::size_t k = 1;
  std::size_t n = 1;

  bool contains(std::size_t index) const { return index % n == k - 1; }
};

/// Reads "k/n" with 1 <= k <= n. Throws std::runtime_error, which says what was expected, for anything else.
Shard parse_shard(const std::string& text);

/// For command lines: empty if parse_shard() reads it, else what that throws.
std::string refusal_of_shard(const std::string& text);

}  // namespace shortshot_bench::campaign
