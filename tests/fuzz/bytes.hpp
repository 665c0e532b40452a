// What all harnesses share: the fuzzer's bytes as numbers, and what must be.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

namespace fuzz {

/// A finding, if not: libFuzzer writes down the bytes that led here.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", what);
  std::abort();
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// The input, byte by byte. After its end there are zeros.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  [[nodiscard]] const std::uint8_t* data() const { return data_; }
  [[nodiscard]] std::size_t left() const { return left_; }

  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  int small() { return static_cast<int>(byte()) - 128; }
  std::size_t below(std::size_t count) { return byte() % count; }

  template <class Number>
  Number number() {
    std::uint8_t bytes[sizeof(Number)];
    for (std::uint8_t& b : bytes) b = byte();
    Number result;
    std::memcpy(&result, bytes, sizeof result);
    return result;
  }

  /// Any float: mostly plain ones, some at the ends of the range, some of any bits.
  float real() {
    using Limits = std::numeric_limits<float>;
    constexpr float ends[] = {0.0f,
                              -0.0f,
                              Limits::quiet_NaN(),
                              Limits::infinity(),
                              -Limits::infinity(),
                              1e38f,
                              -1e38f,
                              Limits::max(),
                              Limits::min(),
                              Limits::denorm_min(),
                              1.5e19f,
                              1e-19f,
                              1e-23f,
                              16777216.0f,
                              -Limits::max(),
                              0.1f};
    switch (const std::uint8_t kind = byte(); kind >> 6) {
      case 0: return number<float>();
      case 1: return ends[kind % 16];
      default: return static_cast<float>(small()) / 32.0f;
    }
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace fuzz
