// shortshot/store/binary.hpp: B-SHOT: one bit for each value of a descriptor, and the distance between such bits.
//
// After S. M. Prakhya, B. Liu, W. Lin: B-SHOT: A binary feature descriptor for fast and efficient keypoint matching on
// 3D point clouds (IROS 2015): the values are taken in groups of four, and the bits of a group say which few of its
// values make up more than 90 % of their sum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "hamming.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D of D::size values as as many bits: bit j is bit j % 8 of byte j / 8, the bits behind the last one are
/// zero. A trivial type of alignment 1: 44 bytes for SHOT-352. `Group` values (2 to 8; 4 in the paper) are looked at
/// together.
template <class D, int Group = 4>
struct BinaryDescriptor {
  static_assert(Group >= 2 && Group <= 8, "BinaryDescriptor<D, Group> supports groups of 2 to 8 values");
  static constexpr int bits = D::size;                                                 ///< one per value
  static constexpr std::size_t size_bytes = (static_cast<std::size_t>(bits) + 7) / 8;  ///< of all bits
  std::uint8_t bytes[size_bytes];  ///< bit j is bit j % 8 of byte j / 8
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// All subsets of a group, the one that B-SHOT prefers last: the whole group, then those that are tried, from the last
/// one to the first, then the empty one. Bit i of a subset stands for value i.
///
/// Fewer values are tried first. Of as many values, the subsets that rotating the group turns into each other follow
/// each other, in the order of the smallest number among them: the smaller it is, the closer together are the values.
/// That one is the first of them, and each rotation by one place the next.
///
/// For four values this is the order that B-SHOT's authors published, but for {1, 3}, which they try before {0, 2}: of
/// values that are not negative, two disjoint subsets never both have more than 90 %.
template <int Group>
struct Subsets {
  static constexpr int count = 1 << Group;
  static constexpr unsigned whole = (1u << Group) - 1u;
  std::uint8_t of[static_cast<std::size_t>(count)];

  constexpr Subsets() noexcept : of{} {
    int place = count - 1;  // of the empty one
    for (int values = 1; values <= Group; ++values) {
      for (unsigned smallest = 1; smallest <= whole; ++smallest) {
        if (values_of(smallest) != values || !is_smallest(smallest)) continue;
        unsigned subset = smallest;
        do {
          of[--place] = static_cast<std::uint8_t>(subset);
          subset = rotated(subset);
        } while (subset != smallest);
      }
    }
  }

  /// How many subsets have more than `values` values: the place of the last one tried of those with as many.
  static constexpr int larger_than(int values) noexcept {
    int larger = 0;
    for (unsigned subset = 1; subset <= whole; ++subset) larger += values_of(subset) > values ? 1 : 0;
    return larger;
  }
  static constexpr unsigned rotated(unsigned subset) noexcept { return (subset << 1 | subset >> (Group - 1)) & whole; }
  static constexpr int values_of(unsigned subset) noexcept {
    int values = 0;
    for (; subset != 0; subset &= subset - 1) ++values;
    return values;
  }
  static constexpr bool is_smallest(unsigned subset) noexcept {
    unsigned other = rotated(subset);
    while (other > subset) other = rotated(other);
    return other == subset;
  }
};
template <int Group>
inline constexpr Subsets<Group> subsets{};

/// Sum of a subset of `values`, the first two first.
template <unsigned Subset>
[[nodiscard, gnu::always_inline]] inline simd::F32 sum_of(const simd::F32* values) noexcept {
  constexpr int last = [] {
    int i = 0;
    while (Subset >> i > 1u) ++i;
    return i;
  }();
  constexpr unsigned others = Subset - (1u << last);
  if constexpr (others == 0) {
    return values[last];
  } else {
    return sum_of<others>(values) + values[last];
  }
}

/// The largest float that is not above 0.9 * sum, for sums from 0: a float is above the one if it is above the other.
/// (The authors compare with that product in double, whose own rounding never moves it to or across a float.)
/// The float product is this number or the next one, because 0.9f is less than half a unit of the product too small. It
/// is the next one if ten times the rest is below the sum. Neither difference is rounded: no term is more than twice
/// the other, or all are subnormal.
[[nodiscard]] inline simd::F32 nine_tenths(simd::F32 sum) noexcept {
  const simd::F32 product = sum * simd::all(0.9f);
  const simd::F32 rest = sum - product;
  const simd::Mask above = sum - rest * simd::all(8.0f) > rest + rest;
  return simd::from_bits(simd::bits_of(product) - simd::keep(above, simd::all_int(1)));
}

/// Where `found` is 0, the place in subsets<Group>.of of the subset of `Values` values or more that is tried first of
/// those with a sum above the limit; else `found`. Most groups of SHOT are zero or have one large value: no more is
/// tried than some lane needs.
template <int Group, int Values>
[[nodiscard, gnu::always_inline]] inline simd::I32 find_subsets(const simd::F32* v, simd::F32 limit,
                                                                simd::I32 found) noexcept {
  if constexpr (Values == Group) {
    return found;
  } else {
    constexpr int first = Subsets<Group>::larger_than(Values);
    unroll<Subsets<Group>::larger_than(Values - 1) - first>([&](auto k) {
      constexpr int place = first + k;
      const simd::Mask enough = sum_of<subsets<Group>.of[place]>(v) > limit;
      found = simd::small_max(found, simd::keep(enough, simd::all_int(place)));
    });
    return any(found == simd::all_int(0)) ? find_subsets<Group, Values + 1>(v, limit, found) : found;
  }
}

/// The places in subsets<Group>.of of as many groups as there are lanes, one group after the other from `values` on.
template <int Group>
[[gnu::always_inline]] inline void find_subsets(const float* values, std::int32_t* places) noexcept {
  constexpr auto stride = static_cast<std::size_t>(Group);
  simd::F32 v[static_cast<std::size_t>(Group)];
  unroll<Group>([&](auto i) { v[i] = simd::from_lanes([&](std::size_t k) { return values[k * stride + i]; }); });
  const simd::F32 sum = sum_of<Subsets<Group>::whole>(v);
  const simd::I32 empty = simd::drop(sum != simd::all(0.0f), simd::all_int(Subsets<Group>::count - 1));
  simd::store(places, find_subsets<Group, 1>(v, nine_tenths(sum), empty));
}

/// The bits of eight groups: as many bytes as a group has values.
template <int Group>
inline void binarize_groups(const float* values, std::uint8_t* bytes) noexcept {
  std::int32_t places[8];
  for (std::size_t group = 0; group < 8; group += simd::lanes) {
    find_subsets<Group>(values + group * static_cast<std::size_t>(Group), places + group);
  }
  unroll<Group>([&](auto byte) {
    unsigned bits = 0;
    unroll<8>([&](auto group) {
      constexpr int shift = group * Group - byte * 8;
      if constexpr (shift > -Group && shift < 8) {
        const unsigned subset = subsets<Group>.of[places[group]];
        bits |= shift < 0 ? subset >> -shift : subset << shift;
      }
    });
    bytes[byte] = static_cast<std::uint8_t>(bits & 0xFFu);
  });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The B-SHOT of D::size descriptor values (not negative, of any scale: only ratios count). In each group of `Group`
/// consecutive values, with S their sum: no bits if all are zero; else the bits of the first subset, in the order of
/// detail::Subsets (single values, then pairs, ...), whose sum is more than 0.9 S; all bits if there is none, which
/// includes a group with a NaN. If D::size is no multiple of Group, the last group is filled up with zeros, which have
/// no bits in `out`.
///
/// The sums are added from left to right in single precision, and the comparisons decide as the authors' in double do:
/// with Group = 4 the bits are theirs. No allocation, no error, reentrant.
template <class D, int Group = 4>
void binarize(const float* values, BinaryDescriptor<D, Group>& out) noexcept {
  constexpr std::size_t bytes = Group;  // of eight groups
  constexpr std::size_t size = D::size;
  constexpr std::size_t rest = size % (8 * bytes);
  std::uint8_t* to = out.bytes;
  for (std::size_t i = 0; i < size - rest; i += 8 * bytes, to += bytes) detail::binarize_groups<Group>(values + i, to);
  if constexpr (rest != 0) {
    float last_values[8 * bytes] = {};
    std::uint8_t last_bytes[bytes];
    std::memcpy(last_values, values + size - rest, rest * sizeof(float));
    detail::binarize_groups<Group>(last_values, last_bytes);
    if constexpr (rest % 8 != 0) last_bytes[rest / 8] &= static_cast<std::uint8_t>((1u << rest % 8) - 1u);
    std::memcpy(to, last_bytes, (rest + 7) / 8);
  }
}

/// Number of bits in which two binary descriptors differ, 0 to D::size.
template <class D, int Group>
[[nodiscard, gnu::always_inline]] inline int hamming_distance(const BinaryDescriptor<D, Group>& a,
                                                              const BinaryDescriptor<D, Group>& b) noexcept {
  return hamming_distance(a.bytes, b.bytes, sizeof a.bytes);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
