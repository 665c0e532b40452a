// One program of translation units for different instruction sets, and for size: all must compute the same bits.
#include <cstdio>
#include <cstring>

#include "isa_probe.hpp"

namespace {

bool same(const char* name, const IsaProbe& probe, const IsaProbe& reference) {
  const bool equal = probe.status == shortshot::Status::ok && probe.status == reference.status &&
                     std::memcmp(probe.scsh, reference.scsh, sizeof probe.scsh) == 0 &&
                     std::memcmp(probe.cshot, reference.cshot, sizeof probe.cshot) == 0 &&
                     std::memcmp(probe.bits, reference.bits, sizeof probe.bits) == 0;
  std::printf("%s: %s, %s\n", name, probe.message, equal ? "same bits" : "DIFFERENT");
  return equal;
}

}  // namespace

int main() {
  const IsaProbe reference = describe_sse2();
  if (!same("scalar", describe_scalar(), reference)) return 1;
  if (!same("small", describe_sse2_small(), reference)) return 1;
  if (!__builtin_cpu_supports("avx2")) {
    std::puts("avx2: skipped, this CPU has none");
    return 77;
  }
  return same("avx2", describe_avx2(), reference) ? 0 : 1;
}
