// shortshot/dispatch/kernel_for_avx2.hpp: the kernel a second time, for AVX2, where the compiler was told of a plain
// x86-64 only. Distributions build such programs, and machines without AVX2 have become rare. Hosted only.
//
// The same files are read again with another lane shim (base/simd.hpp) into a namespace of its own, `shortshot_avx2`,
// whose types are twins of those in `shortshot` (twins.hpp): no function of the one is a function of the other, for the
// compiler or for a linker. It needs no fused multiply-add, and every sum is one of integers: the same bits.
//
// Not where code shall be small (-Os), not where the single header has another name than shortshot.hpp (it reads
// itself), and not where SHORTSHOT_NO_DISPATCH is 1, which saves the time it takes to compile and changes no result.
#pragma once

#include "../config.hpp"
#include "hot_kernel.hpp"

#if defined(__x86_64__) && !defined(__AVX2__) && !defined(__OPTIMIZE_SIZE__) && \
    !SHORTSHOT_IS_SET(SHORTSHOT_NO_DISPATCH) && __has_include("hot_kernel.hpp")
#include <immintrin.h>

namespace shortshot_avx2 {
namespace extend {}
namespace detail {
using namespace extend;
}
}  // namespace shortshot_avx2

#define SHORTSHOT_FOR_AVX2
#include "forget_kernel.hpp"
#define shortshot shortshot_avx2  // NOLINT: no macro of the library, but a name for a while
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

#include "hot_kernel.hpp"  // again

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#undef shortshot
#undef SHORTSHOT_FOR_AVX2
#define SHORTSHOT_HAS_KERNEL_FOR_AVX2
#endif
