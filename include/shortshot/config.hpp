// shortshot/config.hpp: the macros the library sets. Options are template parameters. There is one macro for you to
// set, which changes no result: with -DSHORTSHOT_NO_DISPATCH the library keeps to the instructions that the compiler
// was told of (dispatch/kernel_for_avx2.hpp).
//
// Everything in `shortshot` (for users), `shortshot::extend` (for those who add a signal, a voting rule, a search or a
// frame) and `shortshot::detail` (for nobody) lies in one of two inline namespaces:
//
//     inline namespace SHORTSHOT_TYPES {   what may cross a library's border: plain data, tags, rows of descriptors
//     inline namespace SHORTSHOT_CODE {    what becomes machine code: another one for each set of compiler flags
//
// (both named after the version: two versions in one program do not meet), so that translation units compiled with
// different -m flags can hand each other descriptors, and a linker never takes the one's code for the other. A member
// of a type is told apart by an argument that lies in SHORTSHOT_CODE (a register of lanes), or is always inlined.
#pragma once

#include "version.hpp"

#if !defined(__GNUC__) || defined(__INTEL_COMPILER) || (!defined(__clang__) && __GNUC__ < 9) || \
    (defined(__clang__) && __clang_major__ < 10)
#error "shortshot supports GCC 9 and clang 10 or newer: it needs their builtins and assembly statements"
#elif !defined(__cplusplus) || __cplusplus < 201703L
#error "shortshot supports C++17 or newer: compile with -std=c++17"
#endif

// SHORTSHOT_IS_SET(M) is 1 where M is a macro with the value 1, else 0. (The second of (0, 1, ...) or of (x 1, 0).)
#define SHORTSHOT_BEFORE_ONE_1 0,
#define SHORTSHOT_SECOND(first, second, ...) second
// A comment in the line itself would be pasted, too, with GCC's -CC (Arduino).
// NOLINTNEXTLINE: parentheses would hide the comma
#define SHORTSHOT_CHOOSE(before_one) SHORTSHOT_SECOND(before_one 1, 0, )
#define SHORTSHOT_PASTE_VALUE(value) SHORTSHOT_CHOOSE(SHORTSHOT_BEFORE_ONE_##value)
#define SHORTSHOT_IS_SET(macro) SHORTSHOT_PASTE_VALUE(macro)

// Four of these as a hexadecimal digit.
#define SHORTSHOT_DIGIT_0000 0
#define SHORTSHOT_DIGIT_0001 1
#define SHORTSHOT_DIGIT_0010 2
#define SHORTSHOT_DIGIT_0011 3
#define SHORTSHOT_DIGIT_0100 4
#define SHORTSHOT_DIGIT_0101 5
#define SHORTSHOT_DIGIT_0110 6
#define SHORTSHOT_DIGIT_0111 7
#define SHORTSHOT_DIGIT_1000 8
#define SHORTSHOT_DIGIT_1001 9
#define SHORTSHOT_DIGIT_1010 a
#define SHORTSHOT_DIGIT_1011 b
#define SHORTSHOT_DIGIT_1100 c
#define SHORTSHOT_DIGIT_1101 d
#define SHORTSHOT_DIGIT_1110 e
#define SHORTSHOT_DIGIT_1111 f
#define SHORTSHOT_PASTE_DIGIT(a, b, c, d) SHORTSHOT_DIGIT_##a##b##c##d
#define SHORTSHOT_PASTE_BITS(a, b, c, d) SHORTSHOT_PASTE_DIGIT(a, b, c, d)
#define SHORTSHOT_DIGIT(a, b, c, d) \
  SHORTSHOT_PASTE_BITS(SHORTSHOT_IS_SET(a), SHORTSHOT_IS_SET(b), SHORTSHOT_IS_SET(c), SHORTSHOT_IS_SET(d))

#define SHORTSHOT_JOIN_VERSION_(major, minor) v##major##_##minor
#define SHORTSHOT_JOIN_VERSION(major, minor) SHORTSHOT_JOIN_VERSION_(major, minor)

#define SHORTSHOT_TYPES SHORTSHOT_JOIN_VERSION(SHORTSHOT_VERSION_MAJOR, SHORTSHOT_VERSION_MINOR)

#define SHORTSHOT_JOIN_CODE_(types, a, b, c, d, e, f, g, h, i, j) types##_##a##b##c##d##e##f##g##h##i##j
#define SHORTSHOT_JOIN_CODE(types, a, b, c, d, e, f, g, h, i, j) \
  SHORTSHOT_JOIN_CODE_(types, a, b, c, d, e, f, g, h, i, j)

// A sanitizer checks each copy of a function that was inlined: such code takes twice as long to compile.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SHORTSHOT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(undefined_behavior_sanitizer)
#define SHORTSHOT_SANITIZED 1
#endif
#endif

// Every flag that lets the compiler use other instructions, or makes it compute or inline otherwise, is a bit of the
// name: `v0_1_c000000000` is version 0.1 for plain x86-64.
#define SHORTSHOT_CODE                                                                                                 \
  SHORTSHOT_JOIN_CODE(                                                                                                 \
      SHORTSHOT_TYPES, SHORTSHOT_DIGIT(__SSE__, __SSE2__, __SSE3__, __SSSE3__),                                        \
      SHORTSHOT_DIGIT(__SSE4_1__, __SSE4_2__, __POPCNT__, __SSE4A__),                                                  \
      SHORTSHOT_DIGIT(__AVX__, __F16C__, __FMA__, __AVX2__), SHORTSHOT_DIGIT(__BMI__, __BMI2__, __LZCNT__, __MOVBE__), \
      SHORTSHOT_DIGIT(__AVX512F__, __AVX512BW__, __AVX512DQ__, __AVX512VL__),                                          \
      SHORTSHOT_DIGIT(__AVX512CD__, __AVX512VNNI__, __AVXVNNI__, __FMA4__),                                            \
      SHORTSHOT_DIGIT(__ARM_NEON, __ARM_FEATURE_FMA, __ARM_FEATURE_DSP, __ARM_FEATURE_DOTPROD),                        \
      SHORTSHOT_DIGIT(__ARM_FEATURE_SVE, __ARM_FEATURE_MVE, __FAST_MATH__, __OPTIMIZE_SIZE__),                         \
      SHORTSHOT_DIGIT(__RECIPROCAL_MATH__, __ASSOCIATIVE_MATH__, __NO_SIGNED_ZEROS__, __FINITE_MATH_ONLY__),           \
      SHORTSHOT_DIGIT(SHORTSHOT_NO_DISPATCH, SHORTSHOT_SANITIZED, 0, 0))

// Set by us, too: functions, and lambdas, that are inlined for speed. Functions are left to the compiler where it was
// asked for small code (-Os), and both by sanitizers.
#if defined(__OPTIMIZE_SIZE__) || defined(SHORTSHOT_SANITIZED)
#define SHORTSHOT_INLINE inline
#else
#define SHORTSHOT_INLINE [[gnu::always_inline]] inline
#endif
#if defined(SHORTSHOT_SANITIZED)
#define SHORTSHOT_INLINE_LAMBDA
#else
#define SHORTSHOT_INLINE_LAMBDA __attribute__((always_inline))
#endif

namespace shortshot {
namespace extend {}
namespace detail {
using namespace extend;
}
}  // namespace shortshot
