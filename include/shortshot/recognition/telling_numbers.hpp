// shortshot/recognition/telling_numbers.hpp: which numbers of descriptors tell most of them apart. Hosted only:
// allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../config.hpp"
#include "../store/code_distance.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The numbers of rows, those first that differ most from row to row, by up to 256 pairs: an order in which it is known
/// early that two rows are too far apart. `count` rows of `size` bytes, of numbers of `Bits` bits; difference(a, b) of
/// two numbers.
template <int Bits, class Difference>
[[nodiscard]] std::vector<std::uint32_t> most_telling_first(const std::uint8_t* bytes, std::size_t count,
                                                            std::size_t size, const Difference& difference) {
  constexpr std::size_t most_pairs = 256;
  const std::size_t numbers = size * 8 / Bits;
  std::vector<std::uint64_t> differences(numbers);
  const std::size_t stride = std::max<std::size_t>(1, count / most_pairs);
  for (std::size_t row = stride; row < count; row += stride) {
    const std::uint8_t* const a = bytes + row * size;
    const std::uint8_t* const b = a - stride * size;
    for (std::size_t i = 0; i < numbers; ++i)
      differences[i] += difference(number_at<Bits>(a, i), number_at<Bits>(b, i));
  }
  std::vector<std::uint32_t> order(numbers);
  for (std::size_t i = 0; i < numbers; ++i) order[i] = static_cast<std::uint32_t>(i);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
    return differences[i] != differences[k] ? differences[i] > differences[k] : i < k;
  });
  return order;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
