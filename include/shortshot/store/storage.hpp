// shortshot/store/storage.hpp: what the storages of a descriptor have in common: how they are made, and what they are
// called.
#pragma once

#include <cstdint>

#include "../config.hpp"
#include "../descriptor/layout_text.hpp"
#include "binary.hpp"
#include "code_scale.hpp"
#include "coded.hpp"
#include "half.hpp"
#include "hamming.hpp"
#include "sum_bits.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The descriptor that a storage is of, what its rows are made of in files, how it is said, how it is made; of how many
/// bits the numbers of a row are, and how far two rows are apart in whole numbers, in whatever order these are, if that
/// is below a limit; else any number that is not. (Halves are no whole numbers.)
template <class Stored>
struct Storage;
template <class D>
struct Storage<HalfDescriptor<D>> {
  using Descriptor = D;
  using Value = std::uint16_t;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add(text, "halves");
  }
  static void make(const float* values, HalfDescriptor<D>& out) noexcept { quantize(values, out); }
};
template <class D, int Bits, int Scale>
struct Storage<CodedDescriptor<D, Bits, Scale>> {
  using Descriptor = D;
  using Value = std::uint8_t;
  static constexpr int number_bits = Bits;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add_all(text, "codes of ", Bits, " bits, steps of 1/", Scale);
  }
  static void make(const float* values, CodedDescriptor<D, Bits, Scale>& out) noexcept { quantize(values, out); }
  [[nodiscard]] SHORTSHOT_INLINE static std::uint32_t distance_below(const CodedDescriptor<D, Bits, Scale>& a,
                                                                     const CodedDescriptor<D, Bits, Scale>& b,
                                                                     std::uint32_t limit) noexcept {
    return squared_code_distance_below<Bits>(a.bytes, b.bytes, sizeof a.bytes, limit);
  }
};
template <class D, int Group>
struct Storage<BinaryDescriptor<D, Group>> {
  using Descriptor = D;
  using Value = std::uint8_t;
  static constexpr int number_bits = 1;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add_all(text, "bits of groups of ", Group);
  }
  static void make(const float* values, BinaryDescriptor<D, Group>& out) noexcept { binarize(values, out); }
  [[nodiscard]] SHORTSHOT_INLINE static std::uint32_t distance_below(const BinaryDescriptor<D, Group>& a,
                                                                     const BinaryDescriptor<D, Group>& b,
                                                                     std::uint32_t limit) noexcept {
    return hamming_distance_below(a.bytes, b.bytes, sizeof a.bytes, limit);
  }
};
template <class D, int Bits, int Draws>
struct Storage<SumBits<D, Bits, Draws>> {
  using Descriptor = D;
  using Value = std::uint8_t;
  static constexpr int number_bits = 1;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add_all(text, Bits, " bits of sums of ", Draws, ", steps of 1/", code_scale<D, 4>);
  }
  static void make(const float* values, SumBits<D, Bits, Draws>& out) noexcept { binarize(values, out); }
  [[nodiscard]] SHORTSHOT_INLINE static std::uint32_t distance_below(const SumBits<D, Bits, Draws>& a,
                                                                     const SumBits<D, Bits, Draws>& b,
                                                                     std::uint32_t limit) noexcept {
    return hamming_distance_below(a.bytes, b.bytes, sizeof a.bytes, limit);
  }
};

/// The descriptor's layout, and how it is stored: see storage_layout().
template <class Stored, class Text>
constexpr void add_storage_layout(Text& text) {
  add_layout(text, static_cast<const typename Storage<Stored>::Descriptor*>(nullptr));
  add(text, " in ");
  Storage<Stored>::add_name(text);
}

/// storage_layout() as a number, for where there are no strings.
template <class Stored>
inline constexpr std::uint64_t storage_number = [] {
  LayoutNumber text;
  add_storage_layout<Stored>(text);
  return text.value;
}();

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
