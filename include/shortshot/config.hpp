// shortshot/config.hpp: the macros the library sets. There is none for you to set: options are template parameters.
#pragma once

// Set by us: the kernel's code compiled for another instruction set, or for size, lives in another inline namespace, so
// that two translation units of one program may be compiled with different -m flags, or one with -Os, without one's
// code being linked into the other.
#if defined(__OPTIMIZE_SIZE__)
#define SHORTSHOT_CODE(isa) isa##_small
#else
#define SHORTSHOT_CODE(isa) isa
#endif
#if defined(__AVX512F__)
#define SHORTSHOT_ISA SHORTSHOT_CODE(isa_avx512)
#elif defined(__AVX2__)
#define SHORTSHOT_ISA SHORTSHOT_CODE(isa_avx2)
#elif defined(__AVX__)
#define SHORTSHOT_ISA SHORTSHOT_CODE(isa_avx)
#elif defined(__SSE4_1__)
#define SHORTSHOT_ISA SHORTSHOT_CODE(isa_sse4)
#elif defined(__SSE2__)
#define SHORTSHOT_ISA SHORTSHOT_CODE(isa_sse2)
#elif defined(__ARM_NEON)
#define SHORTSHOT_ISA SHORTSHOT_CODE(isa_neon)
#else
#define SHORTSHOT_ISA SHORTSHOT_CODE(isa_scalar)
#endif

// Set by us, too: functions, and lambdas, that are inlined for speed, but left to the compiler where it was asked for
// small code (-Os).
#if defined(__OPTIMIZE_SIZE__)
#define SHORTSHOT_INLINE inline
#define SHORTSHOT_INLINE_LAMBDA
#else
#define SHORTSHOT_INLINE [[gnu::always_inline]] inline
#define SHORTSHOT_INLINE_LAMBDA __attribute__((always_inline))
#endif
