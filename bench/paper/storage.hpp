// The formats in which descriptors are stored, for descriptors whose type is known at run time only.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "paper/configuration.hpp"
#include "shortshot/shortshot.hpp"

namespace shortshot_bench::paper {

/// Squared distances of codes are in the order of the format's own distances, and have the same ties: its whole steps,
/// or its bits as 0 and 1. So every format can be compared by rows of floats.
struct Storage {
  std::string name;        // "float", "4bit", ...
  std::size_t size_bytes;  // of a descriptor
  std::size_t code_size;   // numbers of its code
  void (*pack)(const float* values, unsigned char* bytes);
  void (*unpack)(const unsigned char* bytes, float* code);
};

/// The codes of all rows.
Described coded(const Described& described, const Storage& storage);

/// Each value's share of its row's sum, all taken as positive, and of that the square root, with the value's sign: the
/// L2 distance of such rows is Hellinger's of the histograms. (RootSIFT: R. Arandjelovic, A. Zisserman: Three things
/// everyone should know to improve object retrieval, CVPR 2012.) A row of zeros stays one.
Described rooted(const Described& described);

namespace storage_detail {

template <class D>
void code_of(const shortshot::HalfDescriptor<D>& packed, float* code) {
  shortshot::dequantize(packed, code);
}
template <class D, int Bits, int Scale>
void code_of(const shortshot::CodedDescriptor<D, Bits, Scale>& packed, float* code) {
  shortshot::dequantize(packed, code);
  for (int i = 0; i < D::size; ++i) code[i] = std::nearbyint(code[i] * static_cast<float>(Scale));
}
template <std::size_t SizeBytes>
void code_of_bits(const std::uint8_t (&bytes)[SizeBytes], int bits, float* code) {
  for (int i = 0; i < bits; ++i) code[i] = static_cast<float>(bytes[i / 8] >> i % 8 & 1);
}
template <class D, int Group>
void code_of(const shortshot::BinaryDescriptor<D, Group>& packed, float* code) {
  code_of_bits(packed.bytes, D::size, code);
}
template <class D, int Bits, int Draws>
void code_of(const shortshot::SumBits<D, Bits, Draws>& packed, float* code) {
  code_of_bits(packed.bytes, Bits, code);
}

/// As the format is made of values: by one of these.
template <class Packed>
auto pack(const float* values, Packed& packed) -> decltype(shortshot::quantize(values, packed)) {
  shortshot::quantize(values, packed);
}
template <class Packed>
auto pack(const float* values, Packed& packed) -> decltype(shortshot::binarize(values, packed)) {
  shortshot::binarize(values, packed);
}

}  // namespace storage_detail

/// Floats as they are.
template <class D>
Storage float_storage() {
  constexpr auto size = static_cast<std::size_t>(D::size);
  const auto pack = [](const float* values, unsigned char* bytes) { std::memcpy(bytes, values, size * sizeof(float)); };
  const auto unpack = [](const unsigned char* bytes, float* code) { std::memcpy(code, bytes, size * sizeof(float)); };
  return {"float", size * sizeof(float), size, pack, unpack};
}

/// One of the library's packed types, which are trivial.
template <class Packed>
Storage packed_storage(std::string name, std::size_t code_size) {
  const auto pack = [](const float* values, unsigned char* bytes) {
    Packed packed;
    storage_detail::pack(values, packed);
    std::memcpy(bytes, &packed, sizeof packed);
  };
  const auto unpack = [](const unsigned char* bytes, float* code) {
    Packed packed;
    std::memcpy(&packed, bytes, sizeof packed);
    storage_detail::code_of(packed, code);
  };
  return {std::move(name), sizeof(Packed), code_size, pack, unpack};
}

}  // namespace shortshot_bench::paper
