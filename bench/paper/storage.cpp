#include "paper/storage.hpp"

namespace shortshot_bench::paper {

Described coded(const Described& described, const Storage& storage) {
  Described result = described;
  const std::size_t rows = described.status.size();
  result.size = storage.code_size;
  result.values.assign(rows * storage.code_size, 0.0f);
  std::vector<unsigned char> bytes(storage.size_bytes);
  for (std::size_t row = 0; row < rows; ++row) {
    storage.pack(described.values.data() + row * described.size, bytes.data());
    storage.unpack(bytes.data(), result.values.data() + row * storage.code_size);
  }
  return result;
}

Described rooted(const Described& described) {
  Described result = described;
  for (std::size_t row = 0; row < described.status.size(); ++row) {
    float* const values = result.values.data() + row * described.size;
    float sum = 0.0f;
    for (std::size_t i = 0; i < described.size; ++i) sum += std::abs(values[i]);
    if (!(sum > 0.0f)) continue;
    for (std::size_t i = 0; i < described.size; ++i) {
      values[i] = std::copysign(std::sqrt(std::abs(values[i]) / sum), values[i]);
    }
  }
  return result;
}

}  // namespace shortshot_bench::paper
