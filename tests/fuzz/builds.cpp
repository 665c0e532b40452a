// The library for AVX2, for SSE2 and without SIMD, in one program: the same bits.
#include "rows_of_build.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes from(data, size);
  const std::size_t which = from.byte();
  const fuzz::MadeCloud cloud = fuzz::made_cloud(from, 64);
  if (cloud.size() == 0) return 0;
  static std::vector<std::uint8_t> scalar, sse2, avx2;
  for (auto* rows : {&scalar, &sse2, &avx2}) rows->clear();
  const std::size_t key = which % cloud.size();
  fuzz::rows_scalar(cloud, key, scalar);
  fuzz::rows_sse2(cloud, key, sse2);
  fuzz::require(scalar == sse2, "SSE2 has the bits of no SIMD");
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 0;
  fuzz::rows_avx2(cloud, key, avx2);
  fuzz::require(scalar == avx2, "AVX2 has the bits of no SIMD");
  return 0;
}
