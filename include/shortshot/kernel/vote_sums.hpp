// shortshot/kernel/vote_sums.hpp: the integers that votes are added to.
#ifndef SHORTSHOT_KERNEL_VOTE_SUMS_HPP
#define SHORTSHOT_KERNEL_VOTE_SUMS_HPP

#include <cstdint>
#include <cstring>

#include "../base/simd.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The integers that votes are added to live in the caller's output array, bit for bit, until they are normalized: no
/// second array is needed. memcpy is how C++ says that; compilers make one load or store of it, if they are told the
/// alignment where CPUs insist on it.
[[nodiscard, gnu::always_inline]] inline std::int32_t integer_at(const float* value) noexcept {
  std::int32_t integer = 0;
  std::memcpy(&integer, __builtin_assume_aligned(value, alignof(float)), sizeof integer);
  return integer;
}

[[gnu::always_inline]] inline void set_bits(float* value, std::int32_t integer) noexcept {
  std::memcpy(__builtin_assume_aligned(value, alignof(float)), &integer, sizeof integer);
}

/// What is at a place, and a weight more. (Modulo 2^32: a place for votes that go nowhere takes any number of them.)
[[nodiscard, gnu::always_inline]] inline std::int32_t sum_at(const float* value, std::int32_t weight) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(integer_at(value)) + static_cast<std::uint32_t>(weight));
}

inline void add_bits(float* value, std::int32_t weight) noexcept { set_bits(value, sum_at(value, weight)); }

/// What the only lane holds.
[[nodiscard, gnu::always_inline]] inline std::int32_t integer_in(simd::I32 lane) noexcept {
  std::int32_t integer = 0;
  simd::store(&integer, lane);
  return integer;
}

/// One vote of the only lane.
[[gnu::always_inline]] inline void add_vote(float* sum, simd::I32 weight) noexcept {
  add_bits(sum, integer_in(weight));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_VOTE_SUMS_HPP
