// What hashes.cpp describes, and how it hashes.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"

namespace shortshot_bits {

/// What is described: key points of a cloud in frames of their own and, where there are any, in given ones.
struct Input {
  std::string name;
  shortshot::CloudView cloud;
  shortshot::Radius radius;
  std::vector<std::uint32_t> keypoints;
  std::vector<shortshot::Frame> frames;  // one per key point, or none at all
};

/// FNV-1a with 64 bits, over the bytes of numbers and of structs of numbers without padding.
class Hash {
 public:
  template <class T>
  void add(const T* values, std::size_t count) {
    std::vector<unsigned char> bytes(count * sizeof(T));
    std::memcpy(bytes.data(), values, bytes.size());
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 1099511628211ULL;
  }

  void print(const std::string& name, const char* array) const {
    std::printf("%s %s %016llx\n", name.c_str(), array, value_);
  }

 private:
  unsigned long long value_ = 14695981039346656037ULL;
};

}  // namespace shortshot_bits
