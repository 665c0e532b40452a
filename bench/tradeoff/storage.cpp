#include "tradeoff/storage.hpp"

namespace shortshot_bench::tradeoff {

paper::Described coded(const paper::Described& described, const Storage& storage) {
  paper::Described result = described;
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

}  // namespace shortshot_bench::tradeoff
