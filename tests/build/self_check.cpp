// Says whether the flags it was compiled with keep the promise of the same bits: exit code 0, 1, or 77 without the CPU.
#include <shortshot/kernel.hpp>

int main() {
#if defined(__AVX__)  // as -mfma implies, whatever else is undefined
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2")) return 77;
#endif
  return shortshot::self_check() ? 0 : 1;
}
