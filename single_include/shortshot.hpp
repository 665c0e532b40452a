// SPDX-License-Identifier: BSD-3-Clause
// shortshot 0.1.0, all of it in one file. Generated: do not edit; edit include/shortshot/*.hpp and regenerate
// with: cmake -P single_include/amalgamate.cmake

// shortshot: short color-shape descriptors (SSH, SCSH) of RGB-D point clouds on small CPUs, and their parents (SHOT,
// CSHOT, B-SHOT).
//
// The umbrella, in reading order. On bare metal it is the kernel: no heap, no exceptions, no operating system. Where
// there is an operating system it adds what allocates: describe_cloud() and extract() for many key points, a grid with
// memory of its own, matching, poses, the recognizer, files.
//
// Two things need another library, included before this header: <nanoflann.hpp> for NanoflannSearch, <Eigen/Core> for
// view_eigen(). Whoever comes too late includes this header once more: what is new is added. Without them, the compiler
// says what is missing where one of the two is used.
//
// Macros of other headers (min, near, Status, ...) do no harm here, whether they come before it or after it. In your
// own code they do what they always do.

// clang-format off

// shortshot/macros_off.hpp: macros of other headers that are words here (X11, Windows, Arduino, Apple), set aside until
// macros_on.hpp puts them back. No include guard: the umbrella includes both as often as it is included.

#pragma push_macro("abs")
#undef abs
#pragma push_macro("round")
#undef round
#pragma push_macro("min")
#undef min
#pragma push_macro("max")
#undef max
#pragma push_macro("near")
#undef near
#pragma push_macro("far")
#undef far
#pragma push_macro("small")
#undef small
#pragma push_macro("check")
#undef check
#pragma push_macro("require")
#undef require
#pragma push_macro("verify")
#undef verify
#pragma push_macro("Status")
#undef Status
#pragma push_macro("Success")
#undef Success
#pragma push_macro("None")
#undef None
#pragma push_macro("Always")
#undef Always
#pragma push_macro("Bool")
#undef Bool
#pragma push_macro("True")
#undef True
#pragma push_macro("False")
#undef False
#pragma push_macro("Complex")
#undef Complex
#pragma push_macro("constrain")
#undef constrain
#pragma push_macro("radians")
#undef radians
#pragma push_macro("degrees")
#undef degrees
#pragma push_macro("sq")
#undef sq
#pragma push_macro("bit")
#undef bit
#pragma push_macro("word")
#undef word
#pragma push_macro("PI")
#undef PI
#pragma push_macro("DEFAULT")
#undef DEFAULT
#pragma push_macro("ERROR")
#undef ERROR
#pragma push_macro("OPTIONAL")
#undef OPTIONAL
#pragma push_macro("IN")
#undef IN
#pragma push_macro("OUT")
#undef OUT
#pragma push_macro("I")
#undef I
#pragma push_macro("C")
#undef C
#pragma push_macro("D")
#undef D
#pragma push_macro("G")
#undef G
#pragma push_macro("K")
#undef K
#pragma push_macro("L")
#undef L
#pragma push_macro("N")
#undef N
#pragma push_macro("P")
#undef P
#pragma push_macro("R")
#undef R
#pragma push_macro("S")
#undef S
#pragma push_macro("T")
#undef T
#pragma push_macro("X")
#undef X
#pragma push_macro("Y")
#undef Y
#pragma push_macro("Z")
#undef Z

// shortshot/dispatch/hot_kernel.hpp: the part of the kernel in which hosts spend their time: what kernel_for_avx2.hpp
// reads once more. All of it has include guards, which can be forgotten (forget_kernel.hpp).
#ifndef SHORTSHOT_DISPATCH_HOT_KERNEL_HPP
#define SHORTSHOT_DISPATCH_HOT_KERNEL_HPP

// shortshot/base/products.hpp: products of the rows of one matrix with those of another, for recognition/match.hpp.
//
// The order of each sum is fixed: one sum for each pair of rows, over their values in ascending order, each product
// rounded by itself. Lanes hold sums of different rows, so neither their number nor the place of a tile, nor threads,
// nor a fused multiply-add change a bit. Blocked for registers and caches it is as fast as Eigen's product (SSE2,
// AVX2).
#ifndef SHORTSHOT_BASE_PRODUCTS_HPP
#define SHORTSHOT_BASE_PRODUCTS_HPP

#include <cstddef>

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
#ifndef SHORTSHOT_CONFIG_HPP
#define SHORTSHOT_CONFIG_HPP

// shortshot/version.hpp: the only place with a version number; CMake reads it from here.
#ifndef SHORTSHOT_VERSION_HPP
#define SHORTSHOT_VERSION_HPP

/// Names may change with it.
#define SHORTSHOT_VERSION_MAJOR 0
/// Before 1.0, names may change with it, too.
#define SHORTSHOT_VERSION_MINOR 1
/// For everything else.
#define SHORTSHOT_VERSION_PATCH 0

/// For the preprocessor: 10,000 major + 100 minor + patch.
#define SHORTSHOT_VERSION (SHORTSHOT_VERSION_MAJOR * 10000 + SHORTSHOT_VERSION_MINOR * 100 + SHORTSHOT_VERSION_PATCH)

namespace shortshot {

/// The same as numbers.
inline constexpr int version_major = SHORTSHOT_VERSION_MAJOR;
inline constexpr int version_minor = SHORTSHOT_VERSION_MINOR;
inline constexpr int version_patch = SHORTSHOT_VERSION_PATCH;

}  // namespace shortshot
#endif  // SHORTSHOT_VERSION_HPP

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
#endif  // SHORTSHOT_CONFIG_HPP

// shortshot/base/simd.hpp: the thin lane shim. Every pass of the kernel is written once, in terms of F32, I32 and Mask;
// the compiler's own macros choose what they are: AVX2, SSE2, NEON (aarch64) or one lane at a time.
//
// All operations are exactly rounded IEEE single precision or pure bit moves, and every accumulation in the kernel is
// an integer sum (fixed_point.hpp), so that the number of lanes never changes a result.
#ifndef SHORTSHOT_BASE_SIMD_HPP
#define SHORTSHOT_BASE_SIMD_HPP

// shortshot/base/quad.hpp: four numbers side by side in memory, for all lane shims.
#ifndef SHORTSHOT_BASE_QUAD_HPP
#define SHORTSHOT_BASE_QUAD_HPP

#include <cstdint>

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// One addition where there are lanes.
using Quad = std::int32_t __attribute__((vector_size(16)));
using FloatQuad = float __attribute__((vector_size(16)));

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_QUAD_HPP

// shortshot/base/unfused.hpp: no a * b + c in one rounding, whatever the compiler was told.
#ifndef SHORTSHOT_BASE_UNFUSED_HPP
#define SHORTSHOT_BASE_UNFUSED_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Hides where a number comes from: an empty assembly statement, no instruction.
template <class Float>
[[nodiscard]] inline Float hidden(Float number) noexcept {
#if defined(__FMA__) || defined(__FMA4__) || defined(__AVX512F__)
  __asm__("" : "+x"(number));
#elif defined(__aarch64__)
  __asm__("" : "+w"(number));
#elif defined(__ARM_FEATURE_FMA)
  __asm__("" : "+t"(number));
#elif defined(__riscv_flen)
  __asm__("" : "+f"(number));
#elif defined(__riscv_zfinx)
  __asm__("" : "+r"(number));
#endif
  return number;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// A product (a float, or a register of them), rounded as IEEE 754 says. Where the CPU has a fused multiply-add, GCC
/// and clang may use it for a product and the sum that it goes into, which gives other bits: every product that goes
/// into a sum must pass through here, and every quotient: by a constant, it may become a product.
template <class Float>
[[nodiscard]] constexpr Float unfused(Float product) noexcept {
  return __builtin_is_constant_evaluated() ? product : detail::hidden(product);
}

/// The inner product, summed as x + z first, then y.
[[nodiscard]] inline float dot(const float (&a)[3], const float (&b)[3]) noexcept {
  return (unfused(a[0] * b[0]) + unfused(a[2] * b[2])) + unfused(a[1] * b[1]);
}

/// 1.5 * 2^23: a float below 2^22 to which this is added, and from which it is taken again, has been rounded to a whole
/// number.
inline constexpr float whole_numbers = 12582912.0f;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_BASE_UNFUSED_HPP

#if defined(__AVX2__) || defined(SHORTSHOT_FOR_AVX2)

// shortshot/base/simd_avx2.hpp: the lane shim on AVX2, 8 lanes. Included by simd.hpp, which says what it must do.
#ifndef SHORTSHOT_BASE_SIMD_AVX2_HPP
#define SHORTSHOT_BASE_SIMD_AVX2_HPP

#include <immintrin.h>

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t lanes = 8;

/// Does one instruction bring an integer to 0..2^k - 1?
inline constexpr bool saturates = false;

/// Does one instruction add to memory, at any constant distance from where a register points?
inline constexpr bool adds_to_memory = true;

struct F32 {
  __m256 v;
};
struct I32 {
  __m256i v;
};
struct Mask {
  __m256 v;
};
using SignMask = Mask;
struct I16 {
  std::int16_t v __attribute__((vector_size(32)));
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float sqrt(float value) noexcept { return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value))); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {_mm256_loadu_ps(p)}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
}
inline void store(float* p, F32 a) noexcept { _mm256_storeu_ps(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
inline void store(std::uint32_t* p, I32 a) noexcept { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
[[nodiscard]] inline F32 all(float value) noexcept { return {_mm256_set1_ps(value)}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {_mm256_setr_ps(value_at(0), value_at(1), value_at(2), value_at(3), value_at(4), value_at(5), value_at(6),
                         value_at(7))};
}

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {_mm256_add_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {_mm256_sub_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(_mm256_mul_ps(a.v, b.v))}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(_mm256_div_ps(a.v, b.v))}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {_mm256_add_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {_mm256_and_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {_mm256_or_ps(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {_mm256_sqrt_ps(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept {
  return {_mm256_and_ps(a.v, _mm256_castsi256_ps(_mm256_set1_epi32(0x7FFFFFFF)))};
}
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {_mm256_min_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {_mm256_max_ps(a.v, b.v)}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept { return {_mm256_blendv_ps(no.v, yes.v, m.v)}; }
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept {
  return {_mm256_xor_ps(a.v, _mm256_and_ps(m.v, _mm256_set1_ps(-0.0f)))};
}
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept { return {_mm256_and_ps(m.v, a.v)}; }
[[nodiscard]] inline bool any(Mask m) noexcept { return _mm256_movemask_ps(m.v) != 0; }
[[nodiscard]] inline bool every(Mask m) noexcept { return _mm256_movemask_ps(m.v) == 0xFF; }
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {_mm256_sub_epi32(a.v, _mm256_castps_si256(m.v))}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {_mm256_castps_si256(a.v)}; }
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept { return {_mm256_castsi256_ps(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {_mm256_cvtepi32_ps(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {_mm256_cvttps_epi32(a.v)}; }

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {_mm256_cvtps_epi32(a.v)}; }

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {_mm256_set1_epi32(value)}; }
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {_mm256_sub_epi32(a.v, b.v)}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {_mm256_and_si256(a.v, b.v)}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept {
  return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))};
}
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept {
  return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))};
}
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept {
  return {_mm256_sll_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// Towards minus infinity.
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept {
  return {_mm256_sra_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {_mm256_min_epi16(a.v, b.v)}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {_mm256_max_epi16(a.v, b.v)}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {_mm256_madd_epi16(a.v, b.v)}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept { return {_mm256_mullo_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask is_negative(I32 a) noexcept { return {_mm256_castsi256_ps(_mm256_srai_epi32(a.v, 31))}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(Mask m) noexcept {
  return {_mm256_or_si256(_mm256_castps_si256(m.v), _mm256_set1_epi32(1))};
}
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(Mask m, I32 a) noexcept { return {_mm256_xor_si256(_mm256_castps_si256(m.v), a.v)}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {_mm256_and_si256(_mm256_castps_si256(m.v), a.v)}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {_mm256_andnot_si256(_mm256_castps_si256(m.v), a.v)}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept {
  return {_mm256_xor_ps(a.v, _mm256_and_ps(sign.v, _mm256_set1_ps(-0.0f)))};
}

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  I16 both{};  // the first halves of a and b, then the second ones
  both.v = reinterpret_cast<decltype(both.v)>(_mm256_packs_epi32(a.v, b.v));
  return both;
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept { return narrow(bits_of({a.v}), bits_of({b.v})); }
/// (Where b comes from is hidden: a product by a constant becomes shifts and sums, which take longer.)
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept {
  __asm__("" : "+x"(b.v));
  return {a.v * b.v};
}
inline void store(std::int16_t* p, I16 a) noexcept {
  const __m256i in_order = _mm256_permute4x64_epi64(reinterpret_cast<__m256i>(a.v), _MM_SHUFFLE(3, 1, 2, 0));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), in_order);
}

/// What each lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  const __m256i ab[2] = {_mm256_unpacklo_epi32(a.v, b.v), _mm256_unpackhi_epi32(a.v, b.v)};
  const __m256i cd[2] = {_mm256_unpacklo_epi32(c.v, d.v), _mm256_unpackhi_epi32(c.v, d.v)};
  const auto put = [&](std::size_t k, __m256i both) {  // lanes k and k + 4
    quads[k] = reinterpret_cast<Quad>(_mm256_castsi256_si128(both));
    quads[k + 4] = reinterpret_cast<Quad>(_mm256_extracti128_si256(both, 1));
  };
  for (std::size_t k = 0; k < 2; ++k) {
    put(2 * k, _mm256_unpacklo_epi64(ab[k], cd[k]));
    put(2 * k + 1, _mm256_unpackhi_epi64(ab[k], cd[k]));
  }
}

/// The three floats at base + 3 * index[k], for all lanes.
[[gnu::always_inline]] inline void load_triples(const float* base, const std::uint32_t* index, F32& a, F32& b,
                                                F32& c) noexcept {
  const auto pair = [&](std::size_t k, std::size_t from) {  // (p[from], p[from + 1]) of lanes k and k + 1
    const auto* const low = reinterpret_cast<const __m64*>(base + 3 * static_cast<std::size_t>(index[k]) + from);
    const auto* const high = reinterpret_cast<const __m64*>(base + 3 * static_cast<std::size_t>(index[k + 1]) + from);
    return _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), low), high);
  };
  // Lanes 0, 1, 4, 5 and 2, 3, 6, 7, so that one shuffle in both halves brings them into order.
  const auto pairs = [&](std::size_t k, std::size_t from) { return _mm256_set_m128(pair(k + 4, from), pair(k, from)); };
  const __m256 ab[2] = {pairs(0, 0), pairs(2, 0)};
  const __m256 bc[2] = {pairs(0, 1), pairs(2, 1)};
  a = {_mm256_shuffle_ps(ab[0], ab[1], _MM_SHUFFLE(2, 0, 2, 0))};
  b = {_mm256_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(2, 0, 2, 0))};
  c = {_mm256_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(3, 1, 3, 1))};
}

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t count) noexcept {
  const __m256i limit = _mm256_set1_epi32(static_cast<int>(count));
  return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(limit, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)))};
}

/// For each set of lanes their numbers in ascending order, four bits each, the lowest bits first.
struct LaneLists {
  std::uint32_t of[256];
  constexpr LaneLists() noexcept : of{} {
    for (std::uint32_t set = 0; set < 256; ++set) {
      std::uint32_t count = 0;
      for (std::uint32_t lane = 0; lane < 8; ++lane) {
        if ((set >> lane & 1u) != 0) of[set] |= lane << 4 * count++;
      }
    }
  }
};
inline constexpr LaneLists lane_lists{};

/// How store() packs the lanes where a mask is set.
struct Packing {
  __m256i lanes;
  std::uint32_t count;
};

[[nodiscard]] inline Packing packing(Mask m) noexcept {
  const auto set = static_cast<std::uint32_t>(_mm256_movemask_ps(m.v));
  const __m256i list = _mm256_set1_epi32(static_cast<int>(lane_lists.of[set]));
  // Permutations look at the lowest three bits of each lane only.
  return {_mm256_srlv_epi32(list, _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28)),
          static_cast<std::uint32_t>(__builtin_popcount(set))};
}

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing& packing) noexcept {
  _mm256_storeu_ps(p, _mm256_permutevar8x32_ps(a.v, packing.lanes));
}
inline void store(std::uint32_t* p, I32 a, const Packing& packing) noexcept {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permutevar8x32_epi32(a.v, packing.lanes));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_AVX2_HPP
#elif defined(__SSE2__)

// shortshot/base/simd_sse2.hpp: the lane shim on SSE2, 4 lanes: every x86-64. Included by simd.hpp, which says what it
// must do.
#ifndef SHORTSHOT_BASE_SIMD_SSE2_HPP
#define SHORTSHOT_BASE_SIMD_SSE2_HPP

#include <emmintrin.h>

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t lanes = 4;

/// Does one instruction bring an integer to 0..2^k - 1?
inline constexpr bool saturates = false;

/// Does one instruction add to memory, at any constant distance from where a register points?
inline constexpr bool adds_to_memory = true;

struct F32 {
  __m128 v;
};
struct I32 {
  __m128i v;
};
struct Mask {
  __m128 v;
};
using SignMask = Mask;
struct I16 {
  std::int16_t v __attribute__((vector_size(16)));
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float sqrt(float value) noexcept { return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value))); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {_mm_loadu_ps(p)}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept {
  return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))};
}
inline void store(float* p, F32 a) noexcept { _mm_storeu_ps(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v); }
inline void store(std::uint32_t* p, I32 a) noexcept { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v); }
[[nodiscard]] inline F32 all(float value) noexcept { return {_mm_set1_ps(value)}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {_mm_setr_ps(value_at(0), value_at(1), value_at(2), value_at(3))};
}

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {_mm_add_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {_mm_sub_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(_mm_mul_ps(a.v, b.v))}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(_mm_div_ps(a.v, b.v))}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {_mm_add_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {_mm_cmplt_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {_mm_cmpgt_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {_mm_cmpge_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {_mm_cmpneq_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {_mm_and_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {_mm_or_ps(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {_mm_sqrt_ps(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {_mm_and_ps(a.v, _mm_castsi128_ps(_mm_set1_epi32(0x7FFFFFFF)))}; }
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {_mm_min_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {_mm_max_ps(a.v, b.v)}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept {
  return {_mm_or_ps(_mm_and_ps(m.v, yes.v), _mm_andnot_ps(m.v, no.v))};
}
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept {
  return {_mm_xor_ps(a.v, _mm_and_ps(m.v, _mm_set1_ps(-0.0f)))};
}
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept { return {_mm_and_ps(m.v, a.v)}; }
[[nodiscard]] inline bool any(Mask m) noexcept { return _mm_movemask_ps(m.v) != 0; }
[[nodiscard]] inline bool every(Mask m) noexcept { return _mm_movemask_ps(m.v) == 0xF; }
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {_mm_sub_epi32(a.v, _mm_castps_si128(m.v))}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {_mm_castps_si128(a.v)}; }
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept { return {_mm_castsi128_ps(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {_mm_cvtepi32_ps(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {_mm_cvttps_epi32(a.v)}; }

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {_mm_cvtps_epi32(a.v)}; }

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {_mm_set1_epi32(value)}; }
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {_mm_sub_epi32(a.v, b.v)}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {_mm_and_si128(a.v, b.v)}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept { return {_mm_castsi128_ps(_mm_cmpeq_epi32(a.v, b.v))}; }
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept { return {_mm_castsi128_ps(_mm_cmpgt_epi32(a.v, b.v))}; }
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept {
  return {_mm_sll_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// Towards minus infinity.
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept {
  return {_mm_sra_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {_mm_min_epi16(a.v, b.v)}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {_mm_max_epi16(a.v, b.v)}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {_mm_madd_epi16(a.v, b.v)}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept {
  const __m128i even = _mm_mul_epu32(a.v, b.v);
  const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(a.v, 32), _mm_srli_epi64(b.v, 32));
  return {_mm_or_si128(even, _mm_slli_epi64(odd, 32))};
}
[[nodiscard]] inline Mask is_negative(I32 a) noexcept { return {_mm_castsi128_ps(_mm_srai_epi32(a.v, 31))}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(Mask m) noexcept {
  return {_mm_or_si128(_mm_castps_si128(m.v), _mm_set1_epi32(1))};
}
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(Mask m, I32 a) noexcept { return {_mm_xor_si128(_mm_castps_si128(m.v), a.v)}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {_mm_and_si128(_mm_castps_si128(m.v), a.v)}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {_mm_andnot_si128(_mm_castps_si128(m.v), a.v)}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept {
  return {_mm_xor_ps(a.v, _mm_and_ps(sign.v, _mm_set1_ps(-0.0f)))};
}

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  I16 both{};
  both.v = reinterpret_cast<decltype(both.v)>(_mm_packs_epi32(a.v, b.v));
  return both;
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept { return narrow(bits_of({a.v}), bits_of({b.v})); }
/// (Where b comes from is hidden: a product by a constant becomes shifts and sums, which take longer.)
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept {
  __asm__("" : "+x"(b.v));
  return {a.v * b.v};
}
inline void store(std::int16_t* p, I16 a) noexcept {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), reinterpret_cast<__m128i>(a.v));
}

/// What each lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  const __m128i ab[2] = {_mm_unpacklo_epi32(a.v, b.v), _mm_unpackhi_epi32(a.v, b.v)};
  const __m128i cd[2] = {_mm_unpacklo_epi32(c.v, d.v), _mm_unpackhi_epi32(c.v, d.v)};
  for (std::size_t k = 0; k < 2; ++k) {
    quads[2 * k] = reinterpret_cast<Quad>(_mm_unpacklo_epi64(ab[k], cd[k]));
    quads[2 * k + 1] = reinterpret_cast<Quad>(_mm_unpackhi_epi64(ab[k], cd[k]));
  }
}

/// The three floats at base + 3 * index[k], for all lanes.
[[gnu::always_inline]] inline void load_triples(const float* base, const std::uint32_t* index, F32& a, F32& b,
                                                F32& c) noexcept {
  const auto pair = [&](std::size_t k, std::size_t from) {  // (p[from], p[from + 1]) of lanes k and k + 1
    const auto* const low = reinterpret_cast<const __m64*>(base + 3 * static_cast<std::size_t>(index[k]) + from);
    const auto* const high = reinterpret_cast<const __m64*>(base + 3 * static_cast<std::size_t>(index[k + 1]) + from);
    return _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), low), high);
  };
  const __m128 ab[2] = {pair(0, 0), pair(2, 0)};
  const __m128 bc[2] = {pair(0, 1), pair(2, 1)};
  a = {_mm_shuffle_ps(ab[0], ab[1], _MM_SHUFFLE(2, 0, 2, 0))};
  b = {_mm_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(2, 0, 2, 0))};
  c = {_mm_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(3, 1, 3, 1))};
}

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t count) noexcept {
  const __m128i limit = _mm_set1_epi32(static_cast<int>(count));
  return {_mm_castsi128_ps(_mm_cmplt_epi32(_mm_setr_epi32(0, 1, 2, 3), limit))};
}

/// How store() packs the lanes where a mask is set: each half of the register is packed by itself, and the second half
/// is stored behind what the first one keeps.
struct Packing {
  __m128 second_only;  // in the lane that receives it: of a pair of lanes, the first is dropped
  std::uint32_t first_half;
  std::uint32_t count;
};

[[nodiscard]] inline Packing packing(Mask m) noexcept {
  const auto bits = static_cast<std::uint32_t>(_mm_movemask_ps(m.v));
  const std::uint32_t pairs = bits - (bits >> 1 & 5u);  // two counts of two bits each
  return {m.v, pairs & 3u, (pairs & 3u) + (pairs >> 2)};
}

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing& packing) noexcept {
  const __m128 second = _mm_shuffle_ps(a.v, a.v, _MM_SHUFFLE(3, 3, 1, 1));
  const __m128 packed = _mm_xor_ps(second, _mm_and_ps(packing.second_only, _mm_xor_ps(second, a.v)));
  _mm_storel_pi(reinterpret_cast<__m64*>(p), packed);
  _mm_storeh_pi(reinterpret_cast<__m64*>(p + packing.first_half), packed);
}
inline void store(std::uint32_t* p, I32 a, const Packing& packing) noexcept {
  store(reinterpret_cast<float*>(p), {_mm_castsi128_ps(a.v)}, packing);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_SSE2_HPP
#elif defined(__aarch64__)

// shortshot/base/simd_neon.hpp: the lane shim on NEON, 4 lanes: every aarch64 (32-bit NEON flushes denormals and cannot
// divide). Included by simd.hpp, which says what it must do.
#ifndef SHORTSHOT_BASE_SIMD_NEON_HPP
#define SHORTSHOT_BASE_SIMD_NEON_HPP

#include <arm_neon.h>

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t lanes = 4;

/// Does one instruction bring an integer to 0..2^k - 1?
inline constexpr bool saturates = false;

/// Does one instruction add to memory, at any constant distance from where a register points?
inline constexpr bool adds_to_memory = false;

struct F32 {
  float32x4_t v;
};
struct I32 {
  int32x4_t v;
};
struct Mask {
  uint32x4_t v;
};
using SignMask = Mask;
struct I16 {
  std::int16_t v __attribute__((vector_size(16)));
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float sqrt(float value) noexcept { return vget_lane_f32(vsqrt_f32(vdup_n_f32(value)), 0); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {vld1q_f32(p)}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept { return {vreinterpretq_s32_u32(vld1q_u32(p))}; }
inline void store(float* p, F32 a) noexcept { vst1q_f32(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { vst1q_s32(p, a.v); }
inline void store(std::uint32_t* p, I32 a) noexcept { vst1q_u32(p, vreinterpretq_u32_s32(a.v)); }
[[nodiscard]] inline F32 all(float value) noexcept { return {vdupq_n_f32(value)}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {float32x4_t{value_at(0), value_at(1), value_at(2), value_at(3)}};
}

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {vaddq_f32(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {vsubq_f32(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(vmulq_f32(a.v, b.v))}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(vdivq_f32(a.v, b.v))}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {vaddq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {vcltq_f32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {vcgtq_f32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {vcgeq_f32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {vmvnq_u32(vceqq_f32(a.v, b.v))}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {vandq_u32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {vorrq_u32(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {vsqrtq_f32(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {vabsq_f32(a.v)}; }
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {vbslq_f32(vcltq_f32(a.v, b.v), a.v, b.v)}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {vbslq_f32(vcgtq_f32(a.v, b.v), a.v, b.v)}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept { return {vbslq_f32(m.v, yes.v, no.v)}; }
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept {
  return {vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a.v), vshlq_n_u32(m.v, 31)))};
}
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept {
  return {vreinterpretq_f32_u32(vandq_u32(m.v, vreinterpretq_u32_f32(a.v)))};
}
[[nodiscard]] inline bool any(Mask m) noexcept { return vmaxvq_u32(m.v) != 0; }
[[nodiscard]] inline bool every(Mask m) noexcept { return vminvq_u32(m.v) != 0; }
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {vsubq_s32(a.v, vreinterpretq_s32_u32(m.v))}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {vreinterpretq_s32_f32(a.v)}; }
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept { return {vreinterpretq_f32_s32(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {vcvtq_f32_s32(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {vcvtq_s32_f32(a.v)}; }

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {vcvtnq_s32_f32(a.v)}; }

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {vdupq_n_s32(value)}; }
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {vsubq_s32(a.v, b.v)}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {vandq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept { return {vceqq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept { return {vcgtq_s32(a.v, b.v)}; }
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept { return {vshlq_s32(a.v, vdupq_n_s32(count))}; }
/// Towards minus infinity.
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept { return {vshlq_s32(a.v, vdupq_n_s32(-count))}; }
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {vminq_s32(a.v, b.v)}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {vmaxq_s32(a.v, b.v)}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {vmulq_s32(a.v, b.v)}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept { return {vmulq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask is_negative(I32 a) noexcept { return {vcltzq_s32(a.v)}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(Mask m) noexcept {
  return {vorrq_s32(vreinterpretq_s32_u32(m.v), vdupq_n_s32(1))};
}
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(Mask m, I32 a) noexcept { return {veorq_s32(vreinterpretq_s32_u32(m.v), a.v)}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {vandq_s32(vreinterpretq_s32_u32(m.v), a.v)}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {vbicq_s32(a.v, vreinterpretq_s32_u32(m.v))}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept {
  const uint32x4_t bit = vandq_u32(vreinterpretq_u32_f32(sign.v), vdupq_n_u32(0x80000000u));
  return {vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a.v), bit))};
}

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  return {vuzp1q_s16(vreinterpretq_s16_s32(a.v), vreinterpretq_s16_s32(b.v))};
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept {
  return narrow(I32{vreinterpretq_s32_u32(a.v)}, I32{vreinterpretq_s32_u32(b.v)});
}
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept { return {a.v * b.v}; }
inline void store(std::int16_t* p, I16 a) noexcept { vst1q_s16(p, a.v); }

/// What each lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  const int32x4x2_t ac = vzipq_s32(a.v, c.v);
  const int32x4x2_t bd = vzipq_s32(b.v, d.v);
  for (std::size_t k = 0; k < 2; ++k) {
    const int32x4x2_t both = vzipq_s32(ac.val[k], bd.val[k]);
    quads[2 * k] = reinterpret_cast<Quad>(both.val[0]);
    quads[2 * k + 1] = reinterpret_cast<Quad>(both.val[1]);
  }
}

/// The three floats at base + 3 * index[k], for all lanes.
[[gnu::always_inline]] inline void load_triples(const float* base, const std::uint32_t* index, F32& a, F32& b,
                                                F32& c) noexcept {
  float32x4x3_t abc{};
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[0]), abc, 0);
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[1]), abc, 1);
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[2]), abc, 2);
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[3]), abc, 3);
  a = {abc.val[0]};
  b = {abc.val[1]};
  c = {abc.val[2]};
}

inline constexpr std::uint32_t lane_numbers[4] = {0, 1, 2, 3};

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t count) noexcept {
  return {vcltq_u32(vld1q_u32(lane_numbers), vdupq_n_u32(static_cast<std::uint32_t>(count)))};
}

/// For each set of lanes the bytes of its lanes, in ascending order.
struct LaneBytes {
  std::uint8_t of[16][16];
  constexpr LaneBytes() noexcept : of{} {
    for (std::uint32_t set = 0; set < 16; ++set) {
      std::uint32_t place = 0;
      for (std::uint32_t byte = 0; byte < 16; ++byte) {
        if ((set >> byte / 4 & 1u) != 0) of[set][place++] = static_cast<std::uint8_t>(byte);
      }
    }
  }
};
inline constexpr LaneBytes lane_bytes{};
inline constexpr std::uint32_t lane_bits[4] = {1, 2, 4, 8};

/// How store() packs the lanes where a mask is set.
struct Packing {
  uint8x16_t bytes;
  std::uint32_t count;
};

[[nodiscard]] inline Packing packing(Mask m) noexcept {
  const std::uint32_t set = vaddvq_u32(vandq_u32(m.v, vld1q_u32(lane_bits)));
  return {vld1q_u8(lane_bytes.of[set]), vaddvq_u32(vshrq_n_u32(m.v, 31))};
}

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing& packing) noexcept {
  vst1q_f32(p, vreinterpretq_f32_u8(vqtbl1q_u8(vreinterpretq_u8_f32(a.v), packing.bytes)));
}
inline void store(std::uint32_t* p, I32 a, const Packing& packing) noexcept {
  vst1q_u32(p, vreinterpretq_u32_u8(vqtbl1q_u8(vreinterpretq_u8_s32(a.v), packing.bytes)));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_NEON_HPP
#else

// shortshot/base/simd_scalar.hpp: the lane shim one lane at a time: microcontrollers, and whatever has no other.
// Included by simd.hpp, which says what it must do.
#ifndef SHORTSHOT_BASE_SIMD_SCALAR_HPP
#define SHORTSHOT_BASE_SIMD_SCALAR_HPP

#include <cstring>

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// Elements of a register of 32 bits each.
inline constexpr std::size_t lanes = 1;

/// Does one instruction bring an integer to 0..2^k - 1?
#if defined(__ARM_FEATURE_SAT)
inline constexpr bool saturates = true;
#else
inline constexpr bool saturates = false;
#endif

/// Does one instruction add to memory, at any constant distance from where a register points?
inline constexpr bool adds_to_memory = true;

/// A register of floats, of integers (signed or not), of conditions, and of integers of 16 bits, twice as many.
struct F32 {
  float v;  ///< the lanes, in a form that is the shim's own business
};
struct I32 {
  std::int32_t v;
};
struct Mask {
  bool v;
};
/// A mask of signs, -1 where set: what it masks is arithmetic, without branches. (Where there are lanes, all masks
/// are.)
struct SignMask {
  std::int32_t v;
  /// The same as a mask of another kind.
  operator Mask() const noexcept { return {v != 0}; }  // NOLINT: it is one
};
struct I16 {
  std::int16_t v __attribute__((vector_size(4)));  ///< the lanes
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno; where there is no
/// instruction for it, this does too (libm's sqrtf is exactly rounded everywhere).
[[nodiscard]] inline float sqrt(float value) noexcept {
#if defined(__ARM_FP)
  float result;
  __asm__("vsqrt.f32 %0, %1" : "=t"(result) : "t"(value));
  return result;
#elif defined(__riscv_flen)
  float result;
  __asm__("fsqrt.s %0, %1" : "=f"(result) : "f"(value));
  return result;
#else
  return __builtin_sqrtf(value);
#endif
}

/// A register of what lies from `p` on, and the other way; no alignment is assumed.
[[nodiscard]] inline F32 load(const float* p) noexcept { return {*p}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept { return {static_cast<std::int32_t>(*p)}; }
inline void store(float* p, F32 a) noexcept { *p = a.v; }
inline void store(std::int32_t* p, I32 a) noexcept { *p = a.v; }
inline void store(std::uint32_t* p, I32 a) noexcept { *p = static_cast<std::uint32_t>(a.v); }
/// `value` in all lanes.
[[nodiscard]] inline F32 all(float value) noexcept { return {value}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {value_at(0)};
}

/// Lane by lane, each operation rounded as IEEE 754 says; a comparison with NaN is false, but for != (true).
[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {a.v + b.v}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {a.v - b.v}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(a.v * b.v)}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(a.v / b.v)}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {a.v + b.v}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {a.v < b.v}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {a.v > b.v}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {a.v >= b.v}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {a.v != b.v}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {a.v && b.v}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {a.v || b.v}; }

/// Lane by lane. min() and max() give b where one of the two is NaN.
[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {sqrt(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {__builtin_fabsf(a.v)}; }
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {a.v < b.v ? a.v : b.v}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {a.v > b.v ? a.v : b.v}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept { return {m.v ? yes.v : no.v}; }
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept { return {m.v ? -a.v : a.v}; }
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept { return {m.v ? a.v : 0.0f}; }
/// Is it set in any lane, in every lane?
[[nodiscard]] inline bool any(Mask m) noexcept { return m.v; }
[[nodiscard]] inline bool every(Mask m) noexcept { return m.v; }
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {a.v + (m.v ? 1 : 0)}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept {
  I32 bits{};
  std::memcpy(&bits.v, &a.v, sizeof bits.v);
  return bits;
}
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept {
  F32 value{};
  std::memcpy(&value.v, &a.v, sizeof value.v);
  return value;
}
/// Rounded to nearest, ties to even.
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {static_cast<float>(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {static_cast<std::int32_t>(a.v)}; }

/// To the nearest integer, ties to even; |a| <= 2^22. Where no instruction does that, adding 1.5 * 2^23 leaves the
/// integer in the low mantissa bits: the same bits on every machine, with no call into libm.
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept {
#if defined(__ARM_FP)
  float integer;  // its bits
  __asm__("vcvtr.s32.f32 %0, %1" : "=t"(integer) : "t"(a.v));
  return bits_of({integer});
#elif defined(__riscv_flen)
  I32 integer;
  __asm__("fcvt.w.s %0, %1, rne" : "=r"(integer.v) : "f"(a.v));
  return integer;
#else
  return {bits_of({a.v + whole_numbers}).v - 0x4B400000};
#endif
}

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {value}; }
/// Lane by lane, modulo 2^32; shifts and comparisons are those of signed numbers.
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {a.v - b.v}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {a.v & b.v}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept { return {a.v == b.v}; }
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept { return {a.v > b.v}; }
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept { return {a.v * (std::int32_t{1} << count)}; }
/// Towards minus infinity (as every compiler we know shifts, and C++20 demands).
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept { return {a.v >> count}; }
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {a.v < b.v ? a.v : b.v}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {a.v > b.v ? a.v : b.v}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {a.v * b.v}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept { return {a.v * b.v}; }
/// Is the sign bit set?
[[nodiscard]] inline SignMask is_negative(I32 a) noexcept { return {a.v >> 31}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(SignMask m) noexcept { return {m.v | 1}; }
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(SignMask m, I32 a) noexcept { return {m.v ^ a.v}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {m.v ? a.v : 0}; }
[[nodiscard]] inline I32 keep(SignMask m, I32 a) noexcept { return {m.v & a.v}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {m.v ? 0 : a.v}; }
[[nodiscard]] inline I32 drop(SignMask m, I32 a) noexcept { return {~m.v & a.v}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept { return {bits_of(sign).v < 0 ? -a.v : a.v}; }

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  I16 both{};
  both.v[0] = static_cast<std::int16_t>(a.v);
  both.v[1] = static_cast<std::int16_t>(b.v);
  return both;
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept { return narrow(I32{a.v ? -1 : 0}, I32{b.v ? -1 : 0}); }
/// Lane by lane, modulo 2^16.
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept { return {a.v * b.v}; }
/// To memory without any alignment, in order.
inline void store(std::int16_t* p, I16 a) noexcept { std::memcpy(p, &a, sizeof a); }

/// What the lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  quads[0] = Quad{a.v, b.v, c.v, d.v};
}

/// The three floats at base + 3 * index[k], for all lanes.
[[gnu::always_inline]] inline void load_triples(const float* base, const std::uint32_t* index, F32& a, F32& b,
                                                F32& c) noexcept {
  const float* const p = base + 3 * static_cast<std::size_t>(*index);
  a = {p[0]};
  b = {p[1]};
  c = {p[2]};
}

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t) noexcept { return {true}; }

/// How store() packs the lanes where a mask is set.
struct Packing {
  std::uint32_t count;  ///< lanes that are set
};

/// How store() packs the lanes where `m` is set.
[[nodiscard]] inline Packing packing(Mask m) noexcept { return {m.v ? 1u : 0u}; }

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing&) noexcept { *p = a.v; }
inline void store(std::uint32_t* p, I32 a, const Packing&) noexcept { store(p, a); }

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_SCALAR_HPP
#endif

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// f applied lane by lane, for the rare function that is not worth a vector version.
template <class Function>
[[nodiscard]] inline F32 map(Function f, F32 a) noexcept {
  float values[lanes];
  store(values, a);
  for (float& value : values) value = f(value);
  return load(values);
}

/// The nearest whole numbers, as floats; |a| must stay below 2^22.
[[nodiscard, gnu::always_inline]] inline F32 to_whole(F32 a) noexcept {
  return (a + all(whole_numbers)) - all(whole_numbers);
}

/// a * b towards zero; |a * b| must stay below 2^31. (Not unfused: no sum follows. A power of two becomes a part of the
/// conversion where it can.)
[[nodiscard, gnu::always_inline]] inline I32 truncated_product(F32 a, F32 b) noexcept {
  return truncate_to_int({a.v * b.v});
}

/// The largest lane.
[[nodiscard, gnu::always_inline]] inline float largest(F32 a) noexcept {
  float values[lanes];
  store(values, a);
  float result = values[0];
  for (const float value : values) result = value > result ? value : result;
  return result;
}

/// Sum of all lanes.
[[nodiscard, gnu::always_inline]] inline std::int32_t sum(I32 a) noexcept {
  std::int32_t values[lanes];
  store(values, a);
  std::int32_t total = 0;
  for (const std::int32_t value : values) total += value;
  return total;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_HPP

// shortshot/base/unroll.hpp: loops of a length known while compiling, written out. Compilers do not unroll them at -O2,
// and what an unrolled body keeps in registers a loop keeps in memory.
#ifndef SHORTSHOT_BASE_UNROLL_HPP
#define SHORTSHOT_BASE_UNROLL_HPP

#include <type_traits>
#include <utility>

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Was the compiler asked for small code?
#if defined(__OPTIMIZE_SIZE__)
inline constexpr bool small_code = true;
#else
inline constexpr bool small_code = false;
#endif

template <class Function, int... I>
[[gnu::always_inline]] inline void unroll([[maybe_unused]] Function f, std::integer_sequence<int, I...>) noexcept {
  (f(std::integral_constant<int, I>{}), ...);
}

/// f(0), f(1), ... f(Count - 1), each with its index as a compile-time constant.
template <int Count, class Function>
[[gnu::always_inline]] inline void unroll(Function f) noexcept {
  unroll(f, std::make_integer_sequence<int, Count>{});
}

/// The same for functions that need no constants: written out for speed, a loop where code shall be small.
template <int Count, class Function>
[[gnu::always_inline]] inline void each(Function f) noexcept {
  if constexpr (small_code) {
    for (int i = 0; i < Count; ++i) f(i);
  } else {
    unroll<Count>(f);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_UNROLL_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Rows that lie side by side.
inline constexpr std::size_t panel_rows = 16;

/// Rows that meet a panel at once: twelve registers of sums, and four for a panel's values, a row's and a product are
/// the 16 that SSE2 and AVX2 have.
inline constexpr std::size_t tile_rows = simd::lanes > 4 ? 6 : 3;

/// Puts rows side by side: value 0 of all of them, then value 1, and so on.
[[gnu::noinline]] inline void pack(const float* const (&rows)[panel_rows], std::size_t size, float* panel) noexcept {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < panel_rows; k += simd::lanes) {
      simd::store(panel, simd::from_lanes([&](std::size_t lane) { return rows[k + lane][i]; }));
      panel += simd::lanes;
    }
  }
}

/// The products of each row of a tile with those of a panel, in their order.
template <std::size_t Rows>
[[gnu::noinline]] void multiply(const float* panel, const float* const (&rows)[Rows], std::size_t size,
                                float (&products)[Rows][panel_rows]) noexcept {
  constexpr std::size_t registers = panel_rows / simd::lanes;
  simd::F32 sums[Rows][registers];
  const float* row[Rows];
  unroll<int{Rows}>([&](auto r) {
    row[r] = rows[r];
    unroll<int{registers}>([&](auto k) { sums[r][k] = simd::all(0.0f); });
  });
  for (std::size_t i = 0; i < size; ++i) {
    unroll<int{Rows}>([&](auto r) SHORTSHOT_INLINE_LAMBDA {
      const simd::F32 value = simd::all(row[r][i]);
      unroll<int{registers}>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
        sums[r][k] = sums[r][k] + value * simd::load(panel + k * simd::lanes);
      });
    });
    panel += panel_rows;
  }
  unroll<int{Rows}>(
      [&](auto r) { unroll<int{registers}>([&](auto k) { simd::store(products[r] + k * simd::lanes, sums[r][k]); }); });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_PRODUCTS_HPP

// shortshot/cloud/voxel_lanes.hpp: in which voxel a point is, a register of points at a time.
#ifndef SHORTSHOT_CLOUD_VOXEL_LANES_HPP
#define SHORTSHOT_CLOUD_VOXEL_LANES_HPP

#include <cmath>

// shortshot/cloud/cloud.hpp: the only door for point clouds. A CloudView borrows the user's own memory, whatever its
// layout.
#ifndef SHORTSHOT_CLOUD_CLOUD_HPP
#define SHORTSHOT_CLOUD_CLOUD_HPP

#include <cstring>

// shortshot/status.hpp: the one way in which the library reports that something is wrong.
#ifndef SHORTSHOT_STATUS_HPP
#define SHORTSHOT_STATUS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Result of every call that can fail. Whatever is not `ok` comes with a zeroed output, never with NaN; unread_channel
/// alone comes with a view of all the rest.
// (version 14 of it does not know attributes of enumerations)
// clang-format off
enum class [[nodiscard]] Status : std::uint8_t {
  ok,                  ///< nothing is wrong
  empty_cloud,         ///< the cloud has no point, or no point with three finite coordinates
  bad_view,            ///< the view's memory cannot be what it says (null pointer, field outside the point, too short)
  bad_radius,          ///< a radius is not a finite number above zero, or its square leaves the range of float
  bad_keypoint,        ///< a key point's index lies outside the cloud
  invalid_keypoint,    ///< a key point's position is not finite
  missing_colors,      ///< the descriptor needs colors and the cloud has none
  missing_normals,     ///< the descriptor needs normals and the cloud has none
  too_few_neighbors,   ///< no neighbor to describe, or fewer than five for a local reference frame or for SHOT
  too_many_neighbors,  ///< the neighborhood does not fit the workspace; Neighborhood::found says what it takes
  ambiguous_frame,     ///< collinear or symmetric neighborhood: two principal axes cannot be told apart
  bad_frame,           ///< a given frame is not orthonormal, or not finite
  bad_viewpoint,       ///< a viewpoint is not finite
  bad_leaf,            ///< a voxel size is not a finite number above zero
  out_of_memory,       ///< caller-provided memory is too small for the cloud
  not_organized,       ///< the cloud is no image of a pinhole camera, so it has no image window to search
  bad_rows,            ///< rows of descriptors that do not fit each other, or null pointers
  bad_option,          ///< an option is outside of the range that its docstring gives
  too_few_pairs,       ///< fewer than three correspondences
  no_pose,             ///< no rigid motion that at least three correspondences agree on
  not_trained,         ///< the recognizer has no training view with a descriptor
  not_a_model,         ///< the bytes are no recognizer's, or no features', whichever was asked for
  other_version,       ///< the file was written by a version with another format
  other_descriptor,    ///< descriptors of another layout than the recognizer or the file has
  damaged_model,       ///< the file is truncated, or its checksum or contents are wrong
  no_file,             ///< a file cannot be read or written
  missing_intensities,  ///< the descriptor needs intensities and the cloud, or the key point, has none
  unsure_frame,         ///< left out by keep_best_frames(): others have surer frames
  sizes_differ,         ///< a view's channels have not as many elements as it has points
  no_coordinates,       ///< a message has no fields x, y and z
  field_outside,        ///< a message's field ends behind its point
  short_data,           ///< a message has less data than its width, height and steps say
  padded_rows,          ///< a message's rows are longer than their points: copy_point_cloud2()
  other_byte_order,     ///< a message's numbers have the other byte order: copy_point_cloud2()
  needs_conversion,     ///< a message's field is no FLOAT32: copy_point_cloud2()
  unread_channel,       ///< a message has colors, normals or intensities that are not read; the view has the rest
  bad_field,            ///< a message's field x, y or z is of no type that there is, or several numbers
  no_point_step,        ///< a message's points are of no byte
  too_many_points,      ///< a message has 2^32 points or more
  short_rows,           ///< a message's rows are shorter than their points, and its data is not as long as all points
  other_cloud,          ///< the search is over another cloud than the one that is described
  coarse_coordinates,   ///< coordinates so large that floats lie farther apart than a 64th of the radius
  not_written,          ///< a memory does not hold what was written to it: it was not erased, or is worn out
};
// clang-format on

/// Number of statuses.
inline constexpr int status_count = static_cast<int>(Status::not_written) + 1;

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// One English sentence for a status. Static storage; never null.
[[nodiscard]] constexpr const char* message(Status status) noexcept {
  switch (status) {
    case Status::ok: return "ok";
    case Status::empty_cloud: return "the cloud has no valid point";
    case Status::bad_view: return "the cloud view does not fit its memory";
    case Status::bad_radius: return "a radius must be finite and above zero";
    case Status::bad_keypoint: return "the key point's index lies outside the cloud";
    case Status::invalid_keypoint: return "the key point is not finite";
    case Status::missing_colors: return "the descriptor needs colors and the cloud has none";
    case Status::missing_normals: return "the descriptor needs normals and the cloud has none";
    case Status::too_few_neighbors: return "too few neighbors within the radius";
    case Status::too_many_neighbors: return "more neighbors than the workspace can hold";
    case Status::ambiguous_frame: return "the neighborhood is too symmetric for a local reference frame";
    case Status::bad_frame: return "the given frame is not orthonormal";
    case Status::bad_viewpoint: return "the viewpoint is not finite";
    case Status::bad_leaf: return "a voxel size must be finite and above zero";
    case Status::out_of_memory: return "the memory provided is too small";
    case Status::not_organized: return "the cloud is not an image of a pinhole camera";
    case Status::bad_rows: return "the rows of descriptors do not fit each other";
    case Status::bad_option: return "an option is out of its range";
    case Status::too_few_pairs: return "a pose takes three correspondences or more";
    case Status::no_pose: return "no rigid motion fits three correspondences or more";
    case Status::not_trained: return "the recognizer has no training view";
    case Status::not_a_model: return "not a file of this kind";
    case Status::other_version: return "the file's format is of another version";
    case Status::other_descriptor: return "the file or the recognizer is of another descriptor";
    case Status::damaged_model: return "the file is damaged";
    case Status::no_file: return "the file cannot be read or written";
    case Status::missing_intensities: return "the descriptor needs intensities and there are none";
    case Status::unsure_frame: return "other key points have surer frames";
    case Status::sizes_differ: return "the view's channels have not as many elements as it has points";
    case Status::no_coordinates: return "the message has no fields x, y and z";
    case Status::field_outside: return "a field of the message lies outside of its point";
    case Status::short_data: return "the message has less data than its width, height, point_step and row_step say";
    case Status::padded_rows: return "the message's rows are padded: copy_point_cloud2() reads them";
    case Status::other_byte_order: return "the message has the other byte order: copy_point_cloud2() reads it";
    case Status::needs_conversion: return "a field of the message is not FLOAT32: copy_point_cloud2() reads it";
    case Status::unread_channel: return "the message's colors, normals or intensities are not of types that are read";
    case Status::bad_field: return "x, y and z of the message are not one number each";
    case Status::no_point_step: return "the message's point_step is 0";
    case Status::too_many_points: return "the message has 2^32 points or more";
    case Status::short_rows: return "the message's row_step is less than width * point_step";
    case Status::other_cloud: return "the search was built over another cloud";
    case Status::coarse_coordinates:
      return "the coordinates are too large: float rounds them to steps that are not small against the radius";
    case Status::not_written: return "the memory does not hold what was written to it";
  }
  return "unknown status";
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_STATUS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Three float coordinates per point: where each one of point 0 lies, and how far it is to the same one of point 1.
/// Covers x y z x y z ..., arrays of structs with padding, and separate x, y, z arrays. No alignment is assumed.
struct Float3Channel {
  /// A float of point 0.
  const unsigned char* x;
  const unsigned char* y;
  const unsigned char* z;
  std::size_t stride_bytes;  ///< bytes from one point to the next
};

/// Three color bytes per point, sRGB. The three pointers express the order r g b, b g r (PCL, packed floats) or
/// planes.
struct ColorChannel {
  /// A byte of point 0.
  const unsigned char* r;
  const unsigned char* g;
  const unsigned char* b;
  std::size_t stride_bytes;  ///< bytes from one point to the next
};

/// How the numbers of a ScalarChannel are stored.
enum class ScalarType : std::uint8_t { float32, uint8, uint16 };

/// One number per point, as the intensity of a lidar's or a time-of-flight camera's echo.
struct ScalarChannel {
  const unsigned char* value;  ///< of point 0
  std::size_t stride_bytes;    ///< bytes from one point to the next
  ScalarType type;             ///< how each is stored
};

/// What a descriptor may need of a cloud beyond its points; `own`: something that no view has, but the caller.
enum class Channel : std::uint8_t { colors, normals, intensities, own };

/// A borrowed point cloud: nothing is copied, nothing is owned, the memory must outlive the view.
/// Positions in meters (any unit works if the radius has the same). Points that are not finite are never neighbors.
/// A channel whose first pointer is null is absent. `width * height == size`; height is 1 for unorganized clouds.
/// Trivial type with plain members, the same in every translation unit; reading it is thread-safe.
struct CloudView {
  Float3Channel points;       ///< where they are
  ColorChannel colors;        ///< r null: none
  Float3Channel normals;      ///< x null: none
  ScalarChannel intensities;  ///< value null: none
  std::size_t size;           ///< number of points, valid or not
  std::size_t width;          ///< columns of the image; `size` for unorganized clouds
  std::size_t height;         ///< rows of the image, from top to bottom
  Status status;              ///< ok, or why the view could not be made: whoever is asked to read it says so
};

/// A position, in the cloud's unit. Trivial type.
struct Point {
  float x, y, z;  ///< coordinates
};

/// A surface normal: a unit vector, or NaN in all three where a point has none.
struct SurfaceNormal {
  float x, y, z;  ///< components
};

/// An sRGB color.
struct Rgb {
  std::uint8_t r, g, b;  ///< red, green and blue
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Does the cloud have this channel?
[[nodiscard]] inline bool has_colors(const CloudView& cloud) noexcept { return cloud.colors.r != nullptr; }
[[nodiscard]] inline bool has_normals(const CloudView& cloud) noexcept { return cloud.normals.x != nullptr; }
[[nodiscard]] inline bool has_intensities(const CloudView& cloud) noexcept {
  return cloud.intensities.value != nullptr;
}

/// Is this a view that can be read at all? Every entry point asks once.
[[nodiscard]] inline Status validate(const CloudView& cloud) noexcept {
  if (cloud.status != Status::ok) return cloud.status;
  if (cloud.size == 0) return Status::empty_cloud;
  if (cloud.size > 0xFFFFFFFFu) return Status::bad_view;  // indices have 32 bits
  if (cloud.points.x == nullptr || cloud.points.y == nullptr || cloud.points.z == nullptr) return Status::bad_view;
  if (has_colors(cloud) && (cloud.colors.g == nullptr || cloud.colors.b == nullptr)) return Status::bad_view;
  if (has_normals(cloud) && (cloud.normals.y == nullptr || cloud.normals.z == nullptr)) return Status::bad_view;
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A channel whose x, y and z follow each other by `step` bytes; absent if there is no memory.
[[nodiscard]] inline Float3Channel float3_channel(const float* first, std::size_t step, std::size_t stride) noexcept {
  if (first == nullptr) return {};
  const auto* x = reinterpret_cast<const unsigned char*>(first);
  return {x, x + step, x + 2 * step, stride};
}

[[nodiscard]] inline ColorChannel color_channel(const unsigned char* r, std::size_t step, std::size_t stride) noexcept {
  if (r == nullptr) return {};
  return {r, r + step, r + 2 * step, stride};
}

/// float32, uint8 or uint16: how a ScalarChannel reads a Scalar.
template <class Scalar>
inline constexpr bool is_channel_scalar =
    std::is_same<Scalar, float>::value || std::is_same<Scalar, std::uint8_t>::value ||
    std::is_same<Scalar, std::uint16_t>::value;

template <class Scalar>
[[nodiscard]] ScalarChannel scalar_channel(const Scalar* first, std::size_t stride) noexcept {
  static_assert(is_channel_scalar<Scalar>, "Intensities are supported as float, std::uint8_t and std::uint16_t");
  if (first == nullptr) return {};
  return {reinterpret_cast<const unsigned char*>(first), stride,
          sizeof(Scalar) == 4   ? ScalarType::float32
          : sizeof(Scalar) == 2 ? ScalarType::uint16
                                : ScalarType::uint8};
}

/// A view of nothing, for a reason.
[[nodiscard]] inline CloudView unusable_view(Status reason) noexcept {
  CloudView view{};
  view.status = reason;
  return view;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// View of `count` points x y z (floats). `stride_bytes` is the distance between points.
[[nodiscard]] inline CloudView view_xyz(const float* xyz, std::size_t count,
                                        std::size_t stride_bytes = 3 * sizeof(float)) noexcept {
  CloudView view{};
  view.points = detail::float3_channel(xyz, sizeof(float), stride_bytes);
  view.size = count;
  view.width = count;
  view.height = 1;
  return view;
}

/// View of `count` points x y z (floats) and their colors r g b (bytes), each with its own stride.
[[nodiscard]] inline CloudView view_xyz_rgb(const float* xyz, const std::uint8_t* rgb, std::size_t count,
                                            std::size_t xyz_stride_bytes = 3 * sizeof(float),
                                            std::size_t rgb_stride_bytes = 3) noexcept {
  CloudView view = view_xyz(xyz, count, xyz_stride_bytes);
  view.colors = detail::color_channel(rgb, 1, rgb_stride_bytes);
  return view;
}

/// The same cloud with `cloud.size` normals x y z (floats), borrowed like the points. `stride_bytes` is the distance
/// between normals.
[[nodiscard]] inline CloudView with_normals(CloudView cloud, const SurfaceNormal* normals,
                                            std::size_t stride_bytes = sizeof(SurfaceNormal)) noexcept {
  cloud.normals = detail::float3_channel(normals == nullptr ? nullptr : &normals->x, sizeof(float), stride_bytes);
  return cloud;
}

/// The same cloud with `cloud.size` intensities (float, std::uint8_t or std::uint16_t), borrowed like the points.
/// `stride_bytes` is the distance between two of them.
template <class Scalar>
[[nodiscard]] CloudView with_intensities(CloudView cloud, const Scalar* intensities,
                                         std::size_t stride_bytes = sizeof(Scalar)) noexcept {
  cloud.intensities = detail::scalar_channel(intensities, stride_bytes);
  return cloud;
}

/// The same cloud as an image of `width * height` pixels, row by row, for OrganizedSearch.
[[nodiscard]] inline CloudView organized(CloudView cloud, std::size_t width, std::size_t height) noexcept {
  cloud.width = width;
  cloud.height = height;
  return cloud;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_CLOUD_CLOUD_HPP

// shortshot/cloud/point_lanes.hpp: the points of one register.
#ifndef SHORTSHOT_CLOUD_POINT_LANES_HPP
#define SHORTSHOT_CLOUD_POINT_LANES_HPP

// shortshot/cloud/read.hpp: what a view says of one point.
#ifndef SHORTSHOT_CLOUD_READ_HPP
#define SHORTSHOT_CLOUD_READ_HPP

// shortshot/base/math.hpp: the few functions the kernel needs beyond + - * / sqrt, with the same bits on every machine.
//
// libm's atan2f, acosf, cbrtf and logf differ from one libm to the next; these do not, and they work on lanes.
#ifndef SHORTSHOT_BASE_MATH_HPP
#define SHORTSHOT_BASE_MATH_HPP

namespace shortshot::extend::math {
inline namespace SHORTSHOT_CODE {

/// A number's bits, and the number that has these bits.
[[nodiscard]] inline std::uint32_t bits_of(float value) noexcept {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
[[nodiscard]] inline float float_of(std::uint32_t bits) noexcept {
  float value = 0.0f;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// True for finite numbers, by the exponent bits: holds under -ffast-math too, where comparisons with NaN do not.
[[nodiscard]] inline bool is_finite(float value) noexcept { return (bits_of(value) & 0x7F800000u) != 0x7F800000u; }

[[nodiscard]] inline bool is_finite(const float (&v)[3]) noexcept {
  for (const float component : v) {
    if (!is_finite(component)) return false;
  }
  return true;
}

/// The least number with all of a float's bits, 2^-126.
inline constexpr float least_normal = 1.17549435e-38f;

/// The angle of (far, near), both >= 0, in turns and less a quarter turn: -1/4 to 0, within 6e-8. A minimax fit with
/// both ends exact, because points on axes and diagonals lie on the borders of cells. Of (0, 0), or of what is not
/// finite: -1/4.
[[nodiscard]] inline simd::F32 angle_below_quarter(simd::F32 far, simd::F32 near) noexcept {
  using simd::all;
  constexpr float fit[] = {0.00106037291698158f, -0.00527749117463827f, 0.0125921480357647f, -0.0210182461887598f,
                           0.0315139554440975f,  -0.0530250333249569f,  0.159154295921326f};
  // The tangent of the angle minus an eighth of a turn; -1 of (0, 0), and nobody divides by zero.
  const simd::F32 f = simd::max(far, all(least_normal));
  const simd::F32 t = (near - f) / (near + f);
  const simd::F32 s = t * t;
  simd::F32 p = all(fit[0]);
  detail::each<6>([&](auto k) SHORTSHOT_INLINE_LAMBDA { p = p * s + all(fit[k + 1]); });
  return p * t - all(0.125f);
}

/// The angle from the z axis, 0 at z > 0 to 1 at z < 0 (theta / pi); rho >= 0 is the distance from the axis.
[[nodiscard]] inline simd::F32 elevation(simd::F32 rho, simd::F32 z) noexcept {
  const simd::F32 before_equator = angle_below_quarter(simd::abs(z), rho);
  return simd::all(0.5f) + simd::flip_sign(before_equator + before_equator, z);
}

/// (atan2(y, x) + pi) / 2 pi in [0, 1]: 1 for y = 0, x < 0.
[[nodiscard]] inline simd::F32 azimuth(simd::F32 x, simd::F32 y) noexcept {
  using simd::all;
  const simd::F32 before_quarter = angle_below_quarter(simd::abs(x), simd::abs(y));
  const simd::F32 half = all(0.25f) + simd::negate(x < all(0.0f), before_quarter);  // 0 to 1/2
  return all(0.5f) + simd::negate(y < all(0.0f), half);
}

/// Natural logarithm of a positive normal number, absolute error below 2e-7 near 1, relative below 2e-7 elsewhere.
[[nodiscard]] inline float log(float value) noexcept {
  const std::uint32_t bits = bits_of(value);
  // Exponent such that the mantissa m lies in [sqrt(1/2), sqrt(2)): the series below is symmetric about 1.
  const std::int32_t exponent = static_cast<std::int32_t>((bits + 0x004AFB0Du) >> 23) - 127;
  const float m = float_of(bits - (static_cast<std::uint32_t>(exponent) << 23));
  const float s = (m - 1.0f) / (m + 1.0f);  // ln m = 2 artanh s, |s| < 0.172
  const float s2 = s * s;
  const float artanh =
      s + unfused(s * s2 *
                  (0.333333333f + unfused(s2 * (0.2f + unfused(s2 * (0.142857143f + unfused(s2 * 0.111111111f)))))));
  return unfused(static_cast<float>(exponent) * 0.693147181f) + unfused(2.0f * artanh);
}

/// The largest power of two not above a positive normal number.
[[nodiscard]] inline float power_of_two_below(float value) noexcept { return float_of(bits_of(value) & 0x7F800000u); }

/// The nearest multiple of a quantum, of a number not above R for a splitter of 12288 R: products of two such numbers,
/// and sums of three products, are exact.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 coarse(simd::F32 value, float splitter) noexcept {
  return (value + simd::all(splitter)) - simd::all(splitter);
}

/// How much longer a vector is than `length`, which is about as long as it and given as the sum of a coarse() number
/// and a small rest: to some bits more than a float of the length itself has. Squares of coarse parts cancel exactly.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 length_beyond(simd::F32 x, simd::F32 y, simd::F32 z, simd::F32 coarse_length,
                                                       simd::F32 rest, float splitter) noexcept {
  using simd::F32;
  const F32 of[3] = {x, y, z};
  F32 exact = simd::all(0.0f) - coarse_length * coarse_length;
  F32 small = simd::all(0.0f) - rest * (coarse_length + coarse_length + rest);
  detail::each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    const F32 part = coarse(of[k], splitter);
    exact = exact + part * part;
    small = small + (of[k] - part) * (of[k] + part);
  });
  return (exact + small) / (coarse_length + coarse_length);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::math

#endif  // SHORTSHOT_BASE_MATH_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// Element `index` of a channel. memcpy, because a PointCloud2 blob need not be aligned. (In place: where each call
/// deepens the stack.)
[[nodiscard, gnu::always_inline]] inline Point read_in_place(const Float3Channel& channel, std::size_t index) noexcept {
  const std::size_t offset = index * channel.stride_bytes;
  Point p{};
  std::memcpy(&p.x, channel.x + offset, sizeof(float));
  std::memcpy(&p.y, channel.y + offset, sizeof(float));
  std::memcpy(&p.z, channel.z + offset, sizeof(float));
  return p;
}

/// Element `index` of a channel of points, or of normals.
[[nodiscard]] inline Point read(const Float3Channel& channel, std::size_t index) noexcept {
  return read_in_place(channel, index);
}

/// Element `index` of a channel of numbers.
[[nodiscard]] inline float read(const ScalarChannel& channel, std::size_t index) noexcept {
  const unsigned char* const at = channel.value + index * channel.stride_bytes;
  if (channel.type == ScalarType::uint8) return static_cast<float>(*at);
  if (channel.type == ScalarType::uint16) {
    std::uint16_t value = 0;
    std::memcpy(&value, at, sizeof value);
    return static_cast<float>(value);
  }
  float value = 0.0f;
  std::memcpy(&value, at, sizeof value);
  return value;
}

[[nodiscard, gnu::always_inline]] inline Rgb read(const ColorChannel& channel, std::size_t index) noexcept {
  const std::size_t offset = index * channel.stride_bytes;
  return {channel.r[offset], channel.g[offset], channel.b[offset]};
}

/// Coordinate 0, 1 or 2 of a point.
[[nodiscard]] inline float coordinate(const Point& p, std::size_t axis) noexcept {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The position of point `index`, which must be below cloud.size, finite or not.
[[nodiscard]] inline Point point(const CloudView& cloud, std::size_t index) noexcept {
  return extend::read(cloud.points, index);
}

/// The normal of point `index`; the cloud must have normals.
[[nodiscard]] inline SurfaceNormal normal(const CloudView& cloud, std::size_t index) noexcept {
  const Point n = extend::read(cloud.normals, index);
  return {n.x, n.y, n.z};
}

/// The color of point `index`; the cloud must have colors.
[[nodiscard]] inline Rgb color(const CloudView& cloud, std::size_t index) noexcept {
  return extend::read(cloud.colors, index);
}

/// The intensity of point `index`, in whatever unit the sensor has; the cloud must have intensities.
[[nodiscard]] inline float intensity(const CloudView& cloud, std::size_t index) noexcept {
  return extend::read(cloud.intensities, index);
}

/// Are all three coordinates finite?
[[nodiscard]] inline bool is_finite(const Point& p) noexcept {
  return extend::math::is_finite(p.x) && extend::math::is_finite(p.y) && extend::math::is_finite(p.z);
}

/// Summed as (dx*dx + dy*dy) + dz*dz, like all distances here.
[[nodiscard]] inline float squared_distance(const Point& a, const Point& b) noexcept {
  const float dx = a.x - b.x;
  const float dy = a.y - b.y;
  const float dz = a.z - b.z;
  return (extend::unfused(dx * dx) + extend::unfused(dy * dy)) + extend::unfused(dz * dz);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// The first point from index `i` on with three finite coordinates; cloud.size if there is none.
[[nodiscard]] inline std::size_t next_valid(const CloudView& cloud, std::size_t i, Point& p) noexcept {
  for (; i < cloud.size; ++i) {
    p = point(cloud, i);
    if (is_finite(p)) break;
  }
  return i;
}

/// Calls f(index, point) for each point with three finite coordinates, in order.
template <class Function>
void for_each_valid(const CloudView& cloud, Function f) {
  Point p;
  for (std::size_t i = next_valid(cloud, 0, p); i < cloud.size; i = next_valid(cloud, i + 1, p)) f(i, p);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_CLOUD_READ_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// The points of one register.
struct PointLanes {
  simd::F32 x, y, z;  ///< of each lane's point
};

/// Their component along an axis, rounded as PCL and the published code round it: x + z first, then y.
/// In place for small code as well: a call of it is longer than what it does.
[[nodiscard, gnu::always_inline]] inline simd::F32 along(const simd::F32 (&axis)[3], const PointLanes& v) noexcept {
  return (v.x * axis[0] + v.z * axis[2]) + v.y * axis[1];
}
[[nodiscard]] SHORTSHOT_INLINE simd::F32 along(const float (&axis)[3], const PointLanes& v) noexcept {
  return (v.x * simd::all(axis[0]) + v.z * simd::all(axis[2])) + v.y * simd::all(axis[1]);
}

/// Element index_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline PointLanes read_lanes(const Float3Channel& channel,
                                                               Function index_at) noexcept {
  const auto read_component = [&](const unsigned char* first) SHORTSHOT_INLINE_LAMBDA {
    return simd::from_lanes([&](std::size_t lane) SHORTSHOT_INLINE_LAMBDA {
      float value = 0.0f;
      std::memcpy(&value, first + index_at(lane) * channel.stride_bytes, sizeof value);
      return value;
    });
  };
  return {read_component(channel.x), read_component(channel.y), read_component(channel.z)};
}

/// Which points have three finite coordinates.
[[nodiscard]] inline simd::Mask is_finite(const PointLanes& p) noexcept {
  const simd::I32 exponent = simd::all_int(0x7F800000);
  const auto below = [&](simd::F32 v) { return (bits_of(v) & exponent) - exponent; };  // negative if v is finite
  return is_negative(below(p.x) & below(p.y) & below(p.z));
}

/// Some points, and which of them have three finite coordinates; the others are zeros.
struct ValidLanes {
  PointLanes points;  ///< zeros where not valid
  simd::Mask valid;   ///< which they are
};

/// `count` points from index `first` on, at most a register, at least one. Beyond them nothing is read or valid.
[[nodiscard, gnu::always_inline]] inline ValidLanes read_valid(const Float3Channel& channel, std::size_t first,
                                                               std::size_t count) noexcept {
  const bool whole = count >= simd::lanes;
  PointLanes p = whole
                     ? read_lanes(channel, [=](std::size_t lane) { return first + lane; })
                     : read_lanes(channel, [=](std::size_t lane) { return first + (lane < count ? lane : count - 1); });
  const simd::Mask valid = whole ? is_finite(p) : is_finite(p) & simd::first(count);
  if (!every(valid)) p = {keep(valid, p.x), keep(valid, p.y), keep(valid, p.z)};
  return {p, valid};
}

/// Calls f(index, points, valid) for registers of points in order: the first one's index, and which lanes have three
/// finite coordinates. At least one has; registers without are passed over. The other lanes are zeros. The view comes
/// by value: no store that f makes can change it.
template <class Function>
[[gnu::always_inline]] inline void for_each_valid_register(const CloudView cloud, Function f) {
  for (std::size_t i = 0; i < cloud.size; i += simd::lanes) {
    const ValidLanes read = read_valid(cloud.points, i, cloud.size - i);
    if (any(read.valid)) f(i, read.points, read.valid);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_CLOUD_POINT_LANES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points in their voxels, which lie on a grid through the origin. Voxel numbers stay floats: whole numbers, exact up
/// to 2^24 voxels from the origin, as the coordinates are; infinite beyond float's range, where all points share one.
struct VoxelLanes {
  simd::F32 number[3];  ///< never -0
  simd::F32 place[3];   ///< in the voxel, from its corner, in voxels
  simd::F32 d2;         ///< to the voxel's center, in voxels
};

[[nodiscard]] inline simd::F32 floor_of(simd::F32 position) noexcept {
  if (every(simd::all(4194304.0f) > simd::abs(position))) {  // 2^22
    const simd::F32 whole = simd::to_whole(position);
    return whole - keep(whole > position, simd::all(1.0f));
  }
  return simd::map([](float a) { return __builtin_floorf(a); }, position) + simd::all(0.0f);
}

[[nodiscard]] inline VoxelLanes voxels_of(const PointLanes& points, float leaf) noexcept {
  VoxelLanes voxels;
  const simd::F32 coordinates[3] = {points.x, points.y, points.z};
  simd::F32 squares[3];
  unroll<3>([&](auto axis) {
    const simd::F32 position = coordinates[axis] / simd::all(leaf);
    voxels.number[axis] = floor_of(position);
    const simd::Mask finite = simd::all(HUGE_VALF) > simd::abs(position);
    voxels.place[axis] = keep(finite, position) - keep(finite, voxels.number[axis]);
    const simd::F32 from_center = voxels.place[axis] - simd::all(0.5f);
    squares[axis] = from_center * from_center;
  });
  voxels.d2 = (squares[0] + squares[1]) + squares[2];
  return voxels;
}

/// Points that are placed at once.
inline constexpr std::size_t voxel_block = 256;

/// Points [begin, begin + voxel_block) of a cloud, as far as there are any: their voxels' numbers, and the squared
/// distances to the voxels' centers, -1 for what is no point. Returns how many that are.
inline std::size_t place_in_voxels(const CloudView& cloud, float leaf, std::size_t begin,
                                   float (&number)[3][voxel_block], float (&d2)[voxel_block]) noexcept {
  static_assert(voxel_block % simd::lanes == 0, "whole registers");
  const std::size_t left = cloud.size - begin;
  const std::size_t size = left < voxel_block ? left : voxel_block;
  const Float3Channel channel = cloud.points;
  for (std::size_t i = 0; i < size; i += simd::lanes) {
    const ValidLanes read = read_valid(channel, begin + i, size - i);
    simd::store(d2 + i, simd::all(-1.0f));
    if (!any(read.valid)) continue;
    const VoxelLanes voxels = voxels_of(read.points, leaf);
    unroll<3>([&](auto axis) { simd::store(number[axis] + i, voxels.number[axis]); });
    simd::store(d2 + i, select(read.valid, voxels.d2, simd::all(-1.0f)));
  }
  return size;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_CLOUD_VOXEL_LANES_HPP

// shortshot/descriptor/compact.hpp: compact descriptors. They find more than the published ones in a fraction of the
// bytes: one pass of soft votes in SHOT's frame, nothing learned.
//
// What they are made of: cells are slices of height over the tangent plane; every vote is shared among all cells around
// it (MultilinearVoting); colors are compared with the mean of the neighborhood's, along L, a and b and with their
// signs; square roots keep crowded cells from deciding alone; and each kind of part has a length of its own. They are
// to be stored in four bits a value: the bytes in their names. Best in a frame whose z axis is turned to the camera
// (Support::viewpoint); without a viewpoint it is SHOT's own.
//
// The formulas below speak of neighbors within the radius, W of them, copies of the key point left out. In the frame
// one lies at (x, y, z) and at the distance d:
//
//     u = d / radius                          along the radius: shells, from the key point outwards
//     e = 1/2 - z / radius, cut off to 0..1   along the height: slices, from half a radius above the tangent plane down
//     a = (atan2(y, x) + pi) / (2 pi)         along the azimuth: sectors, from -x counter-clockwise
//     dL, da, db                              its color (CIELAB, PublishedLab) less the mean of all within the radius,
//                                             where the key point and its copies count too
//
// On an axis of n cells a place from 0 to 1, times n, is t. Cell i = floor(t) (n - 1 at most) has the share f + 1/2 of
// the vote if f = t - i is at most 1/2, and cell i - 1 has the rest; else 3/2 - f, and cell i + 1 has the rest.
// Azimuths go around; beyond the other axes' ends the rest stays in cell i. The share w of a cell (r, e, a) of a grid
// of R x E x A cells, or of a bin in it, is the product over all axes: those of one neighbor add up to 1. A sum without
// bounds is over the neighbors.
#ifndef SHORTSHOT_DESCRIPTOR_COMPACT_HPP
#define SHORTSHOT_DESCRIPTOR_COMPACT_HPP

// shortshot/descriptor/conventions.hpp: the conventions of cells: who is described, where cells begin, on which side a
// border lies, how cells are laid out.
//
// There are two: that of the published SSH / SCSH code and that of SHOT as PCL computes it. A descriptor has one. A
// convention owns its positions: the kernel asks it, and knows none of its rules.
#ifndef SHORTSHOT_DESCRIPTOR_CONVENTIONS_HPP
#define SHORTSHOT_DESCRIPTOR_CONVENTIONS_HPP

// shortshot/search/neighborhood.hpp: the neighbors of one key point, in memory that somebody else owns.
#ifndef SHORTSHOT_SEARCH_NEIGHBORHOOD_HPP
#define SHORTSHOT_SEARCH_NEIGHBORHOOD_HPP

// shortshot/search/radius.hpp: the support radius.
#ifndef SHORTSHOT_SEARCH_RADIUS_HPP
#define SHORTSHOT_SEARCH_RADIUS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A support radius in meters and its square. Neighbors are points with float d2 < squared: strictly inside.
/// Converts from float, squared in float. from_double() squares in double and rounds once, as PCL does: the same
/// neighbors to the last point on the rim. (Meant for constants and hosts: no double is left in firmware code.)
struct Radius {
  float value;    ///< meters
  float squared;  ///< what squared distances are compared with

  /// Squared in float.
  [[gnu::always_inline]] constexpr Radius(float radius) noexcept
      : value(radius), squared(radius * radius) {}  // NOLINT: 0.04f is a radius
  /// Squared in double, rounded once.
  [[nodiscard, gnu::always_inline]] static constexpr Radius from_double(double radius) noexcept {
    Radius r(static_cast<float>(radius));
    r.squared = static_cast<float>(radius * radius);
    return r;
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// A radius must be a positive number whose square is a normal one, and not so near to the largest that a neighbor's
/// coordinates in a frame might have larger ones: at most about 1.8e19.
[[nodiscard]] inline Status validate(Radius radius) noexcept {
  // Bits of positive numbers order as the numbers do; infinity's follow.
  const auto lies_from = [](std::uint32_t first, float value) {
    return extend::math::bits_of(value) - first < 0x7F780000u - first;
  };
  return lies_from(1u, radius.value) && lies_from(0x00800000u, radius.squared) ? Status::ok : Status::bad_radius;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_SEARCH_RADIUS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Most neighbors of one key point: what the fixed-point sums over them can hold.
inline constexpr std::uint32_t max_neighbors = 1u << 24;

/// The neighbors of one key point: a structure of arrays in memory that somebody else owns. Trivial type.
struct Neighborhood {
  float* dx;               ///< neighbor - key point in meters; `capacity` elements, as in all arrays here
  float* dy;               ///< the same along y
  float* dz;               ///< the same along z
  float* d2;               ///< squared distance, summed as (dx*dx + dy*dy) + dz*dz in float
  std::uint32_t* index;    ///< the neighbor's index in the cloud; no two are the same
  std::uint32_t capacity;  ///< how many fit
  std::uint32_t size;      ///< neighbors stored, the key point itself and its copies included
  std::uint32_t found;     ///< neighbors found; more than `capacity` if they did not fit
  Point center;            ///< the key point: what gather() was asked for
};

/// The same in a tenth (or, with 32-bit indices, a fifth) of the memory: indices only. Offsets are worked out from the
/// cloud whenever they are asked for, with the same bits. Trivial type.
template <class Index>
struct CompactNeighborhood {
  Float3Channel points;    ///< of the cloud
  Point center;            ///< the key point
  Index* index;            ///< the neighbor's index in the cloud, `capacity` elements; no two are the same
  std::uint32_t capacity;  ///< how many fit
  std::uint32_t size;      ///< neighbors stored, the key point itself and its copies included
  std::uint32_t found;     ///< neighbors found; more than `capacity` if they did not fit
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// One neighbor: from the key point to it, in meters; how far that is, squared, summed as (dx*dx + dy*dy) + dz*dz; and
/// its index in the cloud.
struct Neighbor {
  float dx, dy, dz, d2;  ///< offset and squared distance
  std::uint32_t index;   ///< in the cloud
};

/// A neighbor of `center` at `p`.
[[nodiscard]] inline Neighbor neighbor_from(const Point& center, const Point& p, std::uint32_t index) noexcept {
  const float dx = p.x - center.x;
  const float dy = p.y - center.y;
  const float dz = p.z - center.z;
  return {dx, dy, dz, (unfused(dx * dx) + unfused(dy * dy)) + unfused(dz * dz), index};
}

/// Neighbor `i` of a neighborhood.
[[nodiscard]] inline Neighbor neighbor_at(const Neighborhood& n, std::uint32_t i) noexcept {
  return {n.dx[i], n.dy[i], n.dz[i], n.d2[i], n.index[i]};
}
template <class Index>
[[nodiscard]] inline Neighbor neighbor_at(const CompactNeighborhood<Index>& n, std::uint32_t i) noexcept {
  return neighbor_from(n.center, read_in_place(n.points, n.index[i]), n.index[i]);
}

/// One register of neighbors. (Of five members, because compilers for ARM move structs of up to four floats to
/// registers and back wherever a function returns them.)
struct NeighborLanes {
  simd::F32 dx, dy, dz, d2;  ///< offsets and squared distances
  simd::I32 index;           ///< in the cloud
};

/// The register from neighbor `i` on. What is left over at the end comes with copies of the key point (all zeros),
/// which no pass counts; nothing is read beyond the neighborhood's size.
template <class Neighbors>
[[nodiscard]] SHORTSHOT_INLINE NeighborLanes load_neighbors(const Neighbors& n, std::uint32_t i) noexcept {
  if constexpr (simd::lanes == 1) {
    const Neighbor v = neighbor_at(n, i);
    return {simd::all(v.dx), simd::all(v.dy), simd::all(v.dz), simd::all(v.d2), simd::load(&v.index)};
  }
  float lanes[4][simd::lanes] = {};
  std::uint32_t index[simd::lanes] = {};
  for (std::uint32_t k = 0; k < simd::lanes && k < n.size - i; ++k) {
    const Neighbor v = neighbor_at(n, i + k);
    lanes[0][k] = v.dx;
    lanes[1][k] = v.dy;
    lanes[2][k] = v.dz;
    lanes[3][k] = v.d2;
    index[k] = v.index;
  }
  return {simd::load(lanes[0]), simd::load(lanes[1]), simd::load(lanes[2]), simd::load(lanes[3]), simd::load(index)};
}

[[nodiscard]] SHORTSHOT_INLINE NeighborLanes load_neighbors(const Neighborhood& n, std::uint32_t i) noexcept {
  if (simd::lanes == 1 || n.size - i >= simd::lanes) {
    return {simd::load(n.dx + i), simd::load(n.dy + i), simd::load(n.dz + i), simd::load(n.d2 + i),
            simd::load(n.index + i)};
  }
  return load_neighbors<Neighborhood>(n, i);
}

/// Their squared distances alone.
template <class Neighbors>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 load_d2(const Neighbors& n, std::uint32_t i) noexcept {
  return load_neighbors(n, i).d2;
}
[[nodiscard]] SHORTSHOT_INLINE simd::F32 load_d2(const Neighborhood& n, std::uint32_t i) noexcept {
  return simd::lanes == 1 || n.size - i >= simd::lanes ? simd::load(n.d2 + i) : load_neighbors(n, i).d2;
}

/// How many of the neighbors lie within a radius, the key point and its copies included.
template <class Neighbors>
[[nodiscard]] inline std::uint32_t count_within(const Neighbors& n, Radius radius) noexcept {
  simd::I32 counts{};
  std::uint32_t i = 0;
  for (; i < n.size; i += simd::lanes) {
    counts = increment(load_d2(n, i) < simd::all(radius.squared), counts);
  }
  return static_cast<std::uint32_t>(sum(counts)) - (i - n.size);  // without what fills up the last register
}

/// A local copy, for loops that store: the compiler knows that no store changes a local, and keeps it in registers
/// (aliasing; all "copies" in this library are for that). Searches copy theirs back in the end. Where code shall be
/// small, no copy.
template <class Neighbors>
using Collector = std::conditional_t<detail::small_code, Neighbors&, Neighbors>;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_SEARCH_NEIGHBORHOOD_HPP

// shortshot/descriptor/axis.hpp: one axis of a part: its cells, and what lies beyond them.
#ifndef SHORTSHOT_DESCRIPTOR_AXIS_HPP
#define SHORTSHOT_DESCRIPTOR_AXIS_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// What lies beyond the last cell of an axis: nothing (radius, elevation, signal) or the first cell (azimuth).
enum class Beyond : std::uint8_t { nothing, first_cell };

/// A position on an axis counts cells from the axis' beginning. What is one below zero?
/// never: there is none. first_cell: a place in the first cell; logarithmic shells have no beginning, and the innermost
/// one holds whatever is closer. nowhere: no place on this axis; by SHOT's convention a point on the frame's z axis has
/// no azimuth.
enum class BelowZero : std::uint8_t { never, first_cell, nowhere };

/// One axis of a part: its number of cells, the distance of two neighboring cells in the descriptor, and its ends.
/// Positions along it are fixed-point numbers of cells with `bits` bits behind the point. A value and not a type: where
/// code is inlined for speed it is as constant, and where it shall be small all axes share one function.
struct Axis {
  std::int32_t cells;       ///< number of them, from 1 on
  std::int32_t stride;      ///< values from one cell to the next
  Beyond end;               ///< what lies beyond the last cell
  BelowZero below_zero;     ///< what a position below zero is
  std::int8_t bits;         ///< of a position behind the point
  bool reaches_end = true;  ///< may a position be the very end, the upper border of the last cell?

  /// A whole cell, and the whole axis.
  [[nodiscard, gnu::always_inline]] constexpr float one() const noexcept {
    return static_cast<float>(std::int32_t{1} << bits);
  }
  [[nodiscard, gnu::always_inline]] constexpr float length() const noexcept {
    return static_cast<float>(cells) * one();
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

#endif  // SHORTSHOT_DESCRIPTOR_AXIS_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// Distances of neighboring cells in a grid's layout, in cells.
struct CellStrides {
  int radial, elevation, azimuth;  ///< from one shell, elevation or sector to the next
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// The cells of the published SSH / SCSH code: elevation from the frame's +z down, a border belongs to the cell above
/// it, radius is laid out fastest and azimuth slowest, and a histogram has bins of equal width.
struct PublishedCells {
  static constexpr const char* name = "published cells";  ///< for layout_of()
  /// Are frames meant to look at the camera, where it is known?
  static constexpr bool wants_viewpoint = false;
  /// Does it depend on the frame in which cell a neighbor lies? Always: whether it is beyond the border of a shell is
  /// worked out from its coordinates there.
  template <class Grid>
  static constexpr bool needs_frame = true;

  /// How the cells of a grid are laid out.
  template <class Grid>
  static constexpr extend::CellStrides strides{1, Grid::radial, Grid::radial* Grid::elevation};
  /// Values of a histogram of a signal's `bins`.
  [[nodiscard, gnu::always_inline]] static constexpr int values(int bins) noexcept { return bins; }
  /// What positions below zero mean on the azimuth axis.
  static constexpr extend::BelowZero azimuth_below_zero = extend::BelowZero::never;
  /// May a position be the very end of its axis?
  static constexpr bool reaches_end = true;
  /// Distances on the borders of shells, multiples of R / borders, are those that double precision gives.
  [[nodiscard, gnu::always_inline]] static constexpr int exact_borders(int borders) noexcept { return borders; }

  /// Are there neighbors enough to describe?
  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] static bool has_enough(const Neighbors&, Radius) noexcept {
    return true;
  }
  /// Which neighbors are described: all but the key point and its copies.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::Mask are_described(extend::simd::F32 d2, Radius radius) noexcept {
    return (d2 < extend::simd::all(radius.squared)) & (d2 > extend::simd::all(1e-15f));
  }

  /// Coordinates 1 and 2 of neighbors (0 is the distance over the radius): the angle from +z over pi, and the angle
  /// from -x, counter-clockwise, in turns; both 0..1.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 elevation(const extend::PointLanes& local,
                                                                    extend::simd::F32 from_axis, Radius) noexcept {
    return extend::math::elevation(from_axis, local.z);
  }
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 azimuth(const extend::PointLanes& local,
                                                                  extend::simd::F32) noexcept {
    return extend::math::azimuth(local.x, local.y);
  }

  /// Where a coordinate, or the value of a signal (k = 3), lies along axis `k`, in the axis' fixed-point unit.
  template <class Scale>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 position(const extend::Axis& axis, int k,
                                                                   extend::simd::F32 coordinate) noexcept {
    if constexpr (!Scale::is_linear) {
      if (k == 0) return truncate_to_int(Scale::position(axis, coordinate));
    }
    return truncated_product(coordinate, extend::simd::all(axis.length()));
  }
};

/// The cells of SHOT and CSHOT in PCL 1.13: elevation from the frame's -z up, a border belongs to the cell below it (a
/// neighbor at R / 2 to the inner shell, one at z = 0 to the lower half), histograms fastest, then elevation, radius
/// and azimuth, and one value more than a histogram has bins, because those are the distances of their middles. (The
/// field's words: azimuth cells are sectors, a histogram of cosines is a local histogram.) A neighbor on the frame's z
/// axis has no azimuth.
struct ShotCells {
  static constexpr const char* name = "SHOT cells";
  static constexpr bool wants_viewpoint = false;
  template <class Grid>
  static constexpr bool needs_frame = true;

  template <class Grid>
  static constexpr extend::CellStrides strides{Grid::elevation, 1, Grid::radial* Grid::elevation};
  [[nodiscard, gnu::always_inline]] static constexpr int values(int bins) noexcept { return bins + 1; }
  static constexpr extend::BelowZero azimuth_below_zero = extend::BelowZero::nowhere;
  static constexpr bool reaches_end = false;
  [[nodiscard, gnu::always_inline]] static constexpr int exact_borders(int) noexcept { return 1; }

  /// Five within the radius, the key point and its copies included.
  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] static bool has_enough(const Neighbors& n, Radius radius) noexcept {
    std::uint32_t missing = 5;
    for (std::uint32_t i = 0; i < n.size; ++i) {
      if (extend::neighbor_at(n, i).d2 < radius.squared && --missing == 0) return true;
    }
    return false;
  }
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::Mask are_described(extend::simd::F32 d2, Radius radius) noexcept {
    return (d2 < extend::simd::all(radius.squared)) & (d2 > extend::simd::all(1e-30f));
  }

  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 elevation(const extend::PointLanes& local,
                                                                    extend::simd::F32 from_axis, Radius) noexcept {
    return extend::math::elevation(from_axis, local.z);
  }
  /// Below 0 on the z axis.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 azimuth(const extend::PointLanes& local,
                                                                  extend::simd::F32 from_axis) noexcept {
    const extend::simd::F32 angle = extend::math::azimuth(local.x, local.y);
    return select(from_axis > extend::simd::all(0.0f), angle, extend::simd::all(-1.0f));
  }

  template <class Scale>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 position(const extend::Axis& axis, int k,
                                                                   extend::simd::F32 coordinate) noexcept {
    using namespace extend;
    if (k == 3) {
      const std::int32_t middle = std::int32_t{1} << (axis.bits - 1);
      return truncated_product(coordinate, simd::all(static_cast<float>(axis.cells - 1) * axis.one())) +
             simd::all_int(middle);
    }
    if constexpr (!Scale::is_linear) {
      if (k == 0) return of_scaled(Scale::position(axis, coordinate));
    }
    const simd::F32 along = k == 1 ? simd::all(1.0f) - coordinate : coordinate;
    const simd::I32 position = of_scaled(along * simd::all(axis.length()));
    if (k == 2) return invert(is_negative(bits_of(coordinate)), position);  // 0 to -1: nowhere
    return position;
  }

 private:
  /// A border belongs to the cell below it.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 of_scaled(extend::simd::F32 scaled) noexcept {
    return truncate_to_int(extend::simd::max(scaled, extend::simd::all(1.0f))) - extend::simd::all_int(1);
  }
};

/// The published cells, but for elevation: a cell is a slice of heights over the tangent plane, from R / 2 above it
/// down to R / 2 below, in place of a cone of angles. Surfaces are flat where they are small: most neighbors lie near
/// the plane, where the cones' borders meet. Distances are as floats round them.
struct HeightCells : PublishedCells {
  static constexpr const char* name = "height cells";
  static constexpr bool wants_viewpoint = true;  // a surface and its back are each other's mirror image in height
  template <class Grid>
  static constexpr bool needs_frame = Grid::elevation > 1 || Grid::azimuth > 1;

  [[nodiscard, gnu::always_inline]] static constexpr int exact_borders(int) noexcept { return 1; }
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::Mask are_described(extend::simd::F32 d2, Radius radius) noexcept {
    return (d2 < extend::simd::all(radius.squared)) & (d2 > extend::simd::all(0.0f));
  }
  /// How far below R / 2 over the plane, over R; cut off at both ends.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 elevation(const extend::PointLanes& local, extend::simd::F32,
                                                                    Radius radius) noexcept {
    using namespace extend;
    const simd::F32 depth = simd::all(0.5f) - local.z * simd::all(1.0f / radius.value);
    return simd::max(simd::min(depth, simd::all(1.0f)), simd::all(0.0f));
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_CONVENTIONS_HPP

// shortshot/descriptor/descriptor.hpp: what a descriptor is made of. Pure types: sizes, offsets and layout are
// compile-time facts.
#ifndef SHORTSHOT_DESCRIPTOR_DESCRIPTOR_HPP
#define SHORTSHOT_DESCRIPTOR_DESCRIPTOR_HPP

// shortshot/descriptor/concepts.hpp: what a signal and a voting rule must have. C++17 knows no concepts; these are
// asked in static_asserts, so that who leaves something out reads one sentence.
#ifndef SHORTSHOT_DESCRIPTOR_CONCEPTS_HPP
#define SHORTSHOT_DESCRIPTOR_CONCEPTS_HPP

// shortshot/frame/frame.hpp: the SHOT local reference frame of a gathered neighborhood.
#ifndef SHORTSHOT_FRAME_FRAME_HPP
#define SHORTSHOT_FRAME_FRAME_HPP

// shortshot/base/fixed_point.hpp: sums that do not depend on their order.
//
// Float additions round, so a sum depends on the order of its terms: on the search that found the neighbors, on the
// number of lanes, on the number of threads. Every sum over neighbors in this library adds numbers that were first
// scaled by a power of two and rounded to integers: exact additions, the same bits whatever the order.
#ifndef SHORTSHOT_BASE_FIXED_POINT_HPP
#define SHORTSHOT_BASE_FIXED_POINT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The largest e such that `n` numbers of magnitude up to 2^bits, times 2^e, can be added up in any order without
/// leaving int32, and each has at most 22 bits (what simd::round_to_int() can take).
[[nodiscard]] inline int fixed_point_exponent(std::uint32_t n, int bits) noexcept {
  const int exponent = n > 256 ? __builtin_clz(n - 1) - 2 : 22;  // 2^(30 - exponent) >= n
  return exponent - bits;
}

/// The same as a factor, for numbers of magnitude up to 1.
[[nodiscard]] inline float fixed_point_scale(std::uint32_t n) noexcept {
  return static_cast<float>(1 << fixed_point_exponent(n, 0));
}

/// The upper half of a * b, towards minus infinity, added to a sum: a step of Horner's scheme. (Cortex-M4 and later
/// have an instruction for it, which GCC does not know of.)
[[nodiscard, gnu::always_inline]] inline std::int32_t add_high_product(std::int32_t sum, std::int32_t a,
                                                                       std::int32_t b) noexcept {
#if defined(__ARM_FEATURE_DSP) && !defined(__aarch64__)
  std::int32_t result;
  __asm__("smmla %0, %1, %2, %3" : "=r"(result) : "r"(a), "r"(b), "r"(sum));
  return result;
#else
  return sum + static_cast<std::int32_t>((std::int64_t{a} * b) >> 32);
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_FIXED_POINT_HPP

// shortshot/base/symmetric_eigen.hpp: eigenvectors of symmetric 3x3 and 4x4 matrices, in float, with the same bits
// everywhere.
//
// Cyclic Jacobi rotations: accurate to a few float epsilons whatever the spacing of the eigenvalues, no libm call but
// the exactly rounded square root. Eigen's solvers are as good on a PC, but the direct one calls atan2, cos and sin
// (other bits with every libm) and both cost more flash than the rest of the frame. Rotations take the same steps for
// every matrix, so a register's lanes hold as many matrices, each with the bits that it would have alone.
#ifndef SHORTSHOT_BASE_SYMMETRIC_EIGEN_HPP
#define SHORTSHOT_BASE_SYMMETRIC_EIGEN_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The upper triangle of a symmetric N x N matrix in each lane, row by row: xx, xy, xz, yy, yz, zz.
template <int N>
struct SymmetricMatrices {
  simd::F32 entry[static_cast<std::size_t>(N * (N + 1) / 2)];
};
using SymmetricLanes = SymmetricMatrices<3>;

/// Eigenvectors of unit length, each followed by its eigenvalue, which ascend. Signs are the solver's.
template <int N>
struct Eigenvectors {
  simd::F32 of[static_cast<std::size_t>(N)][static_cast<std::size_t>(N + 1)];

  [[nodiscard]] simd::F32 value(int i) const noexcept { return of[i][N]; }
  [[nodiscard]] simd::F32 vector(int i, int k) const noexcept { return of[i][k]; }
};
using EigenLanes = Eigenvectors<3>;

/// The entries outside of the diagonal, each once.
template <int N>
struct Couplings {
  static_assert(N == 3 || N == 4, "numbers of pairs of axes are known for these");
  simd::F32 of[static_cast<std::size_t>(N * (N - 1) / 2)];

  [[nodiscard]] simd::F32& between(int i, int k) noexcept {
    if constexpr (N == 3) return of[3 - i - k];  // has the number of the third axis: quickly found
    return of[i == 0 || k == 0 ? i + k - 1 : i + k];
  }
};

/// The axes that are neither p nor q > p, in ascending order.
template <int N>
[[nodiscard]] constexpr int other_axis(int i, int p, int q) noexcept {
  if constexpr (N == 3) return 3 - p - q;
  const int above_p = i < p ? i : i + 1;
  return above_p < q ? above_p : above_p + 1;
}

/// each() for the frames' 3x3 matrices; for others, which fewer wait for, a loop, which is compiled in less time.
template <int N, int Count, class Function>
[[gnu::always_inline]] inline void repeat(Function f) noexcept {
  if constexpr (N == 3) {
    each<Count>(f);
  } else {
    for (int i = 0; i < Count; ++i) f(i);
  }
}

/// One Jacobi rotation in the plane (p, q), q > p, in those lanes where it is worth while: it makes zero what couples
/// the two axes. Entries are at most 2. Returns whether it was worth while anywhere.
template <int N>
SHORTSHOT_INLINE bool rotate(Eigenvectors<N>& e, Couplings<N>& off, int p, int q) noexcept {
  using simd::all;
  using simd::F32;
  F32& coupling = off.between(p, q);
  F32& value_p = e.of[p][N];
  F32& value_q = e.of[q][N];
  // The tangent of an angle of at most an eighth of a turn.
  const F32 gap = value_q - value_p;
  const F32 wide = simd::abs(gap);
  const F32 high = simd::abs(coupling);
  const simd::Mask turns = high - all(1e-12f) > wide * all(7e-9f);  // else no component moves by half its last bit
  if (!any(turns)) return false;
  const F32 root = simd::sqrt(gap * gap + all(4.0f) * (coupling * coupling));
  const F32 sum = gap + simd::negate(gap < all(0.0f), root);
  const F32 t = keep(turns, (coupling + coupling) / sum);
  const F32 c = all(1.0f) / simd::sqrt(t * t + all(1.0f));
  const F32 s = t * c;

  const F32 moved = t * coupling;
  value_p = value_p - moved;
  value_q = value_q + moved;
  coupling = select(turns, all(0.0f), coupling);
  F32* first = &off.between(p, other_axis<N>(0, p, q));
  F32* second = &off.between(q, other_axis<N>(0, p, q));
  repeat<N, N - 2 + N>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    const F32 at_p = *first;
    const F32 at_q = *second;
    *first = c * at_p - s * at_q;
    *second = s * at_p + c * at_q;
    const int next = k + 1;
    const bool couples = next < N - 2;
    first = couples ? &off.between(p, other_axis<N>(next, p, q)) : &e.of[p][next - (N - 2)];
    second = couples ? &off.between(q, other_axis<N>(next, p, q)) : &e.of[q][next - (N - 2)];
  });
  return true;
}

/// Eigen-decompositions. They converge quadratically: two sweeps for each axis are more than any float matrix was seen
/// to need (four of 3x3, five of 4x4 ones).
template <int N = 3>
[[nodiscard]] inline Eigenvectors<N> decompose(const SymmetricMatrices<N>& m) noexcept {
  using simd::all;
  using simd::F32;
  F32 largest = all(1.17549435e-38f);
  for (const F32& entry : m.entry) largest = simd::max(simd::abs(entry), largest);
  const F32 scale = from_bits(bits_of(largest) & simd::all_int(0x7F800000));  // the power of two below it
  const F32 unit = all(1.0f) / scale;
  Eigenvectors<N> e;
  Couplings<N> off;
  const F32* entry = m.entry;
  repeat<N, N>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
    repeat<N, N>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      e.of[i][k] = all(i == k ? 1.0f : 0.0f);
      if (k >= i) (k == i ? e.of[i][N] : off.between(i, k)) = *entry++ * unit;
    });
  });
  bool turned = true;
  for (int sweep = 0; sweep < 2 * N && turned; ++sweep) {
    turned = false;
    for (int p = 0; p < N - 1; ++p) {
      for (int q = p + 1; q < N; ++q) turned = rotate(e, off, p, q) || turned;
    }
  }

  // Sort: exchange neighbors, from 0 and 1 to the last ones, again and again; at last 0 and 1.
  repeat<N, (N - 1) * (N - 2) + 1>([&](auto step) SHORTSHOT_INLINE_LAMBDA {
    auto& first = e.of[step % (N - 1)];
    auto& second = e.of[step % (N - 1) + 1];
    const simd::Mask swap = second[N] < first[N];
    if (!any(swap)) return;
    repeat<N, N + 1>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      const F32 before = first[k];
      first[k] = select(swap, second[k], before);
      second[k] = select(swap, before, second[k]);
    });
  });
  repeat<N, N>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
    auto& v = e.of[i];
    F32 squares = v[0] * v[0];
    unroll<N - 1>([&](auto k) { squares = squares + v[k + 1] * v[k + 1]; });
    const F32 length = simd::sqrt(squares);
    repeat<N, N>([&](auto k) { v[k] = v[k] / length; });
    v[N] = v[N] * scale;
  });
  return e;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_SYMMETRIC_EIGEN_HPP

// shortshot/frame/rank_by_distance.hpp: the neighbors' order by distance, without sorting.
//
// PCL sorts every neighborhood because a tied vote over an axis' sign looks at the five members in the middle. Ties
// are rare (2 to 5 key points in a hundred), so the order is asked for only then, and found by counting.
#ifndef SHORTSHOT_FRAME_RANK_BY_DISTANCE_HPP
#define SHORTSHOT_FRAME_RANK_BY_DISTANCE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Where a neighbor stands in the order: by squared distance (bits of floats >= 0 order as the floats do), then by
/// index in the cloud. The key point and its copies come first, at 0.
using Place = std::uint64_t;

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

template <class Neighbors>
[[nodiscard]] inline Place place_at(const Neighbors& n, std::uint32_t i) noexcept {
  const Neighbor v = neighbor_at(n, i);
  const std::uint32_t bits = math::bits_of(v.d2);
  if (bits == 0 && v.dx == 0.0f && v.dy == 0.0f && v.dz == 0.0f) return 0;
  return (Place{bits} << 32 | v.index) + 1;
}

/// How many neighbors stand before a place.
template <class Neighbors>
[[nodiscard]] inline int count_before(const Neighbors& n, Place limit) noexcept {
  int count = 0;
  std::uint32_t i = 0;
  if (simd::lanes > 1 && limit << 32 == 0) {  // whoever is closer, whole registers at a time
    const float d2 = math::float_of(static_cast<std::uint32_t>(limit >> 32));
    simd::I32 closer{};
    for (; n.size - i >= simd::lanes; i += simd::lanes) {
      closer = increment(load_neighbors(n, i).d2 < simd::all(d2), closer);
    }
    count = sum(closer);
  }
  for (; i < n.size; ++i) count += place_at(n, i) < limit ? 1 : 0;
  return count;
}

/// A place with `rank` neighbors before it, found bit by bit; `rank` must be their number at most.
template <class Neighbors>
[[nodiscard]] inline Place place_of_rank(const Neighbors& n, int rank) noexcept {
  Place place = 0;
  for (Place bit = Place{1} << 62; bit != 0; bit >>= 1) {
    const int before = count_before(n, place | bit);
    if (before <= rank) place |= bit;
    if (before == rank) break;
  }
  return place;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_RANK_BY_DISTANCE_HPP

// shortshot/frame/viewpoint.hpp: to which side of a surface normals and frames are turned.
#ifndef SHORTSHOT_FRAME_VIEWPOINT_HPP
#define SHORTSHOT_FRAME_VIEWPOINT_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A point, in the cloud's coordinates, to which or from which normals and the z axes of frames are turned. Absent (the
/// default): a normal's sign is the solver's, a frame's z is turned by SHOT's vote. Trivially copyable.
struct Viewpoint {
  /// What the point is.
  enum class Side : std::uint8_t { absent, towards, away_from };
  Side side = Side::absent;  ///< absent: the point means nothing
  Point point = {};          ///< in the cloud's coordinates

  /// To the camera, which sees the surface from outside. In a depth camera's own coordinates it is at {0, 0, 0}.
  [[nodiscard, gnu::always_inline]] static constexpr Viewpoint towards(const Point& camera) noexcept {
    return {Side::towards, camera};
  }
  /// Outwards, from a point inside: for whole objects.
  [[nodiscard, gnu::always_inline]] static constexpr Viewpoint away_from(const Point& inside) noexcept {
    return {Side::away_from, inside};
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// ok or bad_viewpoint.
[[nodiscard]] inline Status validate(const Viewpoint& viewpoint) noexcept {
  return viewpoint.side == Viewpoint::Side::absent || is_finite(viewpoint.point) ? Status::ok : Status::bad_viewpoint;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What to turn to at a place; zeros if the viewpoint is absent. bad_viewpoint if it is not finite, or so far away that
/// the difference overflows.
[[nodiscard]] inline Status direction_at(const Viewpoint& viewpoint, const Point& place, float (&view)[3]) noexcept {
  view[0] = view[1] = view[2] = 0.0f;
  if (viewpoint.side == Viewpoint::Side::absent) return Status::ok;
  const float side = viewpoint.side == Viewpoint::Side::towards ? 1.0f : -1.0f;
  view[0] = (viewpoint.point.x - place.x) * side;
  view[1] = (viewpoint.point.y - place.y) * side;
  view[2] = (viewpoint.point.z - place.z) * side;
  return math::is_finite(view) ? Status::ok : Status::bad_viewpoint;
}

/// What every estimate from a neighborhood asks of its arguments; `view` becomes the direction to turn to.
template <class Neighbors>
[[nodiscard]] inline Status validate_estimate(const Neighbors& n, Radius radius, const Viewpoint& viewpoint,
                                              float (&view)[3]) noexcept {
  const Status usable = validate(radius);
  if (usable != Status::ok) return usable;
  return n.size > max_neighbors ? Status::too_many_neighbors : direction_at(viewpoint, n.center, view);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_VIEWPOINT_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A local reference frame: three orthonormal axes in the cloud's coordinates, right-handed. Trivial type.
struct Frame {
  float x[3];  ///< in SHOT: along the surface, where more points are
  float y[3];  ///< z cross x
  float z[3];  ///< in SHOT: the normal, where more points are
};

/// How clear the decisions were that made a frame; confidence() makes one number of them. Zeros: there is no frame, or
/// something was decided by a hair. Trivial type.
struct FrameConfidence {
  float eigenvalue_gap;  ///< 0 to 1: 1 - l2 / l1 of the two largest eigenvalues, l1 >= l2: how unique the line of x is
  float x_margin;        ///< 0 to 1/2: the share of the members on the side that x points to, less 1/2; 0: a tie
  float z_margin;        ///< the same of z; 1/2 where a viewpoint told, which outvotes all members
};

/// Fewest neighbors (other than the key point and its copies) for a frame, as in PCL.
inline constexpr int min_frame_neighbors = 5;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// How sure a frame is, 0 to 1: the least of the eigenvalues' gap and twice either margin. It ranks frames of one
/// radius and is no probability. On generated noisy surfaces, where 15 % of all frames were more than 37 degrees off,
/// 2 % of the surer half were; on surfaces that are flat but for their noise it tells little.
[[nodiscard]] inline float confidence(const FrameConfidence& of) noexcept {
  const float margin = 2.0f * (of.x_margin < of.z_margin ? of.x_margin : of.z_margin);
  return margin < of.eigenvalue_gap ? margin : of.eigenvalue_gap;
}

/// Is this a frame one can describe in: finite, and orthonormal within 1e-3?
[[nodiscard]] inline Status validate(const Frame& frame) noexcept {
  const float(*const axes[3])[3] = {&frame.x, &frame.y, &frame.z};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k <= i; ++k) {
      const float error = extend::dot(*axes[i], *axes[k]) - (i == k ? 1.0f : 0.0f);
      if (!extend::math::is_finite(error) || !(error > -1e-3f && error < 1e-3f)) return Status::bad_frame;
    }
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Members, those who make a frame, lie strictly inside its radius and not at the key point itself: the key point and
/// its copies move no sum, but must not be counted.
[[nodiscard]] inline simd::Mask within(const NeighborLanes& v, Radius radius) noexcept {
  return v.d2 < simd::all(radius.squared);
}
[[nodiscard]] inline simd::Mask is_elsewhere(const NeighborLanes& v) noexcept {
  return simd::abs(v.dx) + simd::abs(v.dy) + simd::abs(v.dz) > simd::all(0.0f);
}

/// Pass 1: how far the members reach, as the squared distance of the farthest one, and how many there are.
struct Census {
  float farthest_d2;
  int members;
};

template <class Neighbors>
[[nodiscard]] inline Census take_census(const Neighbors& n, Radius radius) noexcept {
  simd::F32 farthest = simd::all(0.0f);
  simd::I32 members{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    simd::F32 d2;
    simd::Mask member;
    if constexpr (simd::lanes == 1) {
      const NeighborLanes v = load_neighbors(n, i);
      d2 = v.d2;
      member = within(v, radius);
      if (small_code || any(simd::all(0.0f) >= d2)) member = member & is_elsewhere(v);  // seldom
      if (!any(member)) continue;
    } else {
      d2 = load_d2(n, i);
      member = d2 < simd::all(radius.squared);
      if (any(simd::all(0.0f) >= d2)) member = member & is_elsewhere(load_neighbors(n, i));  // seldom
    }
    farthest = simd::max(farthest, keep(member, d2));
    members = increment(member, members);
  }
  return {simd::largest(farthest), sum(members)};
}

/// How members are brought to fixed point: coordinates times `unit`, a power of two (so that nothing is rounded) that
/// makes the farthest one 1/2 to 1 long, and weights times `scale`.
struct MemberScale {
  float unit;
  float scale;
};

[[nodiscard]] inline MemberScale member_scale(std::uint32_t n, float farthest_d2, Radius radius) noexcept {
  // Below 1e-19 m squares are lost to underflow: such members count as if they were at the key point.
  const float root = simd::sqrt(farthest_d2);
  const float farthest = root > 1e-19f ? root : 1e-19f;
  const float unit = 0.5f / math::power_of_two_below(farthest);
  // The largest w |v|^2 with w = 1 - |v| / R: at |v| = 2/3 R, or at the farthest member if that is closer.
  const float largest_at = radius.value * 0.6667f;
  const float place = farthest > largest_at ? largest_at : farthest;
  float bound = (1.0f - place / radius.value) * (place * unit) * (place * unit);
  float scale = fixed_point_scale(n);
  for (int bits = 0; bound < 0.49f && bits < 4; ++bits, bound *= 2.0f) scale *= 2.0f;
  return {unit, scale};
}

/// Pass 2: sum of w v v^T over the members (PCL's matrix but for its scale, which moves no eigenvector).
template <class Neighbors>
[[nodiscard]] inline SymmetricLanes weighted_scatter(const Neighbors& n, Radius radius, float farthest_d2) noexcept {
  using simd::all;
  using simd::F32;
  const MemberScale to = member_scale(n.size, farthest_d2, radius);
  const F32 unit = all(to.unit);
  const F32 scale = all(to.scale);
  const F32 inverse = all(1.0f / radius.value);
  simd::I32 sums[6] = {};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    const F32 at[3] = {v.dx * unit, v.dy * unit, v.dz * unit};
    const F32 w = keep(within(v, radius), (all(1.0f) - simd::sqrt(v.d2) * inverse) * scale);
    simd::I32* entry = sums;  // of the upper triangle, row by row
    each<3>([&](auto row) SHORTSHOT_INLINE_LAMBDA {
      const F32 weighted = w * at[row];
      each<3>([&](auto column) SHORTSHOT_INLINE_LAMBDA {
        if (column < row) return;
        *entry = *entry + round_to_int(weighted * at[column]);
        ++entry;
      });
    });
  }
  SymmetricLanes total;
  each<6>([&](auto k) { total.entry[k] = all(static_cast<float>(sum(sums[k]))); });
  return total;
}

/// Pass 3: for each of two axes, how many members have v . axis < 0.
struct AxisVotes {
  int x;
  int z;
};

template <class Neighbors>
[[nodiscard]] inline AxisVotes count_votes_against(const Neighbors& n, Radius radius, const float (&x)[3],
                                                   const float (&z)[3]) noexcept {
  using simd::all;
  simd::I32 against_x{}, against_z{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    const simd::Mask near = within(v, radius);
    const PointLanes offset{v.dx, v.dy, v.dz};
    against_x = increment((along(x, offset) < all(0.0f)) & near, against_x);
    against_z = increment((along(z, offset) < all(0.0f)) & near, against_z);
  }
  return {sum(against_x), sum(against_z)};
}

/// PCL's answer to a tied vote: of the five members in the middle of the order by distance, do at least three have
/// v . axis > 0?
template <class Neighbors>
[[nodiscard]] inline bool middle_votes_for(const Neighbors& n, int members, const float (&axis)[3]) noexcept {
  const int rank = count_before(n, 1) + members / 2 - 2;  // behind the key point and its copies
  const Place first = place_of_rank(n, rank);
  const Place end = place_of_rank(n, rank + 5);
  int votes = 0;
  for (std::uint32_t i = 0; i < n.size; ++i) {
    if (place_at(n, i) - first >= end - first) continue;
    const Neighbor v = neighbor_at(n, i);
    votes += dot({v.dx, v.dy, v.dz}, axis) > 0.0f ? 1 : 0;
  }
  return votes >= 3;
}

/// Sign disambiguation: turn an axis towards the majority of the members.
template <class Neighbors>
inline void disambiguate_sign(const Neighbors& n, int members, int against, float (&axis)[3]) noexcept {
  const int lead = 2 * against - members;
  if (lead == 0 ? middle_votes_for(n, members, axis) : lead < 0) return;
  for (float& component : axis) component = 0.0f - component;
}

/// By how much a majority is more than one half.
[[nodiscard]] inline float margin_of(int members, int against) noexcept {
  const int lead = 2 * against - members;
  return static_cast<float>(lead < 0 ? -lead : lead) / static_cast<float>(2 * members);
}

[[nodiscard]] inline FrameConfidence confidence_of(const EigenLanes& eigen, int members, AxisVotes against) noexcept {
  const float gap = 1.0f - simd::largest(eigen.value(1)) / simd::largest(eigen.value(2));
  // What should be zero can be a rounding less.
  return {gap < 1.0f ? gap : 1.0f, margin_of(members, against.x), margin_of(members, against.z)};
}

/// y = z cross x.
[[gnu::always_inline]] inline void set_y(Frame& frame) noexcept {
  frame.y[0] = unfused(frame.z[1] * frame.x[2]) - unfused(frame.z[2] * frame.x[1]);
  frame.y[1] = unfused(frame.z[2] * frame.x[0]) - unfused(frame.z[0] * frame.x[2]);
  frame.y[2] = unfused(frame.z[0] * frame.x[1]) - unfused(frame.z[1] * frame.x[0]);
}

/// estimate_frame() for what was checked before. `view` is the vector to the viewpoint; zeros: there is none.
/// `confidence` is one FrameConfidence, or none: nothing is worked out then, and no code of it is there.
template <class Neighbors, class... Confidence>
[[nodiscard]] inline Status frame_of(const Neighbors& n, Radius radius, const float (&view)[3], Frame& frame,
                                     Confidence&... confidence) noexcept {
  const Census census = take_census(n, radius);
  if (census.members < min_frame_neighbors) return Status::too_few_neighbors;

  const EigenLanes eigen = decompose(weighted_scatter(n, radius, census.farthest_d2));
  // What float can tell apart, and what the rounding of the members to integers may have moved.
  const simd::F32 resolution =
      simd::all(1e-6f) * eigen.value(2) + simd::all(unfused(0.5f * static_cast<float>(census.members)));
  if (!any((eigen.value(2) - eigen.value(1) > resolution) & (eigen.value(1) - eigen.value(0) > resolution))) {
    return Status::ambiguous_frame;
  }

  for (int k = 0; k < 3; ++k) {
    frame.x[k] = simd::largest(eigen.vector(2, k));
    frame.z[k] = simd::largest(eigen.vector(0, k));
  }
  AxisVotes against = count_votes_against(n, radius, frame.x, frame.z);
  const float towards = dot(view, frame.z);
  if (towards != 0.0f) against.z = towards < 0.0f ? census.members : 0;  // a viewpoint that tells outvotes all members
  ((confidence = confidence_of(eigen, census.members, against)), ...);
  disambiguate_sign(n, census.members, against.x, frame.x);
  disambiguate_sign(n, census.members, against.z, frame.z);
  set_y(frame);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// SHOT's local reference frame (LRF) of a gathered neighborhood: x along the largest and z along the smallest
/// principal axis of the members, weighted by R - |v| and centered on the key point, each turned towards the majority
/// of the members; y = z cross x. Source: PCL 1.13's SHOTLocalReferenceFrameEstimation, its rule for ties included.
///
/// `radius` is the frame's own; it may be smaller than the one the neighborhood was gathered with.
/// `viewpoint` turns z, and only x goes by vote: every depth camera knows where it is, and it makes frames more
/// repeatable. Absent, it is SHOT's frame.
///
/// Statuses: bad_radius; bad_viewpoint (not finite); too_many_neighbors (more than 2^24); too_few_neighbors (fewer than
/// five members); ambiguous_frame (two principal axes equal within float resolution: collinear or symmetric
/// neighborhoods). `frame` is zeroed then. On an exactly planar neighborhood all members lie at z = 0 and the sign of
/// z is the solver's unless a viewpoint is given. No allocation, reentrant. The result does not depend on the order of
/// the neighbors.
template <class Neighbors>
[[nodiscard]] inline Status estimate_frame(const Neighbors& n, Radius radius, Frame& frame,
                                           const Viewpoint& viewpoint = {}) noexcept {
  frame = Frame{};
  float view[3] = {};
  const Status usable = detail::validate_estimate(n, radius, viewpoint, view);
  return usable == Status::ok ? detail::frame_of(n, radius, view, frame) : usable;
}

/// The same frame, and how clear its decisions were: zeros where the status is not ok.
template <class Neighbors>
[[nodiscard]] inline Status estimate_frame(const Neighbors& n, Radius radius, Frame& frame, FrameConfidence& confidence,
                                           const Viewpoint& viewpoint = {}) noexcept {
  frame = Frame{};
  confidence = FrameConfidence{};
  float view[3] = {};
  const Status usable = detail::validate_estimate(n, radius, viewpoint, view);
  return usable == Status::ok ? detail::frame_of(n, radius, view, frame, confidence) : usable;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_FRAME_FRAME_HPP

// shortshot/descriptor/signals.hpp: what a cell's histogram is about. A signal is one struct: its name, its bins, where
// its values come from, and how a register of neighbors is measured.
#ifndef SHORTSHOT_DESCRIPTOR_SIGNALS_HPP
#define SHORTSHOT_DESCRIPTOR_SIGNALS_HPP

#include <limits>

// shortshot/cloud/intensity_source.hpp: where a descriptor's intensities come from.
#ifndef SHORTSHOT_CLOUD_INTENSITY_SOURCE_HPP
#define SHORTSHOT_CLOUD_INTENSITY_SOURCE_HPP

// shortshot/cloud/keypoint.hpp: a place to describe.
#ifndef SHORTSHOT_CLOUD_KEYPOINT_HPP
#define SHORTSHOT_CLOUD_KEYPOINT_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A place to describe: a point of the cloud, or any other position (a voxel's centroid), with the color and the
/// intensity that its neighbors' are compared with. Where a descriptor needs one that a key point does not have, the
/// key point has the status missing_colors or missing_intensities. Trivially copyable.
struct KeyPoint {
  Point position;          ///< in the cloud's coordinates
  float intensity;         ///< if has_intensity
  Rgb color;               ///< if has_color
  bool has_color : 1;      ///< can its color be compared?
  bool has_intensity : 1;  ///< can its intensity be compared?

  KeyPoint() = default;
  /// Without a color or an intensity.
  [[gnu::always_inline]] constexpr KeyPoint(const Point& p) noexcept  // NOLINT: a point can be described
      : position(p), intensity(0.0f), color{}, has_color(false), has_intensity(false) {}
  /// With a color.
  [[gnu::always_inline]] constexpr KeyPoint(const Point& p, const Rgb& rgb) noexcept
      : position(p), intensity(0.0f), color(rgb), has_color(true), has_intensity(false) {}
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// The key point at point `index` of a cloud, which must be below cloud.size, with what the cloud has there.
[[nodiscard]] inline KeyPoint keypoint(const CloudView& cloud, std::size_t index) noexcept {
  KeyPoint key(point(cloud, index));
  key.has_color = has_colors(cloud);
  key.has_intensity = has_intensities(cloud);
  if (key.has_color) key.color = color(cloud, index);
  if (key.has_intensity) key.intensity = intensity(cloud, index);
  return key;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Is this the index of a point of the cloud? Negative ones become far too large, and wide ones are compared as they
/// are: where std::size_t has 32 bits, 2^32 is not point 0.
template <class Index>
[[nodiscard, gnu::always_inline]] inline bool is_index(const CloudView& cloud, Index index) noexcept {
  using Number = typename std::conditional_t<(sizeof(Index) > sizeof(std::size_t)), std::make_unsigned<Index>,
                                             std::common_type<std::size_t>>::type;
  return static_cast<Number>(index) < cloud.size;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_CLOUD_KEYPOINT_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The intensities of a cloud's own channel, and the key point's: the source of Intensity. A neighbor whose intensity
/// is not finite has none.
struct CloudIntensities {
  static constexpr Channel channel = Channel::intensities;  ///< of the cloud that it reads
  ScalarChannel intensities;                                ///< the cloud's
  float reference;                                          ///< the key point's
  /// What a signal gets that the caller gives no source to. Reads the key point's alone.
  [[nodiscard]] static CloudIntensities at(const CloudView& cloud, const KeyPoint& key) noexcept {
    const bool known = key.has_intensity && extend::math::is_finite(key.intensity);
    return {known ? cloud.intensities : ScalarChannel{}, key.intensity};
  }
  /// ok or missing_intensities.
  [[nodiscard]] Status status() const noexcept {
    return intensities.value != nullptr ? Status::ok : Status::missing_intensities;
  }
  /// One register of intensities by index.
  [[nodiscard]] extend::simd::F32 operator()(const std::uint32_t* index) const noexcept {
    float lanes[extend::simd::lanes];
    for (std::size_t k = 0; k < extend::simd::lanes; ++k) lanes[k] = extend::read(intensities, index[k]);
    return extend::simd::load(lanes);
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_CLOUD_INTENSITY_SOURCE_HPP

// shortshot/cloud/normal_source.hpp: where a descriptor's normals come from.
#ifndef SHORTSHOT_CLOUD_NORMAL_SOURCE_HPP
#define SHORTSHOT_CLOUD_NORMAL_SOURCE_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The normals of a cloud's own channel: the source of NormalCosine. A neighbor whose normal is not finite has none.
struct CloudNormals {
  static constexpr Channel channel = Channel::normals;  ///< of the cloud that it reads
  Float3Channel normals;                                ///< the cloud's
  /// Borrows the channel; one that is not there is missing_normals.
  explicit CloudNormals(const CloudView& cloud) noexcept : normals(cloud.normals) {}
  /// What a signal gets that the caller gives no source to.
  [[nodiscard]] static CloudNormals at(const CloudView& cloud, const KeyPoint&) noexcept { return CloudNormals(cloud); }
  /// ok or missing_normals.
  [[nodiscard]] Status status() const noexcept { return normals.x != nullptr ? Status::ok : Status::missing_normals; }
  /// One register of normals by index.
  [[nodiscard, gnu::always_inline]] extend::PointLanes operator()(const std::uint32_t* index) const noexcept {
    if constexpr (extend::simd::lanes == 1) {
      const Point n = extend::read(normals, *index);
      return {extend::simd::all(n.x), extend::simd::all(n.y), extend::simd::all(n.z)};
    }
    return extend::read_lanes(normals, [index](std::size_t lane) { return std::size_t{index[lane]}; });
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_CLOUD_NORMAL_SOURCE_HPP

// shortshot/color/color_source.hpp: where a descriptor's colors come from: the cloud's bytes, or an array converted
// before.
#ifndef SHORTSHOT_COLOR_COLOR_SOURCE_HPP
#define SHORTSHOT_COLOR_COLOR_SOURCE_HPP

// shortshot/color/lab.hpp: sRGB bytes -> CIELAB, and the color distance of CSHOT and SCSH.
//
// Both existing codes quantize the CIE ratios to 1/4000 and look their cube root up in a table of 4000 entries; here
// the same quantized ratio goes through a computed root, so that 16 KB of tables are not needed and pure white, which
// reads past the end of both tables, is defined (in PclLab, too: as what PCL was seen to read there).
#ifndef SHORTSHOT_COLOR_LAB_HPP
#define SHORTSHOT_COLOR_LAB_HPP

// shortshot/color/fixed_power.hpp: the roots of CIELAB, in integers: half the instructions of a float version that is
// as good, a fortieth where there is no FPU, and nothing that could round differently elsewhere.
#ifndef SHORTSHOT_COLOR_FIXED_POWER_HPP
#define SHORTSHOT_COLOR_FIXED_POWER_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// t^p of a fixed p below 1/2, for t from 2^-7 up to 2. With t = m 2^e, m from 1/2 to 1, and z = m - 1:
/// t^p = (1 + z (c0 + z (c1 + ... + z c9))) 2^(e p).
struct FixedPower {
  std::int32_t fit[10];     ///< c0 to c9 in units of 2^-32: ((1 + z)^p - 1) / z at Chebyshev nodes
  std::uint32_t octave[8];  ///< 2^(e p) in units of 2^-31, from e = -6 on

  /// In units of 2^-31, of the float that has these bits.
  [[nodiscard]] std::uint32_t fixed(std::uint32_t bits) const noexcept {
    const auto z = static_cast<std::int32_t>(bits << 8 | 0x80000000u);  // in units of 2^-32
    std::int32_t sum = fit[9];
    each<9>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sum = add_high_product(fit[8 - k], sum, z); });
    const auto power =
        static_cast<std::uint32_t>(add_high_product(1, sum, z));  // modulo 1; rounded up, as the rest is down
    return static_cast<std::uint32_t>((std::uint64_t{power} * octave[(bits >> 23) - 120u]) >> 32);
  }

  /// Within 2e-9 before it is rounded to float, once: of the 3965 numbers k / 4000 that CIELAB asks for, all but 18 are
  /// the float that is closest, and those are the next one.
  [[nodiscard]] float operator()(float t) const noexcept {
    return unfused(static_cast<float>(fixed(math::bits_of(t))) * (1.0f / 2147483648.0f));
  }
};

inline constexpr FixedPower cube_root{
    {1431655764, -477219117, 265086957, -177611235, 118766867, -177798683, -243108994, -883031911, -1088405058,
     -784821837},
    {536870912u, 676414963u, 852229450u, 1073741824u, 1352829926u, 1704458901u, 2147483648u, 2705659852u}};

/// t^0.3333, as the published SSH / SCSH code has it.
inline constexpr FixedPower published_root{
    {1431512598, -477195254, 265079000, -177608167, 118765444, -177800906, -243118475, -883057088, -1088438257,
     -784843915},
    {536945343u, 676493110u, 852308217u, 1073816253u, 1352892442u, 1704498283u, 2147483648u, 2705597339u}};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_COLOR_FIXED_POWER_HPP

// shortshot/color/srgb.hpp: sRGB's gamma undone, by a table of 1 KB or, where code shall be small, without: the same
// bits.
#ifndef SHORTSHOT_COLOR_SRGB_HPP
#define SHORTSHOT_COLOR_SRGB_HPP

#include <array>

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// n-th root by Newton's iteration, for tables that are built while compiling; never called at run time.
constexpr double nth_root(double value, int n) noexcept {
  double root = 1.0;
  for (int step = 0; step < 100; ++step) {
    double power = 1.0;
    for (int k = 1; k < n; ++k) power *= root;
    const double next = ((n - 1) * root + value / power) / n;
    if (next == root) break;
    root = next;
  }
  return root;
}

/// Natural logarithm of 0.05 <= value <= 1 to 1e-6, likewise only while compiling: ln v = 2 artanh((v - 1) / (v + 1)).
constexpr double log_series(double value) noexcept {
  const double s = (value - 1.0) / (value + 1.0);
  double power = s;
  double sum = 0.0;
  for (int k = 1; k < 120; k += 2) {
    sum += power / k;
    power *= s * s;
  }
  return 2.0 * sum;
}

/// A power of 2.4 with the existing codes' own roundings, because one bit more or less would move some ratios across a
/// step of their tables: the base is a float, and so is the exponent.
constexpr float srgb_power(float number) noexcept {
  const double base = static_cast<double>(number);
  const double excess = static_cast<double>(2.4f) - 2.4;
  return static_cast<float>(base * base * nth_root(base * base, 5) * (1.0 + excess * log_series(base)));
}

constexpr std::array<float, 256> make_srgb_to_linear() noexcept {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float c = static_cast<float>(i) / 255.0f;
    table[i] = c > 0.04045f ? srgb_power((c + 0.055f) / 1.055f) : c / 12.92f;
  }
  return table;
}

inline constexpr std::array<float, 256> srgb_to_linear = make_srgb_to_linear();

inline constexpr FixedPower srgb_root{
    {1717987336, -515393476, 275016773, -175895406, 155978275, 49167834, 531163086, 686271253, 616103588, 0},
    {406871906u, 536870735u, 708405228u, 934746364u, 1233405304u, 1627488163u, 2147483648u, 2833621849u}};

/// The same power of a number from 1/16 to 1 without double: the square of its mantissa times srgb_root of it, whose p
/// is 2.4 - 2. Of all 245 numbers that the gamma has, each has the table's bits.
[[nodiscard]] inline float small_srgb_power(float base) noexcept {
  const std::uint32_t bits = math::bits_of(base);
  const std::uint32_t mantissa = bits << 8 | 0x80000000u;
  const auto square = static_cast<std::uint32_t>((std::uint64_t{mantissa} * mantissa) >> 32);
  const std::uint64_t product = std::uint64_t{srgb_root.fixed(bits)} * square;  // in units of 2^-63
  const auto high = static_cast<std::uint32_t>(product >> 32);
  const int zeros = __builtin_clz(high);  // 1 to 4
  const auto digits = static_cast<float>(high << zeros | static_cast<std::uint32_t>(product) >> (32 - zeros));
  // Times 2^(2 e - zeros - 31), where base is less than 2^e.
  const int exponent = 2 * (static_cast<int>(bits >> 23) - 126) - zeros - 31;
  return unfused(digits * math::float_of(static_cast<std::uint32_t>(exponent + 127) << 23));
}

/// A byte without sRGB's gamma, 0 to 1.
[[nodiscard]] constexpr float linear_of_srgb(std::uint8_t byte) noexcept {
  if (!small_code || simd::lanes > 1 || __builtin_is_constant_evaluated()) return srgb_to_linear[byte];
  const float c = static_cast<float>(byte) / 255.0f;
  return c > 0.04045f ? small_srgb_power((c + 0.055f) / 1.055f) : c / 12.92f;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_COLOR_SRGB_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// CIELAB color: L in 0..100 (-16 for PclLab's white), a and b clamped to -120..120 as both existing codes do.
struct Lab {
  float L, a, b;  ///< lightness; green to red; blue to yellow
};

/// CIELAB as the published SSH / SCSH code computes it: t^0.3333 above the knee, 7.787 t + 16/116 below.
struct PublishedLab {
  static constexpr const char* name = "published Lab";  ///< for layout_of()
  static constexpr bool leaves_gamut = false;           ///< are there sRGB colors beyond -120..120 in a or b?
  /// Of a CIE ratio, 0 to 1.
  [[nodiscard, gnu::always_inline]] static float root(float t) noexcept {
    return t > 0.008856f ? detail::published_root(t) : extend::unfused(7.787f * t) + 16.0f / 116.0f;
  }
};

/// CIELAB by the formula of PCL's CSHOT: the cube root above the knee, 7.87 t + 16/116 below.
struct CshotLab {
  static constexpr const char* name = "CSHOT Lab";
  static constexpr bool leaves_gamut = false;
  [[nodiscard, gnu::always_inline]] static float root(float t) noexcept {
    return t > 0.008856f ? detail::cube_root(t) : extend::unfused(7.87f * t) + 16.0f / 116.0f;
  }
};

/// The same as PCL's compiled code gives it: its table of roots ends before that of 1, where it reads a zero. White,
/// the only color with such a ratio, becomes L = -16, a = 120, b = -120.
struct PclLab {
  static constexpr const char* name = "PCL Lab";
  static constexpr bool leaves_gamut = true;
  [[nodiscard, gnu::always_inline]] static float root(float t) noexcept { return t < 1.0f ? CshotLab::root(t) : 0.0f; }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A color without sRGB's gamma.
struct LinearRgb {
  float of[3];
};

[[nodiscard]] constexpr LinearRgb to_linear(const Rgb& rgb) noexcept {
  return {{linear_of_srgb(rgb.r), linear_of_srgb(rgb.g), linear_of_srgb(rgb.b)}};
}

/// Linear RGB to CIE XYZ, and the white point.
inline constexpr float xyz_of_rgb[3][3] = {
    {0.412453f, 0.357580f, 0.180423f}, {0.212671f, 0.715160f, 0.072169f}, {0.019334f, 0.119193f, 0.950227f}};
inline constexpr float white_xyz[3] = {0.95047f, 1.0f, 1.08883f};

/// A CIE ratio of a color (0: X / Xn, 1: Y / Yn, 2: Z / Zn) in whole steps of 1 / 4000: the position in the published
/// tables.
[[nodiscard]] constexpr int ratio_step(int ratio, const LinearRgb& rgb) noexcept {
  const float(&row)[3] = xyz_of_rgb[ratio];
  const float sum = unfused(rgb.of[0] * row[0]) + unfused(rgb.of[1] * row[1]) + unfused(rgb.of[2] * row[2]);
  return static_cast<int>(sum / white_xyz[ratio] * 4000.0f);
}

/// The last step that a color can have. The ratios grow with each of the three bytes: no color is beyond white.
inline constexpr int last_ratio_step = 4000;
inline constexpr LinearRgb white = to_linear({255, 255, 255});
static_assert(ratio_step(0, white) <= last_ratio_step && ratio_step(1, white) <= last_ratio_step &&
                  ratio_step(2, white) <= last_ratio_step,
              "white has the largest ratios");

/// The root that `Rule` takes of a ratio of `step` / 4000.
template <class Rule>
[[nodiscard]] inline float root_of_step(int step) noexcept {
  return Rule::root(static_cast<float>(step) / 4000.0f);
}

/// CIELAB of the roots of a color's three ratios. Both existing codes clamp a and b to -120..120 (and L to 100), which
/// is beyond what sRGB colors have but for PclLab's white.
template <class Rule>
[[gnu::always_inline]] inline void lab_of_roots(const float (&f)[3], Lab& lab) noexcept {
  lab = {unfused(116.0f * f[1]) - 16.0f, unfused(500.0f * (f[0] - f[1])), unfused(200.0f * (f[1] - f[2]))};
  if constexpr (Rule::leaves_gamut) {
    const auto clamp = [](float& value) { value = value > 120.0f ? 120.0f : value < -120.0f ? -120.0f : value; };
    clamp(lab.a);
    clamp(lab.b);
  }
}

/// to_lab(), written where it belongs: ARM's compilers copy a returned struct of three floats again and again.
template <class Rule>
inline void put_lab(const Rgb& rgb, Lab& lab) noexcept {
  const LinearRgb linear = to_linear(rgb);
  int steps[3];
  float f[3];
  each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA { steps[k] = ratio_step(k, linear); });
  each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA { f[k] = root_of_step<Rule>(steps[k]); });
  lab_of_roots<Rule>(f, lab);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// sRGB bytes to CIELAB by `Rule` (PublishedLab, CshotLab or PclLab). Source: what the published SSH / SCSH code and
/// PCL 1.13 compute; within 1e-4 of either in L, a and b. No allocation, reentrant. LabTable (lab_table.hpp) gives the
/// same bits several times faster, for 16 KB.
template <class Rule>
[[nodiscard]] inline Lab to_lab(const Rgb& rgb) noexcept {
  Lab lab;
  detail::put_lab<Rule>(rgb, lab);
  return lab;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// Lanes of CIELAB colors.
struct LabLanes {
  simd::F32 L, a, b;  ///< of each lane
};

/// The same color in all lanes.
[[nodiscard]] SHORTSHOT_INLINE LabLanes in_all_lanes(const Lab& color) noexcept {
  return {simd::all(color.L), simd::all(color.a), simd::all(color.b)};
}

/// CSHOT's color distance, 0 to 1 for colors that sRGB has: (|dL| / 100 + (|da| / 120 + |db| / 120) / 2) / 3. NaN for
/// somebody else's NaN.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 color_distances(const LabLanes& p, const LabLanes& q) noexcept {
  using simd::all;
  const simd::F32 chroma = simd::abs(p.a - q.a) + simd::abs(p.b - q.b);
  return simd::abs(p.L - q.L) * all(1.0f / 300.0f) + chroma * all(1.0f / 720.0f);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The same of two colors, cut off at 1.
[[nodiscard]] inline float color_distance(const Lab& p, const Lab& q) noexcept {
  const extend::simd::F32 distances = extend::color_distances(extend::in_all_lanes(p), extend::in_all_lanes(q));
  return extend::simd::largest(extend::simd::min(distances, extend::simd::all(1.0f)));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_COLOR_LAB_HPP

// shortshot/color/packed_lab.hpp: a CIELAB color in 32 bits, for arrays with one color per point.
#ifndef SHORTSHOT_COLOR_PACKED_LAB_HPP
#define SHORTSHOT_COLOR_PACKED_LAB_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A third of Lab's memory. L has 11 bits, a has 10 and b has 11, in steps that just cover what sRGB colors have (L
/// 0..100, a -86.3..98.3, b -108..94.6; anything else, as PclLab's white, is clamped to about that). 0 and 100 of L and
/// 0 of a and b are exact.
///
/// The color distance between an exact Lab and an sRGB color that went through here is wrong by at most 2.9e-4 of its
/// range 0..1 (half a step in each: 0.05 / 600 + 0.1875 / 1440 + 0.1015625 / 1440). In the generated scene (4 cm
/// radius) SCSH-336 differs by an L2 distance of 0.001 on average and 0.016 at most, SCSH-696 by 0.003 and 0.027.
/// Trivial type.
class PackedLab {
 public:
  PackedLab() = default;
  /// The nearest color that 4 bytes have.
  PackedLab(const Lab& color) noexcept  // NOLINT: converts like a number
      : bits_(code(extend::unfused(color.L * 20.0f), 2000.0f) |
              code(extend::unfused((color.a + 90.0f) * (1.0f / a_step)), 1023.0f) << 11 |
              code(extend::unfused((color.b + 108.875f) * (1.0f / b_step)), 2047.0f) << 21) {}

  /// Back, within half a step.
  operator Lab() const noexcept {  // NOLINT: converts like a number
    return {extend::unfused(static_cast<float>(bits_ & 2047u) * 0.05f),
            extend::unfused(static_cast<float>(bits_ >> 11 & 1023u) * a_step) - 90.0f,
            extend::unfused(static_cast<float>(bits_ >> 21) * b_step) - 108.875f};
  }

  /// The colors at lab[index[k]], for all lanes: what operator Lab gives.
  [[nodiscard]] static extend::LabLanes at(const PackedLab* lab, const std::uint32_t* index) noexcept {
    using extend::simd::all;
    using extend::simd::all_int;
    std::uint32_t packed[extend::simd::lanes];
    for (std::size_t k = 0; k < extend::simd::lanes; ++k) packed[k] = lab[index[k]].bits_;
    const extend::simd::I32 bits = extend::simd::load(packed);
    return {to_float(bits & all_int(2047)) * all(0.05f),
            to_float(shift_right(bits, 11) & all_int(1023)) * all(a_step) - all(90.0f),
            to_float(shift_right(bits, 21) & all_int(2047)) * all(b_step) - all(108.875f)};
  }

 private:
  static constexpr float a_step = 0.1875f;     // -90 is -480 steps
  static constexpr float b_step = 0.1015625f;  // -108.875 is -1072 steps

  /// The nearest of 0..last; 0 for NaN.
  [[nodiscard]] static std::uint32_t code(float steps, float last) noexcept {
    const float positive = steps > 0.0f ? steps : 0.0f;
    const float border = 0.5f + (positive < last ? positive : last);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(border));
  }

  std::uint32_t bits_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_COLOR_PACKED_LAB_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Where a source names the rule it converts by, is it this one?
template <class Rule, class Source>
constexpr bool has_rule(const typename Source::Rule*) noexcept {
  return std::is_same<typename Source::Rule, Rule>::value;
}
template <class Rule, class Source>
constexpr bool has_rule(...) noexcept {
  return true;
}

/// A key point where colors are compared with their mean: nobody asks for its own, which may be missing.
struct KeyWithoutColor : KeyPoint {
  explicit KeyWithoutColor(const KeyPoint& key) noexcept : KeyPoint(key) {}
};
template <class Rule>
[[nodiscard]] inline Lab reference_at(const KeyPoint& key) noexcept {
  return to_lab<Rule>(key.color);
}
template <class Rule>
[[nodiscard]] inline Lab reference_at(const KeyWithoutColor&) noexcept {
  return {0.0f, 0.0f, 0.0f};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Colors of a cloud's points by index, and the key point's own: what a ColorDistance compares. This source converts
/// every neighbor's bytes when it is asked: no memory per point.
template <class LabRule>
struct RgbColors {
  static constexpr Channel channel = Channel::colors;  ///< of the cloud that it reads
  using Rule = LabRule;                                ///< by which it converts
  ColorChannel bytes;                                  ///< the cloud's
  Lab reference;                                       ///< the key point's
  /// Compares with `color`; a channel that is not there is missing_colors.
  RgbColors(const CloudView& cloud, const Rgb& color) noexcept : bytes(cloud.colors) {
    detail::put_lab<LabRule>(color, reference);
  }
  /// Compares with a reference that the kernel sets: for signals of the MeanColor.
  explicit RgbColors(const CloudView& cloud) noexcept : bytes(cloud.colors), reference{0.0f, 0.0f, 0.0f} {}
  /// ok or missing_colors.
  [[nodiscard]] Status status() const noexcept { return bytes.r != nullptr ? Status::ok : Status::missing_colors; }
  /// The color of point `index`, converted.
  [[nodiscard]] Lab operator()(std::uint32_t index) const noexcept {
    return to_lab<LabRule>(extend::read(bytes, index));
  }

  /// What a signal gets that the caller gives no source to.
  [[nodiscard]] static RgbColors at(const CloudView& cloud, const KeyPoint& key) noexcept {
    RgbColors colors(cloud, key.color);
    if (!key.has_color) colors.bytes.r = nullptr;
    return colors;
  }
  [[nodiscard]] static RgbColors at(const CloudView& cloud, const detail::KeyWithoutColor&) noexcept {
    return RgbColors(cloud);
  }
  /// May a source stand in for this one? StoredColors and whatever else gives a Lab by index may; if it says by which
  /// rule its colors were converted, it must be this one.
  template <class Source>
  [[nodiscard]] static constexpr bool accepts() noexcept {
    constexpr bool gives_colors = std::is_invocable_r<Lab, const Source&, std::uint32_t>::value;
    static_assert(!gives_colors || detail::has_rule<LabRule, Source>(nullptr),
                  "describe() supports colors converted by D's own rule");
    return gives_colors;
  }
};

/// The same from an array that holds each point's color, converted once for the whole cloud by convert_colors().
template <class Color>
struct StoredColors {
  const Color* lab;  ///< one per point of the cloud, borrowed
  Lab reference;     ///< the key point's
  /// ok or missing_colors.
  [[nodiscard]] Status status() const noexcept { return lab != nullptr ? Status::ok : Status::missing_colors; }
  /// The color of point `index`.
  [[nodiscard]] Lab operator()(std::uint32_t index) const noexcept { return lab[index]; }
};

using LabColors = StoredColors<Lab>;           ///< 12 bytes a point
using PackedColors = StoredColors<PackedLab>;  ///< 4 bytes a point; for its error see PackedLab

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// One register of colors by index.
template <class Colors>
[[nodiscard]] SHORTSHOT_INLINE LabLanes colors_at(const Colors& colors, const std::uint32_t* index) noexcept {
  if constexpr (simd::lanes == 1) return in_all_lanes(colors(*index));
  float lanes[3][simd::lanes];
  for (std::size_t k = 0; k < simd::lanes; ++k) {
    const Lab color = colors(index[k]);
    lanes[0][k] = color.L;
    lanes[1][k] = color.a;
    lanes[2][k] = color.b;
  }
  return {simd::load(lanes[0]), simd::load(lanes[1]), simd::load(lanes[2])};
}

[[nodiscard]] SHORTSHOT_INLINE LabLanes colors_at(const LabColors& colors, const std::uint32_t* index) noexcept {
  LabLanes lab;
  simd::load_triples(&colors.lab->L, index, lab.L, lab.a, lab.b);
  return lab;
}

[[nodiscard]] SHORTSHOT_INLINE LabLanes colors_at(const PackedColors& colors, const std::uint32_t* index) noexcept {
  return PackedLab::at(colors.lab, index);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Colors [begin, end) of a cloud, each converted by convert(rgb).
template <class Convert, class Color>
inline void convert_range(const CloudView& cloud, std::size_t begin, std::size_t end, const Convert& convert,
                          Color* lab) noexcept {
  for (std::size_t i = begin; i < end; ++i) lab[i] = convert(color(cloud, i));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Convert all colors of a cloud into `lab`: cloud.size elements of the caller's, each a Lab or a PackedLab. Statuses:
/// empty_cloud, bad_view, missing_colors. No allocation.
template <class LabRule, class Color>
[[nodiscard]] inline Status convert_colors(const CloudView& cloud, Color* lab) noexcept {
  const Status usable = validate(cloud);
  if (usable != Status::ok) return usable;
  if (!has_colors(cloud)) return Status::missing_colors;
  detail::convert_range(cloud, 0, cloud.size, to_lab<LabRule>, lab);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_COLOR_COLOR_SOURCE_HPP

// shortshot/descriptor/source_set.hpp: where the values of a descriptor's signals come from, all of them in one object.
#ifndef SHORTSHOT_DESCRIPTOR_SOURCE_SET_HPP
#define SHORTSHOT_DESCRIPTOR_SOURCE_SET_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// The kinds of sources that a signal reads, in the order in which measure() gets them.
template <class... Kinds>
struct SourceKinds {};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Some sources, by value: what sources() makes.
template <class... Sources>
struct SourceSet {};
template <class First, class... Others>
struct SourceSet<First, Others...> {
  First first;                  ///< one of them
  SourceSet<Others...> others;  ///< the rest
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The sources of a descriptor's signals, in any order: `sources(LabColors{...}, CloudNormals(cloud))`, or `sources()`
/// for one that reads none.
[[nodiscard]] inline extend::SourceSet<> sources() noexcept { return {}; }
template <class First, class... Others>
[[nodiscard]] extend::SourceSet<First, Others...> sources(const First& first, const Others&... others) noexcept {
  return {first, sources(others...)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// May a source be read where a signal asks for one of this kind? One of the kind itself, or of a class derived from
/// it, or what the kind accepts().
template <class Kind, class Source, class = void>
struct StandsFor : std::is_base_of<Kind, Source> {};
template <class Kind, class Source>
struct StandsFor<Kind, Source, std::void_t<decltype(Kind::template accepts<Source>())>>
    : std::bool_constant<std::is_base_of<Kind, Source>::value || Kind::template accepts<Source>()> {};

template <class Kind, class... Sources>
inline constexpr bool has_source = (StandsFor<Kind, Sources>::value || ...);

/// The first source of a set that stands for a kind; there must be one.
template <class Kind, class First, class... Others>
[[nodiscard]] constexpr const auto& source_of(const extend::SourceSet<First, Others...>& set) noexcept {
  if constexpr (StandsFor<Kind, First>::value || sizeof...(Others) == 0) {
    return set.first;
  } else {
    return source_of<Kind>(set.others);
  }
}

/// Is there one for each of these kinds?
template <class... Kinds, class... Sources>
constexpr bool has_sources(extend::SourceKinds<Kinds...>, const extend::SourceSet<Sources...>*) noexcept {
  return (has_source<Kinds, Sources...> && ...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Kinds of sources, each once.
template <class Have, class... Lists>
struct DistinctKinds {
  using type = Have;
};
template <class... Have, class... Others>
struct DistinctKinds<extend::SourceKinds<Have...>, extend::SourceKinds<>, Others...>
    : DistinctKinds<extend::SourceKinds<Have...>, Others...> {};
template <class... Have, class Next, class... More, class... Others>
struct DistinctKinds<extend::SourceKinds<Have...>, extend::SourceKinds<Next, More...>, Others...>
    : DistinctKinds<std::conditional_t<(std::is_same<Have, Next>::value || ...), extend::SourceKinds<Have...>,
                                       extend::SourceKinds<Have..., Next>>,
                    extend::SourceKinds<More...>, Others...> {};

/// The channel of a cloud that a kind of source reads; a kind that names none reads something of its owner's.
template <class Kind, class = void>
inline constexpr Channel channel_of = Channel::own;
template <class Kind>
inline constexpr Channel channel_of<Kind, std::void_t<decltype(Kind::channel)>> = Kind::channel;

template <class... Kinds>
[[gnu::always_inline]] constexpr bool reads_channel(extend::SourceKinds<Kinds...>,
                                                    [[maybe_unused]] Channel channel) noexcept {
  return ((channel_of<Kinds> == channel) || ...);
}

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_SOURCE_SET_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// What every signal with a histogram of `Bins` bins is derived from. `Kinds`: the sources that it reads; one that the
/// caller does not give is made by Kind::at(cloud, key point). A signal adds
///
///     static constexpr const char* name = "...";  // for layout_of(): tells it from all others
///     template <class At>
///     static extend::simd::F32 measure(const At& at, const Source&... one_of_each_kind) noexcept;
///
/// measure() gives the place of each neighbor of a register in the histogram, from 0 (the first bin's beginning) to 1
/// (the last one's end); the kernel cuts off what lies beyond. NaN: this neighbor has no value and is left out of the
/// whole descriptor. `at` is a NeighborsAt, or where reads_index_only is set an IndicesAt.
template <int Bins, class... Kinds>
struct Signal {
  static constexpr bool has_histogram = true;  ///< else a cell holds a plain sum
  static constexpr int bins = Bins;            ///< of its histogram
  using Sources = SourceKinds<Kinds...>;       ///< kinds of sources that it reads
  /// Signals that are Measured alike have the same values: they are measured once. Set it to the signal of one bin.
  using Measured = void;
  /// Set where measure() looks at nothing but the index, and every point has a value: fewer registers to go through.
  static constexpr bool reads_index_only = false;
  /// How many values measure() gives for each neighbor, as Values<components>, and which of those of the signal that it
  /// is Measured as is this one.
  static constexpr int components = 1;
  static constexpr int component = 0;
  /// The rule by which colors are converted; void: there are none.
  using Rule = void;
  /// What colors are compared with: KeyPointColor or MeanColor, the same for all signals of a descriptor; void:
  /// nothing.
  using Reference = void;
  /// Set where measure() gives values with signs, -4 to 4. Such a signal adds value(), of which a part's means are, and
  /// for histograms place(): both take what was measured.
  static constexpr bool is_signed = false;
  static constexpr bool has_signs = false;  ///< value() may be below 0
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// What is measured at once.
template <int Components>
struct Values {
  simd::F32 of[static_cast<std::size_t>(Components)];  ///< one register for each
};

/// Where the neighbors of one register are.
template <class FrameAxes>
struct NeighborsAt {
  const std::uint32_t* index;  ///< simd::lanes of them, in the cloud
  const PointLanes& offset;    ///< from the key point, in the cloud's coordinates
  const PointLanes& local;     ///< from the key point, in the frame's coordinates
  const FrameAxes& frame;      ///< x, y and z, for along()
};

/// Which neighbors are in one register, for signals that look at nothing else.
struct IndicesAt {
  const std::uint32_t* index;  ///< simd::lanes of them, in the cloud
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What a color signal compares neighbors' colors with: the key point's own, or the mean of all within the radius, the
/// key point included. (One point's color is noise: the mean finds a third more.)
struct KeyPointColor {
  static constexpr const char* name = "key point's color";  ///< for layout_of()
};
struct MeanColor {
  static constexpr const char* name = "mean color";  ///< for layout_of()
};

/// Signal of SSH: none. Every point counts as one, a cell holds a plain sum.
struct Occupancy : extend::Signal<1> {
  static constexpr const char* name = "occupancy";  ///< for layout_of()
  static constexpr bool has_histogram = false;
};

/// Signal of SHOT: the cosine of the angle between a point's normal and the frame's z axis, -1 to 1, over `Bins` bins.
template <int Bins>
struct NormalCosine : extend::Signal<Bins, CloudNormals> {
  static_assert(Bins >= 1 && Bins <= 1023, "NormalCosine<Bins> supports 1 to 1023 histogram bins");
  static constexpr const char* name = "normal cosine";
  using Measured = NormalCosine<1>;
  /// The places of a register of neighbors in the histogram, 0 to 1; see extend::Signal.
  template <class At, class Normals>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Normals& normals) noexcept {
    return extend::along(at.frame.z, normals(at.index)) * extend::simd::all(0.5f) + extend::simd::all(0.5f);
  }
};

/// Signal of CSHOT and SCSH: the CIELAB distance between a point's color and the key point's (or the MeanColor), over
/// `Bins` bins of equal width. `LabRule` is the color conversion (PublishedLab, CshotLab or PclLab).
template <int Bins, class LabRule = PublishedLab, class ReferenceColor = KeyPointColor>
struct ColorDistance : extend::Signal<Bins, RgbColors<LabRule>> {
  static_assert(Bins >= 1 && Bins <= 1024, "ColorDistance<Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = "color distance";
  using Measured = ColorDistance<1, LabRule, ReferenceColor>;
  static constexpr bool reads_index_only = true;
  using Rule = LabRule;
  using Reference = ReferenceColor;
  template <class At, class Colors>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Colors& colors) noexcept {
    return extend::color_distances(extend::colors_at(colors, at.index), extend::in_all_lanes(colors.reference));
  }
};

/// The axes of CIELAB: lightness, green to red, blue to yellow.
enum class LabAxis : std::uint8_t { L, a, b };

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// How a point's color differs from the mean of the neighborhood's, along all axes of CIELAB: dL / 100, da / 60, db
/// / 60.
template <class LabRule = PublishedLab>
struct LabOffset : Signal<1, RgbColors<LabRule>> {
  static constexpr const char* name = "Lab offset";
  static constexpr bool reads_index_only = true;
  static constexpr int components = 3;
  using Rule = LabRule;
  using Reference = MeanColor;
  template <class At, class Colors>
  [[nodiscard]] SHORTSHOT_INLINE static Values<3> measure(const At& at, const Colors& colors) noexcept {
    using simd::all;
    const LabLanes own = colors_at(colors, at.index);
    const LabLanes mean = in_all_lanes(colors.reference);
    return {{(own.L - mean.L) * all(1.0f / 100.0f), (own.a - mean.a) * all(1.0f / 60.0f),
             (own.b - mean.b) * all(1.0f / 60.0f)}};
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// How a point's color differs from the mean of the neighborhood's along one axis of CIELAB, with its sign: dL / 100,
/// da / 60 or db / 60. As a histogram over `Bins` bins: dL from -40 to 40, da and db from -30 to 30; what lies beyond
/// is in the outermost bins.
template <LabAxis Axis, int Bins = 1, class LabRule = PublishedLab>
struct ColorOffset : extend::Signal<Bins, RgbColors<LabRule>> {
  static_assert(Bins >= 1 && Bins <= 1024, "ColorOffset<Axis, Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = Axis == LabAxis::L   ? "lightness offset"
                                      : Axis == LabAxis::a ? "a offset"
                                                           : "b offset";
  using Measured = extend::LabOffset<LabRule>;
  static constexpr bool reads_index_only = true;
  static constexpr int component = static_cast<int>(Axis);
  using Rule = LabRule;
  using Reference = MeanColor;
  static constexpr bool is_signed = true;
  static constexpr bool has_signs = true;
  template <class At, class Colors>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at, const Colors& colors) noexcept {
    return Measured::measure(at, colors).of[component];
  }
  /// What the means of a part are of, from what measure() gave.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 value(extend::simd::F32 offset) noexcept { return offset; }
  /// The place in the histogram, from what measure() gave.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 place(extend::simd::F32 offset) noexcept {
    return offset * extend::simd::all(Axis == LabAxis::L ? 1.25f : 1.0f) + extend::simd::all(0.5f);
  }
};

/// How far it lies above the mean (`Sign` 1) or below it (-1); 0 on the other side. For means alone.
template <LabAxis Axis, int Sign, class LabRule = PublishedLab>
struct ColorExcess : ColorOffset<Axis, 1, LabRule> {
  static_assert(Sign == 1 || Sign == -1, "ColorExcess<Axis, Sign> supports 1 (above the mean) and -1 (below)");
  static constexpr bool has_signs = false;
  static constexpr const char* name = Axis == LabAxis::L   ? (Sign > 0 ? "lightness above" : "lightness below")
                                      : Axis == LabAxis::a ? (Sign > 0 ? "a above" : "a below")
                                                           : (Sign > 0 ? "b above" : "b below");
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 value(extend::simd::F32 offset) noexcept {
    const extend::simd::F32 zero = extend::simd::all(0.0f);
    return extend::simd::max(Sign > 0 ? offset : zero - offset, zero);
  }
};

/// For lidars and time-of-flight cameras: how bright a point's echo is beside the key point's, i / (i + k): 0 (black
/// beside bright) to 1/2 (as bright) to 1, over `Bins` bins. Free of any unit, and of whatever a sensor or its distance
/// multiplies all intensities with. Two echoes of 0 are as bright; what is negative counts as 0. A point without a
/// finite intensity is left out.
template <int Bins>
struct Intensity : extend::Signal<Bins, CloudIntensities> {
  static_assert(Bins >= 1 && Bins <= 1024, "Intensity<Bins> supports 1 to 1024 histogram bins");
  static constexpr const char* name = "intensity";
  using Measured = Intensity<1>;
  template <class At, class Intensities>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 measure(const At& at,
                                                                  const Intensities& intensities) noexcept {
    const extend::simd::F32 zero = extend::simd::all(0.0f);
    const extend::simd::F32 own = intensities(at.index);
    const extend::simd::Mask known = extend::simd::all_int(0x7F800000) > bits_of(extend::simd::abs(own));  // finite
    const extend::simd::F32 echo = extend::simd::max(zero, keep(known, own));
    const extend::simd::F32 sum = echo + extend::simd::max(zero, extend::simd::all(intensities.reference));
    const extend::simd::F32 share = echo / extend::simd::max(sum, extend::simd::all(extend::math::least_normal));
    const extend::simd::F32 value = select(zero >= sum, extend::simd::all(0.5f), share);
    return select(known, value, extend::simd::all(std::numeric_limits<float>::quiet_NaN()));
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The distinct ones of some signals with histograms: those that are measured, once each. `size`: their values.
template <class... Signals>
struct SignalList {
  static constexpr int size = (Signals::components + ... + 0);
};

template <class Signal>
using MeasuredAs =
    std::conditional_t<std::is_void<typename Signal::Measured>::value, Signal, typename Signal::Measured>;

template <class List, class... More>
struct Distinct {
  using type = List;
};
template <class... Have, class Next, class... More>
struct Distinct<SignalList<Have...>, Next, More...>
    : Distinct<std::conditional_t<!Next::has_histogram || (std::is_same<Have, MeasuredAs<Next>>::value || ...),
                                  SignalList<Have...>, SignalList<Have..., MeasuredAs<Next>>>,
               More...> {};

/// The distinct ones of several lists.
template <class List, class... Lists>
struct DistinctOf {
  using type = List;
};
template <class List, class... Signals, class... Others>
struct DistinctOf<List, SignalList<Signals...>, Others...>
    : DistinctOf<typename Distinct<List, Signals...>::type, Others...> {};

/// Do some of them look at where a neighbor is?
template <class... Signals>
[[gnu::always_inline]] constexpr bool look_at_places(SignalList<Signals...>) noexcept {
  return (!Signals::reads_index_only || ...);
}

/// The place of a signal's value among those of a list.
template <class Signal, class... Signals>
[[gnu::always_inline]] constexpr int place_in(SignalList<Signals...>) noexcept {
  constexpr bool same[] = {std::is_same<MeasuredAs<Signal>, Signals>::value...};
  constexpr int components[] = {Signals::components...};
  int place = Signal::component;
  for (int k = 0; !same[k]; ++k) place += components[k];
  return place;
}

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_SIGNALS_HPP

// shortshot/descriptor/voting.hpp: how one point votes for neighboring bins, written once over N axes: SHOT's
// quadrilinear interpolation as PCL computes it, the published code's rule, and others.
//
// A rule has two steps. split() takes a position along one axis and finds the bin (of the grid: the cell; of azimuths:
// the sector) it lies in and the nearer neighboring one, its partner, with the share of each (interpolation.hpp).
// combine() makes a list of votes from the shares of all axes: axis 0 radius, 1 elevation, 2 azimuth, and 3 the
// histogram's signal where the part has one.
//
// A rule that gives each point one vote for its cell and one for its partner along each axis may say so
// (`votes_for_partners`), and give their weights apart from where they go:
//
//     side()               on which side of its cell's middle a position along an axis lies, and the partner's share
//     weight_of_cell()     and
//     weight_of_partner()  in units, from the sides (or shares) along all axes
//     drops_nowhere        does a partner get no vote if the position is nowhere on the axis (BelowZero::nowhere)?
//
// The kernel then works out where they go, for two registers of points at once (short_votes.hpp) or, where there is one
// lane, without a list of votes (single_votes.hpp).
#ifndef SHORTSHOT_DESCRIPTOR_VOTING_HPP
#define SHORTSHOT_DESCRIPTOR_VOTING_HPP

// shortshot/descriptor/interpolation.hpp: linear interpolation along one axis: how a point is shared between the bin it
// lies in and the nearer neighboring one, its partner.
//
// All of it is integer arithmetic: shares are added up exactly, and indices need no conversion. A partner's share is
// kept twice, in half units, because it is the distance from the bin's middle in units of half a bin.
#ifndef SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP
#define SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP

// shortshot/base/simd_shorts.hpp: arithmetic on I16, two registers of small integers in one: half the instructions. The
// names are those of I32's, so that what is written for integers goes with both. A mask is an I16, too.
#ifndef SHORTSHOT_BASE_SIMD_SHORTS_HPP
#define SHORTSHOT_BASE_SIMD_SHORTS_HPP

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// `value` in all lanes, and as many of them as the first argument has.
[[nodiscard]] inline I32 like(I32, std::int32_t value) noexcept { return all_int(value); }
[[nodiscard]] inline I16 like(I16, std::int32_t value) noexcept {
  I16 all{};
  all.v += static_cast<std::int16_t>(value);
  return all;
}

/// As those of I32, on 16 bits: sums are modulo 2^16, and a mask is -1 where it is set, else 0.
[[nodiscard]] inline I16 operator+(I16 a, I16 b) noexcept { return {a.v + b.v}; }
[[nodiscard]] inline I16 operator-(I16 a, I16 b) noexcept { return {a.v - b.v}; }
[[nodiscard]] inline I16 operator&(I16 a, I16 b) noexcept { return {a.v & b.v}; }
[[nodiscard]] inline I16 operator|(I16 a, I16 b) noexcept { return {a.v | b.v}; }
[[nodiscard]] inline I16 operator==(I16 a, I16 b) noexcept { return {a.v == b.v}; }
[[nodiscard]] inline I16 operator>(I16 a, I16 b) noexcept { return {a.v > b.v}; }
[[nodiscard]] inline I16 is_negative(I16 a) noexcept { return {a.v < 0}; }
[[nodiscard]] inline I16 small_min(I16 a, I16 b) noexcept { return {a.v < b.v ? a.v : b.v}; }
[[nodiscard]] inline I16 small_max(I16 a, I16 b) noexcept { return {a.v > b.v ? a.v : b.v}; }
[[nodiscard]] inline I16 keep(I16 m, I16 a) noexcept { return {m.v & a.v}; }
[[nodiscard]] inline I16 drop(I16 m, I16 a) noexcept { return {~m.v & a.v}; }
[[nodiscard]] inline I16 minus_one_or_one(I16 m) noexcept { return m | like(m, 1); }

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_SHORTS_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// The fixed-point unit of all votes: `one`, a power of two, is a whole share. A rule may count twice as much for it;
/// its `weight_bits` say how much that makes of a point: less than 2^weight_bits units, or just as much.
struct VoteUnit {
  int bits;          ///< one is 2^bits
  std::int32_t one;  ///< a whole share
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// A point's share along one axis.
struct Share {
  simd::I32 cell;           ///< index of the primary cell, times the axis' stride
  simd::I32 step;           ///< index of the partner cell minus that of the primary one; 0 where there is no partner
  simd::I32 twice_partner;  ///< twice the partner's share in units: 0 to 1, to 3 below zero; the rest is the cell's
};

/// The votes of one point: `Count` indices into the part and their weights, in units.
template <int Count>
struct Votes {
  simd::I32 index[static_cast<std::size_t>(Count)];   ///< of cells, in the part
  simd::I32 weight[static_cast<std::size_t>(Count)];  ///< what each gets
};

// Cells are counted in lanes of 32 bits (I32), or of 16 (I16), two registers at a time: `Int`. `Lower` is a mask of
// them.

/// Cells on the axis: of those beyond its ends, the last and the first one. (The very end of the axis is the upper
/// border of the last cell.)
template <class Int>
[[nodiscard]] SHORTSHOT_INLINE Int cell_on(const Axis& axis, Int cell) noexcept {
  if (axis.reaches_end || detail::small_code) cell = simd::small_min(cell, simd::like(cell, axis.cells - 1));
  const bool saturates = simd::saturates && !detail::small_code && (axis.cells & (axis.cells - 1)) == 0;
  return axis.below_zero == BelowZero::never && !saturates ? cell : simd::small_max(cell, simd::like(cell, 0));
}

/// The cell of a position.
[[nodiscard]] SHORTSHOT_INLINE simd::I32 cell_of(const Axis& axis, simd::I32 position) noexcept {
  return cell_on(axis, simd::shift_right(position, axis.bits));
}

/// Cells, or -1, 0 or 1 of them, times a number of values below 2^22.
[[nodiscard]] SHORTSHOT_INLINE simd::I32 times(simd::I32 a, std::int32_t factor) noexcept {
  if (factor == 1) return a;
  const simd::I32 low = simd::small_product(a, simd::all_int(factor & 32767));
  return factor < 32768 ? low : low + simd::shift_left(simd::small_product(a, simd::all_int(factor >> 15)), 15);
}

[[nodiscard]] SHORTSHOT_INLINE simd::I16 times(simd::I16 a, std::int32_t factor) noexcept {
  const bool is_shift = (factor & (factor - 1)) == 0;
  return is_shift ? simd::I16{a.v * simd::like(a, factor).v} : a * simd::like(a, factor);
}

/// From a cell to the next one in a direction (1 or -1), around the ends.
template <class Int>
[[nodiscard]] SHORTSHOT_INLINE Int next_around(const Axis& axis, Int cell, Int direction) noexcept {
  const Int next = cell + direction;
  if (!detail::small_code && (axis.cells & (axis.cells - 1)) == 0) return next & simd::like(next, axis.cells - 1);
  return (next + keep(is_negative(next), simd::like(next, axis.cells))) -
         keep(next > simd::like(next, axis.cells - 1), simd::like(next, axis.cells));
}

/// Is there no cell on that side: first and lower, or last and upper?
template <class Int, class Lower>
[[nodiscard]] SHORTSHOT_INLINE auto is_alone(const Axis& axis, Int cell, Lower lower) noexcept {
  return cell == drop(lower, simd::like(cell, axis.cells - 1));
}

/// Where in its cell a position lies.
struct Side {
  simd::SignMask lower;     ///< its partner is the lower neighbor: it lies below the cell's middle, or on it
  simd::I32 twice_partner;  ///< as in a Share
};

/// Fraction 0 is the cell's lower border, 2^axis.bits its upper one. `rounds`: the partner's share is rounded to the
/// nearest unit, not down.
[[nodiscard]] SHORTSHOT_INLINE Side side(const Axis& axis, simd::I32 fraction, const VoteUnit& unit,
                                         bool rounds) noexcept {
  using simd::all_int;
  const std::int32_t half = std::int32_t{1} << (axis.bits - 1);
  const simd::I32 side = fraction - all_int(half + 1);
  const simd::SignMask lower = is_negative(side);
  // The partner's share is the distance from the middle; ~side = -side - 1 is what is left up to it.
  simd::I32 distance = invert(lower, side);
  const int finer_bits = axis.bits - unit.bits - 1;
  if (rounds) distance = distance + all_int((std::int32_t{1} << finer_bits) >> 1);
  return {lower, simd::shift_right(distance, finer_bits)};
}

/// The share of a position on a side of a cell.
[[nodiscard]] SHORTSHOT_INLINE Share share(const Axis& axis, simd::I32 cell, const Side& side) noexcept {
  using simd::all_int;
  const simd::I32 direction = minus_one_or_one(side.lower);
  const simd::I32 index = times(cell, axis.stride);
  if (axis.cells == 1) return {index, all_int(0), side.twice_partner};
  if (axis.end == Beyond::first_cell) {
    return {index, times(next_around(axis, cell, direction) - cell, axis.stride), side.twice_partner};
  }
  return {index, drop(is_alone(axis, cell, side.lower), times(direction, axis.stride)), side.twice_partner};
}

/// How far above its cell's lower border a position is. (On the very end of the axis: a whole cell.)
[[nodiscard]] SHORTSHOT_INLINE simd::I32 fraction_of(const Axis& axis, simd::I32 position, simd::I32 cell) noexcept {
  if (!detail::small_code && !axis.reaches_end && axis.below_zero != BelowZero::first_cell) {
    return position & simd::all_int((std::int32_t{1} << axis.bits) - 1);
  }
  return position - simd::shift_left(cell, axis.bits);
}

/// The share of a position in the cell it lies in.
[[nodiscard]] SHORTSHOT_INLINE Share share_in_cell(const Axis& axis, simd::I32 position, const VoteUnit& unit,
                                                   bool rounds) noexcept {
  const simd::I32 cell = cell_of(axis, position);
  return share(axis, cell, side(axis, fraction_of(axis, position, cell), unit, rounds));
}

/// Are there positions on this axis without a partner?
[[nodiscard]] constexpr bool may_be_alone(const Axis& axis) noexcept {
  return detail::small_code || axis.cells == 1 || axis.end == Beyond::nothing || axis.below_zero == BelowZero::nowhere;
}

/// Index of the primary cell in the part, from the shares along `Axes` axes.
template <int Axes>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 primary_index(const Share (&shares)[4]) noexcept {
  simd::I32 index = shares[0].cell;
  detail::each<Axes - 1>([&](auto i) { index = index + shares[i + 1].cell; });
  return index;
}

/// The sum of all axes' shares, twice, that partners have. (Of `Shares`, or of sides.)
template <int Axes, class Shares>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 twice_all_partners(const Shares (&shares)[4]) noexcept {
  simd::I32 sum = shares[0].twice_partner;
  detail::each<Axes - 1>([&](auto i) { sum = sum + shares[i + 1].twice_partner; });
  return sum;
}

/// The votes of a rule with one for the cell and one for the partner along each axis. Those to partners that do not
/// exist get no weight.
template <class Voting, int Axes>
[[nodiscard, gnu::always_inline]] inline Votes<Axes + 1> votes_for_cell_and_partners(const Axis (&axes)[4],
                                                                                     const Share (&shares)[4],
                                                                                     const VoteUnit& unit) noexcept {
  Votes<Axes + 1> votes;
  votes.index[0] = primary_index<Axes>(shares);
  votes.weight[0] = Voting::template weight_of_cell<Axes>(shares, unit);
  detail::each<Axes>([&](auto i) {
    const simd::I32 weight = Voting::weight_of_partner(i, shares, votes.weight[0], unit);
    votes.index[i + 1] = votes.index[0] + shares[i].step;
    votes.weight[i + 1] = may_be_alone(axes[i]) ? drop(shares[i].step == simd::all_int(0), weight) : weight;
  });
  return votes;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// The additive rule of the published SSH / SCSH code: the shares of all axes ADD UP in the primary cell, and each
/// axis' partner gets the same sum with that axis' share replaced by the partner's. At most 1 + N cells a point, no
/// diagonal ones. Known properties, kept on purpose:
/// * a partner beyond the ends of radius, elevation or signal is dropped, and its weight lost;
/// * the sum of a point's votes depends on where it lies, and jumps when it crosses a border;
/// * a position on the very end of an axis (phi = 180 degrees) counts as the LOWER border of the last cell;
/// * `FlipRadius`: the signal's partner also gets the radial PARTNER's share in place of the radial cell's.
template <bool FlipRadius>
struct AdditiveVoting {
  static constexpr const char* name = FlipRadius ? "published voting" : "additive voting";  ///< for layout_of()
  static constexpr bool partners_get_own_share = false;  ///< of a partner: its own axis' share alone?
  static constexpr bool votes_for_partners = true;       ///< one vote for the cell, and one for each axis' partner
  static constexpr bool drops_nowhere = false;  ///< no vote for a partner where the position is nowhere on the axis
  static constexpr int weight_bits = 2;         ///< a point counts for less than 2^weight_bits units
  /// Votes of a point, at the most.
  template <int Axes>
  static constexpr int votes = Axes + 1;

  /// Where the partner lies along one axis, and its share.
  [[nodiscard]] SHORTSHOT_INLINE static extend::Side side(const extend::Axis& axis, extend::simd::I32 position,
                                                          const extend::VoteUnit& unit) noexcept {
    extend::simd::I32 fraction = position & extend::simd::all_int((std::int32_t{1} << axis.bits) - 1);
    if (axis.below_zero != extend::BelowZero::never) {
      const extend::simd::Mask below = is_negative(position);
      fraction = keep(below, position) + drop(below, fraction);
    }
    return extend::side(axis, fraction, unit, false);
  }

  /// What the primary cell gets, in units.
  template <int Axes, class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_cell(const Sides (&sides)[4],
                                                                         const extend::VoteUnit& unit) noexcept {
    return extend::simd::all_int(Axes * unit.one) -
           extend::simd::shift_right(extend::twice_all_partners<Axes>(sides), 1);
  }
  /// What the partner along `axis` gets, in units.
  template <class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_partner(int axis, const Sides (&sides)[4],
                                                                            extend::simd::I32 of_cell,
                                                                            const extend::VoteUnit& unit) noexcept {
    // A share 1 - p replaced by p.
    const extend::simd::I32 one = extend::simd::all_int(unit.one);
    const extend::simd::I32 weight = (of_cell - one) + sides[axis].twice_partner;
    return FlipRadius && axis == 3 ? weight + (sides[0].twice_partner - one) : weight;
  }

  /// The cell that a position lies in along one axis, its partner, and the partner's share.
  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    return extend::share(axis, extend::cell_of(axis, position), side(axis, position, unit));
  }

  /// The votes of one point from its shares along all axes.
  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<Axes + 1> combine(const extend::Axis (&axes)[4],
                                                                        const extend::Share (&shares)[4],
                                                                        const extend::VoteUnit& unit) noexcept {
    return extend::votes_for_cell_and_partners<AdditiveVoting, Axes>(axes, shares, unit);
  }
};

/// The published rule to the last quirk: the library's default.
using PublishedVoting = AdditiveVoting<true>;

/// SHOT's rule, its quadrilinear interpolation: each axis votes by itself. The shares of all axes ADD UP in the primary
/// cell, as in AdditiveVoting, but an axis' partner gets that axis' share alone. At most 1 + N cells a point; a vote
/// beyond the ends of radius, elevation or histogram is lost. `WrapLastBin` is a defect of PCL, in whose code the bins
/// of a histogram are counted one short: a vote from the last bin but one up to the last one goes to the first one
/// instead.
template <bool WrapLastBin>
struct SeparateVoting {
  static constexpr const char* name = WrapLastBin ? "PCL voting" : "SHOT voting";
  static constexpr bool partners_get_own_share = true;
  static constexpr bool votes_for_partners = !WrapLastBin;
  static constexpr bool drops_nowhere = true;
  static constexpr int weight_bits = 3;  // half units
  template <int Axes>
  static constexpr int votes = Axes + 1;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Side side(const extend::Axis& axis, extend::simd::I32 position,
                                                          const extend::VoteUnit& unit) noexcept {
    return side_in_cell(axis, position, extend::cell_of(axis, position), unit);
  }

  template <int Axes, class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_cell(const Sides (&sides)[4],
                                                                         const extend::VoteUnit& unit) noexcept {
    return extend::simd::all_int(2 * Axes * unit.one) - extend::twice_all_partners<Axes>(sides);
  }
  template <class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_partner(int axis, const Sides (&sides)[4],
                                                                            extend::simd::I32,
                                                                            const extend::VoteUnit&) noexcept {
    return sides[axis].twice_partner;
  }

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    const extend::simd::I32 cell = extend::cell_of(axis, position);
    extend::Share share = extend::share(axis, cell, side_in_cell(axis, position, cell, unit));
    if (axis.below_zero == extend::BelowZero::nowhere) share.step = drop(is_negative(position), share.step);
    return share;
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<Axes + 1> combine(const extend::Axis (&axes)[4],
                                                                        const extend::Share (&shares)[4],
                                                                        const extend::VoteUnit& unit) noexcept {
    extend::Votes<Axes + 1> votes = extend::votes_for_cell_and_partners<SeparateVoting, Axes>(axes, shares, unit);
    if constexpr (WrapLastBin && Axes == 4) {
      const std::int32_t last = axes[3].cells - 1;
      const extend::simd::Mask wraps = shares[3].cell + shares[3].step == extend::simd::all_int(last);
      votes.index[4] = votes.index[4] - keep(wraps, extend::simd::all_int(last));
    }
    return votes;
  }

 private:
  [[nodiscard]] SHORTSHOT_INLINE static extend::Side side_in_cell(const extend::Axis& axis, extend::simd::I32 position,
                                                                  extend::simd::I32 cell,
                                                                  const extend::VoteUnit& unit) noexcept {
    extend::Side side = extend::side(axis, extend::fraction_of(axis, position, cell), unit, true);
    if (axis.below_zero == extend::BelowZero::nowhere) {  // nothing for the cell, and a partner that gets nothing
      const extend::simd::Mask nowhere = is_negative(position);
      side.twice_partner = drop(nowhere, side.twice_partner) + keep(nowhere, extend::simd::all_int(2 * unit.one));
    }
    return side;
  }
};

/// SHOT as its paper has it: the default of Shot and Cshot.
using ShotVoting = SeparateVoting<false>;
using PclVoting = SeparateVoting<true>;  ///< equal to PCL to the last quirk: for what is compared with PCL's output

/// The paper's equation (2): a point counts once, in the cell it falls into.
struct HardVoting {
  static constexpr const char* name = "hard voting";
  static constexpr bool partners_get_own_share = false;
  static constexpr int weight_bits = 2;
  template <int Axes>
  static constexpr int votes = 1;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit&) noexcept {
    using extend::simd::all_int;
    return {extend::times(extend::cell_of(axis, position), axis.stride), all_int(0), all_int(0)};
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<1> combine(const extend::Axis (&)[4],
                                                                 const extend::Share (&shares)[4],
                                                                 const extend::VoteUnit& unit) noexcept {
    return {{extend::primary_index<Axes>(shares)}, {extend::simd::all_int(unit.one)}};
  }
};

/// Multilinear interpolation (quadrilinear with a histogram): shares multiply, over all 2^N cells around the point. A
/// partition of unity (every point counts exactly once in all: what has no partner stays in the cell) and continuous at
/// every border between cells.
struct MultilinearVoting {
  static constexpr const char* name = "multilinear voting";
  static constexpr bool partners_get_own_share = false;
  static constexpr int weight_bits = 2;
  template <int Axes>
  static constexpr int votes = 1 << Axes;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    extend::Share share = extend::share_in_cell(axis, position, unit, false);
    share.twice_partner = drop(share.step == extend::simd::all_int(0), share.twice_partner);
    return share;
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<(1 << Axes)> combine(const extend::Axis (&)[4],
                                                                           const extend::Share (&shares)[4],
                                                                           const extend::VoteUnit& unit) noexcept {
    const extend::simd::F32 half = extend::simd::all(0.5f / static_cast<float>(unit.one));
    extend::Votes<(1 << Axes)> votes;
    extend::simd::F32 weight[1 << Axes];
    votes.index[0] = extend::primary_index<Axes>(shares);
    weight[0] = extend::simd::all(static_cast<float>(unit.one));
    detail::unroll<Axes>([&](auto axis) {
      constexpr int count = 1 << decltype(axis)::value;
      const extend::simd::F32 partner = to_float(shares[axis].twice_partner) * half;
      detail::unroll<count>([&](auto i) {
        votes.index[count + i] = votes.index[i] + shares[axis].step;
        weight[count + i] = weight[i] * partner;
        weight[i] = weight[i] - weight[count + i];
      });
    });
    detail::each<(1 << Axes)>([&](auto i) { votes.weight[i] = round_to_int(weight[i]); });
    return votes;
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_VOTING_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Can a signal be measured, given one source of each kind?
template <class Signal, class At, class Kinds, class = void>
struct IsMeasurable : std::false_type {};
template <class Signal, class At, class... Kinds>
struct IsMeasurable<Signal, At, extend::SourceKinds<Kinds...>,
                    std::void_t<decltype(Signal::measure(std::declval<const At&>(), std::declval<const Kinds&>()...))>>
    : std::is_same<decltype(Signal::measure(std::declval<const At&>(), std::declval<const Kinds&>()...)),
                   extend::simd::F32> {};

template <class Signal, class = void>
struct IsSignal : std::false_type {};
template <class Signal>
struct IsSignal<Signal,
                std::void_t<decltype(Signal::has_histogram), decltype(Signal::bins), decltype(Signal::reads_index_only),
                            typename Signal::Measured, typename Signal::Rule, typename Signal::Sources>>
    : std::bool_constant<
          !Signal::has_histogram ||
          IsMeasurable<Signal,
                       std::conditional_t<Signal::reads_index_only, extend::IndicesAt, extend::NeighborsAt<Frame>>,
                       typename Signal::Sources>::value> {};

template <class Voting, class = void>
struct IsVotingRule : std::false_type {};
template <class Voting>
struct IsVotingRule<Voting, std::void_t<decltype(Voting::weight_bits),
                                        decltype(Voting::template combine<4>(std::declval<const extend::Axis (&)[4]>(),
                                                                             std::declval<const extend::Share (&)[4]>(),
                                                                             std::declval<const extend::VoteUnit&>()))>>
    : std::bool_constant<
          std::is_same<decltype(Voting::split(std::declval<const extend::Axis&>(), std::declval<extend::simd::I32>(),
                                              std::declval<const extend::VoteUnit&>())),
                       extend::Share>::value &&
          std::is_same<decltype(Voting::template combine<4>(std::declval<const extend::Axis (&)[4]>(),
                                                            std::declval<const extend::Share (&)[4]>(),
                                                            std::declval<const extend::VoteUnit&>())),
                       extend::Votes<Voting::template votes<4>>>::value> {};

/// Does an axis' partner get that axis' share alone, so that parts on one grid have such votes in common? A rule that
/// does not say so has nothing in common.
template <class Voting, class = void>
struct PartnersGetOwnShare : std::false_type {};
template <class Voting>
struct PartnersGetOwnShare<Voting, std::void_t<decltype(Voting::partners_get_own_share)>>
    : std::bool_constant<Voting::partners_get_own_share> {};

/// Does a rule vote for a cell and its partners, and say so?
template <class Voting, class = void>
struct VotesForPartners : std::false_type {};
template <class Voting>
struct VotesForPartners<Voting, std::void_t<decltype(Voting::votes_for_partners)>>
    : std::bool_constant<Voting::votes_for_partners> {};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_CONCEPTS_HPP

// shortshot/descriptor/exact_shells.hpp: distances that fall on the right side of a shell's border.
#ifndef SHORTSHOT_DESCRIPTOR_EXACT_SHELLS_HPP
#define SHORTSHOT_DESCRIPTOR_EXACT_SHELLS_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// Where votes jump from shell to shell: on the borders and in the middles of shells, multiples of R / `Multiples`
/// both. For each grid, that is every so many `Steps` of these multiples, borders and middles by turns. Without grids:
/// a float's own rounding is as good as any.
template <int Multiples, int... Steps>
struct ShellBorders {
  static constexpr float per_radius = static_cast<float>(Multiples);      ///< multiples
  static constexpr int grids = static_cast<int>(sizeof...(Steps));        ///< number of them
  static constexpr float steps[] = {static_cast<float>(Steps)..., 0.0f};  ///< of each grid, in multiples; 0: the end
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The smallest common multiple, up to 2^20: as far as floats tell multiples of its inverse apart.
template <class... Numbers>
constexpr int common_multiple(Numbers... numbers) noexcept {
  constexpr int most = 1 << 20;
  int all = 1;
  for (const int number : {numbers...}) {
    int multiple = all;
    while (multiple % number != 0 && multiple < most - all) multiple += all;
    all = multiple % number == 0 ? multiple : most;
  }
  return all;
}

/// How many of `all` multiples of 1 / all lie between two of the `own` of a grid. One shell (2) alone has no border
/// where votes jump: beyond all.
constexpr int step_between(int all, int own) noexcept { return own > 2 ? all / own : 2 * all; }

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// How much longer a vector is than `multiple` >= 1 times R / per_radius, in these units.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 units_beyond(const PointLanes& vector, simd::F32 multiple, Radius radius,
                                                      float per_radius) noexcept {
  using simd::all;
  const float splitter = unfused(12288.0f * radius.value);
  const simd::F32 r = all(radius.value);
  const simd::F32 coarse_r = math::coarse(r, splitter);
  const simd::F32 units = all(per_radius);
  const simd::F32 unit = r / units;
  // multiple * R / per_radius in two parts
  const simd::F32 large = math::coarse(multiple * unit, splitter);
  const simd::F32 rest = ((multiple * coarse_r - units * large) + multiple * (r - coarse_r)) / units;
  return math::length_beyond(vector.x, vector.y, vector.z, large, rest, splitter) / unit;
}

/// How far a place beyond a multiple of R / per_radius is from it as the published code sees it, which rounds a
/// distance in shells to float once: 0 if that makes it the multiple itself. A border is told from what lies below it,
/// a middle from what lies above it.
template <class Borders>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 rounded_beyond(simd::F32 multiple, simd::F32 beyond) noexcept {
  using simd::all;
  if constexpr (Borders::grids == 1) return (multiple + beyond) - multiple;  // it may as well know the other side
  simd::F32 rounded = all(0.0f);
  for (const float* each = Borders::steps; *each > 0.0f; ++each) {
    const simd::F32 step = all(*each);
    const simd::F32 halves = multiple / step;  // of shells
    const simd::F32 off = (halves + beyond / step) - halves;
    // Even numbers of halves are borders, odd ones middles: whole if the votes of this grid jump on that side.
    const simd::F32 jumps = all(0.5f) * select(off > all(0.0f), halves + all(1.0f), halves);
    rounded = select(jumps != simd::to_whole(jumps), rounded, rounded + off * step);
  }
  return rounded;
}

/// Distances over the radius. Points of a regular grid lie exactly on the borders and in the middles of shells, where
/// one bit decides which neighboring shell gets a vote: there, and only there, they fall on the side on which the
/// published code has them.
template <class Borders>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 distance_over_radius(simd::F32 d2, const PointLanes& local,
                                                              Radius radius) noexcept {
  const simd::F32 distance = simd::sqrt(d2) * simd::all(1.0f / radius.value);
  if constexpr (Borders::grids == 0) return distance;
  const simd::F32 position = distance * simd::all(Borders::per_radius);
  const simd::F32 nearest = simd::to_whole(position);
  const simd::F32 rounding = simd::all(1e-6f * Borders::per_radius);
  const simd::Mask near = rounding > simd::abs(position - nearest);
  if (any(near)) {
    const simd::F32 multiple = simd::max(nearest, simd::all(1.0f));  // nothing jumps at 0
    const simd::F32 beyond = units_beyond(local, multiple, radius, Borders::per_radius);
    const simd::F32 side = rounded_beyond<Borders>(multiple, beyond);
    // Twice as far from the border as it is, which no rounding on the way from here to a cell undoes.
    const simd::F32 exact = ((multiple + side) + side) / simd::all(Borders::per_radius);
    // A frame that is not quite orthonormal must not move its neighbors from border to border.
    const simd::Mask same = rounding > simd::abs(beyond);
    return select(near & same, exact, distance);
  }
  return distance;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_EXACT_SHELLS_HPP

// shortshot/descriptor/finish_rules.hpp: how the sums of a part's cells become its values, and what the part weighs
// beside the others. The whole descriptor has length 1 afterwards.
#ifndef SHORTSHOT_DESCRIPTOR_FINISH_RULES_HPP
#define SHORTSHOT_DESCRIPTOR_FINISH_RULES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

[[nodiscard]] inline float root(float value) noexcept { return extend::simd::sqrt(value); }
[[nodiscard]] inline float positive(float value) noexcept { return value > 0.0f ? value : 0.0f; }
[[nodiscard]] inline float magnitude(float value) noexcept { return value < 0.0f ? -value : value; }

/// `values` holds sums of votes, which some rules make negative here and there: these count as 0.
inline void roots_of_shares(float* values, int size, float length) noexcept {
  float sum = 0.0f;
  for (int i = 0; i < size; ++i) sum += positive(values[i]);
  if (!(sum > 0.0f)) return;
  const float weight = length / root(sum);
  for (int i = 0; i < size; ++i) values[i] = weight * root(positive(values[i]));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Sums as they are: parts weigh what votes they have. The published family's.
struct PlainSums {
  static constexpr const char* name = "";  ///< for layout_of()
};

/// Square roots of the shares of a part's votes: its length is the weight, `PerMille` / 1000, whatever it counts. Roots
/// keep a few crowded cells from deciding every distance (for histograms the L2 distance is then Hellinger's).
template <int PerMille = 1000>
struct RootOfShares {
  static_assert(PerMille >= 1 && PerMille <= 100000, "RootOfShares<PerMille> supports weights from 1 / 1000 to 100");
  static constexpr const char* name = "root of shares";
  static constexpr int per_mille = PerMille;  ///< the part's weight, times 1000

  /// Finishes the `size` values of a part, in place.
  static void apply(float* values, int size) noexcept {
    detail::roots_of_shares(values, size, static_cast<float>(PerMille) / 1000.0f);
  }
};

/// Square roots of signed values, their signs kept, over the root of (floor + sum of magnitudes): where there is little
/// to see, the part shrinks. A root is infinitely steep at 0, where it makes much of noise; so it is taken of more than
/// the value and begins at 0 all the same: sqrt(|v| + noise) - sqrt(noise). The part is never longer than its weight,
/// `PerMille` / 1000; the floor is `FloorPercent` / 100, the noise `NoisePerMille` / 1000.
template <int PerMille, int FloorPercent, int NoisePerMille = 0>
struct SignedRoots {
  static_assert(PerMille >= 1 && PerMille <= 100000,
                "SignedRoots<PerMille, Floor, Noise> supports weights from 1 / 1000 to 100");
  static_assert(FloorPercent >= 1, "SignedRoots<PerMille, Floor, Noise> supports floors of 1 percent or more");
  static_assert(NoisePerMille >= 0 && NoisePerMille <= 1000,
                "SignedRoots<PerMille, Floor, Noise> supports noise from 0 to 1");
  static constexpr const char* name = "signed roots";
  static constexpr int per_mille = PerMille;
  static constexpr int floor_percent = FloorPercent;     ///< times 100
  static constexpr int noise_per_mille = NoisePerMille;  ///< times 1000

  static void apply(float* values, int size) noexcept {
    constexpr float noise = static_cast<float>(NoisePerMille) / 1000.0f;
    float sum = static_cast<float>(FloorPercent) / 100.0f;
    for (int i = 0; i < size; ++i) sum += detail::magnitude(values[i]);
    const float weight = static_cast<float>(PerMille) / 1000.0f / detail::root(sum);
    const float start = detail::root(noise);
    for (int i = 0; i < size; ++i) {
      const float long_one = weight * (detail::root(detail::magnitude(values[i]) + noise) - start);
      values[i] = values[i] < 0.0f ? -long_one : long_one;
    }
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_FINISH_RULES_HPP

// shortshot/descriptor/spherical_grid.hpp: the spherical grid of a part, and how wide its shells are.
#ifndef SHORTSHOT_DESCRIPTOR_SPHERICAL_GRID_HPP
#define SHORTSHOT_DESCRIPTOR_SPHERICAL_GRID_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Divisions of the support sphere: `Radial` shells, `Elevation` cells between the frame's +z and -z, `Azimuth` cells
/// counter-clockwise from the frame's -x. The paper's r, e, a (equation 5): n = r * e * a cells. How they are numbered
/// and laid out is the convention's business (conventions.hpp).
template <int Radial, int Elevation, int Azimuth>
struct SphericalGrid {
  static_assert(Radial >= 1 && Elevation >= 1 && Azimuth >= 1,
                "SphericalGrid<Radial, Elevation, Azimuth> supports one or more divisions of each kind");
  static_assert(Radial <= 1024 && Elevation <= 1024 && Azimuth <= 1024 && 1LL * Radial * Elevation * Azimuth <= 65536,
                "SphericalGrid<Radial, Elevation, Azimuth> supports up to 1024 divisions of each kind, 65536 cells");
  static constexpr int radial = Radial;                       ///< shells
  static constexpr int elevation = Elevation;                 ///< cells from +z to -z
  static constexpr int azimuth = Azimuth;                     ///< sectors around z
  static constexpr int cells = Radial * Elevation * Azimuth;  ///< all of them
};

/// Shells of equal width: the published default.
struct LinearRadius {
  static constexpr const char* name = "equal shells";  ///< for layout_of()
  static constexpr bool is_linear = true;              ///< are shells of equal width?
  /// What a distance below the first border is.
  static constexpr extend::BelowZero below_zero = extend::BelowZero::never;
  /// All borders and middles of shells are multiples of 1 / borders.
  static constexpr int borders(int shells) noexcept { return 2 * shells; }
};

/// The published logarithmic shells: the innermost one reaches out to R * Numerator / Denominator, the others share
/// the rest evenly in log r. (The published default, 0.025 m, is 1/4 of a support radius of 0.1 m.)
template <int Numerator = 1, int Denominator = 4>
struct LogRadius {
  static_assert(0 < Numerator && 100LL * Numerator <= 99LL * Denominator,
                "LogRadius<N, D> supports ratios 0 < N / D <= 0.99");
  static constexpr const char* name = "logarithmic shells";
  static constexpr bool is_linear = false;
  static constexpr extend::BelowZero below_zero = extend::BelowZero::first_cell;
  static constexpr int borders(int) noexcept { return 1; }  // in float's own rounding
  /// Where `u`, the distance over the support radius, 0..1, lies along the axis.
  [[nodiscard]] static extend::simd::F32 position(const extend::Axis& shells, extend::simd::F32 u) noexcept {
    const float shell = shells.one();
    const float log_of_ratio = extend::math::log(static_cast<float>(Numerator) / static_cast<float>(Denominator));
    return extend::simd::map(
        [=](float distance) {
          // Distances below the smallest normal number have no logarithm; any tiny one lies in the innermost shell.
          const float log_of_distance = extend::math::log(distance > 1e-30f ? distance : 1e-30f);
          const float p =
              static_cast<float>(shells.cells - 1) * (log_of_distance - log_of_ratio) / -log_of_ratio + 1.0f;
          // Below zero, what counts is the rest of a shell: the cell is the innermost one anyway.
          return extend::unfused((p < 0.0f ? p - static_cast<float>(static_cast<int>(p)) : p) * shell);
        },
        u);
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_SPHERICAL_GRID_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The largest e such that positions up to any of these numbers of cells, times 2^e, are at most 2^30.
template <class... Cells>
[[gnu::always_inline]] constexpr int position_bits(Cells... cells) noexcept {
  int bits = 30;
  for (int covered = 1; ((covered < cells) || ...); covered *= 2) --bits;
  return bits;
}

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A spherical grid with a histogram of one signal in every cell.
/// Layout: histogram bin fastest, then radius, elevation, azimuth (PublishedCells) or elevation, radius, azimuth
/// (ShotCells).
template <class GridType, class SignalType, class RadiusScale = LinearRadius, class CellConvention = PublishedCells,
          class FinishRule = PlainSums>
struct Part {
  static_assert(
      detail::IsSignal<SignalType>::value,
      "Part<Grid, Signal> supports Occupancy, or a signal derived from extend::Signal<Bins, Kinds...> with "
      "`static extend::simd::F32 measure(at, sources...)`, one source of each kind. See 'How to add a signal' "
      "in include/shortshot/README.md");
  /// How the sphere is divided, what histograms are of, how wide shells are, the convention of cells, how sums become
  /// values; what is measured, and the sources that are read, each once.
  using Grid = GridType;
  using Signal = std::conditional_t<detail::IsSignal<SignalType>::value, SignalType, Occupancy>;  // one error is enough
  using Scale = RadiusScale;
  using Cells = CellConvention;
  using Finish = FinishRule;
  using Signals = typename detail::Distinct<detail::SignalList<>, Signal>::type;
  using Sources = typename Signal::Sources;
  static constexpr bool has_histogram = Signal::has_histogram;                    ///< else a plain sum
  static constexpr int values = has_histogram ? Cells::values(Signal::bins) : 1;  ///< of one cell
  static constexpr int size = Grid::cells * values;                               ///< of all cells
  static constexpr int weight_cells = 0;    ///< sums of votes that are kept besides
  static constexpr bool has_signs = false;  ///< values may be below 0

  /// Position of one value within the part.
  [[nodiscard, gnu::always_inline]] static constexpr int index(int r, int e, int a, int bin = 0) noexcept {
    constexpr extend::CellStrides cells = Cells::template strides<Grid>;
    return bin + values * (r * cells.radial + e * cells.elevation + a * cells.azimuth);
  }

  /// Bits of positions behind the point: what int32 has room for on the finest axis. No bit of a float is lost that
  /// could matter.
  static constexpr int grid_bits = detail::position_bits(Grid::radial, Grid::elevation, Grid::azimuth);
  static constexpr int bits = detail::position_bits(1 << (30 - grid_bits), values);

  /// The axes if every cell of the grid had `Values` values: radius, elevation, azimuth, and the histogram's where
  /// there is one.
  static constexpr int axis_count = has_histogram ? 4 : 3;
  template <int Values>
  static constexpr extend::Axis axes[4] = {
      {Grid::radial, Values* Cells::template strides<Grid>.radial, extend::Beyond::nothing, Scale::below_zero,
       grid_bits, Cells::reaches_end},
      {Grid::elevation, Values* Cells::template strides<Grid>.elevation, extend::Beyond::nothing,
       extend::BelowZero::never, grid_bits, Cells::reaches_end},
      {Grid::azimuth, Values* Cells::template strides<Grid>.azimuth, extend::Beyond::first_cell,
       Cells::azimuth_below_zero, grid_bits, Cells::reaches_end},
      {values, 1, extend::Beyond::nothing, extend::BelowZero::never, bits, Cells::reaches_end}};
};

/// A spherical grid with the means of some signed signals in every cell, drawn towards 0 where few points are: the sum
/// of votes times values, over the sum of votes and `ShrinkPercent` / 100 of what a cell has on average. Layout: signal
/// fastest, then radius, elevation, azimuth (as the convention lays out cells).
template <class GridType, class CellConvention, class FinishRule, int ShrinkPercent, class... SignedSignals>
struct CellMeans {
  static_assert(sizeof...(SignedSignals) >= 1 && ((SignedSignals::is_signed) && ...),
                "CellMeans<Grid, Cells, Finish, Shrink, Signals...> supports one or more signals with is_signed");
  static_assert(ShrinkPercent >= 1, "CellMeans supports shrinkage of 1 percent or more: a cell may be empty");
  /// As those of a Part.
  using Grid = GridType;
  using Scale = LinearRadius;
  using Cells = CellConvention;
  using Finish = FinishRule;
  using Counts = Part<Grid, Occupancy, Scale, Cells>;     ///< the votes themselves
  using Averaged = detail::SignalList<SignedSignals...>;  ///< in the order of the layout
  using Signals = typename detail::Distinct<detail::SignalList<>, SignedSignals...>::type;
  using Sources = typename detail::DistinctKinds<extend::SourceKinds<>, typename SignedSignals::Sources...>::type;
  static constexpr int values = static_cast<int>(sizeof...(SignedSignals));  ///< of one cell
  static constexpr int size = Grid::cells * values;                          ///< of all cells
  static constexpr int weight_cells = Grid::cells;                           ///< sums of votes that are kept besides
  static constexpr int shrink_percent = ShrinkPercent;                       ///< see above
  static constexpr bool has_signs = (SignedSignals::has_signs || ...);       ///< values may be below 0
  static constexpr int bits = Counts::bits;                                  ///< of positions behind the point

  /// Position of the mean of signal `k` of one cell within the part.
  [[nodiscard, gnu::always_inline]] static constexpr int index(int r, int e, int a, int k = 0) noexcept {
    return k + values * Counts::index(r, e, a);
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The rule by which all of a descriptor's color parts convert colors; void if it has none.
template <class SignalList>
struct LabRuleOf {
  using type = void;
};
template <class Signal, class... Others>
struct LabRuleOf<SignalList<Signal, Others...>> {
  using Mine = typename Signal::Rule;
  using Next = typename LabRuleOf<SignalList<Others...>>::type;
  static_assert(std::is_void<Mine>::value || std::is_void<Next>::value || std::is_same<Mine, Next>::value,
                "Descriptor supports one color conversion for all its parts");
  using type = std::conditional_t<std::is_void<Mine>::value, Next, Mine>;
};

/// Do all of these parts share their points among the same cells?
template <class... Parts>
struct HaveOneGrid : std::false_type {};
template <class First, class... Others>
struct HaveOneGrid<First, Others...>
    : std::bool_constant<((std::is_same<typename First::Grid, typename Others::Grid>::value &&
                           std::is_same<typename First::Scale, typename Others::Scale>::value) &&
                          ...)> {};

/// Do the color signals of a list compare with the mean color? None may if others do not.
template <class... Signals>
constexpr bool compare_with_mean(SignalList<Signals...>) noexcept {
  constexpr bool mean = (std::is_same<typename Signals::Reference, MeanColor>::value || ...);
  constexpr bool own = (std::is_same<typename Signals::Reference, KeyPointColor>::value || ...);
  static_assert(!(mean && own),
                "Descriptor supports one reference for all its color signals: KeyPointColor or MeanColor");
  return mean;
}

/// The first of some types.
template <class First, class...>
struct FirstOf {
  using type = First;
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor: its parts one after the other, filled by one voting rule and normalized together to L2 norm 1.
template <class VotingRule, class... Parts>
struct Descriptor {
  static_assert(
      detail::IsVotingRule<VotingRule>::value,
      "Descriptor<Voting, Parts...> supports a voting rule with weight_bits, votes<Axes>, split(axis, position, "
      "unit) and combine<Axes>(axes, shares, unit). See 'How to add a voting rule' in "
      "include/shortshot/README.md");
  /// How a point is shared among cells.
  using Voting = std::conditional_t<detail::IsVotingRule<VotingRule>::value, VotingRule, HardVoting>;
  static_assert(sizeof...(Parts) >= 1, "Descriptor<Voting, Parts...> supports one or more parts");

  /// Number of floats, and of bytes when stored as floats.
  static constexpr int size = (Parts::size + ...);
  static constexpr std::size_t size_bytes = sizeof(float) * static_cast<std::size_t>(size);
  static_assert(size <= 65536, "Descriptor supports up to 65536 values");

  /// The kinds of sources that its signals read, each once, and whether a channel of the cloud is among them.
  using Sources = typename detail::DistinctKinds<extend::SourceKinds<>, typename Parts::Sources...>::type;
  [[nodiscard, gnu::always_inline]] static constexpr bool needs(Channel channel) noexcept {
    return detail::reads_channel(Sources{}, channel);
  }
  static constexpr bool needs_colors = needs(Channel::colors);
  static constexpr bool needs_normals = needs(Channel::normals);
  static constexpr bool needs_intensities = needs(Channel::intensities);

  /// The signals that are measured, each once.
  using Signals = typename detail::DistinctOf<detail::SignalList<>, typename Parts::Signals...>::type;
  using LabRule = typename detail::LabRuleOf<Signals>::type;  ///< by which colors are converted; void: none
  /// Are colors compared with the neighborhood's mean? Then key points need none.
  static constexpr bool compares_with_mean = detail::compare_with_mean(Signals{});

  using Cells = typename detail::FirstOf<typename Parts::Cells...>::type;  ///< cell convention of all parts
  static_assert((std::is_same<typename Parts::Cells, Cells>::value && ...),
                "Descriptor supports one cell convention for all its parts");

  /// Meant for frames that are turned to the camera: tools that know where it was tell support's viewpoint.
  static constexpr bool wants_viewpoint = Cells::wants_viewpoint;

  /// Do its values depend on the frame? If not, describe_at() and extract() estimate none.
  static constexpr bool needs_frame =
      (Cells::template needs_frame<typename Parts::Grid> || ...) || detail::look_at_places(Signals{});

  /// Fewest bits behind the point of positions along its axes.
  static constexpr int position_bits = [] {
    int bits = 30;
    ((bits = Parts::bits < bits ? Parts::bits : bits), ...);
    return bits;
  }();

  /// Where its votes jump from shell to shell, and a float's own rounding might decide on which side.
  static constexpr int shell_multiples =
      Cells::exact_borders(detail::common_multiple(Parts::Scale::borders(Parts::Grid::radial)...));
  using ShellBorders = std::conditional_t<
      shell_multiples == 1, extend::ShellBorders<1>,
      extend::ShellBorders<shell_multiples,
                           detail::step_between(shell_multiples, Parts::Scale::borders(Parts::Grid::radial))...>>;

  /// Do sums become values as they are?
  static constexpr bool is_plain = (std::is_same<typename Parts::Finish, PlainSums>::value && ...);
  /// Sums of votes that its CellMeans keep besides the values.
  static constexpr int weight_cells = (Parts::weight_cells + ...);

  /// First value of part `i` (of `parts` ones), and the end of the last part.
  static constexpr int parts = static_cast<int>(sizeof...(Parts));
  [[nodiscard, gnu::always_inline]] static constexpr int offset(int i) noexcept {
    constexpr int sizes[] = {Parts::size...};
    int sum = 0;
    for (int k = 0; k < i && k < parts; ++k) sum += sizes[k];
    return sum;
  }
  /// The same of its sums of votes.
  [[nodiscard, gnu::always_inline]] static constexpr int weight_offset(int i) noexcept {
    constexpr int sizes[] = {Parts::weight_cells...};
    int sum = 0;
    for (int k = 0; k < i && k < parts; ++k) sum += sizes[k];
    return sum;
  }
};

/// SSH (equation 4): how many points lie in each cell. Needs points only.
template <class Grid, class Voting = PublishedVoting, class RadiusScale = LinearRadius>
using Ssh = Descriptor<Voting, Part<Grid, Occupancy, RadiusScale>>;

/// SCSH (equations 6 and 7): SSH on one grid, histograms of color distance on another. Needs points and colors.
template <class ShapeGrid, class ColorGrid, int Bins, class Voting = PublishedVoting, class RadiusScale = LinearRadius,
          class LabRule = PublishedLab>
using Scsh = Descriptor<Voting, Part<ShapeGrid, Occupancy, RadiusScale>,
                        Part<ColorGrid, ColorDistance<Bins, LabRule>, RadiusScale>>;

/// How echoes of a lidar or a time-of-flight camera differ from the key point's, beside where points are: SSH on one
/// grid, histograms of Intensity on another, as SCSH has them of color. Needs points and intensities.
template <class ShapeGrid, class IntensityGrid, int Bins, class Voting = PublishedVoting,
          class RadiusScale = LinearRadius>
using IntensityShape =
    Descriptor<Voting, Part<ShapeGrid, Occupancy, RadiusScale>, Part<IntensityGrid, Intensity<Bins>, RadiusScale>>;

/// SHOT: histograms of how normals lean against the frame's z axis. Needs points and normals. `Bins` as PCL counts
/// them: a histogram has one value more.
template <class Grid, int Bins, class Voting = ShotVoting, class RadiusScale = LinearRadius>
using Shot = Descriptor<Voting, Part<Grid, NormalCosine<Bins>, RadiusScale, ShotCells>>;

/// CSHOT: SHOT, and histograms of color distance on the same grid. Needs points, normals and colors.
template <class Grid, int ShapeBins, int ColorBins, class Voting = ShotVoting, class LabRule = CshotLab,
          class RadiusScale = LinearRadius>
using Cshot = Descriptor<Voting, Part<Grid, NormalCosine<ShapeBins>, RadiusScale, ShotCells>,
                         Part<Grid, ColorDistance<ColorBins, LabRule>, RadiusScale, ShotCells>>;

using Ssh32 = Ssh<SphericalGrid<2, 2, 8>>;                                 ///< of points, 32 values
using Ssh96 = Ssh<SphericalGrid<3, 4, 8>>;                                 ///< of points, 96 values
using Scsh336 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 4>, 15>;  ///< with colors, 336 values
using Scsh696 = Scsh<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 6>, 25>;  ///< with colors, 696 values
using IntensityShape336 = IntensityShape<SphericalGrid<3, 4, 8>, SphericalGrid<2, 2, 4>, 15>;  ///< with intensities

/// SHOT and CSHOT in PCL's sizes and layout, without its two defects: the last bin of a histogram gets its neighbor's
/// votes (PclVoting says what PCL does), and white has a color of its own (PclLab).
using Shot352 = Shot<SphericalGrid<2, 2, 8>, 10>;
using Cshot1344 = Cshot<SphericalGrid<2, 2, 8>, 10, 30>;

/// The same as PCL 1.13 computes them, defects included: for what is compared with descriptors that PCL has made.
using PclShot352 = Shot<SphericalGrid<2, 2, 8>, 10, PclVoting>;
using PclCshot1344 = Cshot<SphericalGrid<2, 2, 8>, 10, 30, PclVoting, PclLab>;

static_assert(Ssh32::size == 32 && Ssh96::size == 96 && Scsh336::size == 336 && Scsh696::size == 696 &&
                  Shot352::size == 352 && Cshot1344::size == 1344,
              "the published sizes");

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_DESCRIPTOR_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Where points are: the roots of the shares that cells have of all points. Length 1. R E A values:
///
///     value[r + R (e + E a)] = sqrt(sum w / W)
template <class Grid>
using HeightPart = Part<Grid, Occupancy, LinearRadius, HeightCells, RootOfShares<1000>>;

/// Where colors are: how each cell's mean color differs from the neighborhood's. Length 0.7 at most, less where there
/// is little contrast, and a hundredth of q's range is taken for noise. 3 R E A values, k = 0, 1, 2 for q = dL / 100,
/// da / 60, db / 60:
///
///     m[c][k] = (sum w q[k]) / (sum w + 0.3 W / (R E A))      c = r + R (e + E a)
///     value[k + 3 c] = 0.7 sign(m) (sqrt(|m| + 0.01) - 0.1) / sqrt(FloorPercent / 100 + sum of all |m|)
template <class Grid, int FloorPercent>
using ColorMeansPart = CellMeans<Grid, HeightCells, SignedRoots<700, FloorPercent, 10>, 30, ColorOffset<LabAxis::L>,
                                 ColorOffset<LabAxis::a>, ColorOffset<LabAxis::b>>;

/// The same for rooms, where near things hide far ones: what is above the mean and what is below, apart. 6 R E A
/// values, value[k + 6 c], k = 0 to 5 for q = max(0, dL) / 100, max(0, -dL) / 100, max(0, da) / 60 and so on.
template <class Grid, int FloorPercent>
using ColorExcessPart = CellMeans<Grid, HeightCells, SignedRoots<700, FloorPercent, 10>, 30, ColorExcess<LabAxis::L, 1>,
                                  ColorExcess<LabAxis::L, -1>, ColorExcess<LabAxis::a, 1>, ColorExcess<LabAxis::a, -1>,
                                  ColorExcess<LabAxis::b, 1>, ColorExcess<LabAxis::b, -1>>;

/// Which colors there are, in rings around the key point and whatever the azimuth: the roots of a histogram along one
/// axis of CIELAB. All three together have the length 1.5. Rings * Bins values; the place along the bins is
/// 1/2 + dL / 80, 1/2 + da / 60 or 1/2 + db / 60, cut off to 0..1:
///
///     value[bin + Bins ring] = 0.866 sqrt(sum w / W)
template <int Rings, LabAxis Axis, int Bins>
using ColorRingsPart =
    Part<SphericalGrid<Rings, 1, 1>, ColorOffset<Axis, Bins>, LinearRadius, HeightCells, RootOfShares<866>>;

/// Shape and color in 95 bytes (190 values), the one to begin with: 2 x 4 x 8 cells of points | 3 x 8 mean colors |
/// histograms of L, a and b in 3 rings of 6 bins. In this and all others the whole is divided by its length.
///
///     0..63     r + 2 (e + 4 a)            points
///     64..135   64 + k + 3 (r + 3 a)       mean colors
///     136..153  136 + bin + 6 ring         L; 154..171 a; 172..189 b
using ShapeColor95 =
    Descriptor<MultilinearVoting, HeightPart<SphericalGrid<2, 4, 8>>, ColorMeansPart<SphericalGrid<3, 1, 8>, 100>,
               ColorRingsPart<3, LabAxis::L, 6>, ColorRingsPart<3, LabAxis::a, 6>, ColorRingsPart<3, LabAxis::b, 6>>;

/// The same in 32 bytes (64 values): 2 x 4 mean colors | histograms in 2 rings of 4 bins | 1 x 4 x 4 cells of points.
///
///     0..23     k + 3 (r + 2 a)            mean colors
///     24..31    24 + bin + 4 ring          L; 32..39 a; 40..47 b
///     48..63    48 + e + 4 a               points
using ShapeColor32 =
    Descriptor<MultilinearVoting, ColorMeansPart<SphericalGrid<2, 1, 4>, 49>, ColorRingsPart<2, LabAxis::L, 4>,
               ColorRingsPart<2, LabAxis::a, 4>, ColorRingsPart<2, LabAxis::b, 4>, HeightPart<SphericalGrid<1, 4, 4>>>;

/// For rooms, 95 bytes (190 values, none of them negative): 2 x 4 x 8 cells of points | 2 x 8 mean excesses |
/// histograms in 2 rings of 5 bins.
///
///     0..63     r + 2 (e + 4 a)            points
///     64..159   64 + k + 6 (r + 2 a)       mean excesses
///     160..169  160 + bin + 5 ring         L; 170..179 a; 180..189 b
using RoomColor95 =
    Descriptor<MultilinearVoting, HeightPart<SphericalGrid<2, 4, 8>>, ColorExcessPart<SphericalGrid<2, 1, 8>, 100>,
               ColorRingsPart<2, LabAxis::L, 5>, ColorRingsPart<2, LabAxis::a, 5>, ColorRingsPart<2, LabAxis::b, 5>>;

/// For cameras without color, 96 bytes (192 values): 3 x 8 x 8 cells of points, r + 3 (e + 8 a).
using HeightShape96 = Descriptor<MultilinearVoting, HeightPart<SphericalGrid<3, 8, 8>>>;

/// Colors alone in 27 bytes (54 values): histograms in 3 rings of 6 bins, of L from bin + 6 ring on, of a from 18, of b
/// from 36. It needs no frame (needs_frame), and no turn changes it; a change of light does.
using ColorRings27 = Descriptor<MultilinearVoting, ColorRingsPart<3, LabAxis::L, 6>, ColorRingsPart<3, LabAxis::a, 6>,
                                ColorRingsPart<3, LabAxis::b, 6>>;

static_assert(ShapeColor95::size == 190 && ShapeColor32::size == 64 && RoomColor95::size == 190 &&
                  HeightShape96::size == 192 && ColorRings27::size == 54,
              "two values a byte");

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_COMPACT_HPP

// shortshot/frame/normals_together.hpp: the normals of a group of points among the same candidates.
#ifndef SHORTSHOT_FRAME_NORMALS_TOGETHER_HPP
#define SHORTSHOT_FRAME_NORMALS_TOGETHER_HPP

// shortshot/frame/candidate_chunk.hpp: points that may be neighbors of a group of points, and what they add to moments.
#ifndef SHORTSHOT_FRAME_CANDIDATE_CHUNK_HPP
#define SHORTSHOT_FRAME_CANDIDATE_CHUNK_HPP

// shortshot/frame/normal.hpp: the surface normal of a gathered neighborhood.
#ifndef SHORTSHOT_FRAME_NORMAL_HPP
#define SHORTSHOT_FRAME_NORMAL_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Fewest neighbors (the key point and its copies included) for a normal, as in PCL.
inline constexpr std::uint32_t min_normal_neighbors = 3;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// How members are brought to fixed point: coordinates times `unit`, which makes the farthest one at most 1 long; then
/// they, and products of two of them, times `scale`.
struct MomentScale {
  float unit;
  float scale;
};

/// The finest for `n` points that are no farther than `farthest`.
[[nodiscard]] inline MomentScale moment_scale(std::uint32_t n, float farthest) noexcept {
  return {1.0f / farthest, fixed_point_scale(n)};
}

/// How far the members reach; 1e-19 m at least: below that, squares are lost to underflow.
template <class Neighbors>
[[nodiscard]] inline float farthest_member(const Neighbors& n, Radius radius) noexcept {
  simd::F32 farthest = simd::all(0.0f);
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const simd::F32 d2 = load_neighbors(n, i).d2;
    farthest = simd::max(farthest, keep(d2 < simd::all(radius.squared), d2));
  }
  const float root = simd::sqrt(simd::largest(farthest));
  return root > 1e-19f ? root : 1e-19f;
}

/// What points add to moments: x, y, z; xx, xy, xz, yy, yz, zz. Integers, see fixed_point.hpp.
struct Terms {
  static constexpr int kinds = 9;
  simd::I32 of[kinds];
};

[[nodiscard, gnu::always_inline]] inline Terms terms_of(const NeighborLanes& v, const MomentScale& by) noexcept {
  using simd::all;
  using simd::F32;
  const F32 x = v.dx * all(by.unit);
  const F32 y = v.dy * all(by.unit);
  const F32 z = v.dz * all(by.unit);
  const F32 wx = x * all(by.scale);
  const F32 wy = y * all(by.scale);
  const F32 wz = z * all(by.scale);
  return {{round_to_int(wx), round_to_int(wy), round_to_int(wz), round_to_int(wx * x), round_to_int(wx * y),
           round_to_int(wx * z), round_to_int(wy * y), round_to_int(wy * z), round_to_int(wz * z)}};
}

/// Sums over the members of a neighborhood: all that its plane depends on. Lanes hold either shares of one
/// neighborhood, or neighborhoods. The origin is arbitrary.
struct Moments {
  simd::I32 members;
  simd::I32 of[Terms::kinds];
};

/// Adds a register of points, where they are members.
template <class TermOf>
[[gnu::always_inline]] inline void add_where(simd::Mask members, Moments& to, TermOf term_of) noexcept {
  to.members = increment(members, to.members);
  unroll<Terms::kinds>([&](auto k) { to.of[k] = to.of[k] + keep(members, term_of(k)); });
}

/// The sums over one neighborhood, in every lane.
template <class Neighbors>
[[nodiscard]] inline Moments moments_of(const Neighbors& n, Radius radius, const MomentScale& by) noexcept {
  Moments shares{};
  std::uint32_t i = 0;
  for (; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    const Terms terms = terms_of(v, by);
    add_where(v.d2 < simd::all(radius.squared), shares, [&](auto k) { return terms.of[k]; });
  }
  const auto left_over = static_cast<std::int32_t>(i - n.size);  // what fills up the last register
  Moments moments;
  moments.members = simd::all_int(sum(shares.members) - left_over);
  unroll<Terms::kinds>([&](auto k) { moments.of[k] = simd::all_int(sum(shares.of[k])); });
  return moments;
}

/// Are there enough members, and do they reach far enough in the unit for their rounding to integers to mean nothing?
[[nodiscard]] inline simd::Mask is_fine(const Moments& m, const MomentScale& by) noexcept {
  const simd::Mask enough = m.members > simd::all_int(static_cast<std::int32_t>(min_normal_neighbors) - 1);
  return enough & (to_float(m.of[3] + m.of[6] + m.of[8]) > to_float(m.members) * simd::all(0.0625f * by.scale));
}

[[nodiscard]] inline PointLanes keep(simd::Mask m, const PointLanes& v) noexcept {
  return {keep(m, v.x), keep(m, v.y), keep(m, v.z)};
}

/// Unit vectors along which the members scatter least about their centroid, turned `towards` something; zeros where
/// they lie on a line, or in one place.
[[nodiscard]] inline PointLanes normals_of(const Moments& m, const MomentScale& by,
                                           const PointLanes& towards) noexcept {
  using simd::all;
  using simd::F32;
  const auto moment = [&m](int kind) { return to_float(m.of[kind]); };
  const F32 members = to_float(m.members);
  const F32 x = moment(0);
  const F32 y = moment(1);
  const F32 z = moment(2);
  const F32 weight = all(1.0f) / (members * all(by.scale));
  const F32 mean_x = x * weight;
  const F32 mean_y = y * weight;
  const F32 mean_z = z * weight;
  const EigenLanes eigen = decompose({{moment(3) - x * mean_x, moment(4) - x * mean_y, moment(5) - x * mean_z,
                                       moment(6) - y * mean_y, moment(7) - y * mean_z, moment(8) - z * mean_z}});
  // What float can tell apart, and what the rounding of the members to integers may have moved.
  const F32 resolution = all(1e-6f) * eigen.value(2) + all(4.0f) * members;
  const simd::Mask flat = eigen.value(1) - eigen.value(0) > resolution;
  const F32(&axis)[4] = eigen.of[0];
  const simd::Mask away = (axis[0] * towards.x + axis[2] * towards.z) + axis[1] * towards.y < all(0.0f);
  const auto turned = [&](int k) { return negate(away, axis[k]) + all(0.0f); };  // no negative zeros
  return keep(flat, PointLanes{turned(0), turned(1), turned(2)});
}

/// What to turn the normals at these places to; zeros if the viewpoint is absent.
[[nodiscard]] inline PointLanes directions(const Viewpoint& viewpoint, const PointLanes& places) noexcept {
  using Side = Viewpoint::Side;
  using simd::all;
  const float side = viewpoint.side == Side::absent ? 0.0f : viewpoint.side == Side::towards ? 1.0f : -1.0f;
  const Point& p = viewpoint.point;
  return {(all(p.x) - places.x) * all(side), (all(p.y) - places.y) * all(side), (all(p.z) - places.z) * all(side)};
}

/// One normal from each lane.
inline void store(SurfaceNormal* normals, const PointLanes& v) noexcept {
  float components[3][simd::lanes];
  simd::store(components[0], v.x);
  simd::store(components[1], v.y);
  simd::store(components[2], v.z);
  for (std::size_t lane = 0; lane < simd::lanes; ++lane) {
    normals[lane] = {components[0][lane], components[1][lane], components[2][lane]};
  }
}

[[nodiscard]] inline bool is_zero(const SurfaceNormal& n) noexcept { return n.x == 0.0f && n.y == 0.0f && n.z == 0.0f; }

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The normal of the plane through a gathered neighborhood: the direction in which the neighbors within `radius`
/// scatter least about their centroid, the key point and its copies among them. Source: PCL 1.13's NormalEstimation.
///
/// `radius` may be smaller than the one the neighborhood was gathered with.
/// `viewpoint` turns the normal. Where it is absent, or at right angles to the normal, the sign is the solver's:
/// arbitrary, but the same on every machine.
///
/// Statuses: bad_radius; bad_viewpoint (not finite); too_many_neighbors (more than 2^24); too_few_neighbors (fewer than
/// three); ambiguous_frame (the two smaller extents are equal within float resolution: the neighbors lie on a line, or
/// in one place). `normal` is zeroed then. No allocation, reentrant. The result does not depend on the order of the
/// neighbors.
template <class Neighbors>
[[nodiscard]] inline Status estimate_normal(const Neighbors& n, Radius radius, SurfaceNormal& normal,
                                            const Viewpoint& viewpoint = {}) noexcept {
  normal = SurfaceNormal{};
  float view[3] = {};
  const Status usable = detail::validate_estimate(n, radius, viewpoint, view);
  if (usable != Status::ok) return usable;

  const extend::PointLanes towards{extend::simd::all(view[0]), extend::simd::all(view[1]), extend::simd::all(view[2])};
  const std::uint32_t members = extend::count_within(n, radius);
  if (members < min_normal_neighbors) return Status::too_few_neighbors;
  // In units of the radius; or, where the members fill too little of it, of the farthest one's distance.
  detail::MomentScale scale = detail::moment_scale(members, radius.value);
  detail::Moments moments = detail::moments_of(n, radius, scale);
  SurfaceNormal found[extend::simd::lanes] = {};
  if (any(detail::is_fine(moments, scale))) detail::store(found, detail::normals_of(moments, scale, towards));
  if (detail::is_zero(found[0])) {
    scale = detail::moment_scale(members, detail::farthest_member(n, radius));
    moments = detail::moments_of(n, radius, scale);
    detail::store(found, detail::normals_of(moments, scale, towards));
  }
  normal = found[0];
  return detail::is_zero(normal) ? Status::ambiguous_frame : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_FRAME_NORMAL_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Some of the points that may be neighbors of a group: where they are, and their terms of moments.
class CandidateChunk {
 public:
  static constexpr std::uint32_t most = 64;

  /// Candidates from `first` on; their moments are about the place that `candidates` were gathered around.
  void fill(const CloudView& cloud, const Neighborhood& candidates, std::uint32_t first,
            const MomentScale& by) noexcept {
    for (size_ = 0; size_ < most && first + size_ < candidates.size; size_ += simd::lanes) {
      const NeighborLanes v = load_neighbors(candidates, first + size_);
      const std::uint32_t left = candidates.size - first - size_;
      std::uint32_t index[simd::lanes];
      simd::store(index, v.index);
      for (std::size_t lane = left; lane < simd::lanes; ++lane) index[lane] = index[0];
      const PointLanes p = read_lanes(cloud.points, [&](std::size_t lane) { return std::size_t{index[lane]}; });
      // What fills up the last register is nobody's neighbor: on the other side of the origin, beyond any radius.
      const float nowhere = candidates.center.x > 0.0f ? -1.3e19f : 1.3e19f;
      simd::store(x_ + size_, select(simd::first(left), p.x, simd::all(nowhere)));
      simd::store(y_ + size_, p.y);
      simd::store(z_ + size_, p.z);
      const Terms each = terms_of(v, by);
      unroll<Terms::kinds>([&](auto k) { simd::store(terms_[k] + size_, each.of[k]); });
    }
  }

  /// Adds those that are neighbors of a point.
  void add_neighbors(const Point& p, Radius radius, Moments& to) const noexcept {
    const simd::F32 x = simd::all(p.x);
    const simd::F32 y = simd::all(p.y);
    const simd::F32 z = simd::all(p.z);
    Moments sums = to;
    for (std::uint32_t i = 0; i < size_; i += simd::lanes) {
      const simd::F32 dx = simd::load(x_ + i) - x;
      const simd::F32 dy = simd::load(y_ + i) - y;
      const simd::F32 dz = simd::load(z_ + i) - z;
      const simd::Mask near = (dx * dx + dy * dy) + dz * dz < simd::all(radius.squared);
      add_where(near, sums, [&](auto k) { return simd::load(terms_[k] + i); });
    }
    to = sums;
  }

 private:
  alignas(simd::F32) float x_[most];
  alignas(simd::F32) float y_[most];
  alignas(simd::F32) float z_[most];
  alignas(simd::F32) std::uint32_t terms_[Terms::kinds][most];
  std::uint32_t size_ = 0;
};

/// The totals of moments whose lanes hold shares, one after the other.
[[nodiscard]] inline Moments totals(const Moments* shares) noexcept {
  Moments result;
  const auto total = [&](const auto& share_of) {
    std::uint32_t lanes[simd::lanes];
    for (std::size_t k = 0; k < simd::lanes; ++k) lanes[k] = static_cast<std::uint32_t>(sum(share_of(shares[k])));
    return simd::load(lanes);
  };
  result.members = total([](const Moments& m) { return m.members; });
  unroll<Terms::kinds>([&](auto k) { result.of[k] = total([k](const Moments& m) { return m.of[k]; }); });
  return result;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_CANDIDATE_CHUNK_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points side by side, at most 16, whole registers of them.
struct PlaceGroup {
  static constexpr std::size_t most = 16;
  const float* x;
  const float* y;
  const float* z;
  std::size_t count;
};

/// Their normals, three components each; zeros for those that need to be looked at alone. `candidates`, gathered within
/// `wide`, has all their neighbors within `radius`.
inline void normals_together(const CloudView& cloud, const Neighborhood& candidates, Radius wide, Radius radius,
                             const Viewpoint& viewpoint, const PlaceGroup& group, float* normals) noexcept {
  const MomentScale scale = moment_scale(candidates.size, wide.value);
  Moments shares[PlaceGroup::most] = {};
  CandidateChunk chunk;
  for (std::uint32_t i = 0; i < candidates.size; i += CandidateChunk::most) {
    chunk.fill(cloud, candidates, i, scale);
    for (std::size_t k = 0; k < group.count; ++k) {
      chunk.add_neighbors({group.x[k], group.y[k], group.z[k]}, radius, shares[k]);
    }
  }
  for (std::size_t k = 0; k < group.count; k += simd::lanes) {
    const Moments moments = totals(shares + k);
    const PointLanes places{simd::load(group.x + k), simd::load(group.y + k), simd::load(group.z + k)};
    const PointLanes towards = directions(viewpoint, places);
    SurfaceNormal found[simd::lanes];
    store(found, keep(is_fine(moments, scale), normals_of(moments, scale, towards)));
    std::memcpy(normals + 3 * k, found, sizeof found);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_NORMALS_TOGETHER_HPP

// shortshot/kernel/describe_at.hpp: one key point from cloud to descriptor: search, frame and kernel in one call.
#ifndef SHORTSHOT_KERNEL_DESCRIBE_AT_HPP
#define SHORTSHOT_KERNEL_DESCRIBE_AT_HPP

// shortshot/search/search.hpp: what a search is.
#ifndef SHORTSHOT_SEARCH_SEARCH_HPP
#define SHORTSHOT_SEARCH_SEARCH_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A search is anything with three functions:
/// * `Status gather(const Point& center, Radius radius, Neighbors& out) const`, for Neighborhood and whatever else it
///   shall work with, offers each valid point within the radius to `out` exactly once, in any order, by the index it
///   has in the cloud: extend::clear(out, center) before the first, extend::offer() for each that may be one, and
///   extend::outcome(out) as the result. It returns status() if that is not ok. It allocates nothing, and several
///   threads may call it at once;
/// * `Status status() const` says why it cannot be asked, if so: what its build() returned;
/// * `std::size_t cloud_size() const` is the size of its cloud, so that it is not asked about another one.
template <class Search, class = void>
struct IsSearch : std::false_type {};
template <class Search>
struct IsSearch<
    Search,
    std::void_t<decltype(std::declval<const Search&>().gather(std::declval<const Point&>(), std::declval<Radius>(),
                                                              std::declval<Neighborhood&>())),
                decltype(std::declval<const Search&>().status()), decltype(std::declval<const Search&>().cloud_size())>>
    : std::bool_constant<
          std::is_same<decltype(std::declval<const Search&>().gather(
                           std::declval<const Point&>(), std::declval<Radius>(), std::declval<Neighborhood&>())),
                       Status>::value &&
          std::is_same<decltype(std::declval<const Search&>().status()), Status>::value &&
          std::is_convertible<decltype(std::declval<const Search&>().cloud_size()), std::size_t>::value> {};

/// Can this cloud be searched, and is this a search over it?
template <class Search>
[[nodiscard]] inline Status validate_search(const CloudView& cloud, const Search& search) noexcept {
  static_assert(IsSearch<Search>::value,
                "A search has `Status gather(const Point&, Radius, Neighbors&) const`, `Status status() const` and "
                "`std::size_t cloud_size() const`. See 'How to add a search' in include/shortshot/README.md");
  Status status = validate(cloud);
  if constexpr (IsSearch<Search>::value) {
    if (status == Status::ok) status = search.status();
    if (status == Status::ok && search.cloud_size() != cloud.size) status = Status::bad_view;
  }
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_SEARCH_HPP

// shortshot/search/workspace.hpp: the memory of a neighborhood, sized at compile time and owned by the caller.
#ifndef SHORTSHOT_SEARCH_WORKSPACE_HPP
#define SHORTSHOT_SEARCH_WORKSPACE_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// All the scratch memory a key point needs, sized at compile time and owned by the caller: a local, a static, a
/// member. 20 bytes a neighbor. Trivial type; one thread at a time may use it.
template <std::size_t MaxNeighbors>
struct Workspace {
  static_assert(MaxNeighbors >= 5 && MaxNeighbors <= max_neighbors,
                "Workspace<MaxNeighbors> supports 5 (a local reference frame needs as many) to 2^24 neighbors");
  float dx[MaxNeighbors];             ///< see Neighborhood, as all of these
  float dy[MaxNeighbors];             ///< along y
  float dz[MaxNeighbors];             ///< along z
  float d2[MaxNeighbors];             ///< squared distances
  std::uint32_t index[MaxNeighbors];  ///< in the cloud
};

/// A Workspace of 2 bytes a neighbor (`Index` std::uint32_t: 4) for targets that have more time than memory. Clouds of
/// more points than `Index` can tell apart have too_many_neighbors wherever there is a neighbor.
template <std::size_t MaxNeighbors, class Index = std::uint16_t>
struct CompactWorkspace {
  static_assert(MaxNeighbors >= 5 && MaxNeighbors <= max_neighbors,
                "CompactWorkspace<MaxNeighbors> supports 5 (a local reference frame needs as many) to 2^24 neighbors");
  static_assert(std::is_same<Index, std::uint16_t>::value || std::is_same<Index, std::uint32_t>::value,
                "CompactWorkspace<MaxNeighbors, Index> supports uint16_t and uint32_t");
  Index index[MaxNeighbors];  ///< see CompactNeighborhood
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// An empty neighborhood in a workspace's memory; a compact one is for key points of `cloud`.
template <std::size_t MaxNeighbors>
[[nodiscard]] inline Neighborhood neighborhood_in(Workspace<MaxNeighbors>& w) noexcept {
  return {w.dx, w.dy, w.dz, w.d2, w.index, static_cast<std::uint32_t>(MaxNeighbors), 0, 0, {}};
}

template <std::size_t MaxNeighbors>
[[nodiscard]] inline Neighborhood neighborhood_in(Workspace<MaxNeighbors>& w, const CloudView&) noexcept {
  return neighborhood_in(w);
}

template <std::size_t MaxNeighbors, class Index>
[[nodiscard]] inline CompactNeighborhood<Index> neighborhood_in(CompactWorkspace<MaxNeighbors, Index>& w,
                                                                const CloudView& cloud) noexcept {
  const bool all_have_indices = cloud.size - 1 <= static_cast<Index>(~Index{0});
  return {cloud.points, {}, w.index, all_have_indices ? static_cast<std::uint32_t>(MaxNeighbors) : 0u, 0, 0};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_SEARCH_WORKSPACE_HPP

// shortshot/kernel/describe.hpp: the kernel. One gathered neighborhood and a frame in, one descriptor out.
//
// Neighbors go through in chunks, each chunk in passes over small arrays: locate (local spherical coordinates,
// to_spherical.hpp), the distances of colors, and then for each part shares among cells (vote_shares.hpp), votes and
// their addition (accumulate.hpp). Where there are lanes, the votes of most rules are worked out two registers at a
// time (short_votes.hpp), in place of vote_shares.hpp; where there is one, each is added as soon as it is known
// (single_votes.hpp). The rule, the arithmetic of cells and the addition are the same code. Votes are integers, and so
// are their sums (fixed_point.hpp).
#ifndef SHORTSHOT_KERNEL_DESCRIBE_HPP
#define SHORTSHOT_KERNEL_DESCRIBE_HPP

// shortshot/kernel/accumulate.hpp: the kernel's second pass. A chunk of located neighbors is shared among the cells of
// each part, and their votes are added up.
#ifndef SHORTSHOT_KERNEL_ACCUMULATE_HPP
#define SHORTSHOT_KERNEL_ACCUMULATE_HPP

#include <numeric>

// shortshot/kernel/single_votes.hpp: the kernel's second pass where there is one lane: each vote is added as soon as it
// is known. For speed every part has code of its own; where code shall be small all parts share one loop over tables of
// axes. The same bits.
#ifndef SHORTSHOT_KERNEL_SINGLE_VOTES_HPP
#define SHORTSHOT_KERNEL_SINGLE_VOTES_HPP

// shortshot/kernel/vote_shares.hpp: from where a chunk's neighbors lie to their shares among the cells of a part, and
// their votes.
#ifndef SHORTSHOT_KERNEL_VOTE_SHARES_HPP
#define SHORTSHOT_KERNEL_VOTE_SHARES_HPP

// shortshot/kernel/measure_signals.hpp: the values of a descriptor's signals, each in a row of the chunk. Most are
// measured while neighbors are located, for they may leave a neighbor out; those that look at nothing but the index,
// after that.
#ifndef SHORTSHOT_KERNEL_MEASURE_SIGNALS_HPP
#define SHORTSHOT_KERNEL_MEASURE_SIGNALS_HPP

// shortshot/kernel/chunk.hpp: the neighbors that go through the kernel together.
#ifndef SHORTSHOT_KERNEL_CHUNK_HPP
#define SHORTSHOT_KERNEL_CHUNK_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A chunk of neighbors in the frame's spherical coordinates, with the values of a descriptor's Signals (a SignalList).
/// Only those that are described: passes need no masks.
template <class Signals, std::uint32_t Room>
struct Chunk {
  static_assert(Room >= simd::lanes && Room <= 1024 && Room % simd::lanes == 0,
                "ChunkSize supports multiples of simd::lanes up to 1024: registers do not reach beyond its end");
  static constexpr std::uint32_t room = Room;
  /// Passes go through a register at a time, or two where the room is for that.
  static constexpr std::uint32_t step =
      Room % (2 * simd::lanes) == 0 && simd::lanes > 1 ? 2 * simd::lanes : simd::lanes;
  static constexpr int rows_of_place = 3;
  static constexpr int signals = Signals::size;
  std::uint32_t size;
  std::uint32_t index[Room];                           ///< in the cloud
  float rows[(rows_of_place + Signals::size) * Room];  // one array, so that one register holds the place in all

  /// From neighbor `i` on, all 0..1: row 0, the distance over the radius; 1, the angle from +z over pi; 2, the angle
  /// from -x, counter-clockwise, in turns, or below 0 where a convention gives none; then a row for each signal.
  [[nodiscard]] const float* row(int k, std::uint32_t i) const noexcept {
    return rows + i + static_cast<std::size_t>(k) * Room;
  }
  template <class Signal>
  static constexpr int row_of = rows_of_place + place_in<Signal>(Signals{});
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_CHUNK_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Values of signals, for histograms' axes: beyond their ends would be beyond the part's memory.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 cut_off(simd::F32 value) noexcept {
  return simd::max(simd::min(value, simd::all(1.0f)), simd::all(0.0f));
}
/// Signed ones: one point's must not leave the sums' integers.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 cut_off_signed(simd::F32 value) noexcept {
  return simd::max(simd::min(value, simd::all(4.0f)), simd::all(-4.0f));
}

/// False for NaN, and for what is too large to be one. By the bits, which order as numbers do.
[[nodiscard]] SHORTSHOT_INLINE simd::Mask has_value(simd::F32 measured) noexcept {
  return simd::all_int(0x7EE1B1E6) > bits_of(simd::abs(measured));  // 1.5e38f
}

/// Where in its histogram a measured value lies.
template <class Signal>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 place_in_histogram(simd::F32 measured) noexcept {
  if constexpr (Signal::is_signed) return cut_off(Signal::place(measured));
  return measured;
}

/// The values of one signal, given the sources of all.
template <class Signal, class... Kinds, class At, class Sources>
[[nodiscard]] SHORTSHOT_INLINE auto measure(extend::SourceKinds<Kinds...>, const At& at,
                                            const Sources& sources) noexcept {
  return Signal::measure(at, source_of<Kinds>(sources)...);
}

/// What is measured while neighbors are located: those of the Signals that may leave some of them out, or look at where
/// they are.
template <class Signals, class Sources>
struct SignalsOfPlace;
template <class... Signals, class Sources>
struct SignalsOfPlace<SignalList<Signals...>, Sources> {
  using List = SignalList<Signals...>;
  static constexpr int count = ((Signals::reads_index_only ? 0 : 1) + ... + 0);
  const Sources& sources;

  /// Into `values`; takes those without a value out of `described`.
  template <class At>
  SHORTSHOT_INLINE void measure(const At& at, simd::Mask& described, simd::F32* values) const noexcept {
    (measure_one<Signals>(at, described, values[place_in<Signals>(List{})]), ...);
  }
  /// The same values behind the first `size` of a chunk.
  template <class Chunk, class... Packing>
  SHORTSHOT_INLINE void append(Chunk& chunk, std::uint32_t size, const simd::F32* values,
                               const Packing&... packing) const noexcept {
    (append_one<Signals>(chunk, size, values[place_in<Signals>(List{})], packing...), ...);
  }

 private:
  template <class Signal, class At>
  SHORTSHOT_INLINE void measure_one(const At& at, simd::Mask& described, simd::F32& value) const noexcept {
    if constexpr (!Signal::reads_index_only) {
      const simd::F32 measured = detail::measure<Signal>(typename Signal::Sources{}, at, sources);
      described = described & has_value(measured);
      // NaN goes no further: to compare it is an invalid operation. (One lane at a time is not appended without a
      // value.)
      value = cut_off(simd::lanes > 1 ? keep(described, measured) : measured);
    }
  }
  template <class Signal, class Chunk, class... Packing>
  SHORTSHOT_INLINE void append_one(Chunk& chunk, std::uint32_t size, simd::F32 value,
                                   const Packing&... packing) const noexcept {
    if constexpr (!Signal::reads_index_only) {
      simd::store(chunk.rows + Chunk::template row_of<Signal> * std::size_t{Chunk::room} + size, value, packing...);
    }
  }
};

/// Where there are none: one type for all descriptors, which so share one locate().
struct NoSignalsOfPlace {
  static constexpr int count = 0;
  template <class At>
  SHORTSHOT_INLINE void measure(const At&, simd::Mask&, simd::F32*) const noexcept {}
  template <class Chunk, class... Packing>
  SHORTSHOT_INLINE void append(Chunk&, std::uint32_t, const simd::F32*, const Packing&...) const noexcept {}
};

template <class Signals, class Sources>
[[nodiscard]] SHORTSHOT_INLINE auto signals_of_place(const Sources& sources) noexcept {
  if constexpr (SignalsOfPlace<Signals, Sources>::count > 0) {
    return SignalsOfPlace<Signals, Sources>{sources};
  } else {
    return NoSignalsOfPlace{};
  }
}

/// One signal that looks at nothing but the index, into its row of a located chunk.
template <class Signal, class Chunk, class Sources>
inline void measure_by_index(const Sources& all, Chunk& chunk) noexcept {
  if constexpr (Signal::reads_index_only) {
    Collector<const Sources> sources = all;
    float* const row = chunk.rows + Chunk::template row_of<Signal> * std::size_t{Chunk::room};
    for (std::uint32_t i = 0; i < chunk.size; i += simd::lanes) {
      const IndicesAt at{chunk.index + i};
      const auto measured = measure<Signal>(typename Signal::Sources{}, at, sources);
      if constexpr (Signal::components == 1) {
        simd::store(row + i, cut_off(measured));
      } else {
        unroll<Signal::components>(
            [&](auto k) { simd::store(row + i + k * std::size_t{Chunk::room}, cut_off_signed(measured.of[k])); });
      }
    }
  }
}

template <class... Signals, class Chunk, class Sources>
inline void measure_all_by_index(SignalList<Signals...>, const Sources& sources, Chunk& chunk) noexcept {
  (measure_by_index<Signals>(sources, chunk), ...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_MEASURE_SIGNALS_HPP

// shortshot/kernel/to_spherical.hpp: the kernel's first pass. A chunk of neighbors goes from offsets in the cloud's
// coordinates to spherical coordinates in the frame.
#ifndef SHORTSHOT_KERNEL_TO_SPHERICAL_HPP
#define SHORTSHOT_KERNEL_TO_SPHERICAL_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A frame in all lanes, and a copy (see Collector). (Small code does without: it takes the frame's own floats.)
struct FrameLanes {
  simd::F32 x[3], y[3], z[3];
  explicit FrameLanes(const Frame& frame) noexcept {
    unroll<3>([&](auto k) {
      x[k] = simd::all(frame.x[k]);
      y[k] = simd::all(frame.y[k]);
      z[k] = simd::all(frame.z[k]);
    });
  }
};

/// The neighbors of one chunk: `count` stretches of the neighborhood, `stride` apart, of `length` each.
struct Stretches {
  std::uint32_t first;
  std::uint32_t stride;
  std::uint32_t count;
  std::uint32_t length;
};

/// Four stretches for each chunk that is full, where there are lanes. Neighbors that follow each other lie in the same
/// cells, where each addition would wait for the one before; a chunk from four places has others to add in between.
/// (Sums do not depend on the order.) The last chunk has what is left, in one stretch; and so has every chunk of a
/// small CPU, which waits for nothing.
inline constexpr std::uint32_t stretches_of_full_chunk = 4;

template <std::uint32_t ChunkSize>
[[nodiscard]] inline Stretches stretches_of_chunk(std::uint32_t chunk, std::uint32_t neighbors) noexcept {
  constexpr std::uint32_t length = ChunkSize / stretches_of_full_chunk;
  constexpr bool spread = simd::lanes > 1 && length > 0 && length % simd::lanes == 0;
  const std::uint32_t full_chunks = neighbors / ChunkSize;
  if (spread && chunk < full_chunks) return {chunk * length, full_chunks * length, stretches_of_full_chunk, length};
  const std::uint32_t left = neighbors - chunk * ChunkSize;
  return {chunk * ChunkSize, 0, 1, left < ChunkSize ? left : ChunkSize};
}

/// One register of neighbors as in the rows of a chunk, and which of them are described.
template <int Values>
struct Located {
  simd::F32 distance, elevation, azimuth;
  simd::F32 values[static_cast<std::size_t>(Values + (Values == 0 ? 1 : 0))];  // an array has one or more
  simd::Mask described;
};

template <class Cells, class Borders, int Values, class FrameAxes, class Signals>
[[nodiscard]] SHORTSHOT_INLINE Located<Values> locate_register(const NeighborLanes& v, const FrameAxes& frame,
                                                               Radius radius, const Signals& signals) noexcept {
  const PointLanes offset{v.dx, v.dy, v.dz};
  const PointLanes local{along(frame.x, offset), along(frame.y, offset), along(frame.z, offset)};
  Located<Values> located{};
  located.distance = distance_over_radius<Borders>(v.d2, local, radius);
  const simd::F32 from_axis = simd::sqrt(local.x * local.x + local.y * local.y);
  located.elevation = Cells::elevation(local, from_axis, radius);
  located.azimuth = Cells::azimuth(local, from_axis);
  located.described = Cells::are_described(v.d2, radius);
  if constexpr (Signals::count > 0) {
    std::uint32_t indices[simd::lanes];
    simd::store(indices, v.index);
    signals.measure(NeighborsAt<FrameAxes>{indices, offset, local, frame}, located.described, located.values);
  }
  return located;
}

/// One register of neighbors behind the first `size` of a chunk; `packing` leaves out those that are not described.
template <class Chunk, int Values, class Signals, class... Packing>
SHORTSHOT_INLINE void append(Chunk& chunk, std::uint32_t size, simd::I32 index, const Located<Values>& located,
                             const Signals& signals, const Packing&... packing) noexcept {
  simd::store(chunk.index + size, index, packing...);
  float* const row = chunk.rows + size;
  simd::store(row, located.distance, packing...);
  simd::store(row + Chunk::room, located.elevation, packing...);
  simd::store(row + 2 * std::size_t{Chunk::room}, located.azimuth, packing...);
  signals.append(chunk, size, located.values, packing...);
}

/// Neighbors into a chunk: from the cloud's coordinates to spherical ones in the frame. (Nothing here depends on the
/// descriptor but through the arguments: many of them share this.)
template <class Cells, class Borders, class Neighbors, class Signals, class Chunk>
[[gnu::noinline]] inline void locate(const Neighbors& all, const Stretches& stretches, const Frame& frame,
                                     Radius radius, const Signals& signals_of_place, Chunk& chunk) noexcept {
  constexpr int values = Signals::count > 0 ? Chunk::signals : 0;
  std::conditional_t<simd::lanes == 1, const Neighbors&, Collector<const Neighbors>> n = all;  // too few registers
  const Signals signals = signals_of_place;
  std::conditional_t<small_code, const Frame&, const FrameLanes> axes(frame);
  std::uint32_t size = 0;
  std::uint32_t i = stretches.first;  // one loop over all stretches: what it keeps in registers is loaded once
  std::uint32_t end = i + stretches.length;
  for (std::uint32_t left = stretches.count;;) {
    const NeighborLanes v = load_neighbors(n, i);
    const Located<values> now = locate_register<Cells, Borders, values>(v, axes, radius, signals);
    if (every(now.described)) {
      append(chunk, size, v.index, now, signals);
      size += static_cast<std::uint32_t>(simd::lanes);
    } else if constexpr (simd::lanes > 1) {
      const simd::Packing packing = simd::packing(now.described);
      append(chunk, size, v.index, now, signals, packing);
      size += packing.count;
    }
    i += simd::lanes;
    if (i >= end) {
      if (simd::lanes == 1 || --left == 0) break;  // where there is one lane, there is one stretch
      i = end + (stretches.stride - stretches.length);
      end += stretches.stride;
    }
  }
  chunk.size = size;
  // What passes read beyond the end must be points that exist, and numbers.
  for (; size % Chunk::step != 0; ++size) {
    chunk.index[size] = n.index[stretches.first];
    for (int k = 0; k < Chunk::rows_of_place + Chunk::signals; ++k)
      chunk.rows[size + std::size_t{Chunk::room} * static_cast<std::size_t>(k)] = 0.0f;
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_TO_SPHERICAL_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The votes that a point has for a part.
template <class Voting, class Part>
inline constexpr int votes_of = Voting::template votes<Part::axis_count>;

/// The share of a `coordinate` along axis `k` of a part (3: its histogram's).
template <class Voting, class Cells, class Scale>
[[nodiscard]] SHORTSHOT_INLINE Share share_along_axis(const Axis& axis, int k, simd::F32 coordinate,
                                                      const VoteUnit& unit) noexcept {
  return Voting::split(axis, Cells::template position<Scale>(axis, k, coordinate), unit);
}

/// What axis `K` of a part (3: its histogram's) goes by, of one register of a chunk's neighbors from `i` on.
template <class Part, int K, class Chunk>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 coordinate_at(const Chunk& chunk, std::uint32_t i) noexcept {
  if constexpr (K == 3) {
    using Signal = typename Part::Signal;
    return place_in_histogram<Signal>(simd::load(chunk.row(Chunk::template row_of<Signal>, i)));
  } else {
    return simd::load(chunk.row(K, i));
  }
}

/// One register of a chunk's neighbors in the frame's spherical coordinates.
struct Coordinates {
  simd::F32 of[3];
};

template <class Chunk>
[[nodiscard]] SHORTSHOT_INLINE Coordinates coordinates_at(const Chunk& chunk, std::uint32_t i) noexcept {
  return {{simd::load(chunk.row(0, i)), simd::load(chunk.row(1, i)), simd::load(chunk.row(2, i))}};
}

/// The shares of a point along all axes of a part, those of the grid first.
struct PointShares {
  Share axes[4];
};

/// The shares in a part's grid if every cell of it had `Values` values.
template <class Voting, class Part, int Values>
[[nodiscard]] SHORTSHOT_INLINE PointShares grid_shares(const Coordinates& at, const VoteUnit& unit) noexcept {
  PointShares shares;
  each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    shares.axes[k] = share_along_axis<Voting, typename Part::Cells, typename Part::Scale>(
        Part::template axes<Values>[k], k, at.of[k], unit);
  });
  return shares;
}

/// The same in a grid whose cells have `Factor` times as many values; the cell of all axes is the first one's.
template <int Factor>
[[nodiscard]] SHORTSHOT_INLINE PointShares widened(const PointShares& shares) noexcept {
  PointShares wide = shares;
  wide.axes[0].cell = times((shares.axes[0].cell + shares.axes[1].cell) + shares.axes[2].cell, Factor);
  wide.axes[1].cell = wide.axes[2].cell = simd::all_int(0);
  wide.axes[0].step = times(shares.axes[0].step, Factor);
  wide.axes[1].step = times(shares.axes[1].step, Factor);
  wide.axes[2].step = times(shares.axes[2].step, Factor);
  return wide;
}

/// All votes for a part of one register of a chunk's neighbors, from `i` on, whose shares in the grid are known.
/// Those of the signal are put into the same object: on a Cortex-M a copy of it costs 56 instructions per neighbor.
template <class Voting, class Part, class Chunk>
[[nodiscard]] SHORTSHOT_INLINE Votes<votes_of<Voting, Part>> votes_at(const Chunk& chunk, std::uint32_t i,
                                                                      PointShares& shares,
                                                                      const VoteUnit& unit) noexcept {
  constexpr const Axis(&axes)[4] = Part::template axes<Part::values>;
  if constexpr (Part::has_histogram) {
    const simd::F32 signal = coordinate_at<Part, 3>(chunk, i);
    shares.axes[3] = share_along_axis<Voting, typename Part::Cells, typename Part::Scale>(axes[3], 3, signal, unit);
  }
  return Voting::template combine<Part::axis_count>(axes, shares.axes, unit);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_VOTE_SHARES_HPP

// shortshot/kernel/vote_sums.hpp: the integers that votes are added to.
#ifndef SHORTSHOT_KERNEL_VOTE_SUMS_HPP
#define SHORTSHOT_KERNEL_VOTE_SUMS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The integers that votes are added to live in the caller's output array, bit for bit, until they are normalized: no
/// second array is needed. memcpy is how C++ says that; compilers make one load or store of it, if they are told the
/// alignment where CPUs insist on it.
[[nodiscard, gnu::always_inline]] inline std::int32_t integer_at(const float* value) noexcept {
  std::int32_t integer = 0;
  std::memcpy(&integer, __builtin_assume_aligned(value, alignof(float)), sizeof integer);
  return integer;
}

[[gnu::always_inline]] inline void set_bits(float* value, std::int32_t integer) noexcept {
  std::memcpy(__builtin_assume_aligned(value, alignof(float)), &integer, sizeof integer);
}

/// What is at a place, and a weight more. (Modulo 2^32: a place for votes that go nowhere takes any number of them.)
[[nodiscard, gnu::always_inline]] inline std::int32_t sum_at(const float* value, std::int32_t weight) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(integer_at(value)) + static_cast<std::uint32_t>(weight));
}

inline void add_bits(float* value, std::int32_t weight) noexcept { set_bits(value, sum_at(value, weight)); }

/// What the only lane holds.
[[nodiscard, gnu::always_inline]] inline std::int32_t integer_in(simd::I32 lane) noexcept {
  std::int32_t integer = 0;
  simd::store(&integer, lane);
  return integer;
}

/// One vote of the only lane.
[[gnu::always_inline]] inline void add_vote(float* sum, simd::I32 weight) noexcept {
  add_bits(sum, integer_in(weight));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_VOTE_SUMS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// f(k) for the axes of a part: as many as is known while compiling, or all of `count` where code shall be small.
template <int Axes, class Function>
[[gnu::always_inline]] inline void for_each_axis([[maybe_unused]] int count, Function f) noexcept {
  if constexpr (small_code) {
    for (int k = 0; k < count; ++k) f(k);
  } else {
    unroll<Axes>(f);
  }
}

/// From a point's cell to its partner along an axis, in values; 0 where there is none.
template <class Voting>
[[nodiscard]] SHORTSHOT_INLINE std::int32_t step_to_partner(const Axis& axis, simd::I32 position, simd::I32 cell,
                                                            simd::SignMask lower) noexcept {
  const simd::I32 direction = minus_one_or_one(lower);
  if (axis.end == Beyond::first_cell) {
    if (Voting::drops_nowhere && axis.below_zero == BelowZero::nowhere && any(is_negative(position))) return 0;
    return integer_in(next_around(axis, cell, direction) - cell) * axis.stride;
  }
  const bool is_beyond =
      static_cast<std::uint32_t>(integer_in(cell + direction)) >= static_cast<std::uint32_t>(axis.cells);
  return is_beyond ? 0 : integer_in(direction) * axis.stride;
}

/// One vote of a point for the cell it lies in, and one for its partner along each axis, if there is one.
template <class Voting, class Cells, class Scale, int Axes, class CoordinateAlong>
[[gnu::always_inline]] inline void vote_for_partners(const Axis (&axes)[4], int count,
                                                     const CoordinateAlong& coordinate_along, const VoteUnit& unit,
                                                     float* values) noexcept {
  constexpr bool begins_below_zero =
      Scale::below_zero != BelowZero::never || Cells::azimuth_below_zero != BelowZero::never;
  Side sides[4];
  simd::I32 positions[4];
  simd::I32 places[4];
  std::int32_t steps[4];
  const auto step_along = [&](auto k) SHORTSHOT_INLINE_LAMBDA {
    return step_to_partner<Voting>(axes[k], positions[k], places[k], sides[k].lower);
  };
  // Without a histogram all of a fourth axis' share is its partner's, which does not exist.
  sides[3].twice_partner = simd::all_int(2 * unit.one);
  float* cell = values;
  for_each_axis<Axes>(count, [&](auto k) SHORTSHOT_INLINE_LAMBDA {
    if (!begins_below_zero && axes[k].below_zero != BelowZero::never) __builtin_unreachable();  // tables do not say so
    positions[k] = Cells::template position<Scale>(axes[k], k, coordinate_along(k));
    places[k] = cell_of(axes[k], positions[k]);
    sides[k] = Voting::side(axes[k], positions[k], unit);
    if constexpr (small_code) steps[k] = step_along(k);
    cell += integer_in(places[k]) * axes[k].stride;
  });
  const simd::I32 of_cell = Voting::template weight_of_cell<Axes>(sides, unit);
  add_vote(cell, of_cell);
  for_each_axis<Axes>(count, [&](auto k) SHORTSHOT_INLINE_LAMBDA {
    if constexpr (!small_code) steps[k] = step_along(k);  // just before it is asked for: one comparison does both
    if (may_be_alone(axes[k]) && steps[k] == 0) return;
    add_vote(cell + steps[k], Voting::weight_of_partner(k, sides, of_cell, unit));
  });
}

/// The votes of neighbor `i` of a chunk for one part, added at once: there is one lane only.
template <class Voting, class Part, class Chunk>
SHORTSHOT_INLINE void add_point(const Chunk& chunk, std::uint32_t i, const Coordinates& at, const VoteUnit& unit,
                                float* values) noexcept {
  if constexpr (VotesForPartners<Voting>::value) {
    const auto coordinate_along = [&](auto k) SHORTSHOT_INLINE_LAMBDA {
      if constexpr (k == 3) {
        return coordinate_at<Part, 3>(chunk, i);
      } else {
        return at.of[k];
      }
    };
    vote_for_partners<Voting, typename Part::Cells, typename Part::Scale, Part::axis_count>(
        Part::template axes<Part::values>, Part::axis_count, coordinate_along, unit, values);
  } else {
    constexpr int count = votes_of<Voting, Part>;
    PointShares shares = grid_shares<Voting, Part, Part::values>(at, unit);
    const Votes<count> votes = votes_at<Voting, Part>(chunk, i, shares, unit);
    each<count>([&](auto k)
                    SHORTSHOT_INLINE_LAMBDA { add_vote(values + integer_in(votes.index[k]), votes.weight[k]); });
  }
}

/// All parts in one loop: what they have in common is worked out once.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void add_points(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const Chunk& chunk,
                                         VoteUnit unit, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; ++i) {
    const Coordinates at = coordinates_at(chunk, i);
    (add_point<Voting, Parts>(chunk, i, at, unit, out + D::offset(I)), ...);
  }
}

/// The row of a chunk that has the signal of a part; 0 if the part has no histogram.
template <class Part, class Chunk>
constexpr int signal_row() noexcept {
  if constexpr (Part::has_histogram) {
    return Chunk::template row_of<typename Part::Signal>;
  } else {
    return 0;
  }
}

/// The signal of a part if it is a signed one.
template <class Part>
using SignedOf = std::conditional_t<Part::Signal::is_signed, typename Part::Signal, void>;

/// The same of one part where code shall be small: this function for all parts with these rules. `signal` is the row of
/// the part's signal, or 0 if it has no histogram.
template <class Voting, class Cells, class Scale, class Signed, class Chunk>
[[gnu::noinline]] inline void add_points_of_part(const Chunk& chunk, const Axis (&axes)[4], int signal,
                                                 const VoteUnit& unit, float* values) noexcept {
  for (std::uint32_t i = 0; i < chunk.size; ++i) {
    const auto coordinate_along = [&](int k) SHORTSHOT_INLINE_LAMBDA {
      const simd::F32 coordinate = simd::load(chunk.row(k == 3 ? signal : k, i));
      if constexpr (!std::is_void<Signed>::value) {
        if (k == 3) return place_in_histogram<Signed>(coordinate);
      }
      return coordinate;
    };
    const int count = signal == 0 ? 3 : 4;
    if constexpr (VotesForPartners<Voting>::value) {
      vote_for_partners<Voting, Cells, Scale, 4>(axes, count, coordinate_along, unit, values);
    } else {
      Share shares[4];
      // Without a histogram all of a fourth axis' share is its partner's, which does not exist.
      shares[3] = {simd::all_int(0), simd::all_int(0), simd::all_int(2 * unit.one)};
      for (int k = 0; k < count; ++k) {
        shares[k] = share_along_axis<Voting, Cells, Scale>(axes[k], k, coordinate_along(k), unit);
      }
      const auto votes = Voting::template combine<4>(axes, shares, unit);
      for (int k = 0; k < Voting::template votes<4>; ++k) {
        add_vote(values + integer_in(votes.index[k]), votes.weight[k]);
      }
    }
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SINGLE_VOTES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Is vote `k` of a neighbor, to its partner along an axis of the grid, of the same weight for all parts on the grid?
template <class Voting>
constexpr bool is_shared(int k) noexcept {
  return PartnersGetOwnShare<Voting>::value && 1 <= k && k <= 3;
}

/// The votes of a chunk for one part, lane-wise: `count` arrays of indices, and as many of weights. Votes go through
/// memory: taken out of registers lane by lane they would cost twice as much.
template <class Voting, class PartType, class Index, std::uint32_t ChunkSize>
struct VoteRows {
  using Part = PartType;
  static constexpr int count = votes_of<Voting, Part>;
  Index index[count * ChunkSize];
  std::int32_t weight[count * ChunkSize];

  VoteRows() noexcept {}  // leaves the arrays as they are

  /// Votes of one register of neighbors, from `i` on. Weights that the `First` part on the grid has as well are kept
  /// there only.
  template <bool First>
  SHORTSHOT_INLINE void keep_weights(std::uint32_t i, const simd::I32* weights) noexcept {
    unroll<count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      if constexpr (First || !is_shared<Voting>(k)) simd::store(weight + i + k * ChunkSize, weights[k]);
    });
  }
};

/// Those for the part that begins at value `Offset` of the descriptor; indices are positions in the part.
template <class Voting, class Part, int Offset, std::uint32_t ChunkSize>
struct ChunkVotes : VoteRows<Voting, Part, std::int32_t, ChunkSize> {
  static constexpr bool goes_to_distinct_places = false;
  using ChunkVotes::VoteRows::count;
  ChunkVotes() noexcept {}  // else `ChunkVotes()` is zeros

  /// Where index 0 of vote `k` is.
  static constexpr int origin(int) noexcept { return Offset; }

  template <bool First, class Chunk>
  SHORTSHOT_INLINE void cast(const Chunk& chunk, std::uint32_t i, PointShares&& shares, const VoteUnit& unit) noexcept {
    const Votes<count> votes = votes_at<Voting, Part>(chunk, i, shares, unit);
    unroll<count>([&](auto k) { simd::store(this->index + i + k * ChunkSize, votes.index[k]); });
    this->template keep_weights<First>(i, votes.weight);
  }
};

/// The largest number of votes that a neighbor has for any of these parts.
template <class First, class... Others>
inline constexpr int votes_of_most = [] {
  int most = First::count;
  ((most = Others::count > most ? Others::count : most), ...);
  return most;
}();

/// Where vote `K` of neighbor `i` of a chunk goes.
template <int K, std::uint32_t ChunkSize, class Votes>
[[nodiscard]] SHORTSHOT_INLINE float* place_of_vote(float* out, const Votes& votes, std::uint32_t i) noexcept {
  return out + Votes::origin(K) + std::ptrdiff_t{votes.index[K * ChunkSize + i]};
}

/// Vote `K` of neighbor `i` of a chunk, of the weight that `source` has.
template <int K, std::uint32_t ChunkSize, class Votes, class Source>
SHORTSHOT_INLINE void add_vote(float* out, const Votes& votes, const Source& source, std::uint32_t i) noexcept {
  if constexpr (K < Votes::count) {
    add_bits(place_of_vote<K, ChunkSize>(out, votes, i), source.weight[K * ChunkSize + i]);
  }
}

/// Votes of one neighbor for a part, to distinct places: their sums are loaded together, and no load waits for a store.
template <int Count>
struct DistinctVotes {
  float* places[static_cast<std::size_t>(Count)];
  std::int32_t sums[static_cast<std::size_t>(Count)];

  template <class Voting, std::uint32_t ChunkSize, bool OneGrid, class First, class Votes>
  SHORTSHOT_INLINE void load(std::uint32_t i, float* out, const First& first, const Votes& votes) noexcept {
    unroll<Count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      places[k] = place_of_vote<k, ChunkSize>(out, votes, i);
      if constexpr (OneGrid && is_shared<Voting>(k)) {
        sums[k] = sum_at(places[k], first.weight[k * ChunkSize + i]);
      } else {
        sums[k] = sum_at(places[k], votes.weight[k * ChunkSize + i]);
      }
    });
  }
  SHORTSHOT_INLINE void store() const noexcept {
    unroll<Count>([&](auto k) SHORTSHOT_INLINE_LAMBDA { set_bits(places[k], sums[k]); });
  }
};

/// All votes of neighbor `i` of a chunk, for several parts; on one grid, or each on its own.
template <class Voting, std::uint32_t ChunkSize, bool OneGrid, class First, class... Others>
SHORTSHOT_INLINE void add_votes(std::uint32_t i, float* out, const First& first, const Others&... others) noexcept {
  if constexpr (First::goes_to_distinct_places && !simd::adds_to_memory) {
    const auto add = [&](auto of_first, auto... of_others) SHORTSHOT_INLINE_LAMBDA {
      of_first.template load<Voting, ChunkSize, OneGrid>(i, out, first, first);
      (of_others.template load<Voting, ChunkSize, OneGrid>(i, out, first, others), ...);
      of_first.store();
      (of_others.store(), ...);
    };
    add(DistinctVotes<First::count>(), DistinctVotes<Others::count>()...);
  } else {
    unroll<votes_of_most<First, Others...>>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      add_vote<k, ChunkSize>(out, first, first, i);
      if constexpr (OneGrid && is_shared<Voting>(k)) {
        (add_vote<k, ChunkSize>(out, others, first, i), ...);
      } else {
        (add_vote<k, ChunkSize>(out, others, others, i), ...);
      }
    });
  }
}

/// The votes of a chunk for several parts. Neighbors from the four stretches of a full chunk are taken in turn.
template <class Voting, std::uint32_t ChunkSize, bool OneGrid, class... Votes>
SHORTSHOT_INLINE void scatter(std::uint32_t size, float* out, const Votes&... votes) noexcept {
  constexpr std::uint32_t quarter = ChunkSize / 4;  // a stretch of a full chunk; any other split would do
  static_assert(stretches_of_full_chunk == 4 && ChunkSize % 4 == 0, "what is written out below");
  const auto add = [&](std::uint32_t i)
                       SHORTSHOT_INLINE_LAMBDA { add_votes<Voting, ChunkSize, OneGrid>(i, out, votes...); };
  std::uint32_t i = 0;
  if (size > 3 * quarter) {
    for (; i < size - 3 * quarter; ++i) unroll<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA { add(i + k * quarter); });
    for (; i < quarter; ++i) {
      for (std::uint32_t k = i; k < 3 * quarter; k += quarter) add(k);
    }
  } else {
    for (; i < size; ++i) add(i);
  }
}

/// One chunk into parts that have one grid: points are shared among its cells once for all of them. (`unit` is a
/// copy: see Collector.)
template <class Voting, class Chunk, class First, class... Others>
inline void accumulate(const Chunk& chunk, VoteUnit unit, float* out, First&& first, Others&&... others) noexcept {
  using Part = typename std::decay_t<First>::Part;
  constexpr int values = [] {
    int divisor = Part::values;
    ((divisor = std::gcd(divisor, std::decay_t<Others>::Part::values)), ...);
    return divisor;
  }();
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    const Coordinates at = coordinates_at(chunk, i);
    if constexpr (sizeof...(Others) == 0) {
      first.template cast<true>(chunk, i, grid_shares<Voting, Part, values>(at, unit), unit);
    } else {
      const PointShares shares = grid_shares<Voting, Part, values>(at, unit);
      first.template cast<true>(chunk, i, widened<Part::values / values>(shares), unit);
      (others.template cast<false>(chunk, i, widened<std::decay_t<Others>::Part::values / values>(shares), unit), ...);
    }
  }
  scatter<Voting, Chunk::room, true>(size, out, first, others...);
}

template <class Voting, class... Parts, std::size_t... I, class Chunk>
inline void accumulate_all(Descriptor<Voting, Parts...> descriptor, std::index_sequence<I...> parts, const Chunk& chunk,
                           const VoteUnit& unit, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  if constexpr (simd::lanes == 1 && small_code) {
    (add_points_of_part<Voting, typename Parts::Cells, typename Parts::Scale, SignedOf<Parts>>(
         chunk, Parts::template axes<Parts::values>, signal_row<Parts, Chunk>(), unit, out + D::offset(I)),
     ...);
  } else if constexpr (simd::lanes == 1) {
    add_points(descriptor, parts, chunk, unit, out);
  } else if constexpr (HaveOneGrid<Parts...>::value) {
    accumulate<Voting>(chunk, unit, out, ChunkVotes<Voting, Parts, D::offset(I), Chunk::room>()...);
  } else {
    const auto accumulate_part = [&](auto part, float* values) {
      accumulate<Voting>(chunk, unit, values, ChunkVotes<Voting, decltype(part), 0, Chunk::room>());
    };
    (accumulate_part(Parts{}, out + D::offset(I)), ...);
  }
}

/// Bytes of a chunk and its votes, those of parts on one grid at the same time.
template <std::uint32_t ChunkSize, class Voting, class... Parts>
constexpr std::size_t scratch_bytes(Descriptor<Voting, Parts...>) noexcept {
  using D = Descriptor<Voting, Parts...>;
  constexpr std::size_t votes[] = {(Parts::weight_cells > 0 ? 0 : sizeof(ChunkVotes<Voting, Parts, 0, ChunkSize>))...};
  std::size_t most = 0;
  for (const std::size_t bytes : votes)
    most = HaveOneGrid<Parts...>::value ? most + bytes : most < bytes ? bytes : most;
  return sizeof(Chunk<typename D::Signals, ChunkSize>) + (simd::lanes == 1 ? 0 : most);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_ACCUMULATE_HPP

// shortshot/kernel/accumulate_means.hpp: votes for a part's means: those of the cells themselves, and votes times the
// values of signals.
#ifndef SHORTSHOT_KERNEL_ACCUMULATE_MEANS_HPP
#define SHORTSHOT_KERNEL_ACCUMULATE_MEANS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes times the values of the `Signals`, for neighbor `i` of a chunk (or a register of them).
template <class Chunk, class... Signals>
SHORTSHOT_INLINE void multiply(SignalList<Signals...>, const Chunk& chunk, std::uint32_t i, simd::I32 weight,
                               simd::I32 (&products)[sizeof...(Signals)]) noexcept {
  const simd::F32 votes = to_float(weight);
  std::size_t k = 0;
  ((products[k++] = round_to_int(votes * Signals::value(simd::load(chunk.row(Chunk::template row_of<Signals>, i))))),
   ...);
}

/// One chunk into a part of means: its votes to `weights`, the products to `values`; integers, bit for bit.
template <class Voting, class Means, class Chunk>
[[gnu::noinline]] inline void accumulate_means(const Chunk& chunk, VoteUnit unit, float* weights,
                                               float* values) noexcept {
  using Counts = typename Means::Counts;
  constexpr int count = votes_of<Voting, Counts>;
  constexpr std::size_t signals = static_cast<std::size_t>(Means::values);
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    PointShares shares = grid_shares<Voting, Counts, 1>(coordinates_at(chunk, i), unit);
    const Votes<count> votes = votes_at<Voting, Counts>(chunk, i, shares, unit);
    const std::size_t lanes = size - i < simd::lanes ? size - i : simd::lanes;
    each<count>([&](auto k) {
      simd::I32 products[signals];
      multiply(typename Means::Averaged{}, chunk, i, votes.weight[k], products);
      std::int32_t index[simd::lanes];
      std::int32_t weight[simd::lanes];
      std::int32_t product[signals][simd::lanes];
      simd::store(index, votes.index[k]);
      simd::store(weight, votes.weight[k]);
      for (std::size_t s = 0; s < signals; ++s) simd::store(product[s], products[s]);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        add_bits(weights + index[lane], weight[lane]);
        float* const cell = values + Means::values * index[lane];
        for (std::size_t s = 0; s < signals; ++s) add_bits(cell + s, product[s][lane]);
      }
    });
  }
}

/// Sums to means, given the sums of votes.
template <class Means>
inline void divide_by_votes(float* values, const float* weights) noexcept {
  float all = 0.0f;
  for (int cell = 0; cell < Means::Grid::cells; ++cell) all += weights[cell];
  if (!(all > 0.0f)) return;  // nobody voted: all sums are 0
  const float shrinkage = unfused(all * (static_cast<float>(Means::shrink_percent) / (100.0f * Means::Grid::cells)));
  for (int cell = 0; cell < Means::Grid::cells; ++cell) {
    const float inverse = 1.0f / (weights[cell] + shrinkage);
    float* const means = values + Means::values * cell;
    for (int k = 0; k < Means::values; ++k) means[k] = unfused(means[k] * inverse);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_ACCUMULATE_MEANS_HPP

// shortshot/kernel/finish.hpp: from the integers of all votes to values of L2 norm 1.
#ifndef SHORTSHOT_KERNEL_FINISH_HPP
#define SHORTSHOT_KERNEL_FINISH_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Integers to floats, in place.
inline void to_floats(float* values, int size) noexcept {
  for (int i = 0; i < size; ++i) values[i] = static_cast<float>(integer_at(values + i));
}

/// Integers (or, of parts that are finished, floats) to floats of L2 norm 1, in place or not. Squares are added up in
/// eight places, whatever the number of lanes: the same order, and so the same bits, from all.
template <bool AreIntegers>
[[nodiscard]] inline Status normalize(const float* from, float* values, int size) noexcept {
  constexpr int lanes = static_cast<int>(simd::lanes);
  const int whole = small_code && lanes == 1 ? 0 : size / 8 * 8;
  simd::F32 squares[8 / lanes] = {};
  for (int i = 0; i < whole; i += 8) {
    each<8 / lanes>([&](auto k) {
      simd::F32 value = simd::load(from + i + k * lanes);
      if constexpr (AreIntegers) {
        value = to_float(bits_of(value));
        simd::store(values + i + k * lanes, value);
      }
      squares[k] = squares[k] + value * value;
    });
  }
  float s[8];
  each<8 / lanes>([&](auto k) { simd::store(s + k * lanes, squares[k]); });
  for (int i = whole; i < size; ++i) {
    if constexpr (AreIntegers) values[i] = static_cast<float>(integer_at(from + i));
    s[i % 8] += unfused(values[i] * values[i]);
  }

  for (std::size_t count = 4; count > 0; count /= 2) {  // neighbors first
    for (std::size_t k = 0; k < count; ++k) s[k] = s[2 * k] + s[2 * k + 1];
  }
  if (!(s[0] > 0.0f)) return Status::too_few_neighbors;
  const float inverse = 1.0f / simd::sqrt(s[0]);
  for (int i = 0; i < whole; i += lanes) simd::store(values + i, simd::load(values + i) * simd::all(inverse));
  for (int i = whole; i < size; ++i) values[i] *= inverse;
  return Status::ok;
}

/// One part's sums to its values: means by their cells' votes, then as its rule says.
template <class Part>
inline void finish_part(float* values, [[maybe_unused]] float* weights) noexcept {
  if constexpr (Part::weight_cells > 0) divide_by_votes<Part>(values, weights);
  if constexpr (!std::is_same<typename Part::Finish, PlainSums>::value) Part::Finish::apply(values, Part::size);
}

/// All parts'; `sums` are the values themselves, unless all are plain; `weights`, the sums of votes of parts with
/// means.
template <class Voting, class... Parts, std::size_t... I>
[[nodiscard]] inline Status finish(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const float* sums,
                                   float* values, [[maybe_unused]] float* weights) noexcept {
  using D = Descriptor<Voting, Parts...>;
  if constexpr (D::is_plain) {
    return normalize<true>(sums, values, D::size);
  } else {
    to_floats(values, D::size);
    to_floats(weights, D::weight_cells);
    (finish_part<Parts>(values + D::offset(I), weights + D::weight_offset(I)), ...);
    return normalize<false>(values, values, D::size);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_FINISH_HPP

// shortshot/kernel/mean_color.hpp: the mean of a neighborhood's colors, with which signals of MeanColor compare.
#ifndef SHORTSHOT_KERNEL_MEAN_COLOR_HPP
#define SHORTSHOT_KERNEL_MEAN_COLOR_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Have all neighbors within the radius the same color? It is in `color` then. Seldom more than a look at two of them.
template <class Neighbors, class Colors>
[[nodiscard]] inline bool have_one_color(const Neighbors& n, const Colors& colors, Radius radius, Lab& color) noexcept {
  Lab* next = &color;
  Lab other;
  for (std::uint32_t i = 0; i < n.size; ++i) {
    const extend::Neighbor v = extend::neighbor_at(n, i);
    if (!(v.d2 < radius.squared)) continue;
    *next = colors(v.index);
    if (!(next->L == color.L && next->a == color.a && next->b == color.b)) return false;
    next = &other;
  }
  return next == &other;
}

/// The mean color of all neighbors within the radius, the key point and its copies included; black if there is none.
/// Where all are alike it is theirs without rounding: nothing differs from it, and no root makes something of it.
template <class Neighbors, class Colors>
[[nodiscard]] inline Lab mean_color(const Neighbors& n, const Colors& colors, Radius radius) noexcept {
  Lab same{};
  if (have_one_color(n, colors, radius, same)) return same;
  const int exponent = fixed_point_exponent(n.size, 7);  // L, a and b are below 128
  const simd::F32 scale = simd::all(static_cast<float>(1 << exponent));
  simd::I32 sums[3] = {simd::all_int(0), simd::all_int(0), simd::all_int(0)};
  simd::I32 counts = simd::all_int(0);
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const extend::NeighborLanes v = extend::load_neighbors(n, i);
    std::uint32_t index[simd::lanes];
    simd::store(index, v.index);
    simd::Mask within = v.d2 < simd::all(radius.squared);
    if (n.size - i < simd::lanes) within = within & simd::first(n.size - i);
    const extend::LabLanes lab = extend::colors_at(colors, index);
    sums[0] = sums[0] + keep(within, round_to_int(lab.L * scale));
    sums[1] = sums[1] + keep(within, round_to_int(lab.a * scale));
    sums[2] = sums[2] + keep(within, round_to_int(lab.b * scale));
    counts = increment(within, counts);
  }
  const std::int32_t count = sum(counts);
  if (count == 0) return {0.0f, 0.0f, 0.0f};
  const float inverse = 1.0f / static_cast<float>(count) / static_cast<float>(1 << exponent);
  const auto mean = [&](simd::I32 lanes) { return unfused(static_cast<float>(sum(lanes)) * inverse); };
  return {mean(sums[0]), mean(sums[1]), mean(sums[2])};
}

/// Sources with the mean color of the neighborhood as the colors' reference.
template <class LabRule, class Neighbors>
[[nodiscard]] inline extend::SourceSet<> with_mean_color(const extend::SourceSet<>&, const Neighbors&,
                                                         Radius) noexcept {
  return {};
}
template <class LabRule, class Neighbors, class First, class... Others>
[[nodiscard]] inline extend::SourceSet<First, Others...> with_mean_color(
    const extend::SourceSet<First, Others...>& sources, const Neighbors& n, Radius radius) noexcept {
  extend::SourceSet<First, Others...> result{sources.first, sources.others};
  if constexpr (StandsFor<RgbColors<LabRule>, First>::value) {
    result.first.reference = mean_color(n, sources.first, radius);
  } else {
    result.others = with_mean_color<LabRule>(sources.others, n, radius);
  }
  return result;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_MEAN_COLOR_HPP

// shortshot/kernel/short_votes.hpp: votes with indices of 16 bits, where there are lanes: two registers of neighbors at
// a time. What a rule of voting for a cell and its partners (voting.hpp) says about weights stays in 32 bits, and so do
// the sums; the arithmetic of cells is the same (interpolation.hpp), in half the instructions.
//
// A vote to a partner that does not exist is not sorted out: it has a place of its own behind the end of all sums,
// which nobody looks at. Indices count from that end: those of values are below 0, and to drop one is to make it 0.
#ifndef SHORTSHOT_KERNEL_SHORT_VOTES_HPP
#define SHORTSHOT_KERNEL_SHORT_VOTES_HPP

// shortshot/kernel/soft_cells.hpp: soft votes where there is one lane: each to its cell. For speed every part has code
// of its own; where code shall be small all of them share one loop over tables. The same bits.
#ifndef SHORTSHOT_KERNEL_SOFT_CELLS_HPP
#define SHORTSHOT_KERNEL_SOFT_CELLS_HPP

// shortshot/kernel/soft_layout.hpp: where the quads of a compact descriptor's parts are, see soft_votes.hpp; all of it
// known while compiling.
#ifndef SHORTSHOT_KERNEL_SOFT_LAYOUT_HPP
#define SHORTSHOT_KERNEL_SOFT_LAYOUT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// An axis with more than one cell. `row`: the coordinate, 3 for the signal. `stride`: in the descriptor, of its cells.
struct SoftAxis {
  std::int16_t row, cells, stride;
  /// The azimuth's: the upper cell of the last one is the first.
  [[nodiscard]] constexpr bool is_around() const noexcept { return row == 2; }
  /// Places of the lower cell.
  [[nodiscard]] constexpr int lowers() const noexcept { return is_around() ? cells : cells - 1; }
  /// The same where parts' signals are told apart.
  [[nodiscard]] constexpr SoftAxis of_part(int part) const noexcept {
    return {static_cast<std::int16_t>(row < 3 ? row : 3 + part), cells, stride};
  }
};

/// Where a part's quads are. The first two axes are within a quad (none, where quads are a cell's numbers); cells of
/// the others are rows of quads.
struct SoftLayout {
  SoftAxis axes[4];
  int count;       ///< of axes
  int within;      ///< axes within a quad
  int of_cell;     ///< quads of a cell of means; 1
  int strides[4];  ///< in quads
  int quads;

  constexpr void add(int row, int axis_cells, int stride) noexcept {
    if (axis_cells == 1) return;
    axes[count++] = {static_cast<std::int16_t>(row), static_cast<std::int16_t>(axis_cells),
                     static_cast<std::int16_t>(stride)};
  }
  constexpr void lay_out(int axes_within) noexcept {
    within = count < axes_within ? count : axes_within;
    quads = of_cell;
    for (int i = 0; i < count; ++i) {
      strides[i] = quads;
      quads *= i < within ? axes[i].lowers() : axes[i].cells + (axes[i].is_around() ? 1 : 0);
    }
  }
  [[nodiscard]] constexpr int corners() const noexcept { return 1 << (count - within); }
};

template <class Part>
inline constexpr SoftLayout soft_layout = [] {
  SoftLayout layout{};
  constexpr bool means = Part::weight_cells > 0;
  constexpr extend::CellStrides cells = Part::Cells::template strides<typename Part::Grid>;
  layout.of_cell = means ? (Part::values + 4) / 4 : 1;
  if (!means) layout.add(3, Part::values, 1);
  layout.add(0, Part::Grid::radial, Part::values * cells.radial);
  layout.add(1, Part::Grid::elevation, Part::values * cells.elevation);
  layout.add(2, Part::Grid::azimuth, Part::values * cells.azimuth);
  layout.lay_out(means ? 0 : 2);
  return layout;
}();

/// The axes of all parts, those with the same cells of the same coordinate once: a point's place on each is found once.
template <int Parts>
struct SoftPlaces {
  SoftAxis axes[static_cast<std::size_t>(4 * Parts)];
  int count;

  [[nodiscard]] constexpr int find(const SoftAxis& axis) const noexcept {
    int k = 0;
    while (k < count && (axes[k].row != axis.row || axes[k].cells != axis.cells)) ++k;
    return k;
  }
  constexpr void add(const SoftLayout& layout, int part) noexcept {
    for (int i = 0; i < layout.count; ++i) {
      const SoftAxis axis = layout.axes[i].of_part(part);
      if (find(axis) == count) axes[count++] = axis;
    }
  }
};

template <class Voting, class... Parts>
constexpr SoftPlaces<sizeof...(Parts)> soft_places(Descriptor<Voting, Parts...>) noexcept {
  SoftPlaces<sizeof...(Parts)> places{};
  int part = 0;
  (places.add(soft_layout<Parts>, part++), ...);
  return places;
}

/// All quads of a descriptor's parts before part `part`.
template <class Voting, class... Parts>
constexpr int soft_quads(Descriptor<Voting, Parts...>, int part) noexcept {
  constexpr int quads[] = {soft_layout<Parts>.quads...};
  int sum = 0;
  for (int k = 0; k < part; ++k) sum += quads[k];
  return sum;
}

/// Most quads: with those of every lane 16 KB of stack.
inline constexpr int most_quads = 1024 / static_cast<int>(simd::lanes);

template <class Voting, class... Parts>
constexpr bool has_linear_radii(Descriptor<Voting, Parts...>) noexcept {
  return (Parts::Scale::is_linear && ...);
}

/// Are a descriptor's votes added up in quads? Those of compact ones, if there are not too many.
template <class D>
constexpr bool is_soft() noexcept {
  constexpr bool is_compact = std::is_same<typename D::Voting, MultilinearVoting>::value && !D::is_plain &&
                              std::is_same<typename D::Cells, HeightCells>::value && has_linear_radii(D{});
  if constexpr (is_compact) return soft_quads(D{}, D::parts) <= most_quads;
  return false;
}

template <class D>
constexpr int quads_of() noexcept {
  if constexpr (is_soft<D>()) return soft_quads(D{}, D::parts);
  return 1;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_LAYOUT_HPP

// shortshot/kernel/soft_shares.hpp: how points are shared among the cells around them where votes are soft. A point
// lies between the middles of two cells on each axis, and votes for both.
#ifndef SHORTSHOT_KERNEL_SOFT_SHARES_HPP
#define SHORTSHOT_KERNEL_SOFT_SHARES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Along one axis: the lower of the two cells, and the share of the upper one.
struct Between {
  simd::I32 lower;
  simd::F32 upper;
};

[[nodiscard]] SHORTSHOT_INLINE Between between(simd::F32 coordinate, const SoftAxis& axis) noexcept {
  using simd::all;
  const auto cells = static_cast<float>(axis.cells);
  const simd::F32 place = coordinate * all(cells) - all(0.5f);
  const simd::F32 from_first = axis.is_around() ? place + keep(place < all(0.0f), all(cells))
                                                : simd::max(simd::min(place, all(cells - 1.0f)), all(0.0f));
  const simd::I32 lower = simd::small_min(truncate_to_int(from_first), simd::all_int(axis.lowers() - 1));
  return {lower, from_first - to_float(lower)};
}

/// Where in its histogram a measured value lies; between() cuts off what lies beyond.
template <class Signal>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 soft_place(simd::F32 measured) noexcept {
  if constexpr (Signal::is_signed) return Signal::place(measured);
  return measured;
}

/// Where the points of a register lie on all axes of a descriptor.
template <class D>
struct SoftPoints {
  static constexpr auto places = soft_places(D{});
  simd::F32 unit;  ///< what a point counts for
  simd::F32 coordinates[static_cast<std::size_t>(3 + D::parts)];
  Between between[static_cast<std::size_t>(places.count)];

  template <class... Parts, class Chunk>
  SHORTSHOT_INLINE void locate(Descriptor<typename D::Voting, Parts...>, const Chunk& chunk, std::uint32_t i) noexcept {
    unroll<3>([&](auto k) { coordinates[k] = simd::load(chunk.row(k, i)); });
    int part = 3;
    (locate_signal<Parts>(chunk, i, coordinates[part++]), ...);
    unroll<places.count>([&](auto k) {
      constexpr SoftAxis axis = places.axes[k];
      between[k] = detail::between(coordinates[axis.row], axis);
    });
  }

 private:
  template <class Part, class Chunk>
  SHORTSHOT_INLINE static void locate_signal(const Chunk& chunk, std::uint32_t i, simd::F32& place) noexcept {
    if constexpr (Part::weight_cells == 0) {
      using Signal = typename Part::Signal;
      if constexpr (Part::has_histogram) {
        place = soft_place<Signal>(simd::load(chunk.row(Chunk::template row_of<Signal>, i)));
      }
    }
  }
};

/// The values of signals for a register's neighbors.
template <class Chunk, class... Signals>
SHORTSHOT_INLINE void values_of(SignalList<Signals...>, const Chunk& chunk, std::uint32_t i,
                                simd::F32* values) noexcept {
  ((*values++ = Signals::value(simd::load(chunk.row(Chunk::template row_of<Signals>, i)))), ...);
}

/// How the points of a register are shared among the cells around them, for part `I` of a descriptor.
template <class D, std::size_t I, class Part>
struct SoftShares {
  static constexpr SoftLayout layout = soft_layout<Part>;
  static constexpr int count = 1 << layout.count;
  static constexpr int numbers = Part::weight_cells > 0 ? Part::values + 1 : 0;  ///< of a mean's cell: votes, sums
  simd::F32 weight[static_cast<std::size_t>(count)];
  simd::F32 measured[static_cast<std::size_t>(numbers == 0 ? 1 : Part::values)];

  /// The axis that bit `n` of a weight's place stands for; those within quads are the last ones.
  static constexpr int axis_of(int n) noexcept { return (n + layout.within) % layout.count; }
  template <int Axis>
  [[nodiscard]] SHORTSHOT_INLINE static const Between& between(const SoftPoints<D>& points) noexcept {
    return points.between[SoftPoints<D>::places.find(layout.axes[Axis].of_part(static_cast<int>(I)))];
  }

  /// Each axis parts all weights in two.
  template <class Chunk>
  SHORTSHOT_INLINE void share(const SoftPoints<D>& points, const Chunk& chunk, std::uint32_t i) noexcept {
    weight[0] = points.unit;
    unroll<layout.count>([&](auto n) {
      constexpr int known = 1 << n;
      const simd::F32 upper = between<axis_of(n)>(points).upper;
      unroll<known>([&](auto k) {
        weight[known + k] = weight[k] * upper;
        weight[k] = weight[k] - weight[known + k];
      });
    });
    if constexpr (numbers > 0) values_of(typename Part::Averaged{}, chunk, i, measured);
  }
  /// Votes in units: those of the cell, and for means times the value of signal `K` - 1.
  template <int Cell, int K = 0>
  [[nodiscard]] SHORTSHOT_INLINE simd::I32 votes() const noexcept {
    if constexpr (K > 0) return truncated_product(weight[Cell], measured[K - 1]);
    return truncate_to_int(weight[Cell]);
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_SHARES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes of a point for part `I` of a descriptor: to `weights`, the sums of cells' votes, and to `values`.
template <class D, std::size_t I, class Part>
struct CellVotes : SoftShares<D, I, Part> {
  using Shares = SoftShares<D, I, Part>;
  using Shares::layout, Shares::numbers;
  static constexpr int width = numbers > 0 ? Part::values : 1;  ///< values of what strides count

  SHORTSHOT_INLINE void add(const SoftPoints<D>& points, float* weights, float* values) const noexcept {
    std::int32_t first[2] = {0, 0};  // the place of the lowest cell; of the next one around, if there is such an axis
    unroll<layout.count>([&](auto i) {
      constexpr SoftAxis axis = layout.axes[i];
      std::int32_t lower = 0;
      simd::store(&lower, Shares::template between<i>(points).lower);
      first[0] += lower * (axis.stride / width);
      if constexpr (axis.is_around()) first[1] = (lower + 1 == axis.cells ? 1 - axis.cells : 1) * (axis.stride / width);
    });
    first[1] += first[0];
    float* const sums = (numbers > 0 ? weights : values);
    unroll<Shares::count>([&](auto k) {
      constexpr int offset = step(k);
      const std::int32_t place = first[is_around(k) ? 1 : 0];
      add_vote(sums + place + offset, this->template votes<k>());
      if constexpr (numbers > 0) {
        const std::int32_t cell = width * place;
        unroll<numbers - 1>([&](auto number) {
          constexpr int further = width * offset + number;
          add_vote(values + cell + further, this->template votes<k, number + 1>());
        });
      }
    });
  }

 private:
  /// Is cell `k` the upper one around?
  static constexpr bool is_around(int k) noexcept {
    bool around = false;
    for (int n = 0; n < layout.count; ++n)
      around = around || (layout.axes[Shares::axis_of(n)].is_around() && k >> n & 1);
    return around;
  }
  /// From the lowest cell to cell `k` but for the axis that goes around.
  static constexpr int step(int k) noexcept {
    int sum = 0;
    for (int n = 0; n < layout.count; ++n) {
      const SoftAxis axis = layout.axes[Shares::axis_of(n)];
      if (!axis.is_around()) sum += (k >> n & 1) * (axis.stride / width);
    }
    return sum;
  }
};

template <class D, std::size_t I, class Part, class Chunk>
SHORTSHOT_INLINE void add_to_cells(const Chunk& chunk, std::uint32_t i, const SoftPoints<D>& points, float* weights,
                                   float* values) noexcept {
  CellVotes<D, I, Part> votes;
  votes.share(points, chunk, i);
  votes.add(points, weights + D::weight_offset(I), values + D::offset(I));
}

/// A part as small code sees it.
struct SoftTable {
  SoftAxis axes[4];      ///< `stride`: in cells of means, else in values
  std::int16_t count;    ///< of axes
  std::int16_t numbers;  ///< that a cell of means adds up besides its votes
  std::int16_t first;    ///< of these, among a point's coordinates
  std::int16_t weights, values;
};

/// The coordinates of a point: place, then histograms' signals, one for each part, then what means are of.
template <class D>
struct SoftTables {
  SoftTable of[static_cast<std::size_t>(D::parts)];
  int coordinates;
  int most_cells;  ///< that a point votes for in one part

  template <class Part>
  constexpr void add(int part) noexcept {
    constexpr SoftLayout layout = soft_layout<Part>;
    constexpr bool means = Part::weight_cells > 0;
    SoftTable& table = of[part];
    for (int n = 0; n < layout.count; ++n) {
      table.axes[n] = layout.axes[(n + layout.within) % layout.count].of_part(part);
      if (means) table.axes[n].stride = static_cast<std::int16_t>(table.axes[n].stride / Part::values);
    }
    table.count = static_cast<std::int16_t>(layout.count);
    table.numbers = means ? Part::values : 0;
    most_cells = most_cells < 1 << layout.count ? 1 << layout.count : most_cells;
    table.first = static_cast<std::int16_t>(coordinates);
    coordinates += table.numbers;
    table.weights = static_cast<std::int16_t>(D::weight_offset(part));
    table.values = static_cast<std::int16_t>(D::offset(part));
  }
};

template <class Voting, class... Parts>
constexpr auto soft_tables(Descriptor<Voting, Parts...>) noexcept {
  SoftTables<Descriptor<Voting, Parts...>> tables{};
  tables.coordinates = 3 + static_cast<int>(sizeof...(Parts));
  int part = 0;
  (tables.template add<Parts>(part++), ...);
  return tables;
}
template <class D>
inline constexpr auto soft_tables_of = soft_tables(D{});

template <class Part, class Chunk>
inline void measure_for(const Chunk& chunk, std::uint32_t i, simd::F32& signal, simd::F32* numbers) noexcept {
  if constexpr (Part::weight_cells > 0) {
    values_of(typename Part::Averaged{}, chunk, i, numbers);
  } else if constexpr (Part::has_histogram) {
    using Signal = typename Part::Signal;
    signal = soft_place<Signal>(simd::load(chunk.row(Chunk::template row_of<Signal>, i)));
  }
}

/// The votes of a point for one part, to `MostCells` cells or fewer: SoftShares and CellVotes as loops.
template <int MostCells>
inline void add_by_table(const SoftTable& part, const simd::F32* coordinates, float one, float* weights,
                         float* values) noexcept {
  simd::F32 weight[static_cast<std::size_t>(MostCells)];
  std::int16_t place[static_cast<std::size_t>(MostCells)];
  int cells = 1;
  weight[0] = simd::all(one);
  place[0] = 0;
  for (int n = 0; n < part.count; ++n, cells *= 2) {
    const SoftAxis& axis = part.axes[n];
    const Between at = between(coordinates[axis.row], axis);
    std::int32_t lower = 0;
    simd::store(&lower, at.lower);
    const int upper = lower + 1 == axis.cells ? 0 : lower + 1;
    for (int k = 0; k < cells; ++k) {
      weight[cells + k] = weight[k] * at.upper;
      weight[k] = weight[k] - weight[cells + k];
      place[cells + k] = static_cast<std::int16_t>(place[k] + upper * axis.stride);
      place[k] = static_cast<std::int16_t>(place[k] + lower * axis.stride);
    }
  }
  float* const sums = part.numbers > 0 ? weights + part.weights : values + part.values;
  for (int k = 0; k < cells; ++k) {
    add_vote(sums + place[k], truncate_to_int(weight[k]));
    for (int n = 0; n < part.numbers; ++n) {
      add_vote(values + part.values + n + place[k] * part.numbers,
               truncated_product(weight[k], coordinates[part.first + n]));
    }
  }
}

/// One chunk into the cells of all parts.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void add_soft_points([[maybe_unused]] Descriptor<Voting, Parts...> descriptor,
                                              std::index_sequence<I...>, const Chunk& chunk, float one, float* weights,
                                              float* values) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; ++i) {
    if constexpr (small_code) {
      constexpr const auto& tables = soft_tables_of<D>;
      simd::F32 coordinates[static_cast<std::size_t>(tables.coordinates)];
      for (int k = 0; k < 3; ++k) coordinates[k] = simd::load(chunk.row(k, i));
      (measure_for<Parts>(chunk, i, coordinates[3 + I], coordinates + tables.of[I].first), ...);
      for (const SoftTable& part : tables.of) add_by_table<tables.most_cells>(part, coordinates, one, weights, values);
    } else {
      SoftPoints<D> points;
      points.unit = simd::all(one);
      points.locate(descriptor, chunk, i);
      (add_to_cells<D, I, Parts>(chunk, i, points, weights, values), ...);
    }
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_CELLS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Two registers' shares along one axis: their cells, the way to their partners, and who has none.
struct ShortShare {
  simd::I16 cell;
  simd::I16 step;   ///< in values; see step_left_out()
  simd::I16 alone;  ///< a mask
};

/// Between one cell and the next there is nothing but a stride: where an instruction that adds has room for a constant,
/// a partner's index is that of the lower one, and the stride goes into the constant.
[[nodiscard]] constexpr int step_left_out(const Axis& axis) noexcept {
  return simd::adds_to_memory && axis.end == Beyond::nothing ? axis.stride : 0;
}

/// `cell`: of positions as they are, also beyond the ends.
template <class Voting>
[[nodiscard]] SHORTSHOT_INLINE ShortShare short_share(const Axis& axis, simd::I16 cell, simd::I16 lower) noexcept {
  using simd::like;
  const simd::I16 on_axis = cell_on(axis, cell);
  if (axis.cells == 1) return {on_axis, like(cell, 0), like(cell, -1)};
  if (axis.end == Beyond::nothing) {
    const simd::I16 step = like(cell, axis.stride - step_left_out(axis)) - keep(lower, like(cell, 2 * axis.stride));
    return {on_axis, step, is_alone(axis, on_axis, lower)};
  }
  const bool drops_nowhere = Voting::drops_nowhere && axis.below_zero == BelowZero::nowhere;
  const simd::I16 next = next_around(axis, on_axis, minus_one_or_one(lower));
  return {on_axis, times(next - on_axis, axis.stride), drops_nowhere ? is_negative(cell) : like(cell, 0)};
}

/// Votes for a part that begins `-Begin` values before the end of the descriptor.
template <class Voting, class Part, int Begin, std::uint32_t ChunkSize>
struct ShortVotes : VoteRows<Voting, Part, std::int16_t, ChunkSize> {
  static constexpr bool goes_to_distinct_places = true;  // but for votes to partners that do not exist
  static constexpr int axis_count = Part::axis_count;
  static constexpr const Axis (&axes)[4] = Part::template axes<Part::values>;
  using ShortVotes::VoteRows::count;

  ShortVotes() noexcept {}  // else `ShortVotes()` is zeros

  /// Where index 0 of vote `k` is: at the end of all sums, or behind it.
  static constexpr int origin(int k) noexcept { return k == 0 ? 0 : step_left_out(axes[k - 1]); }

  /// The votes of two registers of neighbors, from `i` on. (Weights of the first one are stored before the second one
  /// is looked at: there are not registers enough for both.)
  template <bool First, class Chunk>
  SHORTSHOT_INLINE void cast(const Chunk& chunk, std::uint32_t i, const VoteUnit& unit) noexcept {
    simd::I32 positions[4];
    Side first[4];
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      positions[k] = position_at<k>(chunk, i);
      first[k] = Voting::side(axes[k], positions[k], unit);
    });
    cast_weights<First>(i, first, unit);
    Side second[4];
    ShortShare shares[4];
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      const simd::I32 position = position_at<k>(chunk, i + simd::lanes);
      second[k] = Voting::side(axes[k], position, unit);
      const simd::I16 cells = narrow(shift_right(positions[k], axes[k].bits), shift_right(position, axes[k].bits));
      shares[k] = short_share<Voting>(axes[k], cells, narrow(first[k].lower, second[k].lower));
    });
    cast_weights<First>(i + simd::lanes, second, unit);
    cast_indices(i, shares);
  }

 private:
  template <int K, class Chunk>
  [[nodiscard]] SHORTSHOT_INLINE static simd::I32 position_at(const Chunk& chunk, std::uint32_t i) noexcept {
    return Part::Cells::template position<typename Part::Scale>(axes[K], K, coordinate_at<Part, K>(chunk, i));
  }

  template <bool First>
  SHORTSHOT_INLINE void cast_weights(std::uint32_t i, const Side (&sides)[4], const VoteUnit& unit) noexcept {
    simd::I32 weights[static_cast<std::size_t>(count)];
    weights[0] = Voting::template weight_of_cell<axis_count>(sides, unit);
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      weights[k + 1] = Voting::weight_of_partner(k, sides, weights[0], unit);
    });
    this->template keep_weights<First>(i, weights);
  }

  SHORTSHOT_INLINE void cast_indices(std::uint32_t i, const ShortShare (&shares)[4]) noexcept {
    constexpr Axis radius = Part::template axes<1>[0], elevation = Part::template axes<1>[1],
                   azimuth = Part::template axes<1>[2];
    const simd::I16 cell = (times(shares[0].cell, radius.stride) + times(shares[1].cell, elevation.stride)) +
                           times(shares[2].cell, azimuth.stride);
    simd::I16 primary = times(cell, Part::values) + simd::like(cell, Begin);
    if constexpr (axis_count == 4) primary = primary + shares[3].cell;
    simd::store(this->index + i, primary);
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      simd::store(this->index + i + (k + 1) * ChunkSize, drop(shares[k].alone, primary + shares[k].step));
    });
  }
};

/// Room behind the end of all sums, for votes that go nowhere and for registers.
template <class... Parts>
inline constexpr int room_behind_sums = [] {
  int most = static_cast<int>(simd::lanes);
  const auto see = [&](const Axis(&axes)[4]) {
    for (const Axis& axis : axes) most = axis.stride >= most ? axis.stride + 1 : most;
  };
  (see(Parts::template axes<Parts::values>), ...);
  return most;
}();

/// Values of the sums of a descriptor with short votes; 0 if it has none: one lane, small code, other rules, a chunk of
/// less than two registers, more than 16 bits of indices.
template <std::uint32_t ChunkSize, class Voting, class... Parts>
constexpr int short_sums(Descriptor<Voting, Parts...>) noexcept {
  using D = Descriptor<Voting, Parts...>;
  constexpr bool may_be = simd::lanes > 1 && !small_code && D::is_plain && D::weight_cells == 0 && !is_soft<D>();
  if constexpr (may_be && VotesForPartners<Voting>::value && ChunkSize % (2 * simd::lanes) == 0) {
    constexpr int values = D::size + room_behind_sums<Parts...>;
    if (values <= 32768) return values;
  }
  return 0;
}

/// Sums of no vote; of the room behind them, the places where votes go.
template <class Voting, class... Parts>
SHORTSHOT_INLINE void clear_sums(Descriptor<Voting, Parts...>, float* sums) noexcept {
  using D = Descriptor<Voting, Parts...>;
  constexpr int lanes = static_cast<int>(simd::lanes);
  for (int k = 0; k < D::size; k += lanes) simd::store(sums + k, simd::all(0.0f));
  const auto clear_behind = [&](auto part) SHORTSHOT_INLINE_LAMBDA {
    using Part = decltype(part);
    unroll<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      sums[D::size + step_left_out(Part::template axes<Part::values>[k])] = 0.0f;
    });
  };
  sums[D::size] = 0.0f;
  (clear_behind(Parts{}), ...);
}

/// One chunk into the sums of all parts: what they have in common is worked out once.
template <class Voting, class... Parts, class Chunk, class First, class... Others>
SHORTSHOT_INLINE void accumulate_short_votes(Descriptor<Voting, Parts...>, const Chunk& chunk, VoteUnit unit,
                                             float* end, First&& first, Others&&... others) noexcept {
  constexpr bool one_grid = HaveOneGrid<Parts...>::value;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += 2 * simd::lanes) {
    first.template cast<true>(chunk, i, unit);
    (others.template cast<!one_grid>(chunk, i, unit), ...);
  }
  scatter<Voting, Chunk::room, one_grid>(size, end, first, others...);
}

template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void accumulate_all_short_votes(Descriptor<Voting, Parts...> descriptor,
                                                         std::index_sequence<I...>, const Chunk& chunk,
                                                         const VoteUnit& unit, float* sums) noexcept {
  using D = Descriptor<Voting, Parts...>;
  accumulate_short_votes(descriptor, chunk, unit, sums + D::size,
                         ShortVotes<Voting, Parts, D::offset(I) - D::size, Chunk::room>()...);
}

/// Bytes of a chunk, its votes and their sums.
template <std::uint32_t ChunkSize, class Voting, class... Parts>
constexpr std::size_t short_scratch_bytes(Descriptor<Voting, Parts...> descriptor) noexcept {
  using D = Descriptor<Voting, Parts...>;
  return sizeof(Chunk<typename D::Signals, ChunkSize>) + (sizeof(ShortVotes<Voting, Parts, 0, ChunkSize>) + ...) +
         sizeof(float) * static_cast<std::size_t>(short_sums<ChunkSize>(descriptor));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SHORT_VOTES_HPP

// shortshot/kernel/soft_votes.hpp: multilinear votes for parts of compact descriptors, a register of neighbors at a
// time.
//
// The four cells between which a point lies on two axes (or the four numbers that a cell of means adds up) are kept
// side by side, in a quad: one addition for four votes. Cells are so kept several times over, once for each quad they
// belong to, and brought together at the end. And every lane has quads of its own: neighbors that follow each other lie
// in the same cells, where each addition would wait for the one before.
#ifndef SHORTSHOT_KERNEL_SOFT_VOTES_HPP
#define SHORTSHOT_KERNEL_SOFT_VOTES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

using simd::Quad;

/// Votes of a register for part `I` of a descriptor, to the quads of all parts.
template <class D, std::size_t I, class Part>
struct SoftVotes : SoftShares<D, I, Part> {
  using Shares = SoftShares<D, I, Part>;
  using Shares::layout, Shares::numbers;
  static constexpr int corners = layout.corners();

  SHORTSHOT_INLINE void add(const SoftPoints<D>& points, Quad* sums) const noexcept {
    constexpr int lanes = static_cast<int>(simd::lanes);
    simd::I32 first = simd::all_int(0);  // in bytes
    unroll<layout.count>([&](auto i) {
      constexpr int bytes = layout.strides[i] * static_cast<int>(sizeof(Quad));
      first = first + simd::small_product(Shares::template between<i>(points).lower, simd::all_int(bytes));
    });
    std::uint32_t place[simd::lanes];
    simd::store(place, first);
    unsigned char* quad[simd::lanes];
    unroll<lanes>(
        [&](auto lane) { quad[lane] = reinterpret_cast<unsigned char*>(sums + lane * quads_of<D>()) + place[lane]; });
    unroll<corners * layout.of_cell>([&](auto n) {
      constexpr int corner = n / layout.of_cell;
      constexpr int q = n % layout.of_cell;
      Quad quads[simd::lanes];
      transpose(member<corner, 4 * q>(), member<corner, 4 * q + 1>(), member<corner, 4 * q + 2>(),
                member<corner, 4 * q + 3>(), quads);
      constexpr int offset = soft_quads(D{}, static_cast<int>(I)) + step(corner) + q;
      unroll<lanes>([&](auto lane) { reinterpret_cast<Quad*>(quad[lane])[offset] += quads[lane]; });
    });
  }

 private:
  /// The votes of a corner for number `K` of a cell, or for cell `K` within a quad.
  template <int Corner, int K>
  [[nodiscard]] SHORTSHOT_INLINE simd::I32 member() const noexcept {
    if constexpr (K < numbers) {
      return this->template votes<Corner, K>();
    } else if constexpr (numbers == 0 && K < 1 << layout.within) {
      return this->template votes<Corner + K * corners>();
    } else {
      return simd::all_int(0);
    }
  }
  /// From a point's first quad to that of corner `k`.
  static constexpr int step(int k) noexcept {
    int quads = 0;
    for (int i = layout.within; i < layout.count; ++i) quads += (k >> (i - layout.within) & 1) * layout.strides[i];
    return quads;
  }
};

template <class D, std::size_t I, class Part, class Chunk>
SHORTSHOT_INLINE void add_to_quads(const Chunk& chunk, std::uint32_t i, const SoftPoints<D>& points,
                                   Quad* sums) noexcept {
  SoftVotes<D, I, Part> votes;
  votes.share(points, chunk, i);
  votes.add(points, sums);
}

/// One chunk into the quads of all parts. What is beyond its end becomes points that count for nothing.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void add_soft_votes(Descriptor<Voting, Parts...> descriptor, std::index_sequence<I...>,
                                             Chunk& chunk, float one, Quad* sums) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t k = size; k % simd::lanes != 0; ++k) {
    for (int row = 0; row < Chunk::rows_of_place + Chunk::signals; ++row) {
      chunk.rows[k + static_cast<std::uint32_t>(row) * Chunk::room] = 0.0f;
    }
  }
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    SoftPoints<D> points;
    points.unit = simd::all(one);
    if (size - i < simd::lanes) points.unit = keep(simd::first(size - i), points.unit);
    points.locate(descriptor, chunk, i);
    (add_to_quads<D, I, Parts>(chunk, i, points, sums), ...);
  }
}

/// Adds a part's quads to its cells, axis by axis from the last one on. `place`: of the lower cells; `steps`: from
/// there to the upper cells within a quad.
template <class Part, int Axes>
SHORTSHOT_INLINE void gather_quads(const Quad* sums, int place, const int (&steps)[2], float* weights,
                                   float* values) noexcept {
  constexpr SoftLayout layout = soft_layout<Part>;
  if constexpr (Axes > 0) {
    constexpr int i = Axes - 1;
    constexpr SoftAxis axis = layout.axes[i];
    constexpr int size = i < layout.within ? axis.lowers() : axis.cells + (axis.is_around() ? 1 : 0);
    for (int k = 0; k < size; ++k, sums += layout.strides[i]) {
      const int upper = k + 1 == axis.cells ? 0 : k + 1;
      const int first = (k == axis.cells ? 0 : k) * axis.stride;
      int further[2] = {steps[0], steps[1]};
      if constexpr (i < layout.within) further[i] = upper * axis.stride - first;
      gather_quads<Part, i>(sums, place + first, further, weights, values);
    }
  } else if constexpr (Part::weight_cells > 0) {
    add_bits(weights + place / Part::values, sums[0][0]);
    unroll<Part::values>([&](auto k) { add_bits(values + place + k, sums[(k + 1) / 4][(k + 1) % 4]); });
  } else {
    const Quad sum = *sums;
    add_bits(values + place, sum[0]);
    if constexpr (layout.within > 0) add_bits(values + place + steps[0], sum[1]);
    if constexpr (layout.within > 1) {
      add_bits(values + place + steps[1], sum[2]);
      add_bits(values + place + steps[1] + steps[0], sum[3]);
    }
  }
}

template <class Voting, class... Parts, std::size_t... I>
inline void gather_all_quads(Descriptor<Voting, Parts...>, std::index_sequence<I...>, Quad* sums, float* weights,
                             float* values) noexcept {
  using D = Descriptor<Voting, Parts...>;
  for (int k = 0; k < quads_of<D>(); ++k) {
    unroll<static_cast<int>(simd::lanes) - 1>([&](auto lane) { sums[k] += sums[(lane + 1) * quads_of<D>() + k]; });
  }
  const int none[2] = {};
  (gather_quads<Parts, soft_layout<Parts>.count>(sums + soft_quads(D{}, static_cast<int>(I)), 0, none,
                                                 weights + D::weight_offset(I), values + D::offset(I)),
   ...);
}

/// Bytes of a chunk, of sums of votes, and of quads.
template <class D, std::uint32_t ChunkSize>
constexpr std::size_t soft_scratch_bytes() noexcept {
  constexpr auto quads = simd::lanes > 1 ? simd::lanes * static_cast<std::size_t>(quads_of<D>()) : 0;
  return sizeof(Chunk<typename D::Signals, ChunkSize>) + sizeof(float) * static_cast<std::size_t>(D::weight_cells) +
         sizeof(Quad) * quads;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SOFT_VOTES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The finest unit in which the votes of `n` neighbors can be added up, and no finer than positions are.
[[nodiscard]] inline VoteUnit vote_unit(std::uint32_t n, int position_bits, int weight_bits) noexcept {
  const int finest = fixed_point_exponent(n, weight_bits);
  const int bits = finest < position_bits ? finest : position_bits - 1;
  return {bits, std::int32_t{1} << bits};
}

/// For descriptors that are the same in all.
inline constexpr Frame any_frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};

/// The sources as the signals see them.
template <class D, class Sources, class Neighbors>
[[nodiscard]] SHORTSHOT_INLINE decltype(auto) seen_sources(const Sources& sources, const Neighbors& n,
                                                           Radius radius) noexcept {
  if constexpr (D::compares_with_mean) {
    return with_mean_color<typename D::LabRule>(sources, n, radius);
  } else {
    return (sources);
  }
}

/// A chunk into parts one by one, some of them with means.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
inline void accumulate_each(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const Chunk& chunk,
                            const VoteUnit& unit, [[maybe_unused]] float* weights, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const auto accumulate_one = [&](auto part, float* votes, float* values) {
    using Part = decltype(part);
    if constexpr (Part::weight_cells > 0) {
      accumulate_means<Voting, Part>(chunk, unit, votes, values);
    } else {
      accumulate_all(Descriptor<Voting, Part>{}, std::make_index_sequence<1>{}, chunk, unit, values);
    }
  };
  (accumulate_one(Parts{}, weights + D::weight_offset(I), out + D::offset(I)), ...);
}

/// describe() for what was checked before; `out` is all zeros, unless votes have sums of their own. (Not inlined: its
/// chunk need not be on the stack while the frame is estimated.)
template <class D, std::uint32_t ChunkSize, class Neighbors, class Sources>
[[nodiscard, gnu::noinline]] inline Status describe_checked(const Neighbors& n, const Sources& sources,
                                                            const Frame& frame, Radius radius, float* out) noexcept {
  using Signals = typename D::Signals;
  constexpr auto parts = std::make_index_sequence<D::parts>{};
  if (!D::Cells::has_enough(n, radius)) return Status::too_few_neighbors;
  const VoteUnit unit = vote_unit(n.size, D::position_bits, D::Voting::weight_bits);
  const auto& seen = seen_sources<D>(sources, n, radius);
  const auto of_place = signals_of_place<Signals>(seen);
  float weights[static_cast<std::size_t>(D::weight_cells + 1)] = {};  // an array has one or more
  Chunk<Signals, ChunkSize> chunk;
  constexpr bool has_quads = is_soft<D>() && simd::lanes > 1;
  [[maybe_unused]] Quad quads[has_quads ? simd::lanes * static_cast<std::size_t>(quads_of<D>()) : 1];
  if constexpr (has_quads) std::memset(quads, 0, sizeof quads);
  constexpr bool has_short_votes = short_sums<ChunkSize>(D{}) > 0;
  [[maybe_unused]] float own_sums[static_cast<std::size_t>(short_sums<ChunkSize>(D{}) + 1)];
  if constexpr (has_short_votes) clear_sums(D{}, own_sums);
  for (std::uint32_t i = 0; i * ChunkSize < n.size; ++i) {
    locate<typename D::Cells, typename D::ShellBorders>(n, stretches_of_chunk<ChunkSize>(i, n.size), frame, radius,
                                                        of_place, chunk);
    measure_all_by_index(Signals{}, seen, chunk);
    if constexpr (has_quads) {
      add_soft_votes(D{}, parts, chunk, static_cast<float>(unit.one), quads);
    } else if constexpr (is_soft<D>()) {
      add_soft_points(D{}, parts, chunk, static_cast<float>(unit.one), weights, out);
    } else if constexpr (has_short_votes) {
      accumulate_all_short_votes(D{}, parts, chunk, unit, own_sums);
    } else if constexpr (D::is_plain) {
      accumulate_all(D{}, parts, chunk, unit, out);
    } else {
      accumulate_each(D{}, parts, chunk, unit, weights, out);
    }
  }
  if constexpr (has_quads) gather_all_quads(D{}, parts, quads, weights, out);
  return finish(D{}, parts, has_short_votes ? own_sums : out, out, weights);
}

/// The first status that is not ok of those sources that D reads.
template <class... Kinds, class Sources>
[[nodiscard]] inline Status status_of(extend::SourceKinds<Kinds...>, const Sources& sources) noexcept {
  Status status = Status::ok;
  ((status = status == Status::ok ? source_of<Kinds>(sources).status() : status), ...);
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Neighbors that go through the kernel together: of that length are all arrays that it has on the stack. A template
/// parameter of describe() and describe_at(), any multiple of simd::lanes: it changes speed and memory, no result.
inline constexpr std::uint32_t default_chunk_size = extend::simd::lanes == 1 ? 16 : 128;

/// Bytes of those arrays, and of the sums (of compact descriptors: quads) that the kernel keeps for itself where there
/// are lanes.
template <class D, std::uint32_t ChunkSize = default_chunk_size>
inline constexpr std::size_t chunk_bytes = [] {
  if constexpr (detail::is_soft<D>()) {
    return detail::soft_scratch_bytes<D, ChunkSize>();
  } else if constexpr (detail::short_sums<ChunkSize>(D{}) > 0) {
    return detail::short_scratch_bytes<ChunkSize>(D{});
  } else {
    return detail::scratch_bytes<ChunkSize>(D{});
  }
}();

/// Describe a gathered neighborhood in a frame: the kernel of every descriptor.
///
/// `n`        neighbors of one key point, gathered with at least `radius` (farther ones are left out); if they do not
///            come from a search, d2 must be that of dx, dy and dz, and the indices must be ones that the sources have
/// `sources`  what D's signals read, in any order: sources(LabColors{...}, CloudNormals(cloud)), a source alone, or
///            sources() if they read nothing. A neighbor for which one of them has no value is left out
/// `frame`    an orthonormal frame: estimate_frame(), or one you know. Not looked at unless D::needs_frame
/// `out`      D::size floats: the parts of D in order, L2 norm 1
///
/// Source: SSH and SCSH: paper, equations (4), (6) and (7), with cells, shares and roundings as in the published code.
/// SHOT and CSHOT: PCL 1.13's SHOTEstimation and SHOTColorEstimation. The rules are in conventions.hpp and voting.hpp.
/// Statuses: bad_radius, bad_frame, what the sources say (missing_colors, missing_normals, missing_intensities),
/// too_many_neighbors (over 2^24), too_few_neighbors (none to describe; for SHOT and CSHOT also fewer than five, the
/// key point and its copies included); `out` is all zeros then, and never NaN. No allocation; reentrant;
/// chunk_bytes<D, ChunkSize> of stack and half a kilobyte more. The result depends neither on the order of the
/// neighbors nor on ChunkSize: what is done for a neighbor depends on no other, and sums are integers.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Neighbors, class... Own>
[[nodiscard]] inline Status describe(const Neighbors& n, const extend::SourceSet<Own...>& sources, const Frame& frame,
                                     Radius radius, float* out) noexcept {
  constexpr bool has_all = detail::has_sources(typename D::Sources{}, static_cast<extend::SourceSet<Own...>*>(nullptr));
  static_assert(
      has_all,
      "describe() needs a source for each of D's signals: RgbColors or LabColors for ColorDistance, CloudNormals "
      "for NormalCosine, CloudIntensities for Intensity, and your own for your own");
  constexpr bool has_own_sums = detail::short_sums<ChunkSize>(D{}) > 0;
  if (!has_own_sums) std::memset(out, 0, D::size_bytes);
  Status status = validate(radius);
  if (status == Status::ok && D::needs_frame) status = validate(frame);
  if constexpr (has_all) {
    if (status == Status::ok) status = detail::status_of(typename D::Sources{}, sources);
    if (status == Status::ok && n.size > max_neighbors) status = Status::too_many_neighbors;
    const Frame& used = D::needs_frame ? frame : detail::any_frame;
    if (status == Status::ok) status = detail::describe_checked<D, ChunkSize>(n, sources, used, radius, out);
  }
  if (has_own_sums && status != Status::ok) std::memset(out, 0, D::size_bytes);
  return status;
}

/// The same with one source.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Neighbors, class Source>
[[nodiscard]] inline Status describe(const Neighbors& n, const Source& source, const Frame& frame, Radius radius,
                                     float* out) noexcept {
  return describe<D, ChunkSize>(n, sources(source), frame, radius, out);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_KERNEL_DESCRIBE_HPP

// shortshot/kernel/support.hpp: what is described around a key point.
#ifndef SHORTSHOT_KERNEL_SUPPORT_HPP
#define SHORTSHOT_KERNEL_SUPPORT_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What is described around a key point. Converts from a radius: `0.04f` is a support of 4 cm in SHOT's own frame.
struct Support {
  Radius radius;        ///< of the descriptor
  Radius frame_radius;  ///< of the local reference frame (LRF); may be smaller or larger
  Viewpoint viewpoint;  ///< turns the frames' z

  /// The same radius for descriptor and frame; no viewpoint.
  [[gnu::always_inline]] constexpr Support(Radius r) noexcept  // NOLINT: see above
      : radius(r), frame_radius(r) {}
  [[gnu::always_inline]] constexpr Support(float r) noexcept : Support(Radius(r)) {}  // NOLINT: see above
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The larger of the two radii.
[[nodiscard]] inline Radius gather_radius(const Support& support) noexcept {
  return support.frame_radius.squared > support.radius.squared ? support.frame_radius : support.radius;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SUPPORT_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Can this cloud be described by D with this search and support? All that can be said before the first key point.
template <class D, class Search>
[[nodiscard, gnu::always_inline]] inline Status validate(const CloudView& cloud, const Search& search,
                                                         const Support& support) noexcept {
  Status status = detail::validate_search(cloud, search);
  if (status == Status::ok) status = validate(support.radius);
  if (status == Status::ok) status = validate(support.frame_radius);
  if (status == Status::ok) status = validate(support.viewpoint);
  if (status == Status::ok && D::needs_colors && !has_colors(cloud)) status = Status::missing_colors;
  if (status == Status::ok && D::needs_normals && !has_normals(cloud)) status = Status::missing_normals;
  if (status == Status::ok && D::needs_intensities && !has_intensities(cloud)) status = Status::missing_intensities;
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// How far neighbors matter: none for a frame that D does not need.
template <class D>
[[nodiscard]] inline Radius reach_of(const Support& support) noexcept {
  return D::needs_frame ? gather_radius(support) : support.radius;
}

/// Frame and kernel of a neighborhood around `center`; for `confidence` see frame_of(). The arguments were validated
/// before. Where D needs no frame, `frame` and `confidence` stay what they are.
template <class D, std::uint32_t ChunkSize, class Neighbors, class Sources, class... Confidence>
[[nodiscard]] inline Status describe_gathered(const Neighbors& n, const Sources& sources, const Point& center,
                                              const Support& support, Frame& frame, float* out,
                                              Confidence&... confidence) noexcept {
  if constexpr (!D::needs_frame) {
    return describe_checked<D, ChunkSize>(n, sources, any_frame, support.radius, out);
  } else {
    float view[3];
    Status status = direction_at(support.viewpoint, center, view);
    if (status == Status::ok) status = frame_of(n, support.frame_radius, view, frame, confidence...);
    if (status != Status::ok) return status;
    return describe_checked<D, ChunkSize>(n, sources, frame, support.radius, out);
  }
}

template <class Kind, class = void>
struct IsMadeOfCloud : std::false_type {};
template <class Kind>
struct IsMadeOfCloud<Kind,
                     std::void_t<decltype(Kind::at(std::declval<const CloudView&>(), std::declval<const KeyPoint&>()))>>
    : std::true_type {};

/// The source of one kind at a key point: made of the cloud, or the first of the caller's own that stands for it. An
/// array of the whole cloud's colors, converted before, stands for colors.
template <class Kind, class Key>
[[nodiscard]] inline auto source_at(const CloudView& cloud, const Key& key) noexcept {
  static_assert(IsMadeOfCloud<Kind>::value,
                "D has a signal whose source is not made of the cloud: it supports sources of yours as last arguments");
  return Kind::at(cloud, key);
}
template <class Kind, class Key, class First, class... Own>
[[nodiscard]] inline auto source_at(const CloudView& cloud, const Key& key, const First& first,
                                    const Own&... own) noexcept {
  if constexpr (StandsFor<Kind, First>::value) {
    return first;
  } else if constexpr (std::is_pointer<std::decay_t<First>>::value && channel_of<Kind> == Channel::colors) {
    using Color = std::remove_const_t<std::remove_pointer_t<std::decay_t<First>>>;
    const Lab reference = reference_at<typename Kind::Rule>(key);
    const Color* const colors = first;
    return StoredColors<Color>{key.has_color ? colors : nullptr, reference};
  } else {
    return source_at<Kind>(cloud, key, own...);
  }
}

/// All sources of a descriptor at a key point.
template <class... Kinds, class Key, class... Own>
[[nodiscard]] inline auto sources_at(extend::SourceKinds<Kinds...>, const CloudView& cloud, const Key& key,
                                     const Own&... own) noexcept {
  return sources(source_at<Kinds>(cloud, key, own...)...);
}

/// A key point of describe_at(), by index or as it is, with what D needs of it.
template <class D, class Place>
[[nodiscard]] inline Status find_key(const CloudView& cloud, const Place& place, KeyPoint& key) noexcept {
  if constexpr (std::is_integral<Place>::value) {
    if (!is_index(cloud, place)) return Status::bad_keypoint;
    const auto index = static_cast<std::size_t>(place);
    key.position = point(cloud, index);
    key.has_color = D::needs_colors;
    key.has_intensity = D::needs_intensities;
    if constexpr (D::needs_colors && !D::compares_with_mean) key.color = color(cloud, index);
    if constexpr (D::needs_intensities) key.intensity = intensity(cloud, index);
  } else {
    key = place;
  }
  return Status::ok;
}

/// A key point as D's sources see it: where colors are compared with their mean, its own may be missing.
template <class D>
[[nodiscard, gnu::always_inline]] inline decltype(auto) key_for(const KeyPoint& key) noexcept {
  if constexpr (D::compares_with_mean) {
    KeyWithoutColor seen(key);
    seen.has_color = true;
    return seen;
  } else {
    return (key);
  }
}

/// Everything up to the gathered neighborhood; finish(neighborhood, sources, position) makes the descriptor of it.
template <class D, class Search, class Place, class Memory, class Finish, class... Own>
[[nodiscard, gnu::always_inline]] inline Status describe_key(const CloudView& cloud, const Search& search,
                                                             const Place& place, const Support& support,
                                                             Memory& workspace, float* out, const Finish& finish,
                                                             const Own&... own) noexcept {
  std::memset(out, 0, D::size_bytes);
  KeyPoint key;
  Status status = validate<D>(cloud, search, support);
  if (status == Status::ok) status = find_key<D>(cloud, place, key);
  if (status == Status::ok && !is_finite(key.position)) status = Status::invalid_keypoint;
  if (status != Status::ok) return status;
  const auto sources = sources_at(typename D::Sources{}, cloud, key_for<D>(key), own...);
  auto n = neighborhood_in(workspace, cloud);
  status = status_of(typename D::Sources{}, sources);
  if (status == Status::ok) status = search.gather(key.position, reach_of<D>(support), n);
  return status == Status::ok ? finish(n, sources, key.position) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describe one key point of a cloud, given by its index or as a KeyPoint.
///
/// `search`     any search over this cloud
/// `support`    radii and, if known, the camera's position; a plain float is the radius in meters
/// `workspace`  a Workspace<MaxNeighbors> or a CompactWorkspace<MaxNeighbors>: all the memory there is
/// `out`        D::size floats: the descriptor, L2 norm 1, or all zeros if the status is not ok
/// `own`        sources of yours for D's signals, which come before those that the cloud has; a pointer to colors
///              (Lab or PackedLab), one per point, that convert_colors() made by D's own rule: without them, bytes of
///              neighbors are converted again for every key point
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint,
/// missing_colors, missing_normals, missing_intensities (of the cloud or the key point), bad_keypoint (the index),
/// invalid_keypoint, too_many_neighbors (the workspace is too small: Neighborhood::found of a gather() says what it
/// takes), too_few_neighbors, ambiguous_frame; and what the search's build() returned, if not ok. If D needs no frame
/// (D::needs_frame), none is estimated: no ambiguous_frame, and one neighbor is enough. No allocation; reentrant, one
/// workspace per thread.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Search, class Place = KeyPoint, class Memory,
          class... Own>
[[nodiscard, gnu::always_inline]] inline Status describe_at(const CloudView& cloud, const Search& search,
                                                            const Place& place, const Support& support,
                                                            Memory& workspace, float* out, const Own&... own) noexcept {
  return detail::describe_key<D>(
      cloud, search, place, support, workspace, out,
      [&](const auto& n, const auto& sources, const Point& position) __attribute__((always_inline)) {
        Frame frame;
        return detail::describe_gathered<D, ChunkSize>(n, sources, position, support, frame, out);
      },
      own...);
}

/// The same in a frame that the caller knows; bad_frame if it is not orthonormal.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Search, class Place = KeyPoint, class Memory,
          class... Own>
[[nodiscard, gnu::always_inline]] inline Status describe_at(const CloudView& cloud, const Search& search,
                                                            const Place& place, const Frame& frame, Radius radius,
                                                            Memory& workspace, float* out, const Own&... own) noexcept {
  return detail::describe_key<D>(
      cloud, search, place, radius, workspace, out,
      [&](const auto& n, const auto& sources, const Point&)
          __attribute__((always_inline)) { return describe<D, ChunkSize>(n, sources, frame, radius, out); },
      own...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_KERNEL_DESCRIBE_AT_HPP

// shortshot/search/cell_sort.hpp: a cloud's points sorted into the cells of a box, and the search among them.
#ifndef SHORTSHOT_SEARCH_CELL_SORT_HPP
#define SHORTSHOT_SEARCH_CELL_SORT_HPP

// shortshot/search/cell_box.hpp: the box of cells under a grid search, of bounded size whatever the cloud.
#ifndef SHORTSHOT_SEARCH_CELL_BOX_HPP
#define SHORTSHOT_SEARCH_CELL_BOX_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Smallest and largest coordinate along each axis.
struct Extent {
  float low[3];
  float high[3];
};

/// Extent of the valid points; returns how many there are.
[[nodiscard]] inline std::size_t measure(const CloudView& cloud, Extent& extent) noexcept {
  constexpr float most = 3.402823466e38f;
  if constexpr (simd::lanes == 1) {
    extent = {{most, most, most}, {-most, -most, -most}};
    std::size_t valid_points = 0;
    for_each_valid(cloud, [&](std::size_t, const Point& p) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float v = coordinate(p, axis);
        if (v < extent.low[axis]) extent.low[axis] = v;
        if (v > extent.high[axis]) extent.high[axis] = v;
      }
      ++valid_points;
    });
    return valid_points;
  }
  simd::F32 low[3] = {simd::all(most), simd::all(most), simd::all(most)};
  simd::F32 high[3] = {simd::all(-most), simd::all(-most), simd::all(-most)};
  simd::I32 valid_points{};
  for_each_valid_register(cloud, [&](std::size_t, const PointLanes& p, simd::Mask valid) {
    const simd::F32 v[3] = {p.x, p.y, p.z};
    unroll<3>([&](auto axis) {
      low[axis] = min(select(valid, v[axis], low[axis]), low[axis]);
      high[axis] = max(select(valid, v[axis], high[axis]), high[axis]);
    });
    valid_points = increment(valid, valid_points);
  });
  for (int axis = 0; axis < 3; ++axis) {
    extent.low[axis] = 0.0f - simd::largest(simd::all(0.0f) - low[axis]);
    extent.high[axis] = simd::largest(high[axis]);
  }
  return static_cast<std::uint32_t>(sum(valid_points));
}

/// First and last cell of a range, both inside the box.
struct CellRange {
  std::uint32_t first;
  std::uint32_t last;
};

/// Cubic cells, x fastest. Coordinates outside the box belong to its outermost cells: since that map never decreases,
/// a range of coordinates always maps to a range of cells, and no box is too small to be right.
struct GridBox {
  float low[3];
  float rounding[3];  ///< more than rounding can move a cell's edge, in meters
  float cell_size;
  float cells_per_meter;
  float last[3];  ///< dims - 1
  std::uint32_t dims[3];

  [[nodiscard]] std::uint32_t cell(int axis, float v) const noexcept {
    const float position = (v - low[axis]) * cells_per_meter;
    const float inside = position > 0.0f ? position : 0.0f;  // NaN, too
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(inside < last[axis] ? inside : last[axis]));
  }

  [[nodiscard]] CellRange range(int axis, float center, float reach) const noexcept {
    return {cell(axis, center - reach), cell(axis, center + reach)};
  }

  /// How far `v` is at least from the points of a cell; 0 in its own cell. Outermost cells have no outer edge, but it
  /// is always the edge towards v that counts.
  [[nodiscard]] float gap(int axis, float v, std::uint32_t other) const noexcept {
    const std::uint32_t own = cell(axis, v);
    if (other == own) return 0.0f;
    const float near_edge = low[axis] + unfused(static_cast<float>(other < own ? other + 1 : other) * cell_size);
    const float distance = (other < own ? v - near_edge : near_edge - v) - rounding[axis];
    return distance > 0.0f ? distance : 0.0f;
  }

  /// To be called before gap() and crosses().
  void note_rounding(const Extent& extent) noexcept {
    const auto magnitude = [](float v) { return v < 0.0f ? 0.0f - v : v; };
    for (int axis = 0; axis < 3; ++axis) {
      // A dozen roundings of numbers as large as the coordinates.
      rounding[axis] = 1e-6f * (magnitude(extent.low[axis]) + magnitude(extent.high[axis]));
    }
  }

  /// Does a sphere reach a row of cells? `half_chord` is half of what they can have in common.
  [[nodiscard]] bool crosses(const Point& center, std::uint32_t y, std::uint32_t z, float reach,
                             float& half_chord) const noexcept {
    const float gap_y = gap(1, center.y, y);
    const float gap_z = gap(2, center.z, z);
    const float squared = (unfused(reach * reach) - unfused(gap_y * gap_y)) - unfused(gap_z * gap_z);
    if (!(squared >= 0.0f)) return false;
    half_chord = simd::sqrt(squared);
    return true;
  }

  [[nodiscard]] std::size_t row(std::uint32_t y, std::uint32_t z) const noexcept {
    return (static_cast<std::size_t>(z) * dims[1] + y) * dims[0];
  }

  [[nodiscard]] std::size_t cell_of(const Point& p) const noexcept {
    return row(cell(1, p.y), cell(2, p.z)) + cell(0, p.x);
  }

  /// The cells of a register of points; those of points that are not valid mean nothing.
  [[nodiscard]] simd::I32 cells_of(const PointLanes& p) const noexcept {
    const auto along = [this](int axis, simd::F32 v) {
      const simd::F32 position = (v - simd::all(low[axis])) * simd::all(cells_per_meter);
      return truncate_to_int(min(max(position, simd::all(0.0f)), simd::all(last[axis])));
    };
    const auto stride = [this](int axis) { return simd::all_int(static_cast<std::int32_t>(dims[axis])); };
    return product(product(along(2, p.z), stride(1)) + along(1, p.y), stride(0)) + along(0, p.x);
  }

  /// Cells of half the size, over the same box.
  void halve_cells() noexcept {
    cell_size *= 0.5f;
    cells_per_meter *= 2.0f;
    for (int axis = 0; axis < 3; ++axis) {
      dims[axis] *= 2;
      last[axis] = static_cast<float>(dims[axis] - 1);
    }
  }

  [[nodiscard]] std::size_t cells() const noexcept { return static_cast<std::size_t>(dims[0]) * dims[1] * dims[2]; }
};

/// Cells along each axis for an extent of any size; false if together they would be more than `capacity`.
[[nodiscard]] inline bool count_cells(const Extent& extent, float cell_size, std::size_t capacity,
                                      std::uint32_t (&dims)[3]) noexcept {
  std::size_t room = capacity < 0x7FFFFFFFu ? capacity : 0x7FFFFFFFu;
  for (int axis = 0; axis < 3; ++axis) {
    const float cells = (extent.high[axis] - extent.low[axis]) / cell_size + 1.0f;
    if (!(cells < 8388608.0f)) return false;  // float counts them exactly, and twice as many
    dims[axis] = static_cast<std::uint32_t>(cells);
    room /= dims[axis];
    if (room == 0) return false;
  }
  return true;
}

/// Slices of an extent along some of its axes, and how many points lie in each: of 64 slices those at either end that
/// together hold at most 1 point in 128 can be cut off.
template <class Index>
class ThinEnds {
 public:
  static constexpr int slices = 64;

  /// Counts the valid points of a cloud along the axes from `first` on, as many as `counts` has room for; looks at all
  /// points.
  void count(const CloudView& cloud, const Extent& extent, std::size_t first, Index* counts,
             std::size_t room) noexcept {
    first_ = first;
    end_ = 3 * std::size_t{slices} <= room ? 3 : first + 1;
    counts_ = counts;
    simd::F32 low[3], width[3];
    for (std::size_t axis = first; axis < end_; ++axis) {
      width_[axis] = extent.high[axis] / slices - extent.low[axis] / slices;  // finite, whatever the extent
      low[axis] = simd::all(extent.low[axis]);
      width[axis] = simd::all(width_[axis] > 0.0f ? width_[axis] : 1.0f);
      for (int s = 0; s < slices; ++s) at(axis)[s] = 0;
    }
    for_each_valid_register(cloud, [&](std::size_t, const PointLanes& p, simd::Mask valid) {
      const simd::F32 v[3] = {p.x, p.y, p.z};
      const simd::Packing packing = simd::packing(valid);
      for (std::size_t axis = first_; axis < end_; ++axis) {
        const simd::F32 slice = (v[axis] - low[axis]) / width[axis];
        std::uint32_t slice_of[simd::lanes];
        simd::store(slice_of, truncate_to_int(min(max(slice, simd::all(0.0f)), simd::all(slices - 1.0f))), packing);
        for (std::uint32_t k = 0; k < packing.count; ++k) ++at(axis)[slice_of[k]];
      }
    });
  }

  [[nodiscard]] bool has_counted(std::size_t axis) const noexcept { return first_ <= axis && axis < end_; }

  /// Cuts thin ends off an axis that was counted. Returns whether that at least halved the extent, which is when
  /// another round is worth while.
  [[nodiscard]] bool cut(std::size_t valid, std::size_t axis, Extent& extent) const noexcept {
    const float width = width_[axis];
    if (!(width > 0.0f)) return false;
    const Index* const counts = at(axis);
    int first = 0;
    int last = slices - 1;
    std::size_t below = counts[first];
    std::size_t above = counts[last];
    for (; below <= valid / 128 && first < last; below += counts[first]) ++first;
    for (; above <= valid / 128 && first < last; above += counts[last]) --last;
    const float low = extent.low[axis];
    const auto begin_of = [&](int slice) {
      const float half = unfused(static_cast<float>(slice) * (0.5f * width));
      return (low + half) + half;
    };
    extent.low[axis] = begin_of(first);
    extent.high[axis] = begin_of(last + 1);
    return 2 * (last + 1 - first) <= slices;
  }

 private:
  [[nodiscard]] Index* at(std::size_t axis) const noexcept { return counts_ + (axis - first_) * slices; }

  Index* counts_ = nullptr;
  std::size_t first_ = 0, end_ = 0;  ///< axes
  float width_[3] = {};
};

/// Where the cells of an extent are more than `capacity`: cut thinly populated ends off it. `scratch` has as many
/// elements and is free to be written.
template <class Index>
inline void leave_outliers_out(const CloudView& cloud, std::size_t valid, float cell_size, Index* scratch,
                               std::size_t capacity, Extent& extent) noexcept {
  std::uint32_t dims[3];
  ThinEnds<Index> ends;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A round divides the extent by up to 64: two dozen span all of float's range.
    for (int round = 0; round < 24 && capacity >= ThinEnds<Index>::slices; ++round) {
      if (count_cells(extent, cell_size, capacity, dims)) return;
      if (round > 0 || !ends.has_counted(axis)) ends.count(cloud, extent, axis, scratch, capacity);
      if (!ends.cut(valid, axis, extent)) break;
    }
  }
}

/// A box of at most `capacity` cells, which may become larger than `cell_size`.
inline void fit_box(const Extent& extent, float cell_size, std::size_t capacity, GridBox& box) noexcept {
  bool fits = false;
  for (; !(fits = count_cells(extent, cell_size, capacity, box.dims)) && cell_size < 1e37f; cell_size *= 1.25f) {
  }

  box.cell_size = cell_size;
  box.cells_per_meter = 1.0f / cell_size;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = extent.low[axis];
    if (!fits) box.dims[axis] = 1;  // an extent of all of float's range
    box.last[axis] = static_cast<float>(box.dims[axis] - 1);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_CELL_BOX_HPP

// shortshot/search/offer.hpp: how a search fills a neighborhood, and the one rule of who belongs to it.
#ifndef SHORTSHOT_SEARCH_OFFER_HPP
#define SHORTSHOT_SEARCH_OFFER_HPP

// shortshot/base/quiet.hpp: comparisons with NaN that are no invalid operation, for programs that trap those.
//
// What is promised: FE_INVALID and FE_DIVBYZERO are raised by no function of the library, FE_OVERFLOW only where points
// lie farther apart than 1e19. Arithmetic with NaN is quiet by itself; <, min() and max() are not.
#ifndef SHORTSHOT_BASE_QUIET_HPP
#define SHORTSHOT_BASE_QUIET_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// a < b, false with NaN. Where comparisons are calls, there is nothing to trap, and the quiet one would be two.
[[nodiscard, gnu::always_inline]] inline bool is_below(float a, float b) noexcept {
#if defined(__SSE__) || defined(__aarch64__)
  return __builtin_isless(a, b);
#else
  return a < b;
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_QUIET_HPP

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// To be called by a search before it offers the first point: an empty neighborhood around `center`.
template <class Neighbors>
inline void clear(Neighbors& out, const Point& center) noexcept {
  out.center = center;
  out.size = 0;
  out.found = 0;
}

/// Write down neighbor `i`.
inline void put(Neighborhood& n, std::uint32_t i, const Neighbor& v) noexcept {
  n.dx[i] = v.dx;
  n.dy[i] = v.dy;
  n.dz[i] = v.dz;
  n.d2[i] = v.d2;
  n.index[i] = v.index;
}
template <class Index>
inline void put(CompactNeighborhood<Index>& n, std::uint32_t i, const Neighbor& v) noexcept {
  n.index[i] = static_cast<Index>(v.index);
}

/// Offer one point of the cloud to the neighborhood: THE membership rule, for every search. A point is a neighbor if
/// its float squared distance is strictly below `radius_squared`; written so that NaN is refused.
template <class Neighbors>
inline void offer(Neighbors& out, const Point& p, std::uint32_t index, const Point& center,
                  float radius_squared) noexcept {
  const Neighbor v = neighbor_from(center, p, index);
  if (!detail::is_below(v.d2, radius_squared)) return;
  if (out.size < out.capacity) put(out, out.size++, v);
  ++out.found;
}

/// To be returned by a search after it has offered the last point.
template <class Neighbors>
[[nodiscard]] inline Status outcome(const Neighbors& out) noexcept {
  return out.found > out.capacity ? Status::too_many_neighbors : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_SEARCH_OFFER_HPP

// shortshot/search/offer_run.hpp: a run of points offered to a neighborhood, a register of them at a time.
#ifndef SHORTSHOT_SEARCH_OFFER_RUN_HPP
#define SHORTSHOT_SEARCH_OFFER_RUN_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points in an order of their own: all x, then all y, then all z; and where they stand in the cloud.
template <class Index>
struct SortedPoints {
  const float* xyz;
  const Index* order;
  std::size_t size;
};

/// The places in the cloud of a register of points.
template <class Index>
[[nodiscard]] inline simd::I32 load_order(const Index* index) noexcept {
  if constexpr (sizeof(Index) == sizeof(std::uint32_t)) {
    return simd::load(index);
  } else {
    std::uint32_t wide[simd::lanes];
    for (std::size_t k = 0; k < simd::lanes; ++k) wide[k] = index[k];
    return simd::load(wide);
  }
}

/// offer() for the points [i, end).
template <class Index, class Neighbors>
inline void offer_one_by_one(const SortedPoints<Index>& points, std::size_t i, std::size_t end, const Point& center,
                             float radius_squared, Neighbors& out) noexcept {
  const float* const x = points.xyz;
  const std::size_t n = points.size;
  for (; i < end; ++i) offer(out, {x[i], x[n + i], x[2 * n + i]}, points.order[i], center, radius_squared);
}

template <class Index, class Neighbors>
inline void offer_run(const SortedPoints<Index>& points, std::size_t i, std::size_t end, const Point& center,
                      float radius_squared, Neighbors& out) noexcept {
  offer_one_by_one(points, i, end, center, radius_squared, out);
}

template <class Index>
inline void offer_run(const SortedPoints<Index>& points, std::size_t i, std::size_t end, const Point& center,
                      float radius_squared, Neighborhood& out) noexcept {
  const std::size_t n = points.size;
  const float* const x = points.xyz;
  const Index* const order = points.order;
  // Whole registers are read up to the end of the points, and written up to the capacity.
  const bool roomy = simd::lanes > 1 && end + simd::lanes <= n && out.capacity - out.size >= end - i + simd::lanes;
  if (!roomy) {
    offer_one_by_one(points, i, end, center, radius_squared, out);
    return;
  }
  const Neighborhood to = out;
  const simd::F32 center_x = simd::all(center.x);
  const simd::F32 center_y = simd::all(center.y);
  const simd::F32 center_z = simd::all(center.z);
  const simd::F32 limit = simd::all(radius_squared);
  simd::Mask candidates = simd::first(simd::lanes);
  std::uint32_t size = to.size;
  // No branch on who is inside: that is settled by the flip of a coin at every border of the sphere.
  for (; i < end; i += simd::lanes) {
    if (end - i < simd::lanes) candidates = simd::first(end - i);
    const simd::F32 dx = simd::load(x + i) - center_x;
    const simd::F32 dy = simd::load(x + n + i) - center_y;
    const simd::F32 dz = simd::load(x + 2 * n + i) - center_z;
    const simd::F32 d2 = (dx * dx + dy * dy) + dz * dz;
    const simd::Packing inside = simd::packing((d2 < limit) & candidates);
    simd::store(to.dx + size, dx, inside);
    simd::store(to.dy + size, dy, inside);
    simd::store(to.dz + size, dz, inside);
    simd::store(to.d2 + size, d2, inside);
    simd::store(to.index + size, load_order(order + i), inside);
    size += inside.count;
  }
  out.found += size - out.size;
  out.size = size;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_OFFER_RUN_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Memory of a GridIndex, borrowed from the caller: `point_capacity` elements of `order`, `cell_capacity` of
/// `cell_end`. `xyz`, if not null, has 3 * point_capacity floats and receives the sorted points' coordinates, all x,
/// then all y, then all z: runs of neighbors are then tested in lanes. Without it every point is read through the
/// view.
template <class Index>
struct GridMemory {
  Index* order;                ///< the points' indices, cell by cell
  Index* cell_end;             ///< where each cell's points end
  float* xyz;                  ///< null: none
  std::size_t point_capacity;  ///< of order
  std::size_t cell_capacity;   ///< of cell_end
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a search reads of a grid's memory.
template <class Index>
struct GridContents {
  const Index* order;
  const Index* cell_end;
  const float* xyz;
};

/// What a grid knows besides its memory, which is handed to it at every call: an owner of both can be copied. A `Small`
/// one takes a third of the flash: it has no `xyz`, looks at a cube of cells for a sphere, and makes its cells larger
/// where they do not fit.
template <class Index, bool Small = false>
class Grid {
 public:
  using Memory = GridMemory<Index>;
  using Contents = GridContents<Index>;

  [[nodiscard]] Status build(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    const Status status = plan(cloud, cell_size, memory);
    if (status == Status::ok) sort(cloud, memory);
    return status;
  }

  /// The first half of build(): settles the box of cells. Of the memory only cell_end is touched.
  [[nodiscard]] Status plan(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    points_ = 0;
    channel_ = cloud.points;
    cloud_size_ = cloud.size;
    status_ = fit(cloud, cell_size, memory);
    return status_;
  }

  /// Between the halves: eight cells for each one.
  void halve_cells() noexcept { box_.halve_cells(); }

  /// The second half, a counting sort: count per cell, turn counts into ends of the cells before, and let each placed
  /// point move its cell's end forward to where it belongs.
  void sort(const CloudView& cloud, const Memory& memory) const noexcept {
    if constexpr (Small) {
      sort_by_two_passes(cloud, memory);
      return;
    }
    const Memory to = memory;  // a local, see Collector; so below
    const std::size_t cells = box_.cells();
    const bool roomy = to.xyz != nullptr && points_ >= 2 * simd::lanes;
    const CellNotes notes{roomy ? to.xyz : nullptr, points_};
    if (roomy) note_cells(cloud, notes);
    for (std::size_t c = 0; c < cells; ++c) to.cell_end[c] = 0;
    for_each_cell(cloud, notes, [&](std::size_t, std::size_t cell) { ++to.cell_end[cell]; });
    counts_to_begins(to.cell_end, cells);
    for_each_cell(cloud, notes, [&](std::size_t index, std::size_t cell) {
      to.order[to.cell_end[cell]++] = static_cast<Index>(index);
    });
    if (to.xyz != nullptr) copy_points(to.order, to.xyz);
  }

  [[nodiscard]] Status status() const noexcept {
    return points_ == 0 && status_ == Status::ok ? Status::empty_cloud : status_;
  }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return cloud_size_; }
  [[nodiscard]] std::size_t size() const noexcept { return points_; }
  [[nodiscard]] std::size_t cells() const noexcept { return box_.cells(); }

  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] Status gather(const Contents& contents, const Point& center, Radius radius,
                                                  Neighbors& out) const noexcept {
    clear(out, center);
    if (status() != Status::ok) return status();
    if (!is_finite(center)) return Status::ok;
    Collector<Neighbors> found = out;
    // The margin covers the rounding of d2, of the gaps and of the chord: each row gets all cells it needs.
    const float reach = unfused(radius.value * 1.000002f);
    const CellRange y = box_.range(1, center.y, reach);
    const CellRange z = box_.range(2, center.z, reach);
    CellRange x = box_.range(0, center.x, reach);
    for (std::uint32_t cz = z.first; cz <= z.last; ++cz) {
      for (std::uint32_t cy = y.first; cy <= y.last; ++cy) {
        if constexpr (!Small) {
          float half_chord = 0.0f;
          if (!box_.crosses(center, cy, cz, reach, half_chord)) continue;
          x = box_.range(0, center.x, half_chord);
        }
        const std::size_t row = box_.row(cy, cz);
        offer_cells(contents, row + x.first, row + x.last, center, radius.squared, found);
      }
    }
    out = found;
    return outcome(out);
  }

 private:
  /// From the counts of cells to where each of them begins.
  static void counts_to_begins(Index* cell_end, std::size_t cells) noexcept {
    Index begin = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      const Index count = cell_end[c];
      cell_end[c] = begin;
      begin = static_cast<Index>(begin + count);
    }
  }

  /// sort() in less flash: one loop over the points counts, and the same one places.
  void sort_by_two_passes(const CloudView& cloud, const Memory& to) const noexcept {
    const std::size_t cells = box_.cells();
    std::memset(to.cell_end, 0, cells * sizeof(Index));
    for (int pass = 0; pass < 2; ++pass) {
      for_each_valid(cloud, [&](std::size_t index, const Point& p) {
        Index& end = to.cell_end[box_.cell_of(p)];
        if (pass == 1) to.order[end] = static_cast<Index>(index);
        ++end;
      });
      if (pass == 0) counts_to_begins(to.cell_end, cells);
    }
  }

  [[nodiscard]] Status fit(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    const Status usable = validate(cloud);
    if (usable != Status::ok) return usable;
    if (validate(Radius(cell_size)) != Status::ok) return Status::bad_radius;
    if (memory.cell_capacity == 0) return Status::out_of_memory;

    Extent extent;
    const std::size_t valid = measure(cloud, extent);
    if (valid == 0) return Status::empty_cloud;
    constexpr std::size_t most = static_cast<Index>(~Index{0});
    if (valid > memory.point_capacity || cloud.size > most) return Status::out_of_memory;

    if constexpr (!Small) leave_outliers_out(cloud, valid, cell_size, memory.cell_end, memory.cell_capacity, extent);
    fit_box(extent, cell_size, memory.cell_capacity, box_);
    if constexpr (!Small) box_.note_rounding(extent);
    points_ = valid;
    return Status::ok;
  }

  /// The cell of each valid point and its place in the cloud, so that cells are worked out once: integers, kept where
  /// the coordinates will be. The cells are the first third; the places end a register's length before the last
  /// third does, because lanes are packed by stores of whole registers.
  struct CellNotes {
    float* cells;  ///< null if there is no room
    std::size_t size;
    [[nodiscard]] float* places() const noexcept { return cells + 2 * size - simd::lanes; }
  };

  void note_cells(const CloudView& cloud, const CellNotes& notes) const noexcept {
    const GridBox box = box_;
    float* cell = notes.cells;
    float* place = notes.places();
    std::uint32_t lane_numbers[simd::lanes];
    for (std::uint32_t k = 0; k < simd::lanes; ++k) lane_numbers[k] = k;
    const simd::I32 lane = simd::load(lane_numbers);
    for_each_valid_register(cloud, [&](std::size_t i, const PointLanes& points, simd::Mask valid) {
      const simd::Packing packing = simd::packing(valid);
      const simd::I32 index = simd::all_int(static_cast<std::int32_t>(i)) + lane;
      simd::store(cell, simd::from_bits(box.cells_of(points)), packing);
      simd::store(place, simd::from_bits(index), packing);
      cell += packing.count;
      place += packing.count;
    });
  }

  /// Calls f(index, cell) for each valid point, in order.
  template <class Function>
  void for_each_cell(const CloudView& cloud, const CellNotes& notes, Function f) const noexcept {
    if (notes.cells == nullptr) {
      const GridBox box = box_;
      for_each_valid(cloud, [&](std::size_t index, const Point& p) { f(index, box.cell_of(p)); });
      return;
    }
    const auto integer = [](const float* note) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, note, sizeof bits);
      return bits;
    };
    const float* const places = notes.places();
    for (std::size_t k = 0; k < notes.size; ++k) f(integer(places + k), integer(notes.cells + k));
  }

  /// The points' coordinates, in their new order.
  void copy_points(const Index* order, float* xyz) const noexcept {
    const std::size_t n = points_;
    std::size_t i = 0;
    for (; i + simd::lanes <= n; i += simd::lanes) {
      const PointLanes p = read_lanes(channel_, [&](std::size_t lane) { return order[i + lane]; });
      simd::store(xyz + i, p.x);
      simd::store(xyz + n + i, p.y);
      simd::store(xyz + 2 * n + i, p.z);
    }
    for (; i < n; ++i) {
      const Point p = read(channel_, order[i]);
      xyz[i] = p.x;
      xyz[n + i] = p.y;
      xyz[2 * n + i] = p.z;
    }
  }

  /// cell_end[c] is where cell c ends in `order`; it begins where the cell before it ends.
  [[nodiscard]] static std::size_t begin_of(const Contents& contents, std::size_t cell) noexcept {
    return cell == 0 ? 0 : contents.cell_end[cell - 1];
  }

  /// Cells that follow each other are one run of points.
  template <class Neighbors>
  void offer_cells(const Contents& contents, std::size_t first, std::size_t last, const Point& center,
                   float radius_squared, Neighbors& out) const noexcept {
    const std::size_t begin = begin_of(contents, first);
    const std::size_t end = contents.cell_end[last];
    if constexpr (!Small) {
      if (contents.xyz != nullptr && begin < end) {
        offer_run<Index>({contents.xyz, contents.order, points_}, begin, end, center, radius_squared, out);
        return;
      }
    }
    for (std::size_t i = begin; i < end; ++i) {
      offer(out, read(channel_, contents.order[i]), contents.order[i], center, radius_squared);
    }
  }

  Float3Channel channel_;  // the cloud's points, borrowed
  std::size_t cloud_size_;
  GridBox box_;
  std::size_t points_;
  Status status_;
};

/// A grid's gather() as a function of its own.
template <class Index, class Neighbors>
[[nodiscard]] inline Status gather_from(const Grid<Index>& grid, const GridContents<Index>& contents,
                                        const Point& center, Radius radius, Neighbors& out) noexcept {
  return grid.gather(contents, center, radius, out);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_CELL_SORT_HPP

#endif  // SHORTSHOT_DISPATCH_HOT_KERNEL_HPP
#if !defined(SHORTSHOT_FOR_AVX2)  // the single header reads itself up to here (dispatch/kernel_for_avx2.hpp)

// shortshot/kernel.hpp: the part for firmware: no heap, no exceptions, no RTTI, no double, no static initializer, no
// libm (but sqrtf on cores without a floating-point unit). Needs `<array>`, `<cstddef>`, `<cstdint>`, `<cstring>`,
// `<type_traits>` and `<utility>` of the standard library.
#ifndef SHORTSHOT_KERNEL_HPP
#define SHORTSHOT_KERNEL_HPP

// shortshot/frame/fixed_lamp_frame.hpp: frames whose x axis points to where a surface is brighter. A function of its
// own: who does not call it has no byte of it.
#ifndef SHORTSHOT_FRAME_FIXED_LAMP_FRAME_HPP
#define SHORTSHOT_FRAME_FIXED_LAMP_FRAME_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Sums over the members, as integers: of weights w = 1 - |v| / R, of w L, and of both times 4 v / R (so that no term
/// is above the scale), with L from 0 to 1.
struct BrightnessSums {
  float weight, light;
  float offset[3], light_offset[3];
};

template <class Neighbors, class Colors>
[[nodiscard]] inline BrightnessSums brightness_sums(const Neighbors& n, const Colors& colors, Radius radius) noexcept {
  using simd::all;
  using simd::F32;
  const F32 zero = all(0.0f);
  const F32 inverse = all(1.0f / radius.value);
  const F32 scale = all(fixed_point_scale(n.size));
  simd::I32 weights{}, lights{}, offsets[3] = {}, light_offsets[3] = {};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    std::uint32_t index[simd::lanes];
    simd::store(index, v.index);
    const F32 own = extend::colors_at(colors, index).L;
    const F32 light = simd::max(simd::min(own, all(100.0f)), zero) * all(0.01f);
    const simd::Mask member = within(v, radius) & (simd::abs(v.dx) + simd::abs(v.dy) + simd::abs(v.dz) > zero);
    const F32 weight = keep(member, (all(1.0f) - simd::sqrt(v.d2) * inverse) * scale);
    weights = weights + round_to_int(weight);
    lights = lights + round_to_int(weight * light);
    const F32 at[3] = {v.dx, v.dy, v.dz};
    each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      const F32 weighted = weight * (at[k] * inverse * all(4.0f));
      offsets[k] = offsets[k] + round_to_int(weighted);
      light_offsets[k] = light_offsets[k] + round_to_int(weighted * light);
    });
  }
  BrightnessSums sums{static_cast<float>(sum(weights)), static_cast<float>(sum(lights)), {}, {}};
  each<3>([&](auto k) {
    sums.offset[k] = static_cast<float>(sum(offsets[k]));
    sums.light_offset[k] = static_cast<float>(sum(light_offsets[k]));
  });
  return sums;
}

/// Turns x and y of a frame about z, until x points to where it is brighter; if that is nowhere, they stay.
template <class Neighbors, class Colors>
inline void turn_to_brightness(const Neighbors& n, const Colors& colors, Radius radius, Frame& frame) noexcept {
  const BrightnessSums sums = brightness_sums(n, colors, radius);
  if (!(sums.weight > 0.0f)) return;
  const float mean = sums.light / sums.weight;
  float gradient[3], tangent[3];
  for (int k = 0; k < 3; ++k) gradient[k] = sums.light_offset[k] - unfused(mean * sums.offset[k]);
  const float upwards = dot(gradient, frame.z);
  for (int k = 0; k < 3; ++k) tangent[k] = gradient[k] - unfused(upwards * frame.z[k]);

  // What the rounding of the members to integers may have made of no gradient; and of one straight along z.
  const float resolution = unfused(8.0f * static_cast<float>(n.size));
  const float length = simd::sqrt(dot(tangent, tangent));
  if (!(length > resolution + unfused(1e-3f * simd::sqrt(dot(gradient, gradient))))) return;
  for (int k = 0; k < 3; ++k) frame.x[k] = tangent[k] / length;
  set_y(frame);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A local reference frame for things that stay under their lamp: z is that of estimate_frame(), x points to where the
/// surface is brighter, y = z cross x. **A lamp that moves turns it**, and so do shadows. Where two views of an object
/// have the same light it is found again more often than SHOT's frame, whose x follows the shape alone; in rooms, and
/// for recognition, less often. (In a study with the means of 8 cells' colors, 80 of 100 key points were found again
/// under the same lamp, and 57 after it had moved.) Its brightness is CIELAB's L: a gain of all channels changes
/// little.
///
/// x is the projection on the tangent plane, of length 1, of the sum of (R - |v|) (L - mean L) v over the members,
/// where the mean has the weights R - |v| too. If that is 0 but for rounding (all colors are equal, or the gradient is
/// along z), x and y are those of estimate_frame().
///
/// `colors`     of the neighbors by index: RgbColors, LabColors, PackedColors or what else gives a Lab; the reference
///              is not looked at
/// `radius`     the frame's own; it may be smaller than the one the neighborhood was gathered with
/// `viewpoint`  turns z; compact descriptors want one
///
/// Statuses: missing_colors, and those of estimate_frame(); `frame` is zeroed then. No allocation, reentrant. The
/// result does not depend on the order of the neighbors, and has the same bits on every machine. describe() and
/// describe_at() take the frame, extract() one for each key point: "How to add a frame" in include/shortshot/README.md
/// has the loop.
template <class Neighbors, class Colors>
[[nodiscard]] inline Status estimate_frame_under_fixed_lamp(const Neighbors& n, const Colors& colors, Radius radius,
                                                            Frame& frame, const Viewpoint& viewpoint = {}) noexcept {
  frame = Frame{};
  Status status = colors.status();
  if (status == Status::ok) status = estimate_frame(n, radius, frame, viewpoint);
  if (status == Status::ok) detail::turn_to_brightness(n, colors, radius, frame);
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_FRAME_FIXED_LAMP_FRAME_HPP

// shortshot/recognition/learned_objects.hpp: objects that are learned where they are seen, in memory that survives: a
// log of models of one object each (see flash_model.hpp), behind the model that was trained on a PC.
//
// A model's codewords are written as they come, then its names, its header, and its checksum at last: it is there with
// the last unit of that, or not at all. Where one ends, or was torn, the next one begins. All begin with a unit, so
// they are found by looking at each: at the first 8 characters, and if these are right, at the checksum.
#ifndef SHORTSHOT_RECOGNITION_LEARNED_OBJECTS_HPP
#define SHORTSHOT_RECOGNITION_LEARNED_OBJECTS_HPP

// shortshot/frame/local_point.hpp: a point as a frame sees it.
#ifndef SHORTSHOT_FRAME_LOCAL_POINT_HPP
#define SHORTSHOT_FRAME_LOCAL_POINT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A point in a frame's coordinates, and back.
[[nodiscard]] inline Point to_local(const Point& p, const Point& origin, const Frame& frame) noexcept {
  const float offset[3] = {p.x - origin.x, p.y - origin.y, p.z - origin.z};
  return {dot(frame.x, offset), dot(frame.y, offset), dot(frame.z, offset)};
}
[[nodiscard]] inline Point from_local(const Point& p, const Point& origin, const Frame& frame) noexcept {
  const auto component = [&](int k) {
    return (unfused(p.x * frame.x[k]) + unfused(p.y * frame.y[k])) + unfused(p.z * frame.z[k]);
  };
  return {origin.x + component(0), origin.y + component(1), origin.z + component(2)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_FRAME_LOCAL_POINT_HPP

// shortshot/store/checksum.hpp: by which damage is noticed: 64-bit FNV-1a.
//
// FNV-1a is three lines, and each of its steps is a bijection: no single wrong byte goes unnoticed, and other damage
// does once in 2^64 times. It is no protection from who means harm; nobody believes a number because of it.
#ifndef SHORTSHOT_STORE_CHECKSUM_HPP
#define SHORTSHOT_STORE_CHECKSUM_HPP

// shortshot/base/fnv1a.hpp: 64-bit FNV-1a, a number for a sequence of bytes.
#ifndef SHORTSHOT_BASE_FNV1A_HPP
#define SHORTSHOT_BASE_FNV1A_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::uint64_t fnv1a_of_nothing = 0xCBF29CE484222325u;

/// Of what has `hash`, and another byte behind it.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::uint64_t hash, std::uint8_t byte) noexcept {
  return (hash ^ byte) * 0x100000001B3u;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BASE_FNV1A_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t checksum_bytes = 8;

/// `hash`: that of all bytes before these.
[[nodiscard]] inline std::uint64_t checksum(const std::uint8_t* bytes, std::size_t size,
                                            std::uint64_t hash = fnv1a_of_nothing) noexcept {
  for (std::size_t i = 0; i < size; ++i) hash = fnv1a(hash, bytes[i]);
  return hash;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_STORE_CHECKSUM_HPP

// shortshot/store/storage.hpp: what the storages of a descriptor have in common: how they are made, and what they are
// called.
#ifndef SHORTSHOT_STORE_STORAGE_HPP
#define SHORTSHOT_STORE_STORAGE_HPP

// shortshot/descriptor/layout_text.hpp: what the values of a descriptor mean, in English: for files, and for code that
// knows descriptors only at run time. What becomes of the text is up to whom it is told to: a string (layout_of.hpp),
// or a number (LayoutNumber), which needs no memory.
#ifndef SHORTSHOT_DESCRIPTOR_LAYOUT_TEXT_HPP
#define SHORTSHOT_DESCRIPTOR_LAYOUT_TEXT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Policy, class = void>
struct HasName : std::false_type {};
template <class Policy>
struct HasName<Policy, std::enable_if_t<std::is_convertible<decltype(Policy::name), const char*>::value>>
    : std::true_type {};

/// A text's pieces, one after the other, to whoever has add(const char*).
template <class Text>
constexpr void add(Text& text, const char* piece) {
  text.add(piece);
}
template <class Text>
constexpr void add(Text& text, int number) {
  char digits[12] = {};
  char* first = digits + 11;
  for (; number >= 10; number /= 10) *--first = static_cast<char>('0' + number % 10);
  *--first = static_cast<char>('0' + number);
  text.add(first);
}
template <class Text, class... Pieces>
constexpr void add_all(Text& text, Pieces... pieces) {
  (add(text, pieces), ...);
}

template <class Policy>
[[nodiscard]] constexpr const char* name_of() noexcept {
  static_assert(HasName<Policy>::value,
                "layout_of<D>() supports policies with `static constexpr const char* name`, which must tell them from "
                "all others");
  return Policy::name;
}

/// What a radius scale's name leaves open.
template <class Scale>
struct ScaleParameters {
  template <class Text>
  static constexpr void add_to(Text&) {}
};
template <int Numerator, int Denominator>
struct ScaleParameters<LogRadius<Numerator, Denominator>> {
  template <class Text>
  static constexpr void add_to(Text& text) {
    constexpr int common = std::gcd(Numerator, Denominator);
    add_all(text, " from ", Numerator / common, "/", Denominator / common);
  }
};

/// What a part's finish says of itself; nothing where sums are its values.
template <class Finish>
struct FinishText {
  template <class Text>
  static constexpr void add_to(Text& text) {
    add_all(text, ", ", name_of<Finish>());
  }
};
template <>
struct FinishText<PlainSums> {
  template <class Text>
  static constexpr void add_to(Text&) {}
};
template <int PerMille>
struct FinishText<RootOfShares<PerMille>> {
  template <class Text>
  static constexpr void add_to(Text& text) {
    add_all(text, ", ", name_of<RootOfShares<PerMille>>(), ", length ", PerMille, "/1000");
  }
};
template <int PerMille, int FloorPercent, int NoisePerMille>
struct FinishText<SignedRoots<PerMille, FloorPercent, NoisePerMille>> {
  template <class Text>
  static constexpr void add_to(Text& text) {
    add_all(text, ", ", name_of<SignedRoots<PerMille, FloorPercent, NoisePerMille>>(), ", length ", PerMille,
            "/1000, floor ", FloorPercent, "/100, noise ", NoisePerMille, "/1000");
  }
};

template <class Signal, class Text>
constexpr void add_color(Text& text) {
  if constexpr (!std::is_void<typename Signal::Rule>::value) {
    add_all(text, " (", name_of<typename Signal::Rule>());
    if constexpr (std::is_same<typename Signal::Reference, MeanColor>::value)
      add_all(text, " from ", name_of<MeanColor>());
    add(text, ")");
  }
}

template <class Text, class First, class... Others>
constexpr void add_means(Text& text, SignalList<First, Others...>) {
  add_all(text, "means of ", name_of<First>());
  (add_all(text, " & ", name_of<Others>()), ...);
  add_color<First>(text);
}

template <class Part, class Text>
constexpr void add_part(Text& text) {
  using Grid = typename Part::Grid;
  if constexpr (Part::weight_cells > 0) {
    add_means(text, typename Part::Averaged{});
    add_all(text, " shrunk by ", Part::shrink_percent, "/100");
  } else {
    using Signal = typename Part::Signal;
    add(text, name_of<Signal>());
    if constexpr (Signal::has_histogram) add_all(text, " ", Signal::bins, " bins");
    add_color<Signal>(text);
  }
  add_all(text, " ", Grid::radial, "x", Grid::elevation, "x", Grid::azimuth, " ", name_of<typename Part::Scale>());
  ScaleParameters<typename Part::Scale>::add_to(text);
  FinishText<typename Part::Finish>::add_to(text);
}

/// What D's values mean: see layout_of().
template <class Text, class Voting, class... Parts>
constexpr void add_layout(Text& text, const Descriptor<Voting, Parts...>*) {
  add_all(text, name_of<Voting>(), ", ", name_of<typename Descriptor<Voting, Parts...>::Cells>());
  const char* separator = ": ";
  ((add(text, separator), add_part<Parts>(text), separator = " | "), ...);
}

/// A text as a number.
struct LayoutNumber {
  std::uint64_t value = fnv1a_of_nothing;
  constexpr void add(const char* piece) noexcept {
    for (; *piece != '\0'; ++piece) value = fnv1a(value, static_cast<std::uint8_t>(*piece));
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_DESCRIPTOR_LAYOUT_TEXT_HPP

// shortshot/store/binary.hpp: B-SHOT: one bit for each value of a descriptor, and the distance between such bits.
//
// After S. M. Prakhya, B. Liu, W. Lin: B-SHOT: A binary feature descriptor for fast and efficient keypoint matching on
// 3D point clouds (IROS 2015): the values are taken in groups of four, and the bits of a group say which few of its
// values make up more than 90 % of their sum.
#ifndef SHORTSHOT_STORE_BINARY_HPP
#define SHORTSHOT_STORE_BINARY_HPP

// shortshot/store/hamming.hpp: the number of bits in which rows of bytes differ.
#ifndef SHORTSHOT_STORE_HAMMING_HPP
#define SHORTSHOT_STORE_HAMMING_HPP

// shortshot/base/simd_halves.hpp: two numbers in a register of 32 bits: the DSP instructions of Cortex-M4 and later.
#ifndef SHORTSHOT_BASE_SIMD_HALVES_HPP
#define SHORTSHOT_BASE_SIMD_HALVES_HPP

#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32) && (defined(__clang__) || __GNUC__ >= 10)
#define SHORTSHOT_HAS_HALVES
#include <arm_acle.h>
#endif

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// Is it worth a loop of its own?
#if defined(SHORTSHOT_HAS_HALVES)
inline constexpr bool has_halves = true;
#else
inline constexpr bool has_halves = false;
#endif

/// `sum` and the squared differences of the four bytes of a and b.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_squared_differences(std::uint32_t a, std::uint32_t b,
                                                                               std::uint32_t sum) noexcept {
#if defined(SHORTSHOT_HAS_HALVES)
#if defined(__clang__)
  using Bytes = int8x4_t;  // its header says so; GCC's has the sign of the instruction
#else
  using Bytes = uint8x4_t;
#endif
  const auto halves = [](std::uint32_t v) { return static_cast<uint16x2_t>(__uxtb16(static_cast<Bytes>(v))); };
  const auto even = static_cast<std::int32_t>(__usub16(halves(a), halves(b)));
  const auto odd = static_cast<std::int32_t>(__usub16(halves(a >> 8), halves(b >> 8)));
  const std::int32_t half = __smlad(even, even, static_cast<std::int32_t>(sum));  // sums wrap, as unsigned ones do
  return static_cast<std::uint32_t>(__smlad(odd, odd, half));
#else
  for (int shift = 0; shift < 32; shift += 8) {
    const auto difference = static_cast<std::int32_t>(a >> shift & 255u) - static_cast<std::int32_t>(b >> shift & 255u);
    sum += static_cast<std::uint32_t>(difference * difference);
  }
  return sum;
#endif
}

/// `sum` and the four bytes of a.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_bytes(std::uint32_t a, std::uint32_t sum) noexcept {
#if defined(SHORTSHOT_HAS_HALVES)
  return __usada8(static_cast<uint8x4_t>(a), 0, sum);
#else
  for (int shift = 0; shift < 32; shift += 8) sum += a >> shift & 255u;
  return sum;
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
#endif  // SHORTSHOT_BASE_SIMD_HALVES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// All ones, divided by this: a one in every field of so many bits.
inline constexpr std::size_t all_ones = ~std::size_t{0};

/// The bits of a word of which every second field of `Bits` bits is made. (As an assembly statement's they are not
/// known to be that: what is left when they are taken away is a subtraction, and shifted as it is added, for which
/// Thumb has an instruction. It has none that masks what it shifts.)
template <int Bits>
[[nodiscard, gnu::always_inline]] inline std::size_t every_second(std::size_t word) noexcept {
  std::size_t low = word & all_ones / ((std::size_t{1} << Bits) + 1);
  __asm__("" : "+r"(low));
  return low;
}

/// The sums of a word's fields of `Bits` bits, two by two.
template <int Bits>
[[nodiscard, gnu::always_inline]] inline std::size_t sums_of_two(std::size_t word) noexcept {
  const std::size_t low = every_second<Bits>(word);
  return low + ((word - low) >> Bits);
}

/// `sum` and a word's bytes, which are less than 256 together.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_all_bytes(std::size_t word, std::uint32_t sum) noexcept {
  if constexpr (simd::has_halves) return simd::add_bytes(static_cast<std::uint32_t>(word), sum);
  return sum + static_cast<std::uint32_t>(word * (all_ones / 255) >> (8 * (sizeof word - 1)));
}

/// `sum` and the ones of three words: those of the third are added to the pairs of the others.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_ones(std::size_t a, std::size_t b, std::size_t c,
                                                                std::uint32_t sum) noexcept {
  const std::size_t low = every_second<1>(c);
  const std::size_t fours =
      sums_of_two<2>(sums_of_two<1>(a) + low) + sums_of_two<2>(sums_of_two<1>(b) + ((c - low) >> 1));
  return add_all_bytes(sums_of_two<4>(fours), sum);
}

/// Ones in a word. __builtin_popcount is a call to the compiler's library where the CPU has no instruction for it.
[[nodiscard, gnu::always_inline]] inline int count_ones(std::size_t word) noexcept {
#if defined(__POPCNT__) || defined(__aarch64__)
  return __builtin_popcountll(word);
#else
  return static_cast<int>(add_all_bytes(sums_of_two<4>(sums_of_two<2>(sums_of_two<1>(word))), 0));
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Number of bits that differ (0 to 8 * size_bytes) in two arrays of `size_bytes` bytes of any alignment. No
/// allocation, no error, reentrant. Always in line: a copy compiled with the instruction for counting ones must not
/// serve a translation unit compiled without.
[[nodiscard, gnu::always_inline]] inline int hamming_distance(const std::uint8_t* a, const std::uint8_t* b,
                                                              std::size_t size_bytes) noexcept {
  using Word = std::size_t;
  int distance = 0;
  const auto add = [&](std::size_t i, std::size_t length) {
    Word of_a = 0, of_b = 0;
    std::memcpy(&of_a, a + i, length);
    std::memcpy(&of_b, b + i, length);
    distance += detail::count_ones(of_a ^ of_b);
  };
  const std::size_t rest = size_bytes % sizeof(Word);
  for (std::size_t i = 0; i < size_bytes - rest; i += sizeof(Word)) add(i, sizeof(Word));
  if (rest != 0) add(size_bytes - rest, rest);
  return distance;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The number of bits in which rows differ, if that is below the limit; else a number that is not. Three words at a
/// time, whose ones are added up before they are counted to the end: then it is known whether going on is of use.
[[nodiscard]] SHORTSHOT_INLINE std::uint32_t hamming_distance_below(const std::uint8_t* a, const std::uint8_t* b,
                                                                    std::size_t size_bytes,
                                                                    std::uint32_t limit) noexcept {
  using Word = std::size_t;
  constexpr std::size_t words = 3;
  const auto differing = [&](std::size_t i) {
    Word of_a, of_b;
    std::memcpy(&of_a, a + i, sizeof(Word));
    std::memcpy(&of_b, b + i, sizeof(Word));
    return of_a ^ of_b;
  };
  std::uint32_t distance = 0;
  std::size_t i = 0;
  for (; i + words * sizeof(Word) <= size_bytes; i += words * sizeof(Word)) {
    distance = add_ones(differing(i), differing(i + sizeof(Word)), differing(i + 2 * sizeof(Word)), distance);
    if (distance >= limit) return distance;
  }
  return distance + static_cast<std::uint32_t>(hamming_distance(a + i, b + i, size_bytes - i));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_STORE_HAMMING_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D of D::size values as as many bits: bit j is bit j % 8 of byte j / 8, the bits behind the last one are
/// zero. A trivial type of alignment 1: 44 bytes for SHOT-352. `Group` values (2 to 8; 4 in the paper) are looked at
/// together.
template <class D, int Group = 4>
struct BinaryDescriptor {
  static_assert(Group >= 2 && Group <= 8, "BinaryDescriptor<D, Group> supports groups of 2 to 8 values");
  static constexpr int bits = D::size;                                                 ///< one per value
  static constexpr std::size_t size_bytes = (static_cast<std::size_t>(bits) + 7) / 8;  ///< of all bits
  std::uint8_t bytes[size_bytes];  ///< bit j is bit j % 8 of byte j / 8
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// All subsets of a group, the one that B-SHOT prefers last: the whole group, then those that are tried, from the last
/// one to the first, then the empty one. Bit i of a subset stands for value i.
///
/// Fewer values are tried first. Of as many values, the subsets that rotating the group turns into each other follow
/// each other, in the order of the smallest number among them: the smaller it is, the closer together are the values.
/// That one is the first of them, and each rotation by one place the next.
///
/// For four values this is the order that B-SHOT's authors published, but for {1, 3}, which they try before {0, 2}: of
/// values that are not negative, two disjoint subsets never both have more than 90 %.
template <int Group>
struct Subsets {
  static constexpr int count = 1 << Group;
  static constexpr unsigned whole = (1u << Group) - 1u;
  std::uint8_t of[static_cast<std::size_t>(count)];

  constexpr Subsets() noexcept : of{} {
    int place = count - 1;  // of the empty one
    for (int values = 1; values <= Group; ++values) {
      for (unsigned smallest = 1; smallest <= whole; ++smallest) {
        if (values_of(smallest) != values || !is_smallest(smallest)) continue;
        unsigned subset = smallest;
        do {
          of[--place] = static_cast<std::uint8_t>(subset);
          subset = rotated(subset);
        } while (subset != smallest);
      }
    }
  }

  /// How many subsets have more than `values` values: the place of the last one tried of those with as many.
  static constexpr int larger_than(int values) noexcept {
    int larger = 0;
    for (unsigned subset = 1; subset <= whole; ++subset) larger += values_of(subset) > values ? 1 : 0;
    return larger;
  }
  static constexpr unsigned rotated(unsigned subset) noexcept { return (subset << 1 | subset >> (Group - 1)) & whole; }
  static constexpr int values_of(unsigned subset) noexcept {
    int values = 0;
    for (; subset != 0; subset &= subset - 1) ++values;
    return values;
  }
  static constexpr bool is_smallest(unsigned subset) noexcept {
    unsigned other = rotated(subset);
    while (other > subset) other = rotated(other);
    return other == subset;
  }
};
template <int Group>
inline constexpr Subsets<Group> subsets{};

/// Sum of a subset of `values`, the first two first.
template <unsigned Subset>
[[nodiscard, gnu::always_inline]] inline simd::F32 sum_of(const simd::F32* values) noexcept {
  constexpr int last = [] {
    int i = 0;
    while (Subset >> i > 1u) ++i;
    return i;
  }();
  constexpr unsigned others = Subset - (1u << last);
  if constexpr (others == 0) {
    return values[last];
  } else {
    return sum_of<others>(values) + values[last];
  }
}

/// The largest float that is not above 0.9 * sum, for sums from 0: a float is above the one if it is above the other.
/// (The authors compare with that product in double, whose own rounding never moves it to or across a float.)
/// The float product is this number or the next one, because 0.9f is less than half a unit of the product too small. It
/// is the next one if ten times the rest is below the sum. Neither difference is rounded: no term is more than twice
/// the other, or all are subnormal.
[[nodiscard]] inline simd::F32 nine_tenths(simd::F32 sum) noexcept {
  const simd::F32 product = sum * simd::all(0.9f);
  const simd::F32 rest = sum - product;
  const simd::Mask above = sum - rest * simd::all(8.0f) > rest + rest;
  return simd::from_bits(simd::bits_of(product) - simd::keep(above, simd::all_int(1)));
}

/// Where `found` is 0, the place in subsets<Group>.of of the subset of `Values` values or more that is tried first of
/// those with a sum above the limit; else `found`. Most groups of SHOT are zero or have one large value: no more is
/// tried than some lane needs.
template <int Group, int Values>
[[nodiscard, gnu::always_inline]] inline simd::I32 find_subsets(const simd::F32* v, simd::F32 limit,
                                                                simd::I32 found) noexcept {
  if constexpr (Values == Group) {
    return found;
  } else {
    constexpr int first = Subsets<Group>::larger_than(Values);
    unroll<Subsets<Group>::larger_than(Values - 1) - first>([&](auto k) {
      constexpr int place = first + k;
      const simd::Mask enough = sum_of<subsets<Group>.of[place]>(v) > limit;
      found = simd::small_max(found, simd::keep(enough, simd::all_int(place)));
    });
    return any(found == simd::all_int(0)) ? find_subsets<Group, Values + 1>(v, limit, found) : found;
  }
}

/// The places in subsets<Group>.of of as many groups as there are lanes, one group after the other from `values` on.
template <int Group>
[[gnu::always_inline]] inline void find_subsets(const float* values, std::int32_t* places) noexcept {
  constexpr auto stride = static_cast<std::size_t>(Group);
  simd::F32 v[static_cast<std::size_t>(Group)];
  unroll<Group>([&](auto i) { v[i] = simd::from_lanes([&](std::size_t k) { return values[k * stride + i]; }); });
  const simd::F32 sum = sum_of<Subsets<Group>::whole>(v);
  const simd::I32 empty = simd::drop(sum != simd::all(0.0f), simd::all_int(Subsets<Group>::count - 1));
  simd::store(places, find_subsets<Group, 1>(v, nine_tenths(sum), empty));
}

/// The bits of eight groups: as many bytes as a group has values.
template <int Group>
inline void binarize_groups(const float* values, std::uint8_t* bytes) noexcept {
  std::int32_t places[8];
  for (std::size_t group = 0; group < 8; group += simd::lanes) {
    find_subsets<Group>(values + group * static_cast<std::size_t>(Group), places + group);
  }
  unroll<Group>([&](auto byte) {
    unsigned bits = 0;
    unroll<8>([&](auto group) {
      constexpr int shift = group * Group - byte * 8;
      if constexpr (shift > -Group && shift < 8) {
        const unsigned subset = subsets<Group>.of[places[group]];
        bits |= shift < 0 ? subset >> -shift : subset << shift;
      }
    });
    bytes[byte] = static_cast<std::uint8_t>(bits & 0xFFu);
  });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The B-SHOT of D::size descriptor values (not negative, of any scale: only ratios count). In each group of `Group`
/// consecutive values, with S their sum: no bits if all are zero; else the bits of the first subset, in the order of
/// detail::Subsets (single values, then pairs, ...), whose sum is more than 0.9 S; all bits if there is none, which
/// includes a group with a NaN. If D::size is no multiple of Group, the last group is filled up with zeros, which have
/// no bits in `out`.
///
/// The sums are added from left to right in single precision, and the comparisons decide as the authors' in double do:
/// with Group = 4 the bits are theirs. No allocation, no error, reentrant.
template <class D, int Group = 4>
void binarize(const float* values, BinaryDescriptor<D, Group>& out) noexcept {
  constexpr std::size_t bytes = Group;  // of eight groups
  constexpr std::size_t size = D::size;
  constexpr std::size_t rest = size % (8 * bytes);
  std::uint8_t* to = out.bytes;
  for (std::size_t i = 0; i < size - rest; i += 8 * bytes, to += bytes) detail::binarize_groups<Group>(values + i, to);
  if constexpr (rest != 0) {
    float last_values[8 * bytes] = {};
    std::uint8_t last_bytes[bytes];
    std::memcpy(last_values, values + size - rest, rest * sizeof(float));
    detail::binarize_groups<Group>(last_values, last_bytes);
    if constexpr (rest % 8 != 0) last_bytes[rest / 8] &= static_cast<std::uint8_t>((1u << rest % 8) - 1u);
    std::memcpy(to, last_bytes, (rest + 7) / 8);
  }
}

/// Number of bits in which two binary descriptors differ, 0 to D::size.
template <class D, int Group>
[[nodiscard, gnu::always_inline]] inline int hamming_distance(const BinaryDescriptor<D, Group>& a,
                                                              const BinaryDescriptor<D, Group>& b) noexcept {
  return hamming_distance(a.bytes, b.bytes, sizeof a.bytes);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_STORE_BINARY_HPP

// shortshot/store/code_scale.hpp: how fine the steps of coded descriptors are, for each descriptor.
#ifndef SHORTSHOT_STORE_CODE_SCALE_HPP
#define SHORTSHOT_STORE_CODE_SCALE_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Steps in 1 for the values of D in codes of `Bits` bits. By default for the published descriptors: 512 in 8 bits; in
/// 4 bits 32, their values are seldom above 15 / 32; in 3 bits so many that the same values are cut off as in 4 bits.
/// Specialize it for your own, as below.
template <class D, int Bits>
inline constexpr int code_scale = Bits == 8 ? 512 : 32;
template <class D>
inline constexpr int code_scale<D, 3> = (7 * code_scale<D, 4> + 7) / 15;

/// Compact descriptors in 4 bits: measured.
template <>
inline constexpr int code_scale<ShapeColor95, 4> = 50;
template <>
inline constexpr int code_scale<RoomColor95, 4> = 50;
template <>
inline constexpr int code_scale<ShapeColor32, 4> = 40;
template <>
inline constexpr int code_scale<HeightShape96, 4> = 60;
template <>
inline constexpr int code_scale<ColorRings27, 4> = 50;

/// And in 8 bits: no value is cut off. The whole is at least sqrt(1 + 1.5^2) = 1.80 times as long as where points are,
/// and as 1.5 for colors: values without a sign are below 1 / 1.8 = 0.56 and 0.866 / 1.5 = 0.58, those with one below
/// 0.62 / 1.8 = 0.35 (no color is farther than 3.3 times 60 from another one), which is 127 / 360. HeightShape96 may
/// have a 1.
template <>
inline constexpr int code_scale<ShapeColor95, 8> = 360;
template <>
inline constexpr int code_scale<RoomColor95, 8> = 360;
template <>
inline constexpr int code_scale<ShapeColor32, 8> = 360;
template <>
inline constexpr int code_scale<HeightShape96, 8> = 255;
template <>
inline constexpr int code_scale<ColorRings27, 8> = 360;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot
#endif  // SHORTSHOT_STORE_CODE_SCALE_HPP

// shortshot/store/coded.hpp: a descriptor in 8, 4 or 3 bits a value, and the distance between such.
#ifndef SHORTSHOT_STORE_CODED_HPP
#define SHORTSHOT_STORE_CODED_HPP

// shortshot/store/code_distance.hpp: numbers of a few bits one behind the other, and the squared distance of two rows
// of them.
#ifndef SHORTSHOT_STORE_CODE_DISTANCE_HPP
#define SHORTSHOT_STORE_CODE_DISTANCE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Number `place` of those of `Bits` bits that lie one behind the other, the lowest bits first.
template <int Bits>
[[nodiscard, gnu::always_inline]] inline unsigned number_at(const std::uint8_t* bytes, std::size_t place) noexcept {
  constexpr unsigned mask = (1u << Bits) - 1u;
  const std::size_t bit = place * static_cast<std::size_t>(Bits);
  unsigned number = static_cast<unsigned>(bytes[bit / 8]) >> bit % 8;
  if constexpr (8 % Bits != 0) {
    if (bit % 8 + static_cast<std::size_t>(Bits) > 8)
      number |= static_cast<unsigned>(bytes[bit / 8 + 1]) << (8 - bit % 8);
  }
  return number & mask;
}

/// Writes one where all bits are 0 so far.
template <int Bits>
[[gnu::always_inline]] inline void put_number(std::uint8_t* bytes, std::size_t place, unsigned number) noexcept {
  const std::size_t bit = place * static_cast<std::size_t>(Bits);
  const unsigned shifted = number << bit % 8;
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] | (shifted & 255u));
  if (shifted > 255u) bytes[bit / 8 + 1] = static_cast<std::uint8_t>(bytes[bit / 8 + 1] | shifted >> 8);
}

/// Numbers i of `Bits` bits, number(i), one behind the other in so many bytes as they take. In place, too, for numbers
/// that lie behind where they are written.
template <int Bits, class Number>
[[gnu::always_inline]] inline void write_numbers(std::uint8_t* bytes, int count, const Number& number) noexcept {
  unsigned waiting = 0;
  int bits = 0;  // that wait
  for (int i = 0; i < count; ++i) {
    waiting |= number(i) << bits;
    for (bits += Bits; bits >= 8 || (bits > 0 && i == count - 1); bits -= 8) {
      *bytes++ = static_cast<std::uint8_t>(waiting & 255u);
      waiting >>= 8;
    }
  }
}

/// The numbers of a row of so many bytes in another order: number i is number place(i) of the row.
template <int Bits, class Place>
inline void arrange(const std::uint8_t* row, std::uint8_t* out, std::size_t size, const Place& place) noexcept {
  write_numbers<Bits>(out, static_cast<int>(8 * size / Bits),
                      [&](int i) { return number_at<Bits>(row, place(static_cast<std::size_t>(i))); });
}

/// The sum of squared differences of the numbers in `Width` bytes, in a form that compilers turn into lanes at -O2,
/// too.
template <int Bits, std::size_t Width>
[[nodiscard, gnu::always_inline]] inline std::uint32_t squared_piece_distance(const std::uint8_t* a,
                                                                              const std::uint8_t* b) noexcept {
  std::int32_t sum = 0;
  if constexpr (Bits == 3) {
    for (std::size_t k = 0; k < Width * 8 / 3; ++k) {
      const int difference = static_cast<int>(number_at<3>(a, k)) - static_cast<int>(number_at<3>(b, k));
      sum += difference * difference;
    }
  } else {
    constexpr unsigned mask = (1u << Bits) - 1u;
    for (std::size_t k = 0; k < Width; ++k) {
      const auto low = static_cast<std::int16_t>((a[k] & mask) - (b[k] & mask));
      sum += low * low;
    }
    for (std::size_t k = 0; Bits == 4 && k < Width; ++k) {
      const auto high = static_cast<std::int16_t>((a[k] >> 4) - (b[k] >> 4));
      sum += high * high;
    }
  }
  return static_cast<std::uint32_t>(sum);
}

/// The sum of squared differences of the numbers of 8, 4 or 3 bits in `size` bytes; of up to 66051 numbers it fits.
template <int Bits>
[[nodiscard]] inline std::uint32_t squared_code_distance(const std::uint8_t* a, const std::uint8_t* b,
                                                         std::size_t size) noexcept {
  static_assert(Bits == 8 || Bits == 4 || Bits == 3, "whole numbers in every piece");
  std::uint32_t sum = 0;
  std::size_t i = 0;
  if constexpr (simd::has_halves && Bits != 3) {
    for (; i + 4 <= size; i += 4) {
      std::uint32_t of_a, of_b;
      std::memcpy(&of_a, a + i, 4);
      std::memcpy(&of_b, b + i, 4);
      if constexpr (Bits == 8) {
        sum = simd::add_squared_differences(of_a, of_b, sum);
      } else {
        constexpr std::uint32_t low = 0x0F0F0F0Fu;
        sum = simd::add_squared_differences(of_a & low, of_b & low, sum);
        sum = simd::add_squared_differences(of_a >> 4 & low, of_b >> 4 & low, sum);
      }
    }
  } else {
    constexpr std::size_t width = Bits == 3 ? 3 : Bits == 4 ? 16 : 32;
    for (; i + width <= size; i += width) sum += squared_piece_distance<Bits, width>(a + i, b + i);
  }
  const std::size_t whole = i * 8 / static_cast<std::size_t>(Bits);
  for (std::size_t k = whole; k < size * 8 / static_cast<std::size_t>(Bits); ++k) {
    const int difference = static_cast<int>(number_at<Bits>(a, k)) - static_cast<int>(number_at<Bits>(b, k));
    sum += static_cast<std::uint32_t>(difference * difference);
  }
  return sum;
}

/// The same if it is below the limit; else a number that is not.
template <int Bits>
[[nodiscard]] inline std::uint32_t squared_code_distance_below(const std::uint8_t* a, const std::uint8_t* b,
                                                               std::size_t size, std::uint32_t limit) noexcept {
  constexpr std::size_t piece = 24;  // whole numbers
  std::uint32_t sum = 0;
  std::size_t i = 0;
  for (; i + piece < size && sum < limit; i += piece) sum += squared_code_distance<Bits>(a + i, b + i, piece);
  return sum < limit ? sum + squared_code_distance<Bits>(a + i, b + i, size - i) : sum;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_STORE_CODE_DISTANCE_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D of D::size values, each as a whole multiple of `step`, in `Bits` bits (8, 4 or 3): from 0 to
/// 2^Bits - 1 (255, 15, 7), or in parts whose values have signs from -m to m with m = 2^(Bits - 1) - 1 (127, 7, 3),
/// which are stored as 1 to 2 m + 1. What lies beyond is cut off. A trivial type of alignment 1.
///
/// Layout: the bits of value i are those from Bits * i on, the lowest ones of a byte first; what is left over at the
/// end is 0. So is value 2 i of 4 bits the low half of byte i.
///
/// Steps are 1 / `Scale`; code_scale<D, Bits> cuts off few values.
template <class D, int Bits, int Scale = code_scale<D, Bits>>
struct CodedDescriptor {
  static_assert(Bits == 8 || Bits == 4 || Bits == 3, "CodedDescriptor<D, Bits> supports 8, 4 or 3 bits a value");
  static_assert(Scale >= 1 && Scale <= 65536, "CodedDescriptor<D, Bits, Scale> supports scales from 1 to 65536");
  static_assert(D::size >= 1 && D::size <= 66051, "CodedDescriptor<D, Bits> supports 1 to 66051 values");
  static_assert(std::uint64_t{66051} * 255 * 255 <= 0xFFFFFFFFu, "squared_distance() cannot overflow");
  static constexpr int size = D::size;                                                           ///< number of values
  static constexpr int bits = Bits;                                                              ///< of each value
  static constexpr std::size_t size_bytes = (static_cast<std::size_t>(D::size) * Bits + 7) / 8;  ///< of all values
  /// The L2 distance of two descriptors is step * sqrt(squared_distance(a, b)).
  static constexpr float step = 1.0f / static_cast<float>(Scale);
  std::uint8_t bytes[size_bytes];  ///< the codes
};

/// One byte a value, a quarter of its floats: 336 bytes for SCSH-336, with steps of 1/512 from 0 to 255/512.
///
/// A value below that comes back within half a step, 1/1024 (and 6e-11 for rounding), and so the distance of two
/// descriptors, at the worst, within sqrt(D::size) / 512. What it costs in practice: of 12,630 key points of generated
/// tabletop scenes, seen twice with other pixels and noise, 92 % (SSH-32) to 97 % (SCSH-696) have the same nearest
/// neighbor in the other view as with floats; the others have one at most 1.11 times as far away, and as many of all
/// are right. Distances to it, 0.07 to 0.18 long, are wrong by 0.001 (root mean square). Steps of 1/255, which reach 1,
/// make that 0.0016 to 0.002; finer ones cut off too much: in SSH-32 every fifth value is above 1/4.
///
/// SHOT-352 and CSHOT-1344 have peaks above 1/2 (one value in 4,000 and in 200,000). Nearest neighbors are kept as
/// well (95 % and 98 %), but the distance from a descriptor with such a peak can be too small by 0.4 and 0.2.
///
/// Compact descriptors have steps of 1/360, and no value is cut off.
template <class D, int Scale = code_scale<D, 8>>
using ByteDescriptor = CodedDescriptor<D, 8, Scale>;

/// Half a byte a value, an eighth of its floats: 95 bytes for ShapeColor95.
template <class D, int Scale = code_scale<D, 4>>
using NibbleDescriptor = CodedDescriptor<D, 4, Scale>;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// May value i of D be below 0?
template <class D>
struct SignsOf {
  [[nodiscard, gnu::always_inline]] static constexpr bool at(int) noexcept { return false; }
};
template <class Voting, class... Parts>
struct SignsOf<Descriptor<Voting, Parts...>> {
  [[nodiscard, gnu::always_inline]] static constexpr bool at(int value) noexcept {
    int part = 0;
    bool has_sign = false;
    ((has_sign = has_sign || (Parts::has_signs && value >= Descriptor<Voting, Parts...>::offset(part) &&
                              value < Descriptor<Voting, Parts...>::offset(part) + Parts::size),
      ++part),
     ...);
    return has_sign;
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// What is stored of a value: the nearest whole number of steps (of the product, a float), halves away from 0. NaN
/// becomes 0 steps. Compared before it is converted.
template <int Bits>
[[nodiscard]] inline unsigned code_of(float value, float scale, bool has_sign) noexcept {
  constexpr int zero = 1 << (Bits - 1);  // as it is stored where there are signs
  const float half_steps = unfused(value * (2.0f * scale));
  const float high = half_steps < 0.0f ? -half_steps : half_steps;
  const int most = has_sign ? zero - 1 : 2 * zero - 1;
  const auto limit = static_cast<float>(2 * most);
  const int steps = high < limit ? (static_cast<std::int32_t>(high) + 1) / 2 : high >= limit ? most : 0;
  if (!has_sign) return half_steps > 0.0f ? static_cast<unsigned>(steps) : 0u;
  return static_cast<unsigned>(half_steps < 0.0f ? zero - steps : zero + steps);
}

/// The whole number of steps that value i is stored as.
template <class D, int Bits, int Scale>
[[nodiscard, gnu::always_inline]] inline int steps_at(const CodedDescriptor<D, Bits, Scale>& coded, int i) noexcept {
  const auto stored = static_cast<int>(number_at<Bits>(coded.bytes, static_cast<std::size_t>(i)));
  return SignsOf<D>::at(i) ? stored - (1 << (Bits - 1)) : stored;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The D::size values of a descriptor as codes. NaN becomes 0. No allocation, no error, reentrant; the same bytes on
/// every machine.
///
/// In place, too: `out` may lie where `values` begin. A byte is written when its values have been read, and lies before
/// those that have not. A union of both needs no second buffer:
///
///     union { float values[D::size]; ByteDescriptor<D> bytes; } d;
///     if (describe_at<D>(cloud, search, index, 0.04f, workspace, d.values) == Status::ok) quantize(d.values, d.bytes);
template <class D, int Bits, int Scale>
void quantize(const float* values, CodedDescriptor<D, Bits, Scale>& out) noexcept {
  detail::write_numbers<Bits>(out.bytes, D::size, [&](int i) {
    return detail::code_of<Bits>(values[i], static_cast<float>(Scale), detail::SignsOf<D>::at(i));
  });
}

/// The values that codes stand for, D::size floats. No allocation, no error, reentrant; the same bits on every machine.
template <class D, int Bits, int Scale>
void dequantize(const CodedDescriptor<D, Bits, Scale>& coded, float* values) noexcept {
  for (int i = 0; i < D::size; ++i) {
    values[i] = static_cast<float>(detail::steps_at(coded, i)) * CodedDescriptor<D, Bits, Scale>::step;
  }
}

/// The squared L2 distance in steps, exact: an integer from 0 to D::size * (2^Bits - 1)^2, for which 32 bits are
/// enough. The order of distances needs no root.
template <class D, int Bits, int Scale>
[[nodiscard]] std::uint32_t squared_distance(const CodedDescriptor<D, Bits, Scale>& a,
                                             const CodedDescriptor<D, Bits, Scale>& b) noexcept {
  return detail::squared_code_distance<Bits>(a.bytes, b.bytes, sizeof a.bytes);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_STORE_CODED_HPP

// shortshot/store/half.hpp: a descriptor in 16-bit floats, half of its floats.
#ifndef SHORTSHOT_STORE_HALF_HPP
#define SHORTSHOT_STORE_HALF_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D of D::size values as IEEE 754's binary16 (11 bits of precision: a value of a descriptor comes back
/// within 1/4096 of itself, or 3e-8). A trivial type of alignment 2. Distances are those of the floats that they stand
/// for.
template <class D>
struct HalfDescriptor {
  static_assert(D::size >= 1 && D::size <= 66051, "HalfDescriptor<D> supports 1 to 66051 values");
  static constexpr int size = D::size;                                              ///< number of values
  static constexpr std::size_t size_bytes = 2 * static_cast<std::size_t>(D::size);  ///< of all values
  std::uint16_t values[D::size];                                                    ///< as binary16, one per value
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The nearest half, ties to even, as IEEE 754 rounds; from 65520 on infinity. NaN stays NaN (a quiet one). In
/// integers: neither compilers nor CPUs have a say.
[[nodiscard]] inline std::uint16_t half_of(float value) noexcept {
  const std::uint32_t bits = math::bits_of(value);
  const std::uint32_t sign = bits >> 16 & 0x8000u;
  const std::uint32_t high = bits & 0x7FFFFFFFu;
  if (high >= 0x7F800000u) return static_cast<std::uint16_t>(sign | (high > 0x7F800000u ? 0x7E00u : 0x7C00u));
  if (high >= 0x477FF000u) return static_cast<std::uint16_t>(sign | 0x7C00u);
  std::uint32_t whole = high - 0x38000000u;  // the exponent's bias is 112 less
  std::uint32_t shift = 13;
  if (high < 0x38800000u) {  // below 2^-14: multiples of 2^-24
    shift = 126 - (high >> 23);
    if (shift > 25) return static_cast<std::uint16_t>(sign);
    whole = (high & 0x7FFFFFu) | 0x800000u;
  }
  const std::uint32_t half_unit = (1u << (shift - 1)) - 1u + (whole >> shift & 1u);
  return static_cast<std::uint16_t>(sign | (whole + half_unit) >> shift);
}

/// The float that a half stands for, exactly.
[[nodiscard]] inline float float_of_half(std::uint16_t half) noexcept {
  const std::uint32_t sign = std::uint32_t{half & 0x8000u} << 16;
  std::uint32_t high = half & 0x7FFFu;
  if (high >= 0x7C00u) return math::float_of(sign | 0x7F800000u | (high & 0x3FFu) << 13);
  if (high >= 0x400u) return math::float_of(sign | ((high << 13) + 0x38000000u));
  if (high == 0) return math::float_of(sign);
  std::uint32_t exponent = 113;  // of 2^-14
  for (; (high & 0x400u) == 0; high <<= 1) --exponent;
  return math::float_of(sign | exponent << 23 | (high & 0x3FFu) << 13);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The D::size values of a descriptor as halves, each the nearest one (ties to even). No allocation, no error,
/// reentrant; the same bits on every machine, whatever it does with subnormal floats.
template <class D>
void quantize(const float* values, HalfDescriptor<D>& out) noexcept {
  for (int i = 0; i < D::size; ++i) out.values[i] = detail::half_of(values[i]);
}

/// The floats that halves stand for.
template <class D>
void dequantize(const HalfDescriptor<D>& halves, float* values) noexcept {
  for (int i = 0; i < D::size; ++i) values[i] = detail::float_of_half(halves.values[i]);
}

/// The squared L2 distance of the floats that halves stand for, summed up as squared_l2_distance() does: what matching
/// compares.
template <class D>
[[nodiscard]] float squared_distance(const HalfDescriptor<D>& a, const HalfDescriptor<D>& b) noexcept {
  float sums[8] = {};
  for (int i = 0; i < D::size; ++i) {
    const float difference = detail::float_of_half(a.values[i]) - detail::float_of_half(b.values[i]);
    sums[i % 8] += extend::unfused(difference * difference);
  }
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_STORE_HALF_HPP

// shortshot/store/sum_bits.hpp: a descriptor in bits that each say whether a sum of a few of its values is positive.
#ifndef SHORTSHOT_STORE_SUM_BITS_HPP
#define SHORTSHOT_STORE_SUM_BITS_HPP

// shortshot/store/draws.hpp: random numbers that are the same everywhere, made while compiling.
#ifndef SHORTSHOT_STORE_DRAWS_HPP
#define SHORTSHOT_STORE_DRAWS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The generator of std::mt19937 (M. Matsumoto, T. Nishimura: Mersenne Twister, ACM TOMACS 8, 1998), for constants.
class MersenneTwister {
 public:
  constexpr explicit MersenneTwister(std::uint32_t seed) noexcept : state_{seed} {
    for (std::uint32_t i = 1; i < count; ++i) {
      const std::uint32_t before = state_[i - 1];
      state_[i] = 1812433253u * (before ^ before >> 30) + i;
    }
  }
  constexpr std::uint32_t operator()() noexcept {
    const std::size_t next = (at_ + 1) % count;
    const std::uint32_t joined = (state_[at_] & 0x80000000u) | (state_[next] & 0x7FFFFFFFu);
    std::uint32_t number = state_[(at_ + 397) % count] ^ joined >> 1 ^ ((joined & 1u) != 0 ? 0x9908B0DFu : 0u);
    state_[at_] = number;
    at_ = next;
    number ^= number >> 11;
    number ^= number << 7 & 0x9D2C5680u;
    number ^= number << 15 & 0xEFC60000u;
    return number ^ number >> 18;
  }

 private:
  static constexpr std::size_t count = 624;
  std::uint32_t state_[count];
  std::size_t at_ = 0;
};

/// The first numbers of mt19937 with seed 1, modulo `Size`; in bytes, if they fit.
template <int Size, std::size_t Count>
struct Draws {
  using Draw = std::conditional_t<(Size <= 256), std::uint8_t, std::uint16_t>;
  Draw of[Count];
  constexpr Draws() noexcept : of{} {
    MersenneTwister next(1);
    for (Draw& draw : of) draw = static_cast<Draw>(next() % static_cast<std::uint32_t>(Size));
  }
};
template <int Size, std::size_t Count>
inline constexpr Draws<Size, Count> draws{};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail
#endif  // SHORTSHOT_STORE_DRAWS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D as `Bits` signs of sparse sums: bit j is bit j % 8 of byte j / 8, and says whether the sum of `Draws`
/// of its values in nibbles, with the signs -, +, -, +, ..., is above 0. Which values, is drawn once and for all: value
/// g() % D::size with g an std::mt19937 with seed 1, for one bit after the other. A trivial type of alignment 1.
///
/// 352 bits of four draws are 44 bytes, the least that keeps most of what ShapeColor95 finds; 256 bits of six draws are
/// 32 bytes.
template <class D, int Bits = 352, int Draws = 4>
struct SumBits {
  static_assert(Bits >= 8 && Bits <= 65536 && Bits % 8 == 0, "SumBits<D, Bits> supports whole bytes: 8 to 65536 bits");
  static_assert(Draws >= 2 && Draws <= 64, "SumBits<D, Bits, Draws> supports 2 to 64 draws for a bit");
  static constexpr int bits = Bits;                                              ///< number of them
  static constexpr std::size_t size_bytes = static_cast<std::size_t>(Bits) / 8;  ///< of all bits
  std::uint8_t bytes[size_bytes];                                                ///< bit j is bit j % 8 of byte j / 8
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// The bits of a descriptor in nibbles. The same ones on every machine: there is nothing but integers. Codes of parts
/// with signs count as -7 to 7, the others as 0 to 15. No allocation, no error, reentrant.
template <class D, int Scale, int Bits, int Draws>
void binarize(const NibbleDescriptor<D, Scale>& nibbles, SumBits<D, Bits, Draws>& out) noexcept {
  constexpr auto& draws = detail::draws<D::size, static_cast<std::size_t>(Bits) * Draws>;
  const auto* draw = draws.of;
  std::int8_t steps[D::size];  // each is drawn several times
  for (int i = 0; i < D::size; ++i) steps[i] = static_cast<std::int8_t>(detail::steps_at(nibbles, i));
  for (std::uint8_t& byte : out.bytes) {
    unsigned bits = 0;
    for (int bit = 0; bit < 8; ++bit) {
      int sum = 0;
      for (int k = 0; k < Draws; ++k) {
        const std::int8_t drawn = steps[*draw++];
        sum += k % 2 == 0 ? -drawn : drawn;
      }
      if (sum > 0) bits |= 1u << bit;
    }
    byte = static_cast<std::uint8_t>(bits);
  }
}

/// The same of D::size values, by way of nibbles with steps of 1 / code_scale<D, 4>.
template <class D, int Bits, int Draws>
void binarize(const float* values, SumBits<D, Bits, Draws>& out) noexcept {
  NibbleDescriptor<D> nibbles;
  quantize(values, nibbles);
  binarize(nibbles, out);
}

/// Number of bits in which two descriptors differ, 0 to Bits.
template <class D, int Bits, int Draws>
[[nodiscard, gnu::always_inline]] inline int hamming_distance(const SumBits<D, Bits, Draws>& a,
                                                              const SumBits<D, Bits, Draws>& b) noexcept {
  return hamming_distance(a.bytes, b.bytes, sizeof a.bytes);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_STORE_SUM_BITS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The descriptor that a storage is of, what its rows are made of in files, how it is said, how it is made; of how many
/// bits the numbers of a row are, and how far two rows are apart in whole numbers, in whatever order these are, if that
/// is below a limit; else any number that is not. (Halves are no whole numbers.)
template <class Stored>
struct Storage;
template <class D>
struct Storage<HalfDescriptor<D>> {
  using Descriptor = D;
  using Value = std::uint16_t;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add(text, "halves");
  }
  static void make(const float* values, HalfDescriptor<D>& out) noexcept { quantize(values, out); }
};
template <class D, int Bits, int Scale>
struct Storage<CodedDescriptor<D, Bits, Scale>> {
  using Descriptor = D;
  using Value = std::uint8_t;
  static constexpr int number_bits = Bits;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add_all(text, "codes of ", Bits, " bits, steps of 1/", Scale);
  }
  static void make(const float* values, CodedDescriptor<D, Bits, Scale>& out) noexcept { quantize(values, out); }
  [[nodiscard]] SHORTSHOT_INLINE static std::uint32_t distance_below(const CodedDescriptor<D, Bits, Scale>& a,
                                                                     const CodedDescriptor<D, Bits, Scale>& b,
                                                                     std::uint32_t limit) noexcept {
    return squared_code_distance_below<Bits>(a.bytes, b.bytes, sizeof a.bytes, limit);
  }
};
template <class D, int Group>
struct Storage<BinaryDescriptor<D, Group>> {
  using Descriptor = D;
  using Value = std::uint8_t;
  static constexpr int number_bits = 1;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add_all(text, "bits of groups of ", Group);
  }
  static void make(const float* values, BinaryDescriptor<D, Group>& out) noexcept { binarize(values, out); }
  [[nodiscard]] SHORTSHOT_INLINE static std::uint32_t distance_below(const BinaryDescriptor<D, Group>& a,
                                                                     const BinaryDescriptor<D, Group>& b,
                                                                     std::uint32_t limit) noexcept {
    return hamming_distance_below(a.bytes, b.bytes, sizeof a.bytes, limit);
  }
};
template <class D, int Bits, int Draws>
struct Storage<SumBits<D, Bits, Draws>> {
  using Descriptor = D;
  using Value = std::uint8_t;
  static constexpr int number_bits = 1;
  template <class Text>
  static constexpr void add_name(Text& text) {
    add_all(text, Bits, " bits of sums of ", Draws, ", steps of 1/", code_scale<D, 4>);
  }
  static void make(const float* values, SumBits<D, Bits, Draws>& out) noexcept { binarize(values, out); }
  [[nodiscard]] SHORTSHOT_INLINE static std::uint32_t distance_below(const SumBits<D, Bits, Draws>& a,
                                                                     const SumBits<D, Bits, Draws>& b,
                                                                     std::uint32_t limit) noexcept {
    return hamming_distance_below(a.bytes, b.bytes, sizeof a.bytes, limit);
  }
};

/// The descriptor's layout, and how it is stored: see storage_layout().
template <class Stored, class Text>
constexpr void add_storage_layout(Text& text) {
  add_layout(text, static_cast<const typename Storage<Stored>::Descriptor*>(nullptr));
  add(text, " in ");
  Storage<Stored>::add_name(text);
}

/// storage_layout() as a number, for where there are no strings.
template <class Stored>
inline constexpr std::uint64_t storage_number = [] {
  LayoutNumber text;
  add_storage_layout<Stored>(text);
  return text.value;
}();

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_STORE_STORAGE_HPP

// shortshot/recognition/flash_model.hpp: a trained recognizer as bytes that are read where they lie, in flash:
// save_for_flash() writes them.
//
// All numbers are little-endian, floats by their bits:
//
//      0  8 characters "SSHOTFLA", 4 bytes format version, 4 bytes size of all, a multiple of 4
//     16  8 bytes storage_number of what is stored
//     24  options: 4 bytes each bandwidth, neighbors, most
//     36  3 bytes: bytes of a row; 1 byte: bits of a number of a row, or 0 if these are in the descriptor's order
//     40  4 bytes each: codewords, instances, classes, bytes of text
//     56  4 bytes, as a float: the unit of centers in meters, a power of two
//     60  for each instance 2 bytes class; 2 bytes 0 if that is no multiple of 4
//         unless that is 0, for each number of a row 2 bytes, which one of the descriptor it is; 2 bytes 0 if that is
//         no multiple of 4 for each codeword 2 bytes instance, 3 times 2 bytes center in the key point's frame, signed,
//         and its row of codes or bits, without gaps text, a 0 behind each: storage_layout, names of classes, names of
//         instances up to three bytes 0 8 bytes checksum (64-bit FNV-1a) of all bytes before it
#ifndef SHORTSHOT_RECOGNITION_FLASH_MODEL_HPP
#define SHORTSHOT_RECOGNITION_FLASH_MODEL_HPP

// shortshot/recognition/hypothesis.hpp: what recognizers are told, and what they say.
#ifndef SHORTSHOT_RECOGNITION_HYPOTHESIS_HPP
#define SHORTSHOT_RECOGNITION_HYPOTHESIS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// How objects are looked for. Trivially copyable.
struct RecognizerOptions {
  float bandwidth = 0.03f;      ///< h of the density of votes, 1e-6 to 1e6 meters: about how far votes miss the center
  std::uint32_t neighbors = 1;  ///< nearest codewords that each descriptor activates, 1 to 1024
  std::uint32_t most = 8;       ///< hypotheses at the most, from 1 on
};

/// An object that may be there; see Recognizer::class_name() and instance_name() for the numbers. Trivial type.
struct Hypothesis {
  std::uint32_t object_class;  ///< number of the class
  std::uint32_t instance;      ///< number of the instance, among those of all classes
  Point center;                ///< where that of the training views is in this view
  float score;  ///< density of the class' votes there: 1 for each that hits it, exp(-d^2 / (2 h^2)) if d meters off
};

/// A key point as recognizers need it. Trivial type.
template <class Stored>
struct StoredKeyPoint {
  Stored descriptor;  ///< as it is stored
  Point position;     ///< where the key point is in the view
  Frame frame;        ///< its local reference frame
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// ok or bad_option.
[[nodiscard]] inline Status validate(const RecognizerOptions& options) noexcept {
  const bool usable = options.bandwidth >= 1e-6f && options.bandwidth <= 1e6f && options.neighbors >= 1 &&
                      options.neighbors <= 1024 && options.most >= 1;
  return usable ? Status::ok : Status::bad_option;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Does one of these say the same: the class, within the bandwidth of the place?
[[nodiscard]] inline bool is_known(const Hypothesis* known, std::size_t count, std::uint32_t object_class,
                                   const Point& at, float bandwidth) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const bool same_class = known[i].object_class == object_class;
    if (same_class && squared_distance(known[i].center, at) <= unfused(bandwidth * bandwidth)) return true;
  }
  return false;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_HYPOTHESIS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr char flash_model_magic[] = "SSHOTFLA";
inline constexpr std::uint32_t flash_model_version = 1;

[[nodiscard]] inline std::uint32_t number16(const std::uint8_t* bytes) noexcept {
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}
[[nodiscard]] inline std::uint32_t number32(const std::uint8_t* bytes) noexcept {
  return number16(bytes) | number16(bytes + 2) << 16;
}
[[nodiscard]] inline std::uint64_t number64(const std::uint8_t* bytes) noexcept {
  return number32(bytes) | static_cast<std::uint64_t>(number32(bytes + 4)) << 32;
}

/// Where the parts of a model begin, by how many there are of each. Numbers of 64 bits: sums of products of what may be
/// damaged fit.
struct FlashLayout {
  static constexpr std::uint64_t header = 60;
  static constexpr std::uint64_t before_row = 8;  // of a codeword

  std::uint64_t order;
  std::uint64_t codewords;
  std::uint64_t text;
  std::uint64_t checksum;

  [[nodiscard]] static constexpr std::uint64_t whole(std::uint64_t bytes) noexcept { return (bytes + 3) / 4 * 4; }

  constexpr FlashLayout(std::uint32_t row_bytes, std::uint32_t number_count, std::uint32_t codeword_count,
                        std::uint32_t instance_count, std::uint32_t text_bytes) noexcept
      : order(header + whole(2 * std::uint64_t{instance_count})),
        codewords(order + whole(2 * std::uint64_t{number_count})),
        text(codewords + (before_row + row_bytes) * codeword_count),
        checksum(whole(text + text_bytes)) {}
};

/// What stands before the codewords, but for the first 12 bytes.
struct FlashHeader {
  std::uint32_t size_bytes = 0;
  std::uint64_t storage = 0;
  RecognizerOptions options{0.0f, 0, 0};
  std::uint32_t row_bytes = 0;
  std::uint32_t number_bits = 0;
  std::uint32_t codewords = 0;
  std::uint32_t instances = 0;
  std::uint32_t classes = 0;
  std::uint32_t text_bytes = 0;
  float unit = 0.0f;

  /// Of numbers whose order the model has.
  [[nodiscard]] constexpr std::uint32_t number_count() const noexcept {
    return number_bits == 0 ? 0 : 8 * row_bytes / number_bits;
  }
  [[nodiscard]] constexpr FlashLayout layout() const noexcept {
    return {row_bytes, number_count(), codewords, instances, text_bytes};
  }
};

template <class Writer>
void write(Writer& to, const FlashHeader& header) {
  to.number(header.size_bytes);
  to.number(header.storage);
  to.number(math::bits_of(header.options.bandwidth));
  to.number(header.options.neighbors);
  to.number(header.options.most);
  to.number(header.row_bytes | header.number_bits << 24);
  to.number(header.codewords);
  to.number(header.instances);
  to.number(header.classes);
  to.number(header.text_bytes);
  to.number(math::bits_of(header.unit));
}

/// A coordinate in whole units, to the nearest.
[[nodiscard]] inline std::uint16_t units_of(float coordinate, float unit) noexcept {
  const float units = coordinate / unit;
  std::int32_t rounded[extend::simd::lanes];
  store(rounded, round_to_int(extend::simd::all(units > 32767.0f ? 32767.0f : units < -32767.0f ? -32767.0f : units)));
  return static_cast<std::uint16_t>(rounded[0]);
}

/// What stands before a codeword's row.
template <class Writer>
void write_codeword(Writer& to, std::uint32_t instance, const Point& center, float unit) {
  to.number(static_cast<std::uint16_t>(instance));
  to.number(units_of(center.x, unit));
  to.number(units_of(center.y, unit));
  to.number(units_of(center.z, unit));
}

/// Codewords as a model has them, one behind the other.
struct CodewordRun {
  const std::uint8_t* bytes = nullptr;
  std::uint32_t count = 0;
  std::uint32_t row_bytes = 0;
  float unit = 0.0f;
  bool is_arranged = false;  // not in the descriptor's order

  [[nodiscard]] const std::uint8_t* at(std::uint32_t i) const noexcept {
    return bytes + (FlashLayout::before_row + row_bytes) * i;
  }
  [[nodiscard]] const std::uint8_t* row(std::uint32_t i) const noexcept { return at(i) + FlashLayout::before_row; }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t i) const noexcept { return number16(at(i)); }
  [[nodiscard]] Point center_of(std::uint32_t i) const noexcept {
    const auto coordinate = [&](std::uint32_t offset) {
      return static_cast<float>(static_cast<std::int16_t>(number16(at(i) + offset))) * unit;
    };
    return {coordinate(2), coordinate(4), coordinate(6)};
  }
};

/// A model of any storage. Validated once, in open(): a look at each byte, and at each codeword, instance and name.
class FlashModel {
 public:
  constexpr FlashModel() noexcept = default;
  /// None yet, but its options are known.
  explicit constexpr FlashModel(const RecognizerOptions& options) noexcept { header_.options = options; }

  /// Statuses: not_a_model, other_version, damaged_model. What was open before stays so if it is not ok.
  [[nodiscard]] Status open(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    if (bytes == nullptr || size_bytes < 8) return Status::not_a_model;
    for (std::size_t i = 0; i < 8; ++i) {
      if (bytes[i] != static_cast<std::uint8_t>(flash_model_magic[i])) return Status::not_a_model;
    }
    if (size_bytes < 12) return Status::damaged_model;
    if (number32(bytes + 8) != flash_model_version) return Status::other_version;
    FlashModel model;
    if (!model.read(bytes, size_bytes) || !model.is_sound()) return Status::damaged_model;
    *this = model;
    return Status::ok;
  }

  [[nodiscard]] std::uint32_t size_bytes() const noexcept { return header_.size_bytes; }
  [[nodiscard]] std::uint64_t storage() const noexcept { return header_.storage; }
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return header_.options; }
  [[nodiscard]] std::uint32_t row_bytes() const noexcept { return header_.row_bytes; }
  [[nodiscard]] std::uint32_t codeword_count() const noexcept { return header_.codewords; }
  [[nodiscard]] std::uint32_t instance_count() const noexcept { return header_.instances; }
  [[nodiscard]] std::uint32_t class_count() const noexcept { return header_.classes; }
  [[nodiscard]] std::uint32_t class_of(std::uint32_t instance) const noexcept {
    return number16(bytes_ + FlashLayout::header + 2 * std::size_t{instance});
  }
  [[nodiscard]] const char* class_name(std::uint32_t object_class) const noexcept { return text(1 + object_class); }
  [[nodiscard]] const char* instance_name(std::uint32_t instance) const noexcept {
    return text(1 + class_count() + instance);
  }
  [[nodiscard]] std::uint32_t number_bits() const noexcept { return header_.number_bits; }
  /// Which number of a descriptor is number i of a row, of number_count() ones: those come first that tell most
  /// codewords apart. 0, and the order is that of the descriptor.
  [[nodiscard]] std::uint32_t number_count() const noexcept { return header_.number_count(); }
  [[nodiscard]] std::uint32_t place_of(std::uint32_t i) const noexcept {
    return number16(bytes_ + header_.layout().order + 2 * std::size_t{i});
  }
  [[nodiscard]] CodewordRun codewords() const noexcept {
    const std::uint8_t* const begin = bytes_ == nullptr ? nullptr : bytes_ + header_.layout().codewords;
    return {begin, header_.codewords, header_.row_bytes, header_.unit, header_.number_bits != 0};
  }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t codeword) const noexcept {
    return codewords().instance_of(codeword);
  }
  [[nodiscard]] Point center_of(std::uint32_t codeword) const noexcept { return codewords().center_of(codeword); }
  /// 0 is the layout, then come the classes and the instances.
  [[nodiscard]] const char* text(std::uint32_t number) const noexcept {
    const char* place = reinterpret_cast<const char*>(bytes_ + header_.layout().text);
    while (number > 0) number -= *place++ == 0 ? 1u : 0u;
    return place;
  }

 private:
  [[nodiscard]] bool read(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    if (size_bytes < FlashLayout::header + checksum_bytes || number32(bytes + 12) != size_bytes) return false;
    bytes_ = bytes;
    header_.size_bytes = number32(bytes + 12);
    header_.storage = number64(bytes + 16);
    header_.options = {math::float_of(number32(bytes + 24)), number32(bytes + 28), number32(bytes + 32)};
    header_.row_bytes = number32(bytes + 36) & 0xFFFFFFu;
    header_.number_bits = bytes[39];
    header_.codewords = number32(bytes + 40);
    header_.instances = number32(bytes + 44);
    header_.classes = number32(bytes + 48);
    header_.text_bytes = number32(bytes + 52);
    header_.unit = math::float_of(number32(bytes + 56));
    if (header_.row_bytes == 0 || header_.row_bytes > 66051 || header_.number_bits > 8) return false;
    const std::uint64_t checked = header_.layout().checksum;
    if (checked + checksum_bytes != size_bytes) return false;
    return checksum(bytes, static_cast<std::size_t>(checked)) == number64(bytes + checked);
  }

  /// A checksum may be right by chance, or by design: nothing that is read later may be wrong.
  [[nodiscard]] bool is_sound() const noexcept {
    const FlashHeader& h = header_;
    bool sound = validate(h.options) == Status::ok && h.codewords > 0 && h.instances <= 65536 && h.classes <= 65536 &&
                 h.unit >= 1e-30f && h.unit <= 1e30f;
    for (std::uint32_t i = 0; sound && i < h.instances; ++i) sound = class_of(i) < h.classes;
    const CodewordRun run = codewords();
    for (std::uint32_t i = 0; sound && i < run.count; ++i) sound = run.instance_of(i) < h.instances;
    const std::uint32_t numbers = number_count();
    for (std::uint32_t i = 0; sound && i < numbers; ++i) sound = place_of(i) < numbers;
    const std::uint8_t* const text_begin = bytes_ + h.layout().text;
    std::uint32_t texts = 0;
    for (std::uint32_t i = 0; i < h.text_bytes; ++i) texts += text_begin[i] == 0 ? 1u : 0u;
    return sound && texts == 1 + h.classes + h.instances && text_begin[h.text_bytes - 1] == 0;
  }

  const std::uint8_t* bytes_ = nullptr;
  FlashHeader header_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_FLASH_MODEL_HPP

// shortshot/recognition/model_view.hpp: what a MicroRecognizer knows: a model that is read where it lies, and what was
// learned since.
#ifndef SHORTSHOT_RECOGNITION_MODEL_VIEW_HPP
#define SHORTSHOT_RECOGNITION_MODEL_VIEW_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A model of one object, and what it and its class are numbered among all.
struct LearnedModel {
  CodewordRun codewords;
  const char* class_name = nullptr;
  const char* instance_name = nullptr;
  std::uint32_t object_class = 0;
  std::uint32_t instance = 0;
};

[[nodiscard]] inline bool same_text(const char* a, const char* b) noexcept {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A recognizer's model of descriptors in a storage (CodedDescriptor, BinaryDescriptor or SumBits), in memory that is
/// only read and must outlive the view. Nothing is copied, nothing allocated; reentrant.
///
///     ModelView<NibbleDescriptor<ShapeColor95>> model;
///     if (model.open(cups_model, sizeof cups_model) != Status::ok) ...
///     model.instance_name(3);
///
/// One with what was learned on the spot comes from LearnedObjects::model().
template <class Stored>
class ModelView {
 public:
  constexpr ModelView() noexcept = default;
  /// Without a codeword: what all is learned on the spot begins with. Options as validate() has them.
  explicit constexpr ModelView(const RecognizerOptions& options) noexcept : model_(options) {}

  /// What save_for_flash() has written. Takes a look at each byte (some 10 instructions each on a Cortex-M), whatever
  /// they say. Statuses, the first one that applies: not_a_model, other_version, damaged_model, other_descriptor. A
  /// model that was open before stays so.
  [[nodiscard]] Status open(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    detail::FlashModel opened;
    const Status status = opened.open(bytes, size_bytes);
    if (status != Status::ok) return status;
    if (!is_of_storage(opened)) return Status::other_descriptor;
    *this = ModelView(opened);
    return Status::ok;
  }

  /// As it was trained; all zeros, and no codewords, before a model is open.
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return model_.options(); }
  [[nodiscard]] std::uint32_t codeword_count() const noexcept { return codewords_; }
  [[nodiscard]] std::uint32_t instance_count() const noexcept { return instances_; }
  [[nodiscard]] std::uint32_t class_count() const noexcept { return classes_; }
  /// For numbers below the counts. Names are looked for from the first one on.
  [[nodiscard]] std::uint32_t class_of(std::uint32_t instance) const noexcept {
    if (instance < model_.instance_count()) return model_.class_of(instance);
    return first_learned([&](const detail::LearnedModel& m) { return m.instance == instance; }).object_class;
  }
  [[nodiscard]] const char* class_name(std::uint32_t object_class) const noexcept {
    if (object_class < model_.class_count()) return model_.class_name(object_class);
    return first_learned([&](const detail::LearnedModel& m) { return m.object_class == object_class; }).class_name;
  }
  [[nodiscard]] const char* instance_name(std::uint32_t instance) const noexcept {
    if (instance < model_.instance_count()) return model_.instance_name(instance);
    return first_learned([&](const detail::LearnedModel& m) { return m.instance == instance; }).instance_name;
  }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t codeword) const noexcept {
    const Place place = place_of_codeword(codeword);
    return place.learned == nullptr ? place.run.instance_of(place.codeword) : place.learned->instance;
  }
  /// The object's center in the frame of the codeword's key point.
  [[nodiscard]] Point center_of(std::uint32_t codeword) const noexcept {
    const Place place = place_of_codeword(codeword);
    return place.run.center_of(place.codeword);
  }
  /// As it was trained.
  [[nodiscard]] Stored descriptor(std::uint32_t codeword) const noexcept {
    static_assert(alignof(Stored) == 1, "ModelView<Stored> supports storages of bytes");
    const Place place = place_of_codeword(codeword);
    const auto& row = *reinterpret_cast<const Stored*>(place.run.row(place.codeword));
    if (!place.run.is_arranged) return row;
    Stored out{};
    for (std::uint32_t i = 0; i < number_count(); ++i)
      detail::put_number<number_bits>(out.bytes, place_of(i), detail::number_at<number_bits>(row.bytes, i));
    return out;
  }

  /// The order of the trained model's codes or bits: how many there are, and which one of the descriptor number i is.
  /// None: that of the descriptor.
  [[nodiscard]] std::uint32_t number_count() const noexcept { return model_.number_count(); }
  [[nodiscard]] std::uint32_t place_of(std::uint32_t i) const noexcept { return model_.place_of(i); }
  /// A descriptor with its codes or bits in that order, in which those come first that tell most codewords apart.
  [[nodiscard]] Stored arranged(const Stored& stored) const noexcept {
    if (number_count() == 0) return stored;
    Stored out{};
    detail::arrange<number_bits>(stored.bytes, out.bytes, sizeof out.bytes,
                                 [&](std::size_t i) { return place_of(static_cast<std::uint32_t>(i)); });
    return out;
  }

  /// use(first, run) for codewords that lie one behind the other, in ascending order: the number of the first one.
  template <class Use>
  void for_each_run(const Use& use) const noexcept {
    std::uint32_t first = 0;
    for (std::uint32_t part = 0; part <= learned_count_; ++part) {
      const detail::CodewordRun run = run_of(part);
      use(first, run);
      first += run.count;
    }
  }

 private:
  template <class S, class Memory, std::size_t MaxObjects>
  friend class LearnedObjects;

  static constexpr int number_bits = detail::Storage<Stored>::number_bits;

  struct Place {
    detail::CodewordRun run;
    std::uint32_t codeword;  // of the run
    const detail::LearnedModel* learned;
  };

  explicit ModelView(const detail::FlashModel& trained) noexcept
      : model_(trained),
        codewords_(trained.codeword_count()),
        instances_(trained.instance_count()),
        classes_(trained.class_count()) {}

  [[nodiscard]] static bool is_of_storage(const detail::FlashModel& model) noexcept {
    return model.storage() == detail::storage_number<Stored> && model.row_bytes() == sizeof(Stored) &&
           (model.number_bits() == 0 || model.number_bits() == std::uint32_t{number_bits});
  }

  /// The model's own codewords, or those of what was learned.
  [[nodiscard]] detail::CodewordRun run_of(std::uint32_t part) const noexcept {
    return part == 0 ? model_.codewords() : learned_[part - 1].codewords;
  }
  [[nodiscard]] Place place_of_codeword(std::uint32_t codeword) const noexcept {
    std::uint32_t part = 0;
    detail::CodewordRun run = run_of(0);
    for (; codeword >= run.count; run = run_of(++part)) codeword -= run.count;
    return {run, codeword, part == 0 ? nullptr : learned_ + part - 1};
  }
  template <class Condition>
  [[nodiscard]] const detail::LearnedModel& first_learned(const Condition& is_it) const noexcept {
    const detail::LearnedModel* learned = learned_;
    while (!is_it(*learned)) ++learned;
    return *learned;
  }

  /// Makes the next of the learned models one of this view's: numbers it, and what is new about it.
  void append(detail::LearnedModel& next) noexcept {
    next.object_class = 0;
    while (next.object_class < classes_ && !detail::same_text(class_name(next.object_class), next.class_name))
      ++next.object_class;
    const auto is_it = [&](std::uint32_t i) {
      return class_of(i) == next.object_class && detail::same_text(instance_name(i), next.instance_name);
    };
    next.instance = 0;
    while (next.instance < instances_ && !is_it(next.instance)) ++next.instance;
    if (next.object_class == classes_) ++classes_;
    if (next.instance == instances_) ++instances_;
    codewords_ += next.codewords.count;
    ++learned_count_;
  }

  detail::FlashModel model_;
  const detail::LearnedModel* learned_ = nullptr;
  std::uint32_t learned_count_ = 0;
  std::uint32_t codewords_ = 0;
  std::uint32_t instances_ = 0;
  std::uint32_t classes_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_MODEL_VIEW_HPP

// shortshot/recognition/unit_writer.hpp: bytes into memory that is programmed in whole units, each of them once, and
// can be read at any time: flash, or RAM.
#ifndef SHORTSHOT_RECOGNITION_UNIT_WRITER_HPP
#define SHORTSHOT_RECOGNITION_UNIT_WRITER_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::uint8_t erased_byte = 0xFF;

/// A unit is programmed when it is full. One of nothing but erased bytes stays as it is: so whatever comes behind the
/// last byte that is not erased can still be programmed, also after the power went.
template <class Memory>
class UnitWriter {
 public:
  static constexpr std::size_t unit_bytes = Memory::unit_bytes;

  constexpr UnitWriter() noexcept = default;
  /// From `begin` on, where a unit begins.
  UnitWriter(Memory& memory, std::size_t begin) noexcept : memory_(&memory), at_(begin) {}

  /// False from the first unit on that the memory did not take.
  [[nodiscard]] bool good() const noexcept { return !has_failed_; }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }

  template <class Unsigned>
  void number(Unsigned value) noexcept {
    append(value, sizeof value);
  }
  void bytes(const std::uint8_t* from, std::size_t count) noexcept {
    for (std::size_t k = 0; k < count; ++k) append(from[k], 1);
  }
  /// With the 0 behind it.
  void text(const char* from) noexcept {
    do append(static_cast<std::uint8_t>(*from), 1);
    while (*from++ != 0);
  }
  /// The same byte up to a place.
  void pad(std::size_t place, std::uint8_t byte) noexcept {
    while (at_ < place) append(byte, 1);
  }

  /// Of all bytes since `begin`, where a unit begins: those of the last unit may not have been programmed.
  [[nodiscard]] std::uint64_t checksum_since(std::size_t begin) const noexcept {
    const std::size_t pending = at_ % unit_bytes;
    return checksum(unit_, pending, checksum(memory_->bytes() + begin, at_ - pending - begin));
  }

 private:
  [[gnu::noinline]] void append(std::uint64_t value, std::size_t count) noexcept {
    for (std::size_t k = 0; k < count; ++k, value >>= 8) {
      unit_[at_ % unit_bytes] = static_cast<std::uint8_t>(value & 0xFFu);
      if (++at_ % unit_bytes == 0) has_failed_ = has_failed_ || !program(at_ - unit_bytes);
    }
  }

  [[nodiscard]] bool program(std::size_t place) noexcept {
    bool is_erased = true;
    for (const std::uint8_t byte : unit_) is_erased = is_erased && byte == erased_byte;
    if (!is_erased && !memory_->write(place, unit_)) return false;
    const std::uint8_t* const written = memory_->bytes() + place;
    for (std::size_t k = 0; k < unit_bytes; ++k) {
      if (written[k] != unit_[k]) return false;
    }
    return true;
  }

  Memory* memory_ = nullptr;
  std::size_t at_ = 0;
  std::uint8_t unit_[unit_bytes] = {};
  bool has_failed_ = false;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_UNIT_WRITER_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Memory for LearnedObjects in RAM: what is learned lasts as long as it does. All zeros is not erased: erase() it.
template <std::size_t Size>
class RamMemory {
 public:
  static constexpr std::size_t unit_bytes = 1;  ///< programmed at a time

  /// Forgets all: before the first open(), too.
  void erase() noexcept { std::memset(bytes_, detail::erased_byte, Size); }
  /// All of it.
  [[nodiscard]] const std::uint8_t* bytes() const noexcept { return bytes_; }
  /// How much that is.
  [[nodiscard]] std::size_t size_bytes() const noexcept { return Size; }
  /// Writes a unit; true.
  bool write(std::size_t place, const std::uint8_t* unit) noexcept {
    bytes_[place] = *unit;
    return true;
  }

 private:
  std::uint8_t bytes_[Size] = {};
};

/// Learns objects on a microcontroller. An object is there after commit(), also if the power goes at any time later,
/// and not before it: if the power goes before, or in commit(), open() finds what was there until then.
///
///     static LearnedObjects<Stored, MyFlash> learned;
///     learned.open(model, flash);
///     for (each key point) if (recognizer.describe(cloud, search, key point, 0.04f, key) == Status::ok)
///       learned.add(key, center);
///     learned.commit("mug", "my mug");
///     recognizer.start(learned.model());
///
/// `Stored`      what the model is of
/// `Memory`      what is written to. A type with `static constexpr std::size_t unit_bytes`, what is programmed at a
///               time: a power of two, up to 64; `const std::uint8_t* bytes()`, all of it, and `std::size_t
///               size_bytes()`; and `bool write(std::size_t place, const std::uint8_t* unit)`, which programs a unit,
///               false if it cannot. Bytes are 0xFF where they were erased. No unit is programmed twice; what was
///               programmed must be seen in bytes() at once. As RamMemory is
/// `MaxObjects`  calls of commit() in all, since the memory was erased; 32 bytes each, and on hosts 48
///
/// In the memory, a commit() takes 72 bytes, and the names; a codeword its descriptor and 8 bytes. What was torn takes
/// its place until all is erased, which the caller does, before open(). No allocation; one thread.
template <class Stored, class Memory, std::size_t MaxObjects = 16>
class LearnedObjects {
  static constexpr std::size_t unit_bytes = Memory::unit_bytes;
  static constexpr std::size_t header_bytes = detail::FlashLayout(sizeof(Stored), 0, 0, 1, 0).codewords;
  static_assert(unit_bytes >= 1 && (unit_bytes & (unit_bytes - 1)) == 0 && header_bytes % unit_bytes == 0,
                "LearnedObjects<Stored, Memory> supports memory that is programmed in units of 1, 2, 4, ..., 64 bytes");
  static_assert(MaxObjects >= 1 && MaxObjects <= 65536,
                "LearnedObjects<Stored, Memory, MaxObjects> supports 1 to 65536");

 public:
  /// All zeros: static ones take no flash and no code.
  constexpr LearnedObjects() noexcept = default;
  LearnedObjects(const LearnedObjects&) = delete;
  LearnedObjects& operator=(const LearnedObjects&) = delete;

  /// Finds what was learned. `trained` is what it is learned in addition to (its bytes must stay), or a ModelView of
  /// nothing but options; another one than last time is another numbering, no more. What is not whole is passed over.
  /// Takes a look at each byte. Ends the life of views that model() gave.
  ///
  /// Statuses: bad_option (of the options), bad_view (no memory, or 2^32 bytes or more), other_descriptor (there are
  /// learned objects of another one), out_of_memory (there are more than MaxObjects). Nothing can be added then.
  [[nodiscard]] Status open(const ModelView<Stored>& trained, Memory& memory) noexcept {
    memory_ = nullptr;
    model_ = ModelView<Stored>(trained.model_);
    model_.learned_ = learned_;
    if (validate(trained.options()) != Status::ok) return Status::bad_option;
    const std::uint64_t size_bytes = memory.size_bytes() / unit_bytes * unit_bytes;
    if (memory.bytes() == nullptr || size_bytes > 0xFFFFFFFFu) return Status::bad_view;
    std::size_t end = 0;
    for (std::size_t at = 0; at < size_bytes;) {
      detail::FlashModel found;
      Status status = open_at(memory, at, found);
      if (status == Status::ok) status = append(found);
      if (status == Status::other_descriptor || status == Status::out_of_memory) return status;
      at += status == Status::ok ? whole_units(found.size_bytes()) : unit_bytes;
      if (status == Status::ok) end = at;
    }
    memory_ = &memory;
    begin_behind(end);
    return Status::ok;
  }

  /// A key point of the object that is being learned. `center`: the same place of the object in each of its views, in
  /// the coordinates of the view.
  ///
  /// Statuses, the first one that applies: not_trained (nothing is open), invalid_keypoint (it or the center is not
  /// finite, or they lie more than some 64 bandwidths apart), bad_frame, out_of_memory, not_written: then all of this
  /// object is lost. Of the others the key point alone.
  [[nodiscard]] Status add(const StoredKeyPoint<Stored>& key, const Point& center) noexcept {
    if (memory_ == nullptr) return Status::not_trained;
    if (!is_finite(key.position) || !is_finite(center)) return Status::invalid_keypoint;
    if (validate(key.frame) != Status::ok) return Status::bad_frame;
    const Point local = detail::to_local(center, key.position, key.frame);
    const float reach = 32767.0f * unit();
    for (const float c : {local.x, local.y, local.z}) {
      if (!(c >= -reach && c <= reach)) return Status::invalid_keypoint;
    }
    if (!fits(writer_.at() + detail::FlashLayout::before_row + sizeof(Stored))) return Status::out_of_memory;
    ++codewords_;
    detail::write_codeword(writer_, 0, local, unit());
    writer_.bytes(key.descriptor.bytes, sizeof(Stored));
    if (writer_.good()) return Status::ok;
    discard();
    return Status::not_written;
  }

  /// Makes a known object of the key points since the last one, or another view of an object that is known by these
  /// names. It is in model() then.
  ///
  /// Statuses: not_trained (no key point was added), bad_option (a null pointer), out_of_memory (more than MaxObjects,
  /// or the names do not fit): nothing is lost then. not_written: the object is.
  [[nodiscard]] Status commit(const char* object_class, const char* instance) noexcept {
    if (codewords_ == 0) return Status::not_trained;
    if (object_class == nullptr || instance == nullptr) return Status::bad_option;
    const std::uint64_t text_bytes = std::uint64_t{1} + text_size(object_class) + text_size(instance);
    if (model_.learned_count_ == MaxObjects || !fits(text_bytes)) return Status::out_of_memory;
    detail::FlashHeader header{0,
                               detail::storage_number<Stored>,
                               model_.options(),
                               sizeof(Stored),
                               0,  // the descriptor's order: what is learned does not depend on what was trained
                               codewords_,
                               1,
                               1,
                               static_cast<std::uint32_t>(text_bytes),
                               unit()};
    const auto checked_bytes = static_cast<std::size_t>(header.layout().checksum);
    header.size_bytes = static_cast<std::uint32_t>(checked_bytes + detail::checksum_bytes);
    if (!fits(std::uint64_t{begin_} + header.size_bytes)) return Status::out_of_memory;
    write_names(object_class, instance);
    writer_.pad(begin_ + checked_bytes, 0);
    write_header(header);
    writer_.number(writer_.checksum_since(begin_));
    writer_.pad(whole_units(writer_.at()), detail::erased_byte);
    return finish();
  }

  /// Forgets the key points since the last commit().
  void discard() noexcept {
    if (memory_ != nullptr) begin_behind(begin_);
  }

  /// What was trained and what was learned until now: for start(), after each commit() anew.
  [[nodiscard]] const ModelView<Stored>& model() const noexcept { return model_; }

  /// What is left for more, including an object that is being learned.
  [[nodiscard]] std::size_t bytes_left() const noexcept { return memory_ == nullptr ? 0 : size_bytes() - begin_; }

 private:
  [[nodiscard]] static constexpr std::size_t whole_units(std::size_t bytes) noexcept {
    return (bytes + unit_bytes - 1) / unit_bytes * unit_bytes;
  }
  /// With the 0 behind it; more than the memory has if it does not fit. (Without a bound it were a call of strlen.)
  [[nodiscard]] std::size_t text_size(const char* text) const noexcept {
    std::size_t size = 1;
    while (size <= size_bytes() && text[size - 1] != 0) ++size;
    return size;
  }
  [[nodiscard]] std::size_t size_bytes() const noexcept { return memory_->size_bytes() / unit_bytes * unit_bytes; }
  [[nodiscard]] bool fits(std::uint64_t end) const noexcept { return end <= size_bytes(); }

  /// Of centers: the power of two below a 256th of the bandwidth, so that 16 bits reach 64 bandwidths.
  [[nodiscard]] float unit() const noexcept {
    constexpr std::uint32_t exponent = 0x7F800000u;
    return detail::math::float_of(detail::math::bits_of(model_.options().bandwidth) & exponent) / 256.0f;
  }

  /// A whole model of one object of this storage, if one begins there.
  [[nodiscard]] static Status open_at(const Memory& memory, std::size_t begin, detail::FlashModel& out) noexcept {
    const std::uint8_t* const bytes = memory.bytes() + begin;
    const std::size_t left = memory.size_bytes() - begin;
    const std::size_t size = left < header_bytes ? left : detail::number32(bytes + 12);
    if (size > left) return Status::damaged_model;
    const Status status = out.open(bytes, size);
    if (status != Status::ok) return status;
    if (!ModelView<Stored>::is_of_storage(out)) return Status::other_descriptor;
    const bool is_one_object = out.class_count() == 1 && out.instance_count() == 1 && out.number_bits() == 0;
    return is_one_object ? Status::ok : Status::damaged_model;
  }
  [[nodiscard]] Status append(const detail::FlashModel& found) noexcept {
    if (model_.learned_count_ == MaxObjects) return Status::out_of_memory;
    detail::LearnedModel& next = learned_[model_.learned_count_];
    next = {found.codewords(), found.class_name(0), found.instance_name(0), 0, 0};
    model_.append(next);
    return Status::ok;
  }

  /// The next one begins behind all that was ever written, and not before `least`.
  void begin_behind(std::size_t least) noexcept {
    std::size_t end = size_bytes();
    while (end > least && memory_->bytes()[end - 1] == detail::erased_byte) --end;
    begin_ = whole_units(end);
    writer_ = {*memory_, begin_ + header_bytes};
    codewords_ = 0;
  }

  void write_names(const char* object_class, const char* instance) noexcept {
    writer_.number(std::uint8_t{0});  // no layout: its number is in the header
    writer_.text(object_class);
    writer_.text(instance);
  }
  void write_header(const detail::FlashHeader& header) noexcept {
    detail::UnitWriter<Memory> to(*memory_, begin_);
    to.bytes(reinterpret_cast<const std::uint8_t*>(detail::flash_model_magic), 8);
    to.number(detail::flash_model_version);
    detail::write(to, header);
    to.pad(begin_ + header_bytes, 0);  // the class of the instance, too
  }

  [[nodiscard]] Status finish() noexcept {
    detail::FlashModel made;
    const bool is_made = writer_.good() && open_at(*memory_, begin_, made) == Status::ok;
    if (is_made) static_cast<void>(append(made));
    begin_behind(is_made ? writer_.at() : begin_);
    return is_made ? Status::ok : Status::not_written;
  }

  Memory* memory_ = nullptr;
  ModelView<Stored> model_;
  detail::LearnedModel learned_[MaxObjects] = {};
  std::size_t begin_ = 0;  // of the object that is being learned, which is none yet
  std::uint32_t codewords_ = 0;
  detail::UnitWriter<Memory> writer_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_LEARNED_OBJECTS_HPP

// shortshot/recognition/micro_recognizer.hpp: recognition without a heap: a view's key points one after the other,
// against a model in flash.
#ifndef SHORTSHOT_RECOGNITION_MICRO_RECOGNIZER_HPP
#define SHORTSHOT_RECOGNITION_MICRO_RECOGNIZER_HPP

// shortshot/recognition/climb.hpp: from a vote to a maximum of the density of votes.
//
// After D. Comaniciu, P. Meer: Mean shift: A robust approach toward feature space analysis (PAMI 24, 2002), with a
// Gaussian kernel.
#ifndef SHORTSHOT_RECOGNITION_CLIMB_HPP
#define SHORTSHOT_RECOGNITION_CLIMB_HPP

// shortshot/recognition/vote_density.hpp: how dense votes are at a place, and where their mean lies from there.
#ifndef SHORTSHOT_RECOGNITION_VOTE_DENSITY_HPP
#define SHORTSHOT_RECOGNITION_VOTE_DENSITY_HPP

// shortshot/recognition/vote_centers.hpp: votes for an object's center, as lanes read them.
#ifndef SHORTSHOT_RECOGNITION_VOTE_CENTERS_HPP
#define SHORTSHOT_RECOGNITION_VOTE_CENTERS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A vote for an object's center.
struct Vote {
  Point center;
  std::uint32_t object_class;
  std::uint32_t instance;
};

/// Centers of votes, borrowed. A register that they do not fill is filled with the last one at an infinite x: out of
/// any reach, and nothing overflows on the way.
struct VoteCenters {
  const float* x;
  const float* y;
  const float* z;
  std::size_t padded;  ///< how many there are with these; a multiple of lanes
};

/// How far some votes lie from a place.
struct VoteOffsets {
  simd::F32 x, y, z;
  simd::F32 d2;  ///< as squared_distance() has it
};

[[nodiscard]] SHORTSHOT_INLINE VoteOffsets offsets(const VoteCenters& votes, std::size_t i,
                                                   const Point& from) noexcept {
  const simd::F32 x = simd::load(votes.x + i) - simd::all(from.x);
  const simd::F32 y = simd::load(votes.y + i) - simd::all(from.y);
  const simd::F32 z = simd::load(votes.z + i) - simd::all(from.z);
  return {x, y, z, (x * x + y * y) + z * z};
}

[[nodiscard]] constexpr std::size_t padded(std::size_t count) noexcept {
  return (count + simd::lanes - 1) / simd::lanes * simd::lanes;
}

/// Fills the last register of columns of centers.
inline void pad(float* x, float* y, float* z, std::size_t count) noexcept {
  for (std::size_t i = count; i < padded(count); ++i) {
    x[i] = extend::math::float_of(0x7F800000u);
    y[i] = y[count - 1];
    z[i] = z[count - 1];
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_VOTE_CENTERS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// e^-t, for t from 0 to 80: within 3e-7 of it, relatively, and the same on every machine, as libm's is not.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 exp_minus(simd::F32 t) noexcept {
  using simd::all;
  using simd::F32;
  using simd::I32;
  constexpr float factors[] = {1.0f / 720.0f, 1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f};
  const I32 halvings = shift_right(truncate_to_int(t * all(2.88539008f)) + simd::all_int(1), 1);  // t / ln 2, rounded
  const F32 n = to_float(halvings);
  const F32 r = (n * all(0.693359375f) - t) - n * all(2.12194440e-4f);  // ln 2 in two parts; |r| <= ln 2 / 2
  F32 sum = all(factors[0]);
  unroll<6>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sum = all(factors[k + 1]) + r * sum; });
  return simd::from_bits(bits_of(sum) - shift_left(halvings, 23));  // exactly: above 2^-126
}
[[nodiscard]] inline float exp_minus(float t) noexcept { return simd::largest(exp_minus(simd::all(t))); }

/// The density of votes (finite, of one class): the sum of w = exp(-d^2 / (2 h^2)) over their distances d, with h the
/// bandwidth.
class VoteDensity {
 public:
  static constexpr float reach = 6.0f;  ///< in bandwidths; the weight of a vote that far away is lost next to a 1

  explicit VoteDensity(float bandwidth) noexcept
      : bandwidth_(bandwidth),
        reach_d2_(reach * reach * bandwidth * bandwidth),
        factor_(0.5f / (bandwidth * bandwidth)) {}

  [[nodiscard]] float bandwidth() const noexcept { return bandwidth_; }

  /// What a vote adds to the density at a place.
  [[nodiscard]] float weight(const Vote& vote, const Point& at) const noexcept {
    const float d2 = squared_distance(vote.center, at);
    return d2 < reach_d2_ ? exp_minus(extend::unfused(factor_ * d2)) : 0.0f;
  }

  struct Sums {
    float density;
    Point shift;  ///< of w times the vote's offset: of differences, so that nothing is lost far away from the origin
  };

  /// Of votes that include all in reach. They are added one after the other, whatever the number of lanes; one that is
  /// out of reach adds zeros, as if it were not there. Offsets of the votes must be finite.
  [[nodiscard]] Sums at(const Point& place, const VoteCenters& votes) const noexcept {
    using simd::F32;
    const F32 reach_d2 = simd::all(reach_d2_);
    const F32 factor = simd::all(factor_);
    Sum sum;
    for (std::size_t i = 0; i < votes.padded; i += simd::lanes) {
      const VoteOffsets offset = offsets(votes, i, place);
      const simd::Mask reached = offset.d2 < reach_d2;
      const F32 w = keep(reached, exp_minus(factor * keep(reached, offset.d2)));
      sum.add(w, w * keep(reached, offset.x), w * offset.y, w * offset.z);  // x may be infinite
    }
    return sum.result();
  }

 private:
  /// Four sums, of numbers in lanes.
  class Sum {
   public:
    template <class F32>
    SHORTSHOT_INLINE void add(F32 w, F32 x, F32 y, F32 z) noexcept {
      if constexpr (simd::lanes == 1) {
        const F32 terms[] = {w, x, y, z};
        each<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sums_[+k] += simd::largest(terms[k]); });
      } else {
        simd::Quad terms[simd::lanes];
        transpose(bits_of(w), bits_of(x), bits_of(y), bits_of(z), terms);
        unroll<simd::lanes>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sums_ += reinterpret_cast<Four>(terms[k]); });
      }
    }
    [[nodiscard]] Sums result() const noexcept { return {sums_[0], {sums_[1], sums_[2], sums_[3]}}; }

   private:
    using Four = float __attribute__((vector_size(16)));
    Four sums_{};
  };

  float bandwidth_;
  float reach_d2_;
  float factor_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_VOTE_DENSITY_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A place and how dense votes are there.
struct Peak {
  Point at;
  float density;
};

/// The maximum where the mean shift from a vote's center ends, after 100 steps at the most. reachable(place) gives
/// VoteCenters with all votes of the class that are in reach of a place; others among them change no bit.
template <class Reachable>
[[nodiscard]] inline Peak climb(const VoteDensity& density, const Point& from, const Reachable& reachable) noexcept {
  constexpr float still = 1e-3f;  // a shift that ends the climb, in bandwidths
  constexpr int most_steps = 100;
  const float still_d2 = still * still * density.bandwidth() * density.bandwidth();
  Peak peak{from, 0.0f};
  Point at = from;
  for (int step = 0; step < most_steps; ++step) {
    const VoteDensity::Sums sums = density.at(at, reachable(at));
    if (!(sums.density > peak.density)) break;  // it grows, but for rounding, from the 1 of the vote itself
    peak = {at, sums.density};
    at = {at.x + sums.shift.x / sums.density, at.y + sums.shift.y / sums.density, at.z + sums.shift.z / sums.density};
    if (!(squared_distance(at, peak.at) > still_d2)) break;
  }
  return peak;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_CLIMB_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes for a class are those in [begin, end) of all.
struct VotesOfClass {
  std::size_t begin;
  std::size_t end;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Recognizes objects as recognize() does, with memory whose size is known before the program runs: sizeof this. The
/// hypotheses are those of recognize() with the recognizer that load_from_flash() makes of the model, bit for bit, for
/// the same key points in the same order.
///
///     static MicroRecognizer<NibbleDescriptor<ShapeColor95>, 128> recognizer;
///     recognizer.start(model);
///     for (each key point) recognizer.add(cloud, search, key point, 0.04f);
///     Hypothesis found[4];
///     const std::size_t count = recognizer.finish(found);
///
/// `Stored`        what the model is of: codes or bits of a descriptor that has a local reference frame
/// `MaxKeypoints`  of a view that count, at the most
/// `MaxNeighbors`  of a key point, as of a Workspace; 20 bytes each
/// `MaxActivated`  codewords that a descriptor activates at the most: RecognizerOptions::neighbors of the model
///
/// 48 bytes for each key point and activated codeword. No allocation; reentrant, one for each thread.
///
/// Time: add() is that of describe_at() and of a comparison with each codeword (some instructions for each of its
/// bytes). finish() is less than 100 steps of mean shift for each vote, where each step looks at each vote of its
/// class: at the most 100 V^2 looks for V votes, in practice some ten; and V^2 for each hypothesis.
template <class Stored, std::size_t MaxKeypoints, std::size_t MaxNeighbors = 512, std::size_t MaxActivated = 1>
class MicroRecognizer {
  using D = typename detail::Storage<Stored>::Descriptor;
  static_assert(D::needs_frame, "MicroRecognizer<Stored, ...> supports descriptors in a local reference frame");
  static_assert(MaxKeypoints >= 1 && MaxKeypoints <= 65536 && MaxActivated >= 1 && MaxActivated <= 1024,
                "MicroRecognizer<Stored, MaxKeypoints, MaxNeighbors, MaxActivated> supports 1 to 65536 key points and "
                "1 to 1024 codewords for each");

 public:
  /// Most votes that a view can have.
  static constexpr std::size_t max_votes = MaxKeypoints * MaxActivated;

  /// All zeros: static ones take no flash and no code.
  constexpr MicroRecognizer() noexcept = default;

  /// Begins a view, with a model, which is copied (its bytes are not).
  void start(const ModelView<Stored>& model) noexcept {
    model_ = model;
    votes_count_ = 0;
  }

  /// Describes a key point, by index or as a KeyPoint, and casts its votes; `own` as for describe_at().
  ///
  /// Statuses, the first one that applies: not_trained (not started, or no model is open), bad_option (a descriptor
  /// activates more than MaxActivated codewords), out_of_memory (MaxKeypoints have voted), and those of describe_at().
  /// The key point has no vote then, as one that is left out of recognize().
  template <class Search, class Place = KeyPoint, class... Own>
  [[nodiscard]] Status add(const CloudView& cloud, const Search& search, const Place& place, const Support& support,
                           const Own&... own) noexcept {
    Status status = ready();
    StoredKeyPoint<Stored> described;
    if (status == Status::ok) status = describe(cloud, search, place, support, described, own...);
    if (status == Status::ok) vote(described.descriptor, described.position, described.frame);
    return status;
  }

  /// Describes alone, for LearnedObjects or another add(): with or without a model. Statuses: those of describe_at();
  /// `out` is all zeros then.
  template <class Search, class Place = KeyPoint, class... Own>
  [[nodiscard]] Status describe(const CloudView& cloud, const Search& search, const Place& place,
                                const Support& support, StoredKeyPoint<Stored>& out, const Own&... own) noexcept {
    out = {};
    const Status status = detail::describe_key<D>(
        cloud, search, place, support, workspace_, values_,
        [&](const auto& n, const auto& sources, const Point& at) {
          out.position = at;
          return detail::describe_gathered<D, default_chunk_size>(n, sources, at, support, out.frame, values_);
        },
        own...);
    if (status == Status::ok) {
      detail::Storage<Stored>::make(values_, out.descriptor);
    } else {
      out = {};
    }
    return status;
  }

  /// The same for what was described elsewhere. Also invalid_keypoint and bad_frame.
  [[nodiscard]] Status add(const Stored& stored, const Point& position, const Frame& frame) noexcept {
    Status status = ready();
    if (status == Status::ok && !is_finite(position)) status = Status::invalid_keypoint;
    if (status == Status::ok) status = validate(frame);
    if (status == Status::ok) vote(stored, position, frame);
    return status;
  }

  /// Votes that were cast since start(). An object of the model has about this share of them as its score that it is
  /// seen in; where no hypothesis has an eighth, none of them may be there.
  [[nodiscard]] std::size_t votes() const noexcept { return votes_count_; }

  /// The densest places of all votes so far, at most `Most` and RecognizerOptions::most of the model; returns how many.
  /// See recognize(). More key points may follow.
  template <std::size_t Most>
  std::size_t finish(Hypothesis (&out)[Most]) noexcept {
    const std::size_t most = model_.options().most < Most ? model_.options().most : Most;
    const detail::VoteDensity density(model_.options().bandwidth);
    climb_from_all(density);
    std::size_t count = 0;
    while (count < most) {
      const std::size_t densest = densest_unknown(out, count);
      if (densest == votes_count_) break;
      const detail::Peak& peak = peaks_[densest];
      const std::uint32_t instance = heaviest_instance(density, votes_of_class_at(densest), peak.at);
      out[count++] = {votes_[densest].object_class, instance, peak.at, peak.density};
    }
    return count;
  }

 private:
  struct Activated {
    std::uint32_t codeword;
    std::uint32_t distance;
  };

  [[nodiscard]] Status ready() const noexcept {
    if (model_.codeword_count() == 0) return Status::not_trained;
    if (model_.options().neighbors > MaxActivated) return Status::bad_option;
    return votes_count_ + model_.options().neighbors > max_votes ? Status::out_of_memory : Status::ok;
  }

  /// One vote for each of the codewords that are nearest.
  void vote(const Stored& stored, const Point& position, const Frame& frame) noexcept {
    Activated nearest[MaxActivated];
    const std::size_t count = find_nearest(stored, nearest);
    for (std::size_t i = 0; i < count; ++i) {
      const Point center = detail::from_local(model_.center_of(nearest[i].codeword), position, frame);
      const std::uint32_t instance = model_.instance_of(nearest[i].codeword);
      if (is_finite(center)) insert({center, model_.class_of(instance), instance});
    }
  }

  /// Nearest first, the first ones of those that are as near; returns how many count.
  std::size_t find_nearest(const Stored& stored, Activated (&nearest)[MaxActivated]) const noexcept {
    const Stored arranged = model_.arranged(stored);
    for (Activated& none : nearest) none = {0, 0xFFFFFFFFu};
    model_.for_each_run([&](std::uint32_t first, const detail::CodewordRun& run) {
      for (std::uint32_t i = 0; i < run.count; ++i) {
        Activated next = first_below(run.is_arranged ? arranged : stored, run, i, nearest[MaxActivated - 1].distance);
        if (next.codeword == run.count) break;
        i = next.codeword;
        next.codeword += first;
        bool is_nearer = false;  // and then all that come later make room
        for (Activated& known : nearest) {
          is_nearer = is_nearer || next.distance < known.distance;
          if (is_nearer) std::swap(next, known);
        }
      }
    });
    const std::uint32_t most = model_.options().neighbors;
    return most < model_.codeword_count() ? most : model_.codeword_count();
  }

  /// The first codeword of a run from i on whose distance is below the limit; their number if there is none. Not in
  /// line: here most of the time goes, and all registers.
  [[gnu::noinline]] static Activated first_below(const Stored& stored, const detail::CodewordRun& run, std::uint32_t i,
                                                 std::uint32_t limit) noexcept {
    const std::uint32_t count = run.count;
    const std::uint8_t* row = run.row(i);
    for (; i < count; ++i, row += detail::FlashLayout::before_row + sizeof(Stored)) {
      const auto& codeword = *reinterpret_cast<const Stored*>(row);
      const std::uint32_t distance = detail::Storage<Stored>::distance_below(stored, codeword, limit);
      if (distance < limit) return {i, distance};
    }
    return {count, limit};
  }

  /// Behind all votes for its class and those before it.
  void insert(const detail::Vote& vote) noexcept {
    std::size_t place = votes_count_++;
    for (; place > 0 && vote.object_class < votes_[place - 1].object_class; --place) votes_[place] = votes_[place - 1];
    votes_[place] = vote;
  }

  [[nodiscard]] detail::VotesOfClass votes_of_class_at(std::size_t vote) const noexcept {
    detail::VotesOfClass of_class{vote, vote + 1};
    const std::uint32_t object_class = votes_[vote].object_class;
    while (of_class.begin > 0 && votes_[of_class.begin - 1].object_class == object_class) --of_class.begin;
    while (of_class.end < votes_count_ && votes_[of_class.end].object_class == object_class) ++of_class.end;
    return of_class;
  }

  void climb_from_all(const detail::VoteDensity& density) noexcept {
    for (std::size_t begin = 0; begin < votes_count_;) {
      const detail::VotesOfClass of_class = votes_of_class_at(begin);
      const detail::VoteCenters centers = centers_of(of_class);
      for (; begin < of_class.end; ++begin) {
        peaks_[begin] = detail::climb(density, votes_[begin].center, [&](const Point&) { return centers; });
      }
    }
  }

  [[nodiscard]] detail::VoteCenters centers_of(const detail::VotesOfClass& of_class) noexcept {
    const std::size_t count = of_class.end - of_class.begin;
    for (std::size_t i = 0; i < count; ++i) {
      const Point& center = votes_[of_class.begin + i].center;
      x_[i] = center.x;
      y_[i] = center.y;
      z_[i] = center.z;
    }
    detail::pad(x_, y_, z_, count);
    return {x_, y_, z_, detail::padded(count)};
  }

  /// The densest peak, the first one of those that are as dense, that is no hypothesis yet; votes_count_ if there is
  /// none.
  [[nodiscard]] std::size_t densest_unknown(const Hypothesis* known, std::size_t count) const noexcept {
    std::size_t densest = votes_count_;
    for (std::size_t i = 0; i < votes_count_; ++i) {
      if (densest < votes_count_ && !(peaks_[i].density > peaks_[densest].density)) continue;
      const bool is_known =
          detail::is_known(known, count, votes_[i].object_class, peaks_[i].at, model_.options().bandwidth);
      if (!is_known) densest = i;
    }
    return densest;
  }

  /// The instance whose votes have the largest sum of weights at a place, the first trained one of those.
  [[nodiscard]] std::uint32_t heaviest_instance(const detail::VoteDensity& density,
                                                const detail::VotesOfClass& of_class, const Point& at) noexcept {
    float* const weights = x_;  // the votes' columns are not needed any more
    for (std::size_t i = of_class.begin; i < of_class.end; ++i) {
      weights[i - of_class.begin] = density.weight(votes_[i], at);
    }
    std::uint32_t heaviest = votes_[of_class.begin].instance;
    float largest = -1.0f;
    for (std::size_t i = of_class.begin; i < of_class.end; ++i) {
      const std::uint32_t instance = votes_[i].instance;
      float sum = 0.0f;
      for (std::size_t k = of_class.begin; k < of_class.end; ++k) {
        if (votes_[k].instance == instance) sum += weights[k - of_class.begin];
      }
      if (sum > largest || (sum == largest && instance < heaviest)) {
        largest = sum;
        heaviest = instance;
      }
    }
    return heaviest;
  }

  static constexpr std::size_t columns = max_votes + extend::simd::lanes;

  ModelView<Stored> model_;
  std::size_t votes_count_ = 0;
  detail::Vote votes_[max_votes] = {};  // by class, those of a class in the order in which they were cast
  detail::Peak peaks_[max_votes] = {};
  float x_[columns] = {};
  float y_[columns] = {};
  float z_[columns] = {};
  float values_[D::size] = {};
  Workspace<MaxNeighbors> workspace_ = {};
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_MICRO_RECOGNIZER_HPP

// shortshot/search/brute.hpp: neighbors by looking at every point. No index, no memory: the reference, and the choice
// for a handful of key points in a small cloud.
#ifndef SHORTSHOT_SEARCH_BRUTE_HPP
#define SHORTSHOT_SEARCH_BRUTE_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A search (search.hpp) without an index.
class BruteSearch {
 public:
  /// Borrows the cloud's memory; a view that cannot be read is its status().
  explicit BruteSearch(const CloudView& cloud) noexcept
      : points_(cloud.points), size_(cloud.size), status_(validate(cloud)) {}

  /// ok, or why the cloud cannot be read.
  [[nodiscard]] Status status() const noexcept { return status_; }

  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return size_; }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). O(points); allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    extend::clear(out, center);
    if (status_ != Status::ok) return status_;
    const Point at = center;  // a local: what is stored cannot change it
    extend::Collector<Neighbors> found = out;
    for (std::size_t i = 0; i < size_; ++i) {
      extend::offer(found, extend::read(points_, i), static_cast<std::uint32_t>(i), at, radius.squared);
    }
    out = found;
    return extend::outcome(out);
  }

 private:
  Float3Channel points_;  // of the cloud, which is borrowed
  std::size_t size_;
  Status status_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_SEARCH_BRUTE_HPP

// shortshot/search/cell_index.hpp: the fixed-radius grid. Points are counting-sorted into cubic cells once per cloud; a
// query looks at runs of neighboring cells. Ten times faster to build than a tree, faster to search, and of bounded
// memory.
#ifndef SHORTSHOT_SEARCH_CELL_INDEX_HPP
#define SHORTSHOT_SEARCH_CELL_INDEX_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The index itself, in memory that somebody else owns; a search (see search.hpp for the concept). Trivial type:
/// build() before the first gather(). The cloud and the memory must outlive it. `Index` may be uint16_t for clouds of
/// up to 65,535 points, invalid ones included.
template <class Index = std::uint32_t>
class GridIndex {
  static_assert(std::is_same<Index, std::uint16_t>::value || std::is_same<Index, std::uint32_t>::value,
                "GridIndex<Index> supports uint16_t and uint32_t");

 public:
  /// Sort the cloud's valid points into cells of `cell_size` meters; best close to the search radius, or half of it for
  /// several hundred neighbors and more. Where the cells would not fit the memory (clouds of huge extent, far
  /// outliers) the outliers are put into the outermost cells and, if that is not enough, cells become larger: any cell
  /// size gives the same neighbors, only slower.
  ///
  /// Statuses: empty_cloud, bad_view, bad_radius (the cell size), out_of_memory (more valid points than
  /// point_capacity, points with indices beyond Index, or no cell). O(points + cells); allocates nothing.
  [[nodiscard]] Status build(const CloudView& cloud, float cell_size, const GridMemory<Index>& memory) noexcept {
    memory_ = memory;
    return grid_.build(cloud, cell_size, memory);
  }

  /// What the last build() returned; empty_cloud before the first one (in memory that started as zeros).
  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  /// Number of points in the index: the cloud's valid ones.
  [[nodiscard]] std::size_t size() const noexcept { return grid_.size(); }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    return grid_.gather({memory_.order, memory_.cell_end, memory_.xyz}, center, radius, out);
  }

 private:
  detail::Grid<Index> grid_;
  GridMemory<Index> memory_;
};

/// A grid with its memory inside, for clouds of up to `MaxPoints` valid points: a static or a member, no heap. 2 bytes
/// a point and 2 a cell up to 65,535 points, else 4 (the cloud's indices must fit those bytes, too). Trivial type:
/// build() before the first gather().
///
/// It takes less flash than a GridIndex and finds the same neighbors, but where a cloud's extent asks for more than
/// `MaxCells` cells, all of them become larger: take stray far returns out of the cloud (as NaN), or a GridIndex, which
/// leaves them out of its box.
template <std::size_t MaxPoints, std::size_t MaxCells>
class StaticGrid {
  static_assert(MaxPoints >= 1 && MaxCells >= 1, "StaticGrid<MaxPoints, MaxCells> supports one or more of both");

 public:
  /// Type of its indices.
  using Index = std::conditional_t<(MaxPoints <= 65535), std::uint16_t, std::uint32_t>;

  /// See GridIndex::build(), but for outliers.
  [[nodiscard]] Status build(const CloudView& cloud, float cell_size) noexcept {
    return grid_.build(cloud, cell_size, {order_, cell_end_, nullptr, MaxPoints, MaxCells});
  }

  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    return grid_.gather({order_, cell_end_, nullptr}, center, radius, out);
  }

 private:
  detail::Grid<Index, true> grid_;
  Index order_[MaxPoints];
  Index cell_end_[MaxCells];
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_SEARCH_CELL_INDEX_HPP

// shortshot/search/organized.hpp: neighbors in a window of the depth image. No index at all: for organized clouds on
// targets that cannot spare one.
#ifndef SHORTSHOT_SEARCH_ORGANIZED_HPP
#define SHORTSHOT_SEARCH_ORGANIZED_HPP

// shortshot/search/pinhole.hpp: the camera that an organized cloud was taken with, fitted to its points.
#ifndef SHORTSHOT_SEARCH_PINHOLE_HPP
#define SHORTSHOT_SEARCH_PINHOLE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// pixel = focal * (x / z) + center, for one direction of the image; no valid point is farther than `error` from it.
struct Projection {
  float focal;
  float center;
  float error;

  void widen(float slope, float pixel) noexcept {
    const float deviation = pixel - (extend::unfused(focal * slope) + center);
    const float magnitude = deviation < 0.0f ? 0.0f - deviation : deviation;
    if (!(magnitude <= error)) error = magnitude;
  }
};

/// Least squares of pixel over slope in float, by running means so that a million points do not wear it out. It need
/// not be exact: what the fit misses, the margin covers.
struct PinholeLine {
  float count, mean_slope, mean_pixel, variance, covariance;

  void add_to_mean(float slope, float pixel) noexcept {
    count += 1.0f;
    mean_slope += (slope - mean_slope) / count;
    mean_pixel += (pixel - mean_pixel) / count;
  }
  void add_to_slope(float slope, float pixel) noexcept {
    variance += extend::unfused((slope - mean_slope) * (slope - mean_slope));
    covariance += extend::unfused((slope - mean_slope) * (pixel - mean_pixel));
  }
  [[nodiscard]] bool is_finite() const noexcept {
    return extend::math::is_finite(mean_slope) && extend::math::is_finite({variance, mean_pixel, covariance});
  }
  [[nodiscard]] Projection projection() const noexcept {
    const float focal = variance > 0.0f ? covariance / variance : 0.0f;
    return {focal, mean_pixel - extend::unfused(focal * mean_slope), 0.0f};
  }
};

/// Is it an image, of at least one column? (Whatever the view says, nothing overflows.)
[[nodiscard]] inline bool is_image(const CloudView& cloud) noexcept {
  return cloud.height > 1 && cloud.width > 0 && cloud.size / cloud.width == cloud.height &&
         cloud.size % cloud.width == 0;
}

/// Calls add(column, row, x / z, y / z) for every `step`-th pixel whose point is valid and not in the camera's own
/// plane.
template <class Add>
inline void for_pixels(const CloudView& cloud, std::size_t step, Add add) noexcept {
  for (std::size_t i = 0; i < cloud.size; i += step) {
    const Point p = point(cloud, i);
    if (!is_finite(p) || p.z == 0.0f) continue;
    const std::size_t row = i / cloud.width;
    add(static_cast<float>(i - row * cloud.width), static_cast<float>(row), p.x / p.z, p.y / p.z);
  }
}

/// The camera of an image by every `step`-th point. not_organized: they deviate from every pinhole by more than a
/// quarter of the image.
[[nodiscard]] inline Status fit_pinhole(const CloudView& cloud, std::size_t step, Projection& columns,
                                        Projection& rows) noexcept {
  PinholeLine u_line{};
  PinholeLine v_line{};
  for_pixels(cloud, step, [&](float u, float v, float x, float y) {
    u_line.add_to_mean(x, u);
    v_line.add_to_mean(y, v);
  });
  if (!u_line.is_finite() || !v_line.is_finite()) return Status::not_organized;
  for_pixels(cloud, step, [&](float u, float v, float x, float y) {
    u_line.add_to_slope(x, u);
    v_line.add_to_slope(y, v);
  });
  if (!u_line.is_finite() || !v_line.is_finite()) return Status::not_organized;
  columns = u_line.projection();
  rows = v_line.projection();
  for_pixels(cloud, step, [&](float u, float v, float x, float y) {
    columns.widen(x, u);
    rows.widen(y, v);
  });
  const bool is_pinhole = columns.error <= 0.25f * static_cast<float>(cloud.width) &&
                          rows.error <= 0.25f * static_cast<float>(cloud.height);
  return is_pinhole ? Status::ok : Status::not_organized;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_SEARCH_PINHOLE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// First and last pixel of a window.
struct PixelRange {
  std::size_t first;
  std::size_t last;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Search of an organized cloud by projecting the support sphere into the image; a search (see search.hpp). The camera
/// need not be known: build() fits a pinhole to the cloud and keeps the largest deviation as the window's margin, so
/// that the neighbors are exactly those of every other search. Trivial type; the cloud must outlive it.
class OrganizedSearch {
 public:
  /// Statuses: empty_cloud, bad_view, not_organized (height 1, width * height != size, points in front of and behind
  /// the camera, or points that deviate from every pinhole by more than a quarter of the image, as after moving the
  /// cloud into another coordinate system). O(points); allocates nothing.
  [[nodiscard]] Status build(const CloudView& cloud) noexcept {
    *this = OrganizedSearch{};
    cloud_ = cloud;
    status_ = fit();
    return status_;
  }

  /// What the last build() returned; empty_cloud before the first one (in memory that started as zeros).
  [[nodiscard]] Status status() const noexcept { return cloud_.size == 0 ? Status::empty_cloud : status_; }

  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return cloud_.size; }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    extend::clear(out, center);
    if (status() != Status::ok) return status();
    if (!shortshot::is_finite(center)) return Status::ok;
    const float reach = extend::unfused(radius.value * 1.000001f);  // covers the rounding of d2
    const detail::PixelRange columns = window(columns_, center.x, center.z, reach, cloud_.width);
    const detail::PixelRange rows = window(rows_, center.y, center.z, reach, cloud_.height);
    for (std::size_t v = rows.first; v < rows.last; ++v) {
      for (std::size_t u = columns.first; u < columns.last; ++u) {
        const std::size_t i = v * cloud_.width + u;
        extend::offer(out, point(cloud_, i), static_cast<std::uint32_t>(i), center, radius.squared);
      }
    }
    return extend::outcome(out);
  }

 private:
  /// Pixels (first, one past last) that the cube around the sphere projects to; all of them if it reaches the camera.
  [[nodiscard]] static detail::PixelRange window(const detail::Projection& p, float center, float z, float reach,
                                                 std::size_t pixels) noexcept {
    const float near = z - reach;
    const float far = z + reach;
    if (!(near * far > 0.0f)) return {0, pixels};
    const float corners[4] = {(center - reach) / near, (center - reach) / far, (center + reach) / near,
                              (center + reach) / far};
    float low = extend::unfused(p.focal * corners[0]) + p.center;
    float high = low;
    for (const float corner : corners) {
      const float pixel = extend::unfused(p.focal * corner) + p.center;
      low = pixel < low ? pixel : low;
      high = pixel > high ? pixel : high;
    }
    // NaN, where there is no slope and a corner lies beyond float's range, leaves nobody out.
    const float first = low - p.error - 1.0f;
    const float last = high + p.error + 2.0f;
    const auto end = static_cast<float>(pixels);
    return {!(first > 0.0f) ? 0
            : first < end   ? static_cast<std::size_t>(first)
                            : pixels,
            !(last < end) ? pixels
            : last > 0.0f ? static_cast<std::size_t>(last)
                          : 0};
  }

  [[nodiscard]] Status fit() noexcept {
    const Status usable = validate(cloud_);
    if (usable != Status::ok) return usable;
    if (!detail::is_image(cloud_) || cloud_.width < 2) return Status::not_organized;
    bool front = false;
    bool behind = false;
    bool nowhere = false;  // in the camera's own plane: in no pixel
    extend::for_each_valid(cloud_, [&](std::size_t, const Point& p) {
      front = front || p.z > 0.0f;
      behind = behind || p.z < 0.0f;
      nowhere = nowhere || p.z == 0.0f;
    });
    if (!front && !behind && !nowhere) return Status::empty_cloud;
    if ((front && behind) || nowhere) return Status::not_organized;
    return detail::fit_pinhole(cloud_, 1, columns_, rows_);
  }

  CloudView cloud_;
  Status status_;
  detail::Projection columns_;
  detail::Projection rows_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_SEARCH_ORGANIZED_HPP

// shortshot/self_check.hpp: does the build at hand keep the promise of the same bits everywhere?
#ifndef SHORTSHOT_SELF_CHECK_HPP
#define SHORTSHOT_SELF_CHECK_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

[[nodiscard, gnu::always_inline]] inline float product(float a, float b) noexcept { return extend::unfused(a * b); }
[[nodiscard, gnu::always_inline]] inline simd::F32 product(simd::F32 a, simd::F32 b) noexcept { return a * b; }

[[nodiscard, gnu::always_inline]] inline bool has_bits(float value, float expected) noexcept {
  return math::bits_of(value) == math::bits_of(expected);
}
[[nodiscard, gnu::always_inline]] inline bool has_bits(simd::F32 value, float expected) noexcept {
  return every(bits_of(value) == bits_of(simd::all(expected)));
}

/// Arithmetic with a float, or with a register of them, of which `of` makes one. Each line is true if operations are
/// what they say, and false under what its comment names.
template <class Of>
[[nodiscard, gnu::always_inline]] inline bool rounds_each_operation(Of of) noexcept {
  // Volatile: what is computed while compiling says nothing about the program.
  const auto number = [&](float value) {
    volatile float unknown = value;
    return of(unknown);
  };
  constexpr float half_ulp = 5.96046448e-8f;  // 2^-24, of numbers from 1 on
  constexpr float least = 1.17549435e-38f;    // of normal numbers: 2^-126
  const auto one = number(1.0f);
  const auto above_one = number(1.0f + 4096.0f * half_ulp);  // its square needs 25 bits
  const auto large = number(extend::whole_numbers);
  const auto divisor = number(3.0f);
  const auto quotients = [&](float a) { return has_bits(number(a) / divisor, a / 3.0f); };
  using simd::sqrt;

  // All of them, whatever the first say: the compiler replaces several divisions at once.
  bool right = has_bits(product(above_one, above_one) - number(1.0f + 8192.0f * half_ulp), 0.0f);  // fused
  right &= has_bits((number(0.25f) + large) - large, 0.0f);                                        // regrouped
  right &= quotients(5.0f);  // multiplied by the reciprocal, these and the next ones
  right &= quotients(7.0f);
  right &= quotients(11.0f);
  right &= quotients(13.0f);
  right &= has_bits(number(5.0f) / of(3.0f), 5.0f / 3.0f);
  right &= has_bits(number(7.0f) / of(3.0f), 7.0f / 3.0f);
  right &= has_bits(sqrt(number(3.0f)), 1.73205081f);  // approximated
  right &= has_bits(sqrt(number(5.0f)), 2.23606798f);
  right &= has_bits(one + number(half_ulp / 2.0f), 1.0f);                 // rounded up
  right &= has_bits(one - number(half_ulp / 4.0f), 1.0f);                 // rounded down, or towards zero
  right &= has_bits(number(-0.0f) + of(0.0f), 0.0f);                      // signs of zeros ignored
  right &= has_bits(product(number(least), of(0.5f)), least / 2.0f);      // small results flushed to zero
  right &= has_bits(number(least / 2.0f) + number(least / 2.0f), least);  // small operands taken for zero
  return right;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// True if arithmetic is what the same bits on every machine need: every operation rounded by itself, to the nearest.
/// GCC and clang are kept from fusing a * b + c into one rounding by unfused() wherever their CPUs can; other CPUs may
/// need -ffp-contract=off. False
///   * where something is fused nevertheless;
///   * under -ffast-math, and under those of its parts that change bits, one by one: sums regrouped
///     (-fassociative-math), divisions replaced (-freciprocal-math), NaN or the signs of zeros ignored
///     (-ffinite-math-only, -fno-signed-zeros);
///   * where floats have more bits than 32 on the way (x87: with -m32, add -msse2 -mfpmath=sse);
///   * in a thread that rounds otherwise (fesetround()), or takes numbers below 2^-126 for zero, as a program does of
///     which any library was linked with -ffast-math.
/// Descriptors are then still descriptors, but may differ in their last bits from those of other builds; without NaN,
/// NaN points may be taken for neighbors. It speaks for the flags of the translation unit that calls it, and for the
/// thread. No allocation, reentrant.
[[nodiscard, gnu::always_inline]] inline bool self_check() noexcept {
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
  return false;
#else
  const bool floats = detail::rounds_each_operation([](float value) { return value; });
  const bool lanes = detail::rounds_each_operation([](float value) { return extend::simd::all(value); });
  return floats && lanes;
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_SELF_CHECK_HPP
#endif  // SHORTSHOT_KERNEL_HPP

// shortshot/cloud/view_of.hpp: views of containers of structs, PCL's clouds among them, by their members' names.
//
// No other library is included: whatever has the members is understood. A point needs float x, y, z (in that or any
// order, with any padding), for color one-byte r, g, b (in any order: PCL keeps b, g, r, a), and for a normal float
// normal_x, normal_y, normal_z, which may also stand in structs of their own; for an intensity a float, a std::uint8_t
// or a std::uint16_t of that name (pcl::PointXYZI).
#ifndef SHORTSHOT_CLOUD_VIEW_OF_HPP
#define SHORTSHOT_CLOUD_VIEW_OF_HPP

#include <iterator>

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class P, class = void>
struct HasRgb : std::false_type {};
template <class P>
struct HasRgb<P, std::void_t<decltype(P::r), decltype(P::g), decltype(P::b)>>
    : std::bool_constant<sizeof(P::r) == 1 && sizeof(P::g) == 1 && sizeof(P::b) == 1> {};

template <class P, class = void>
struct HasNormal : std::false_type {};
template <class P>
struct HasNormal<P, std::void_t<decltype(P::normal_x), decltype(P::normal_y), decltype(P::normal_z)>>
    : std::bool_constant<std::is_same<std::remove_cv_t<decltype(P::normal_x)>, float>::value &&
                         std::is_same<std::remove_cv_t<decltype(P::normal_y)>, float>::value &&
                         std::is_same<std::remove_cv_t<decltype(P::normal_z)>, float>::value> {};

template <class P, class = void>
struct HasIntensity : std::false_type {};
template <class P>
struct HasIntensity<P, std::void_t<decltype(P::intensity)>>
    : std::bool_constant<is_channel_scalar<std::remove_cv_t<decltype(P::intensity)>>> {};

template <class C, class = void>
struct HasPoints : std::false_type {};
template <class C>
struct HasPoints<C, std::void_t<decltype(std::declval<const C&>().points.data())>> : std::true_type {};

/// view_of()'s second argument is a container, unless it is a count.
template <class C>
using IfContainer = std::enable_if_t<!std::is_convertible<C, std::size_t>::value>;

/// The structs in a container, or in the `points` of a pcl::PointCloud-shaped object.
template <class C>
[[nodiscard]] const auto& structs_of(const C& container) noexcept {
  if constexpr (HasPoints<C>::value) {
    return container.points;
  } else {
    return container;
  }
}

template <class Member>
[[nodiscard]] const unsigned char* bytes_of(const Member& member) noexcept {
  return reinterpret_cast<const unsigned char*>(&member);
}

template <class P>
[[nodiscard]] Float3Channel normals_of(const P* structs, std::size_t count) noexcept {
  if (structs == nullptr || count == 0) return {};
  return {bytes_of(structs->normal_x), bytes_of(structs->normal_y), bytes_of(structs->normal_z), sizeof(P)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// View of `count` structs with members x, y, z and, if they have them, r, g, b; normal_x, normal_y, normal_z; and
/// intensity.
template <class P>
[[nodiscard]] CloudView view_of(const P* points, std::size_t count) noexcept {
  static_assert(std::is_same<std::remove_cv_t<decltype(P::x)>, float>::value &&
                    std::is_same<std::remove_cv_t<decltype(P::y)>, float>::value &&
                    std::is_same<std::remove_cv_t<decltype(P::z)>, float>::value,
                "view_of() supports points with float members x, y and z");
  CloudView view{};
  view.size = count;
  view.width = count;
  view.height = 1;
  if (points == nullptr || count == 0) return view;  // to be refused by validate()
  view.points = {detail::bytes_of(points->x), detail::bytes_of(points->y), detail::bytes_of(points->z), sizeof(P)};
  if constexpr (detail::HasRgb<P>::value) {
    view.colors = {detail::bytes_of(points->r), detail::bytes_of(points->g), detail::bytes_of(points->b), sizeof(P)};
  }
  if constexpr (detail::HasNormal<P>::value) view.normals = detail::normals_of(points, count);
  if constexpr (detail::HasIntensity<P>::value) return with_intensities(view, &points->intensity, sizeof(P));
  return view;
}

/// View of an array, a std::vector or anything else with data() and size(); or of a pcl::PointCloud-shaped object:
/// `points` with data() and size(), and `width` and `height`.
template <class Container>
[[nodiscard]] CloudView view_of(const Container& cloud) noexcept {
  const auto& structs = detail::structs_of(cloud);
  const CloudView view = view_of(std::data(structs), std::size(structs));
  if constexpr (detail::HasPoints<Container>::value) {
    if (static_cast<std::size_t>(cloud.width) * cloud.height == view.size) {
      return organized(view, cloud.width, cloud.height);
    }
  }
  return view;
}

/// The same with normals from a second container of structs with members normal_x, normal_y, normal_z, such as a
/// pcl::PointCloud<pcl::Normal>; normals that the points have themselves are not read. sizes_differ if the numbers of
/// structs do.
template <class Container, class Normals, class = detail::IfContainer<Normals>>
[[nodiscard]] CloudView view_of(const Container& cloud, const Normals& normals) noexcept {
  const auto& structs = detail::structs_of(normals);
  using Struct = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(structs))>>;
  static_assert(detail::HasNormal<Struct>::value,
                "view_of() supports normals with float members normal_x, normal_y and normal_z");
  CloudView view = view_of(cloud);
  if (std::size(structs) != view.size) return detail::unusable_view(Status::sizes_differ);
  view.normals = detail::normals_of(std::data(structs), std::size(structs));
  return view;
}

/// A container that dies at the end of the statement cannot be viewed.
template <class Container>
CloudView view_of(const Container&& cloud) = delete;
template <class Container, class Normals, class = detail::IfContainer<Normals>>
CloudView view_of(const Container&& cloud, const Normals& normals) = delete;
template <class Container, class Normals, class = detail::IfContainer<Normals>>
CloudView view_of(const Container& cloud, const Normals&& normals) = delete;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_CLOUD_VIEW_OF_HPP

// shortshot/cloud/view_point_cloud2.hpp: views of sensor_msgs/PointCloud2-shaped messages, without including ROS.
#ifndef SHORTSHOT_CLOUD_VIEW_POINT_CLOUD2_HPP
#define SHORTSHOT_CLOUD_VIEW_POINT_CLOUD2_HPP

// shortshot/cloud/point_cloud2.hpp: what a sensor_msgs/PointCloud2-shaped message says of itself, checked before any of
// its bytes is read: which fields are its coordinates, colors, normals and intensities, and where its rows lie.
#ifndef SHORTSHOT_CLOUD_POINT_CLOUD2_HPP
#define SHORTSHOT_CLOUD_POINT_CLOUD2_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// PointField's datatypes.
enum FieldType : int {
  field_int8 = 1,
  field_uint8,
  field_int16,
  field_uint16,
  field_int32,
  field_uint32,
  field_float32,
  field_float64
};

/// Bytes of a number; 0 for a type that there is not.
[[nodiscard]] inline std::uint64_t size_of_type(std::uint64_t type) noexcept {
  constexpr std::uint8_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return type < sizeof sizes ? sizes[type] : 0;
}

/// A message's numbers have 32 bits. What has more in another's struct, and what is negative, becomes 2^32.
template <class Number>
[[nodiscard]] std::uint64_t message_number(const Number& number) noexcept {
  constexpr std::uint64_t too_large = std::uint64_t{1} << 32;
  const auto wide = static_cast<std::uint64_t>(number);
  return wide < too_large ? wide : too_large;
}

template <class Field, class = void>
struct HasElementCount : std::false_type {};
template <class Field>
struct HasElementCount<Field, std::void_t<decltype(std::declval<const Field&>().count)>> : std::true_type {};

struct MessageField {
  bool exists;
  std::uint64_t offset;
  std::uint64_t type;
  std::uint64_t count;
};

/// The first field of a name. A count of 0 means 1: some drivers never set it, and PCL reads them so.
template <class Message>
[[nodiscard]] MessageField field_of(const Message& message, const char* name) noexcept {
  for (const auto& field : message.fields) {
    if (!(field.name == name)) continue;
    MessageField found{true, message_number(field.offset), message_number(field.datatype), 1};
    if constexpr (HasElementCount<std::decay_t<decltype(field)>>::value)
      found.count = field.count == 0 ? 1 : message_number(field.count);
    return found;
  }
  return {};
}

/// Three numbers of a point, or one: where they are, and whether they can be read: ok in place, needs_conversion by a
/// copy, else why not.
struct MessageChannel {
  Status status;
  std::size_t offset[3];
  int type[3];
};

/// Which types a channel may have, and what it is to have none, or only some of its fields.
struct ChannelRule {
  Status (*accept)(std::uint64_t type, std::uint64_t count);
  Status missing;
  Status partial;
};

inline Status accept_coordinate(std::uint64_t type, std::uint64_t count) noexcept {
  if (count != 1 || size_of_type(type) == 0) return Status::bad_field;
  return type == field_float32 ? Status::ok : Status::needs_conversion;
}
inline Status accept_normal(std::uint64_t type, std::uint64_t count) noexcept {
  if (count != 1 || (type != field_float32 && type != field_float64)) return Status::unread_channel;
  return type == field_float32 ? Status::ok : Status::needs_conversion;
}
inline Status accept_intensity(std::uint64_t type, std::uint64_t count) noexcept {
  if (count != 1 || size_of_type(type) == 0) return Status::unread_channel;
  const bool in_place = type == field_float32 || type == field_uint8 || type == field_uint16;
  return in_place ? Status::ok : Status::needs_conversion;
}
/// Other types than bytes may mean 0 to 1, 0 to 255 or 0 to 65535: a guess could be a wrong color.
inline Status accept_byte(std::uint64_t type, std::uint64_t count) noexcept {
  return count == 1 && type == field_uint8 ? Status::ok : Status::unread_channel;
}
/// 0xAARRGGBB in 32 bits, whatever they are called.
inline Status accept_packed(std::uint64_t type, std::uint64_t count) noexcept {
  const bool word = type == field_int32 || type == field_uint32 || type == field_float32;
  return count == 1 && word ? Status::ok : Status::unread_channel;
}
inline Status accept_packed_or_bytes(std::uint64_t type, std::uint64_t count) noexcept {
  return count == 3 && type == field_uint8 ? Status::ok : accept_packed(type, count);
}

/// How bad it is. From `damaged` on the message contradicts itself, and nothing of it is believed.
inline constexpr int missing_channel = 3;
inline constexpr int damaged_channel = 4;
[[nodiscard]] inline int severity(Status status) noexcept {
  switch (status) {
    case Status::ok: return 0;
    case Status::needs_conversion: return 1;
    case Status::bad_field:
    case Status::unread_channel: return 2;
    case Status::field_outside: return damaged_channel;
    default: return missing_channel;
  }
}

/// The channel of `count` fields; if none of them is there, its status is rule.missing.
template <class Message>
[[nodiscard]] MessageChannel channel_of(const Message& message, const char* const* names, std::size_t count,
                                        const ChannelRule& rule) noexcept {
  MessageChannel channel{};
  std::size_t missing = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const MessageField field = field_of(message, names[k]);
    if (!field.exists) {
      ++missing;
      continue;
    }
    const std::uint64_t size = size_of_type(field.type);
    const std::uint64_t end = field.offset + (size == 0 ? 1 : size) * field.count;
    Status status = rule.accept(field.type, field.count);
    if (end > message_number(message.point_step)) status = Status::field_outside;
    if (severity(status) > severity(channel.status)) channel.status = status;
    if (severity(status) >= damaged_channel) continue;
    channel.offset[k] = static_cast<std::size_t>(field.offset);
    channel.type[k] = static_cast<int>(field.type <= field_float64 ? field.type : 0);
  }
  if (severity(channel.status) >= damaged_channel || missing == 0) return channel;
  channel.status = missing == count ? rule.missing : rule.partial;
  return channel;
}

/// Of two channels that mean the same: damage is not passed over, else the one that can be read more easily.
[[nodiscard]] inline const MessageChannel& better(const MessageChannel& a, const MessageChannel& b) noexcept {
  const int of_a = severity(a.status);
  const int of_b = severity(b.status);
  if (of_a >= damaged_channel || of_b >= damaged_channel) return of_a >= of_b ? a : b;
  return of_a <= of_b ? a : b;
}

template <class Message>
[[nodiscard]] MessageChannel coordinates_of(const Message& message) noexcept {
  constexpr const char* names[][3] = {{"x", "y", "z"}, {"X", "Y", "Z"}};
  const ChannelRule rule{accept_coordinate, Status::no_coordinates, Status::no_coordinates};
  return better(channel_of(message, names[0], 3, rule), channel_of(message, names[1], 3, rule));
}

template <class Message>
[[nodiscard]] MessageChannel normals_in(const Message& message) noexcept {
  constexpr const char* names[][3] = {{"normal_x", "normal_y", "normal_z"}, {"nx", "ny", "nz"}};
  const ChannelRule rule{accept_normal, Status::missing_normals, Status::unread_channel};
  return better(channel_of(message, names[0], 3, rule), channel_of(message, names[1], 3, rule));
}

template <class Message>
[[nodiscard]] MessageChannel intensities_in(const Message& message) noexcept {
  constexpr const char* name = "intensity";
  return channel_of(message, &name, 1, {accept_intensity, Status::missing_intensities, Status::missing_intensities});
}

/// Offsets are those of the bytes red, green and blue.
template <class Message>
[[nodiscard]] MessageChannel colors_in(const Message& message) noexcept {
  constexpr const char* words[] = {"rgb", "rgba"};
  constexpr const char* bytes[][3] = {
      {"r", "g", "b"}, {"red", "green", "blue"}, {"R", "G", "B"}, {"Red", "Green", "Blue"}};
  MessageChannel colors{Status::missing_colors, {}, {}};
  const bool big = static_cast<bool>(message.is_bigendian);
  for (const auto& name : words) {
    const bool is_rgb = &name == &words[0];
    MessageChannel word =
        channel_of(message, &name, 1,
                   {is_rgb ? accept_packed_or_bytes : accept_packed, Status::missing_colors, Status::missing_colors});
    const bool is_packed = word.type[0] != field_uint8;
    const std::size_t places[3] = {is_packed ? (big ? 1u : 2u) : 0u,
                                   is_packed && !big ? 1u
                                   : is_packed       ? 2u
                                                     : 1u,
                                   is_packed ? (big ? 3u : 0u) : 2u};
    for (std::size_t k = 3; k-- > 0;) word.offset[k] = word.offset[0] + places[k];
    colors = better(colors, word);
  }
  for (const auto& names : bytes) {
    colors =
        better(colors, channel_of(message, names, 3, {accept_byte, Status::missing_colors, Status::unread_channel}));
  }
  return colors;
}

/// Where the points lie in a message's data.
struct MessageRows {
  Status status;  ///< ok: all points follow each other by `step`; padded_rows: rows by `row_bytes`; else why not
  std::size_t width;
  std::size_t height;
  std::size_t step;
  std::size_t row_bytes;
};

/// Data that is as long as all points tells the truth, whatever row_step says. No product leaves 64 bits: there are
/// less than 2^32 points, hence rows and columns together, and steps are 2^32 at most. What fits the data fits
/// std::size_t.
template <class Message>
[[nodiscard]] MessageRows rows_in(const Message& message) noexcept {
  const std::uint64_t width = message_number(message.width);
  const std::uint64_t height = message_number(message.height);
  const std::uint64_t step = message_number(message.point_step);
  const std::uint64_t size = message.data.size();
  const auto refused = [](Status status) { return MessageRows{status, 0, 0, 0, 0}; };
  if (width == 0 || height == 0) return refused(Status::empty_cloud);
  if (step == 0) return refused(Status::no_point_step);
  if (width > 0xFFFFFFFFu / height) return refused(Status::too_many_points);
  const std::uint64_t row = width * step;
  if (size < row * height) return refused(Status::short_data);
  const std::uint64_t said = height > 1 ? message_number(message.row_step) : row;
  const bool dense = said == row || size == row * height;
  if (!dense && said < row) return refused(Status::short_rows);
  if (!dense && size < said * (height - 1) + row) return refused(Status::short_data);
  return {dense ? Status::ok : Status::padded_rows, static_cast<std::size_t>(width), static_cast<std::size_t>(height),
          static_cast<std::size_t>(step), static_cast<std::size_t>(dense ? row : said)};
}

[[nodiscard]] inline bool is_little_endian() noexcept { return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__; }

/// All of it.
struct MessageParts {
  Status status;  ///< ok: copy_point_cloud2() can read the points, if not view_point_cloud2()
  bool has_other_order;
  MessageRows rows;
  MessageChannel points;
  MessageChannel colors;
  MessageChannel normals;
  MessageChannel intensities;
};

template <class Message>
[[nodiscard]] MessageParts parts_of(const Message& message) noexcept {
  MessageParts parts{Status::ok,
                     static_cast<bool>(message.is_bigendian) == is_little_endian(),
                     rows_in(message),
                     coordinates_of(message),
                     colors_in(message),
                     normals_in(message),
                     intensities_in(message)};
  const Status of_rows = parts.rows.status;
  const auto refuse = [&](Status status) {
    if (parts.status == Status::ok) parts.status = status;
  };
  if (parts.points.status == Status::no_coordinates) refuse(Status::no_coordinates);
  if (of_rows == Status::empty_cloud || of_rows == Status::no_point_step) refuse(of_rows);
  if (severity(parts.points.status) > severity(Status::needs_conversion)) refuse(parts.points.status);
  for (const MessageChannel* channel : {&parts.colors, &parts.normals, &parts.intensities}) {
    if (severity(channel->status) >= damaged_channel) refuse(channel->status);
  }
  if (of_rows != Status::padded_rows) refuse(of_rows);
  return parts;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_CLOUD_POINT_CLOUD2_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What a message has, and who reads it. Each is ok (view_point_cloud2() reads it, and so does copy_point_cloud2()),
/// needs_conversion (copy_point_cloud2() alone), or why nobody does: no_coordinates, missing_colors, missing_normals,
/// missing_intensities (there is none), bad_field, unread_channel (a type or a number of elements that is not read, or
/// a part of it is missing), field_outside.
struct PointCloud2Channels {
  Status coordinates;  ///< fields x, y and z
  Status colors;       ///< rgb or rgba
  Status normals;      ///< normal_x, normal_y and normal_z
  Status intensities;  ///< intensity
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// What a message has; only its fields, point_step and is_bigendian are looked at. No allocation; reentrant.
template <class Message>
[[nodiscard]] PointCloud2Channels point_cloud2_channels(const Message& message) noexcept {
  return {detail::coordinates_of(message).status, detail::colors_in(message).status, detail::normals_in(message).status,
          detail::intensities_in(message).status};
}

/// View of a message with members data (data(), size()), fields (name, offset, datatype and, if it has one, count),
/// point_step, row_step, width, height and is_bigendian. The view borrows the message's bytes, and is organized as the
/// message.
///
/// Read are fields x, y, z (or X, Y, Z) of FLOAT32; colors `rgb` or `rgba`, 0xAARRGGBB packed into a FLOAT32, UINT32 or
/// INT32, `rgb` of three UINT8 (red first), or UINT8 fields r g b, red green blue, R G B, Red Green Blue; normals
/// normal_x, normal_y, normal_z or nx, ny, nz of FLOAT32; an intensity of FLOAT32, UINT8 or UINT16. A row_step that is
/// wrong does no harm where data.size() is width * height * point_step.
///
/// Statuses: unread_channel: the message has colors, normals or intensities that are not read in place: the view has
/// the rest, and point_cloud2_channels() says which. All others leave an empty view: no_coordinates, empty_cloud (no
/// point), no_point_step, bad_field, field_outside (a field of any of these names), too_many_points,
/// short_data, short_rows; and those that copy_point_cloud2() reads: other_byte_order, needs_conversion (coordinates),
/// padded_rows. The first one that applies. No allocation; reentrant.
template <class Message>
[[nodiscard]] Status view_point_cloud2(const Message& message, CloudView& view) noexcept {
  view = CloudView{};
  const detail::MessageParts parts = detail::parts_of(message);
  if (parts.status != Status::ok) return parts.status;
  if (parts.has_other_order) return Status::other_byte_order;
  if (parts.points.status != Status::ok) return parts.points.status;
  if (parts.rows.status != Status::ok) return parts.rows.status;

  const auto* data = reinterpret_cast<const unsigned char*>(message.data.data());
  const std::size_t step = parts.rows.step;
  const auto floats = [=](const detail::MessageChannel& channel) -> Float3Channel {
    return {data + channel.offset[0], data + channel.offset[1], data + channel.offset[2], step};
  };
  view.size = parts.rows.width * parts.rows.height;
  view.width = parts.rows.width;
  view.height = parts.rows.height;
  view.points = floats(parts.points);
  bool all_read = true;
  const auto is_read = [&](const detail::MessageChannel& channel) {
    all_read =
        all_read && (channel.status == Status::ok || detail::severity(channel.status) == detail::missing_channel);
    return channel.status == Status::ok;
  };
  if (is_read(parts.colors)) {
    const std::size_t(&rgb)[3] = parts.colors.offset;
    view.colors = {data + rgb[0], data + rgb[1], data + rgb[2], step};
  }
  if (is_read(parts.normals)) view.normals = floats(parts.normals);
  if (is_read(parts.intensities)) {
    const int type = parts.intensities.type[0];
    view.intensities = {data + parts.intensities.offset[0], step,
                        type == detail::field_float32  ? ScalarType::float32
                        : type == detail::field_uint16 ? ScalarType::uint16
                                                       : ScalarType::uint8};
  }
  return all_read ? Status::ok : Status::unread_channel;
}

/// A message that dies at the end of the statement cannot be viewed.
template <class Message>
Status view_point_cloud2(const Message&& message, CloudView& view) = delete;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_CLOUD_VIEW_POINT_CLOUD2_HPP

#if defined(__unix__) || defined(__APPLE__) || defined(_WIN32)

// shortshot/batch/grid_search.hpp: the fixed-radius grid with memory of its own. Hosted only: build allocates.
#ifndef SHORTSHOT_BATCH_GRID_SEARCH_HPP
#define SHORTSHOT_BATCH_GRID_SEARCH_HPP

#include <vector>

// shortshot/dispatch/widest.hpp: parts of the kernel with the widest lanes that the CPU has, whatever the compiler was
// told. Hosted only.
#ifndef SHORTSHOT_DISPATCH_WIDEST_HPP
#define SHORTSHOT_DISPATCH_WIDEST_HPP

#include <atomic>

// shortshot/dispatch/twins.hpp: what is called what in the kernel for AVX2. Hosted only.
#ifndef SHORTSHOT_DISPATCH_TWINS_HPP
#define SHORTSHOT_DISPATCH_TWINS_HPP

// shortshot/base/same_bits.hpp: a value as another type of plain data.
#ifndef SHORTSHOT_BASE_SAME_BITS_HPP
#define SHORTSHOT_BASE_SAME_BITS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// C++20's std::bit_cast.
template <class To, class From>
[[nodiscard, gnu::always_inline]] inline To same_bits(const From& from) noexcept {
  static_assert(
      sizeof(To) == sizeof(From) && std::is_trivially_copyable<To>::value && std::is_trivially_copyable<From>::value,
      "plain data of one size");
  union Uninitialized {
    Uninitialized() noexcept {}
    To value;
  } to;
  std::memcpy(static_cast<void*>(&to.value), &from, sizeof from);
  return to.value;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BASE_SAME_BITS_HPP

// shortshot/dispatch/kernel_for_avx2.hpp: the kernel a second time, for AVX2, where the compiler was told of a plain
// x86-64 only. Distributions build such programs, and machines without AVX2 have become rare. Hosted only.
//
// The same files are read again with another lane shim (base/simd.hpp) into a namespace of its own, `shortshot_avx2`,
// whose types are twins of those in `shortshot` (twins.hpp): no function of the one is a function of the other, for the
// compiler or for a linker. It needs no fused multiply-add, and every sum is one of integers: the same bits.
//
// Not where code shall be small (-Os), not where the single header has another name than shortshot.hpp (it reads
// itself), and not where SHORTSHOT_NO_DISPATCH is 1, which saves the time it takes to compile and changes no result.
#ifndef SHORTSHOT_DISPATCH_KERNEL_FOR_AVX2_HPP
#define SHORTSHOT_DISPATCH_KERNEL_FOR_AVX2_HPP

#if defined(__x86_64__) && !defined(__AVX2__) && !defined(__OPTIMIZE_SIZE__) && \
    !SHORTSHOT_IS_SET(SHORTSHOT_NO_DISPATCH) && __has_include("shortshot.hpp")
#include <immintrin.h>

namespace shortshot_avx2 {
namespace extend {}
namespace detail {
using namespace extend;
}
}  // namespace shortshot_avx2

#define SHORTSHOT_FOR_AVX2

// shortshot/dispatch/forget_kernel.hpp: the include guards of hot_kernel.hpp and all that it includes, so that it can
// be read once more. No include guard.

#undef SHORTSHOT_BASE_FIXED_POINT_HPP
#undef SHORTSHOT_BASE_MATH_HPP
#undef SHORTSHOT_BASE_PRODUCTS_HPP
#undef SHORTSHOT_BASE_QUAD_HPP
#undef SHORTSHOT_BASE_QUIET_HPP
#undef SHORTSHOT_BASE_SIMD_AVX2_HPP
#undef SHORTSHOT_BASE_SIMD_HPP
#undef SHORTSHOT_BASE_SIMD_NEON_HPP
#undef SHORTSHOT_BASE_SIMD_SCALAR_HPP
#undef SHORTSHOT_BASE_SIMD_SHORTS_HPP
#undef SHORTSHOT_BASE_SIMD_SSE2_HPP
#undef SHORTSHOT_BASE_SYMMETRIC_EIGEN_HPP
#undef SHORTSHOT_BASE_UNFUSED_HPP
#undef SHORTSHOT_BASE_UNROLL_HPP
#undef SHORTSHOT_CLOUD_CLOUD_HPP
#undef SHORTSHOT_CLOUD_INTENSITY_SOURCE_HPP
#undef SHORTSHOT_CLOUD_KEYPOINT_HPP
#undef SHORTSHOT_CLOUD_NORMAL_SOURCE_HPP
#undef SHORTSHOT_CLOUD_POINT_LANES_HPP
#undef SHORTSHOT_CLOUD_READ_HPP
#undef SHORTSHOT_CLOUD_VOXEL_LANES_HPP
#undef SHORTSHOT_COLOR_COLOR_SOURCE_HPP
#undef SHORTSHOT_COLOR_FIXED_POWER_HPP
#undef SHORTSHOT_COLOR_LAB_HPP
#undef SHORTSHOT_COLOR_PACKED_LAB_HPP
#undef SHORTSHOT_COLOR_SRGB_HPP
#undef SHORTSHOT_DESCRIPTOR_AXIS_HPP
#undef SHORTSHOT_DESCRIPTOR_COMPACT_HPP
#undef SHORTSHOT_DESCRIPTOR_CONCEPTS_HPP
#undef SHORTSHOT_DESCRIPTOR_CONVENTIONS_HPP
#undef SHORTSHOT_DESCRIPTOR_DESCRIPTOR_HPP
#undef SHORTSHOT_DESCRIPTOR_EXACT_SHELLS_HPP
#undef SHORTSHOT_DESCRIPTOR_FINISH_RULES_HPP
#undef SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP
#undef SHORTSHOT_DESCRIPTOR_SIGNALS_HPP
#undef SHORTSHOT_DESCRIPTOR_SOURCE_SET_HPP
#undef SHORTSHOT_DESCRIPTOR_SPHERICAL_GRID_HPP
#undef SHORTSHOT_DESCRIPTOR_VOTING_HPP
#undef SHORTSHOT_DISPATCH_HOT_KERNEL_HPP
#undef SHORTSHOT_FRAME_CANDIDATE_CHUNK_HPP
#undef SHORTSHOT_FRAME_FRAME_HPP
#undef SHORTSHOT_FRAME_NORMALS_TOGETHER_HPP
#undef SHORTSHOT_FRAME_NORMAL_HPP
#undef SHORTSHOT_FRAME_RANK_BY_DISTANCE_HPP
#undef SHORTSHOT_FRAME_VIEWPOINT_HPP
#undef SHORTSHOT_KERNEL_ACCUMULATE_HPP
#undef SHORTSHOT_KERNEL_ACCUMULATE_MEANS_HPP
#undef SHORTSHOT_KERNEL_CHUNK_HPP
#undef SHORTSHOT_KERNEL_DESCRIBE_AT_HPP
#undef SHORTSHOT_KERNEL_DESCRIBE_HPP
#undef SHORTSHOT_KERNEL_FINISH_HPP
#undef SHORTSHOT_KERNEL_MEAN_COLOR_HPP
#undef SHORTSHOT_KERNEL_MEASURE_SIGNALS_HPP
#undef SHORTSHOT_KERNEL_SHORT_VOTES_HPP
#undef SHORTSHOT_KERNEL_SINGLE_VOTES_HPP
#undef SHORTSHOT_KERNEL_SOFT_CELLS_HPP
#undef SHORTSHOT_KERNEL_SOFT_LAYOUT_HPP
#undef SHORTSHOT_KERNEL_SOFT_SHARES_HPP
#undef SHORTSHOT_KERNEL_SOFT_VOTES_HPP
#undef SHORTSHOT_KERNEL_SUPPORT_HPP
#undef SHORTSHOT_KERNEL_TO_SPHERICAL_HPP
#undef SHORTSHOT_KERNEL_VOTE_SHARES_HPP
#undef SHORTSHOT_KERNEL_VOTE_SUMS_HPP
#undef SHORTSHOT_SEARCH_CELL_BOX_HPP
#undef SHORTSHOT_SEARCH_CELL_SORT_HPP
#undef SHORTSHOT_SEARCH_NEIGHBORHOOD_HPP
#undef SHORTSHOT_SEARCH_OFFER_HPP
#undef SHORTSHOT_SEARCH_OFFER_RUN_HPP
#undef SHORTSHOT_SEARCH_RADIUS_HPP
#undef SHORTSHOT_SEARCH_SEARCH_HPP
#undef SHORTSHOT_SEARCH_WORKSPACE_HPP
#undef SHORTSHOT_STATUS_HPP
#define shortshot shortshot_avx2  // NOLINT: no macro of the library, but a name for a while
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

#include "shortshot.hpp"

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#undef shortshot
#undef SHORTSHOT_FOR_AVX2
#define SHORTSHOT_HAS_KERNEL_FOR_AVX2
#endif
#endif  // SHORTSHOT_DISPATCH_KERNEL_FOR_AVX2_HPP

#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The type of the same name in shortshot_avx2; none for one that is not the library's, like a signal of the caller's.
template <class T, class = void>
struct Twin {};
template <class T>
using TwinOf = typename Twin<T>::type;

template <class T, class = void>
struct HasTwin : std::false_type {};
template <class T>
struct HasTwin<T, std::void_t<TwinOf<T>>> : std::true_type {};
template <class... T>
using IfTwins = std::enable_if_t<std::conjunction<HasTwin<T>...>::value>;

#define SHORTSHOT_TWIN(name)             \
  template <>                            \
  struct Twin<shortshot::name> {         \
    using type = ::shortshot_avx2::name; \
  };
#define SHORTSHOT_TWIN_OF_NUMBERS(name)        \
  template <auto... N>                         \
  struct Twin<shortshot::name<N...>> {         \
    using type = ::shortshot_avx2::name<N...>; \
  };
SHORTSHOT_TWIN(CloudIntensities)
SHORTSHOT_TWIN(CloudNormals)
SHORTSHOT_TWIN(CloudView)
SHORTSHOT_TWIN(CshotLab)
SHORTSHOT_TWIN(Frame)
SHORTSHOT_TWIN(FrameConfidence)
SHORTSHOT_TWIN(GridMemory<std::uint32_t>)
SHORTSHOT_TWIN(HardVoting)
SHORTSHOT_TWIN(HeightCells)
SHORTSHOT_TWIN(KeyPointColor)
SHORTSHOT_TWIN(LabColors)
SHORTSHOT_TWIN(LinearRadius)
SHORTSHOT_TWIN(MeanColor)
SHORTSHOT_TWIN(MultilinearVoting)
SHORTSHOT_TWIN(Neighborhood)
SHORTSHOT_TWIN(Occupancy)
SHORTSHOT_TWIN(PclLab)
SHORTSHOT_TWIN(PlainSums)
SHORTSHOT_TWIN(Point)
SHORTSHOT_TWIN(PublishedCells)
SHORTSHOT_TWIN(PublishedLab)
SHORTSHOT_TWIN(Radius)
SHORTSHOT_TWIN(ShotCells)
SHORTSHOT_TWIN(Support)
SHORTSHOT_TWIN(Viewpoint)
SHORTSHOT_TWIN(detail::Grid<std::uint32_t>)
SHORTSHOT_TWIN(detail::GridContents<std::uint32_t>)
SHORTSHOT_TWIN(detail::PlaceGroup)
SHORTSHOT_TWIN_OF_NUMBERS(AdditiveVoting)
SHORTSHOT_TWIN_OF_NUMBERS(SeparateVoting)
SHORTSHOT_TWIN_OF_NUMBERS(Intensity)
SHORTSHOT_TWIN_OF_NUMBERS(LogRadius)
SHORTSHOT_TWIN_OF_NUMBERS(NormalCosine)
SHORTSHOT_TWIN_OF_NUMBERS(RootOfShares)
SHORTSHOT_TWIN_OF_NUMBERS(SignedRoots)
SHORTSHOT_TWIN_OF_NUMBERS(SphericalGrid)
#undef SHORTSHOT_TWIN
#undef SHORTSHOT_TWIN_OF_NUMBERS

template <int Bins, class... Colors>
struct Twin<ColorDistance<Bins, Colors...>, IfTwins<Colors...>> {
  using type = ::shortshot_avx2::ColorDistance<Bins, TwinOf<Colors>...>;
};
template <LabAxis Axis, int Number, class Rule>
struct Twin<ColorOffset<Axis, Number, Rule>, IfTwins<Rule>> {
  using type = ::shortshot_avx2::ColorOffset<static_cast<::shortshot_avx2::LabAxis>(Axis), Number, TwinOf<Rule>>;
};
template <LabAxis Axis, int Number, class Rule>
struct Twin<ColorExcess<Axis, Number, Rule>, IfTwins<Rule>> {
  using type = ::shortshot_avx2::ColorExcess<static_cast<::shortshot_avx2::LabAxis>(Axis), Number, TwinOf<Rule>>;
};
template <class... Rules>
struct Twin<Part<Rules...>, IfTwins<Rules...>> {
  using type = ::shortshot_avx2::Part<TwinOf<Rules>...>;
};
template <class Grid, class Cells, class Finish, int ShrinkPercent, class... Signals>
struct Twin<CellMeans<Grid, Cells, Finish, ShrinkPercent, Signals...>, IfTwins<Grid, Cells, Finish, Signals...>> {
  using type =
      ::shortshot_avx2::CellMeans<TwinOf<Grid>, TwinOf<Cells>, TwinOf<Finish>, ShrinkPercent, TwinOf<Signals>...>;
};
template <class... Rules>
struct Twin<Descriptor<Rules...>, IfTwins<Rules...>> {
  using type = ::shortshot_avx2::Descriptor<TwinOf<Rules>...>;
};

template <class... Sources>
struct Twin<extend::SourceSet<Sources...>, IfTwins<Sources...>> {
  using type = ::shortshot_avx2::extend::SourceSet<TwinOf<Sources>...>;
};

/// A value as its twin, and back: the same text made both types, so that they have the same bytes.
template <class T>
[[nodiscard]] inline TwinOf<T> twin_of(const T& value) noexcept {
  return same_bits<TwinOf<T>>(value);
}
template <class T>
inline void take_back(T& value, const TwinOf<T>& twin) noexcept {
  value = same_bits<T>(twin);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif
#endif  // SHORTSHOT_DISPATCH_TWINS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline std::atomic<bool> may_use_wider_lanes{true};

/// Are there wider lanes than the compiler was told of?
[[nodiscard]] inline bool has_wider_lanes() noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  return may_use_wider_lanes.load(std::memory_order_relaxed) && __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// Functions for hosts (extract(), GridSearch, ...) that were compiled for a plain x86-64 use AVX2 where the CPU has
/// it, which nothing but the clock shows: the bits are the same. This keeps them from it, or lets them again, for
/// whoever wants to compare; it counts for all threads. Says whether they use it now.
inline bool allow_wider_lanes(bool allowed) noexcept {
  detail::may_use_wider_lanes.store(allowed, std::memory_order_relaxed);
  return detail::has_wider_lanes();
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// describe_gathered(). A descriptor or a source of the caller's own has no twin, and takes the lanes that the compiler
/// was told of.
template <class D, class Sources>
[[nodiscard]] inline Status describe_widest(const Neighborhood& n, const Sources& sources, const Point& center,
                                            const Support& support, Frame& frame, float* out,
                                            FrameConfidence& confidence) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if constexpr (HasTwin<D>::value && HasTwin<Sources>::value) {
    if (has_wider_lanes()) {
      auto its_frame = twin_of(frame);
      auto its_confidence = twin_of(confidence);
      const auto status = ::shortshot_avx2::detail::describe_gathered<TwinOf<D>, default_chunk_size>(
          twin_of(n), twin_of(sources), twin_of(center), twin_of(support), its_frame, out, its_confidence);
      take_back(frame, its_frame);
      take_back(confidence, its_confidence);
      return static_cast<Status>(status);
    }
  }
#endif
  return describe_gathered<D, default_chunk_size>(n, sources, center, support, frame, out, confidence);
}

/// describe().
template <class D, class Sources>
[[nodiscard]] inline Status describe_widest(const Neighborhood& n, const Sources& sources, const Frame& frame,
                                            Radius radius, float* out) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if constexpr (HasTwin<D>::value && HasTwin<Sources>::value) {
    if (has_wider_lanes()) {
      return static_cast<Status>(
          ::shortshot_avx2::describe<TwinOf<D>>(twin_of(n), twin_of(sources), twin_of(frame), twin_of(radius), out));
    }
  }
#endif
  return describe<D>(n, sources, frame, radius, out);
}

/// place_in_voxels().
inline std::size_t place_widest(const CloudView& cloud, float leaf, std::size_t begin, float (&number)[3][voxel_block],
                                float (&d2)[voxel_block]) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if (has_wider_lanes()) {
    return ::shortshot_avx2::detail::place_in_voxels(twin_of(cloud), leaf, begin, number, d2);
  }
#endif
  return place_in_voxels(cloud, leaf, begin, number, d2);
}

/// normals_together().
inline void normals_widest(const CloudView& cloud, const Neighborhood& candidates, Radius wide, Radius radius,
                           const Viewpoint& viewpoint, const PlaceGroup& group, float* normals) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if (has_wider_lanes()) {
    ::shortshot_avx2::detail::normals_together(twin_of(cloud), twin_of(candidates), twin_of(wide), twin_of(radius),
                                               twin_of(viewpoint), twin_of(group), normals);
    return;
  }
#endif
  normals_together(cloud, candidates, wide, radius, viewpoint, group, normals);
}

/// multiply().
template <std::size_t Rows>
inline void multiply_widest(const float* panel, const float* const (&rows)[Rows], std::size_t size,
                            float (&products)[Rows][panel_rows]) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if (has_wider_lanes()) {
    ::shortshot_avx2::detail::multiply(panel, rows, size, products);
    return;
  }
#endif
  multiply(panel, rows, size, products);
}

using HostGrid = Grid<std::uint32_t>;

/// A grid's gather().
template <class Neighbors>
[[nodiscard]] inline Status gather_widest(const HostGrid& grid, const GridContents<std::uint32_t>& contents,
                                          const Point& center, Radius radius, Neighbors& out) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if constexpr (HasTwin<Neighbors>::value) {
    if (has_wider_lanes()) {
      auto its_neighbors = twin_of(out);
      const auto status = ::shortshot_avx2::detail::gather_from(twin_of(grid), twin_of(contents), twin_of(center),
                                                                twin_of(radius), its_neighbors);
      take_back(out, its_neighbors);
      return static_cast<Status>(status);
    }
  }
#endif
  return grid.gather(contents, center, radius, out);
}

/// The first half of a grid's build().
[[nodiscard]] inline Status plan_widest(HostGrid& grid, const CloudView& cloud, float cell_size,
                                        const GridMemory<std::uint32_t>& memory) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if (has_wider_lanes()) {
    auto its_grid = twin_of(grid);
    const auto status = its_grid.plan(twin_of(cloud), cell_size, twin_of(memory));
    take_back(grid, its_grid);
    return static_cast<Status>(status);
  }
#endif
  return grid.plan(cloud, cell_size, memory);
}

/// The second half.
inline void sort_widest(const HostGrid& grid, const CloudView& cloud,
                        const GridMemory<std::uint32_t>& memory) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if (has_wider_lanes()) {
    twin_of(grid).sort(twin_of(cloud), twin_of(memory));
    return;
  }
#endif
  grid.sort(cloud, memory);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_DISPATCH_WIDEST_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A fixed-radius grid that owns its memory: 16 bytes a valid point and 4 a cell, with as many cells as the cloud's box
/// holds, but at most four a point (and 4,096). A search (see search.hpp); the cloud must outlive it. build() again for
/// the next frame: its memory is reused. Queries are thread-safe.
class GridSearch {
 public:
  GridSearch() = default;

  /// Sorts the cloud into cells of `radius`, or of half of it where points are dense. If that fails status() says why,
  /// and so do extract() and describe_at().
  GridSearch(const CloudView& cloud, float radius) { static_cast<void>(build(cloud, radius)); }

  /// One that was moved from is as one that was never built: empty_cloud.
  GridSearch(GridSearch&& other) noexcept { swap(other); }
  GridSearch(const GridSearch& other) = default;
  GridSearch& operator=(GridSearch other) noexcept {
    swap(other);
    return *this;
  }
  ~GridSearch() = default;

  /// See GridIndex::build(); may throw std::bad_alloc.
  [[nodiscard]] Status build(const CloudView& cloud, float radius) {
    const std::size_t points = validate(cloud) == Status::ok ? cloud.size : 0;  // a bad view says anything of its size
    const std::size_t cells = 4 * points + 4096;
    if (cell_end_.size() < planning_cells) cell_end_.resize(planning_cells);
    grid_ = {};  // and so it stays if there is no memory
    detail::HostGrid next{};
    if (detail::plan_widest(next, cloud, radius, {nullptr, cell_end_.data(), nullptr, points, cells}) != Status::ok) {
      grid_ = next;
      return next.status();
    }
    // Points lie on surfaces, which pass through few cells of their box: 8 points a cell of the box mean hundreds in
    // those that are not empty, and then smaller cells, fewer of whose points lie outside the sphere, pay.
    if (8 * next.cells() <= next.size()) next.halve_cells();
    if (order_.size() < next.size()) {
      order_.resize(next.size());
      xyz_.resize(3 * next.size());
    }
    if (cell_end_.size() < next.cells()) cell_end_.resize(next.cells());
    detail::sort_widest(next, cloud, {order_.data(), cell_end_.data(), xyz_.data(), order_.size(), cell_end_.size()});
    grid_ = next;
    return Status::ok;
  }

  /// What the last build() returned; empty_cloud before the first one.
  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    return detail::gather_widest(grid_, {order_.data(), cell_end_.data(), xyz_.data()}, center, radius, out);
  }

 private:
  static constexpr std::size_t planning_cells = 3 * std::size_t{detail::ThinEnds<std::uint32_t>::slices};

  void swap(GridSearch& other) noexcept {
    std::swap(grid_, other.grid_);
    order_.swap(other.order_);
    cell_end_.swap(other.cell_end_);
    xyz_.swap(other.xyz_);
  }

  detail::HostGrid grid_{};
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> cell_end_;
  std::vector<float> xyz_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_GRID_SEARCH_HPP

// shortshot/descriptor/layout_of.hpp: what the values of a descriptor mean, as a string. Hosted only: allocates.
#ifndef SHORTSHOT_DESCRIPTOR_LAYOUT_OF_HPP
#define SHORTSHOT_DESCRIPTOR_LAYOUT_OF_HPP

#include <string>

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

struct StringText {
  std::string string;
  // Called, not inlined: text is put together from many pieces, and a compiler would take its time for each.
  [[gnu::noinline]] void add(const char* piece) { string += piece; }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// What the values of descriptor D mean and how they are laid out, in English and in ASCII: its voting rule, its cell
/// convention, and for each part its signal, histogram bins, color conversion, grid (radius x elevation x azimuth) and
/// radius scale. SCSH-336:
///
///     published voting, published cells: occupancy 3x4x8 equal shells | color distance 15 bins (published Lab) 2x2x4
///     equal shells
///
/// (in one line). Two types with the same text have values that can be compared; two that differ in anything named here
/// have different texts. What is no part of D is not in it: the radii, and how frames were turned. A policy of your own
/// needs a `name` as those of the library have, which says everything about it, parameters included. Allocates.
template <class D>
[[nodiscard]] std::string layout_of() {
  detail::StringText text;
  detail::add_layout(text, static_cast<const D*>(nullptr));
  return text.string;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_DESCRIPTOR_LAYOUT_OF_HPP

// shortshot/batch/keypoints.hpp: uniform key points, one per occupied voxel. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_KEYPOINTS_HPP
#define SHORTSHOT_BATCH_KEYPOINTS_HPP

#include <algorithm>

// shortshot/batch/voxels.hpp: the voxels of a cloud, numbered in one pass. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_VOXELS_HPP
#define SHORTSHOT_BATCH_VOXELS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A voxel that holds points, and which of them is nearest to its center.
struct Voxel {
  float number[3];
  float d2;
  std::uint32_t nearest;
  std::uint32_t points;
};

/// Voxels in the order in which their first points come. Memory is kept from cloud to cloud.
class VoxelTable {
 public:
  void clear() {
    voxels_.clear();
    if (slots_.empty()) slots_.resize(std::size_t{1} << (64 - shift_));
    std::fill(slots_.begin(), slots_.end(), 0u);
    last_ = 0;
  }

  [[nodiscard]] const std::vector<Voxel>& voxels() const noexcept { return voxels_; }

  /// The place, among voxels(), of a point's voxel, with the point in it. Points come in the order of their indices.
  std::uint32_t add(const float (&number)[3], float d2, std::uint32_t index) {
    if (voxels_.empty() || !is_at(voxels_[last_], number)) last_ = find(number);
    Voxel& voxel = voxels_[last_];
    ++voxel.points;
    if (d2 < voxel.d2) {
      voxel.d2 = d2;
      voxel.nearest = index;
    }
    return last_;
  }

 private:
  [[nodiscard]] static bool is_at(const Voxel& voxel, const float (&number)[3]) noexcept {
    return voxel.number[0] == number[0] && voxel.number[1] == number[1] && voxel.number[2] == number[2];
  }

  /// The slot that has a voxel, or the free one for it. Odd factors of 64 bits for each axis: the upper bits of the sum
  /// depend on all bits of the numbers.
  [[nodiscard]] std::size_t slot_of(const float (&number)[3]) const noexcept {
    const std::uint64_t sum = math::bits_of(number[0]) * std::uint64_t{0x9E3779B97F4A7C15} +
                              math::bits_of(number[1]) * std::uint64_t{0xC2B2AE3D27D4EB4F} +
                              math::bits_of(number[2]) * std::uint64_t{0x165667B19E3779F9};
    auto slot = static_cast<std::size_t>(sum >> shift_);
    while (slots_[slot] != 0 && !is_at(voxels_[slots_[slot] - 1], number)) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  [[nodiscard]] std::uint32_t find(const float (&number)[3]) {
    const std::size_t slot = slot_of(number);
    if (slots_[slot] != 0) return slots_[slot] - 1;
    const auto place = static_cast<std::uint32_t>(voxels_.size());
    voxels_.push_back({{number[0], number[1], number[2]}, HUGE_VALF, 0, 0});
    slots_[slot] = place + 1;
    if (2 * voxels_.size() > slots_.size()) grow();
    return place;
  }

  void grow() {
    std::vector<std::uint32_t> slots(2 * slots_.size());
    slots_.swap(slots);
    --shift_;
    for (std::size_t k = 0; k < voxels_.size(); ++k)
      slots_[slot_of(voxels_[k].number)] = static_cast<std::uint32_t>(k + 1);
  }

  std::vector<Voxel> voxels_;
  std::vector<std::uint32_t> slots_;  // a power of two of them, half of them empty or more: place + 1 in voxels_, or 0
  int shift_ = 54;                    // 64 - log2 of their number
  std::uint32_t last_ = 0;            // neighbors in the cloud mostly share a voxel
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_VOXELS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Calls f(voxel's number, squared distance to its center, index) for each valid point, in order.
template <class Function>
[[nodiscard]] inline Status for_each_in_voxel(const CloudView& cloud, float leaf, Function f) {
  const Status usable = validate(cloud);
  if (usable != Status::ok) return usable;
  if (!math::is_finite(leaf) || !(leaf > 0.0f)) return Status::bad_leaf;
  bool any_valid = false;
  float numbers[3][voxel_block];
  float d2[voxel_block];
  for (std::size_t begin = 0; begin < cloud.size; begin += voxel_block) {
    const std::size_t size = place_widest(cloud, leaf, begin, numbers, d2);
    for (std::size_t k = 0; k < size; ++k) {
      if (d2[k] < 0.0f) continue;
      any_valid = true;
      const float number[3] = {numbers[0][k], numbers[1][k], numbers[2][k]};
      f(number, d2[k], static_cast<std::uint32_t>(begin + k));
    }
  }
  return any_valid ? Status::ok : Status::empty_cloud;
}

/// What is added up over the points of a voxel.
struct VoxelSums {
  float place[3] = {};
  std::uint64_t rgb[3] = {};
  float intensities = 0.0f;
  std::uint32_t echoes = 0;  ///< intensities that are numbers

  void add_channels(const CloudView& cloud, std::uint32_t index) noexcept {
    if (has_colors(cloud)) {
      const Rgb c = color(cloud, index);
      rgb[0] += c.r;
      rgb[1] += c.g;
      rgb[2] += c.b;
    }
    const float echo = has_intensities(cloud) ? intensity(cloud, index) : 0.0f;
    if (!math::is_finite(echo)) return;
    intensities += echo;
    ++echoes;
  }

  /// Points of the cloud in one voxel, named by the lower halves of `members`.
  void add_all(const CloudView& cloud, float leaf, const std::uint64_t* members, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; i += simd::lanes) {
      const std::size_t size = count - i < simd::lanes ? count - i : simd::lanes;
      const auto index_at = [&](std::size_t lane) {
        return static_cast<std::uint32_t>(members[i + (lane < size ? lane : 0)]);
      };
      const VoxelLanes voxels = voxels_of(read_lanes(cloud.points, index_at), leaf);
      unroll<3>([&](auto axis) {
        float places[simd::lanes];
        simd::store(places, voxels.place[axis]);
        for (std::size_t lane = 0; lane < size; ++lane) place[axis] += places[lane];
      });
      for (std::size_t lane = 0; lane < size; ++lane) add_channels(cloud, index_at(lane));
    }
  }
};

/// The centroid of a voxel's points, with the means of their colors and of their intensities (the finite ones).
[[nodiscard]] inline KeyPoint centroid_of(const CloudView& cloud, float leaf, const Voxel& voxel,
                                          const VoxelSums& sums) noexcept {
  const std::uint32_t count = voxel.points;
  const auto at = [&](std::size_t axis) {
    return (voxel.number[axis] + sums.place[axis] / static_cast<float>(count)) * leaf;
  };
  const auto mean = [&](std::size_t c) { return static_cast<std::uint8_t>((sums.rgb[c] + count / 2) / count); };
  KeyPoint key(Point{at(0), at(1), at(2)});
  // Beyond the reach of voxel numbers a point stands for itself.
  if (!is_finite(key.position)) return keypoint(cloud, voxel.nearest);
  if (has_colors(cloud)) key = KeyPoint(key.position, {mean(0), mean(1), mean(2)});
  key.has_intensity = has_intensities(cloud) && sums.echoes > 0;
  if (key.has_intensity) key.intensity = sums.intensities / static_cast<float>(sums.echoes);
  return key;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Chooses key points of clouds, one for each voxel of `leaf` meters that holds a valid point; voxels lie on a grid
/// through the origin. Keep it from frame to frame: what it allocated for one frame it has for the next. One thread at
/// a time; a pass over the points takes less than starting others would.
class KeypointSampler {
 public:
  /// The point nearest to each voxel's center (the one with the smaller index if two are as near). `keypoints` receives
  /// indices into the cloud in ascending order. Statuses: empty_cloud (also if no point is valid), bad_view, bad_leaf;
  /// no key points then. Linear in the points; allocates 40 bytes a voxel and a bit a point, none if it has had as much
  /// before; the same result on every machine.
  [[nodiscard]] Status sample_uniform(const CloudView& cloud, float leaf, std::vector<std::uint32_t>& keypoints) {
    keypoints.clear();
    table_.clear();
    const Status status = detail::for_each_in_voxel(
        cloud, leaf, [this](const float(&number)[3], float d2, std::uint32_t index) { table_.add(number, d2, index); });
    if (status != Status::ok) return status;
    chosen_.assign((cloud.size + 63) / 64, 0u);
    for (const detail::Voxel& voxel : table_.voxels()) chosen_[voxel.nearest / 64] |= bit_of(voxel.nearest);
    keypoints.reserve(table_.voxels().size());
    for (std::size_t word = 0; word < chosen_.size(); ++word) {
      for (std::uint64_t left = chosen_[word]; left != 0; left &= left - 1)
        keypoints.push_back(static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(__builtin_ctzll(left)));
    }
    return Status::ok;
  }

  /// The same with the centroid, the mean color and the mean intensity (of what the cloud has) of each voxel's points:
  /// less noise than any one of them has, which pays most where the key point's color is what color distances refer
  /// to. Voxels by z, then y, then x. Allocates 20 bytes a point besides.
  [[nodiscard]] Status sample_centroids(const CloudView& cloud, float leaf, std::vector<KeyPoint>& keypoints) {
    keypoints.clear();
    table_.clear();
    voxel_of_.clear();
    member_.clear();
    const Status status =
        detail::for_each_in_voxel(cloud, leaf, [this](const float(&number)[3], float d2, std::uint32_t index) {
          voxel_of_.push_back(table_.add(number, d2, index));
          member_.push_back(std::uint64_t{detail::math::bits_of(d2)} << 32 | index);
        });
    if (status != Status::ok) return status;
    sort_members();
    const std::vector<detail::Voxel>& voxels = table_.voxels();
    keypoints.reserve(voxels.size());
    for (const std::uint32_t v : order_) {
      detail::VoxelSums sums;
      sums.add_all(cloud, leaf, sorted_.data() + first_[v], voxels[v].points);
      keypoints.push_back(detail::centroid_of(cloud, leaf, voxels[v], sums));
    }
    return Status::ok;
  }

 private:
  [[nodiscard]] static std::uint64_t bit_of(std::uint32_t index) noexcept { return std::uint64_t{1} << index % 64; }

  /// Members voxel after voxel, in each the one nearest to its center first: sums of floats have one order, whatever
  /// that of the points. And the order of the voxels.
  void sort_members() {
    const std::vector<detail::Voxel>& voxels = table_.voxels();
    first_.resize(voxels.size());
    order_.resize(voxels.size());
    std::uint32_t end = 0;
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      first_[v] = end;
      end += voxels[v].points;
      order_[v] = static_cast<std::uint32_t>(v);
    }
    sorted_.resize(member_.size());
    for (std::size_t k = 0; k < member_.size(); ++k) sorted_[first_[voxel_of_[k]]++] = member_[k];
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      std::uint64_t* const past = sorted_.data() + first_[v];
      first_[v] -= voxels[v].points;
      std::sort(sorted_.data() + first_[v], past);
    }
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      for (std::size_t axis = 3; axis-- > 0;) {
        if (voxels[a].number[axis] != voxels[b].number[axis]) return voxels[a].number[axis] < voxels[b].number[axis];
      }
      return false;
    });
  }

  detail::VoxelTable table_;
  std::vector<std::uint64_t> chosen_;    // a bit for each point
  std::vector<std::uint32_t> voxel_of_;  // of each valid point
  std::vector<std::uint64_t> member_;    // squared distance to the center, which orders as its bits do, and index
  std::vector<std::uint64_t> sorted_;
  std::vector<std::uint32_t> first_, order_;  // of voxels: their first member, and their order by z, y, x
};

/// KeypointSampler::sample_uniform() for one cloud.
[[nodiscard]] inline Status sample_uniform(const CloudView& cloud, float leaf, std::vector<std::uint32_t>& keypoints) {
  return KeypointSampler().sample_uniform(cloud, leaf, keypoints);
}

/// KeypointSampler::sample_centroids() for one cloud.
[[nodiscard]] inline Status sample_centroids(const CloudView& cloud, float leaf, std::vector<KeyPoint>& keypoints) {
  return KeypointSampler().sample_centroids(cloud, leaf, keypoints);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_KEYPOINTS_HPP

// shortshot/batch/estimate_normals.hpp: the surface normals of a whole cloud, on one or more threads. Hosted only:
// allocates, starts threads.
#ifndef SHORTSHOT_BATCH_ESTIMATE_NORMALS_HPP
#define SHORTSHOT_BATCH_ESTIMATE_NORMALS_HPP

// shortshot/batch/executor.hpp: who does extract()'s work: threads started for one call, or an executor of the
// caller's. Hosted only.
#ifndef SHORTSHOT_BATCH_EXECUTOR_HPP
#define SHORTSHOT_BATCH_EXECUTOR_HPP

#include <thread>

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The executor that a plain number of threads stands for. One of them is the caller's; the others are started and
/// joined by each run().
class StartedThreads {
 public:
  explicit StartedThreads(std::size_t threads) noexcept : threads_(threads) {}
  [[nodiscard]] std::size_t threads() const noexcept { return threads_; }

  template <class Work>
  void run(const Work& work) const {
    run_erased([](const void* erased) { (*static_cast<const Work*>(erased))(); }, &work);
  }

 private:
  /// Compiled once for all work: std::thread and a vector of them take a compiler their time.
  void run_erased(void (*call)(const void* work), const void* work) const {
    struct Threads : std::vector<std::thread> {
      ~Threads() {  // also when one more thread cannot be started: those that run finish the work
        for (std::thread& thread : *this) thread.join();
      }
    } others;
    others.reserve(threads_ - 1);
    for (std::size_t t = 1; t < threads_; ++t) others.emplace_back(call, work);
    call(work);
  }

  std::size_t threads_;
};

struct NoWork {
  void operator()() const noexcept {}
};

template <class T, class = void>
struct IsExecutor : std::false_type {};
template <class T>
struct IsExecutor<T, std::void_t<decltype(static_cast<std::size_t>(std::declval<T&>().threads())),
                                 decltype(std::declval<T&>().run(NoWork{}))>> : std::true_type {};

/// The executor meant by `threads`; a number is cut to what `blocks` of work can keep busy.
template <class Threads>
[[nodiscard]] decltype(auto) executor_of(Threads& threads, std::size_t blocks) {
  constexpr bool is_number = std::is_integral<Threads>::value;
  static_assert(
      is_number || IsExecutor<Threads>::value,
      "extract() and estimate_normals() support a number of threads, or an executor with threads() and run(work)");
  if constexpr (is_number) {
    const std::size_t wanted = threads > 0 ? static_cast<std::size_t>(threads) : 1;
    return StartedThreads(std::max<std::size_t>(1, std::min(wanted, blocks)));
  } else {
    return (threads);
  }
}

/// Blocks of [0, count), to be taken one after the other by whoever is free.
class Blocks {
 public:
  Blocks(std::size_t count, std::size_t size) noexcept : count_(count), size_(size) {}

  /// Calls work(begin, end) for blocks until there are none left.
  template <class Work>
  void take(const Work& work) {
    for (std::size_t begin = next_.fetch_add(size_); begin < count_; begin = next_.fetch_add(size_)) {
      work(begin, std::min(begin + size_, count_));
    }
  }

 private:
  std::atomic<std::size_t> next_{0};
  std::size_t count_;
  std::size_t size_;
};

/// Calls work(thread, begin, end) for blocks of [0, count) on an executor; `thread` is below `threads`, and no two
/// calls at the same time have the same.
template <class Executor, class Work>
void for_blocks(Executor& executor, std::size_t threads, std::size_t count, std::size_t block_size, const Work& work) {
  Blocks blocks(count, block_size);
  std::atomic<std::size_t> arrived{0};
  const auto take_part = [&] {
    const std::size_t thread = arrived.fetch_add(1);
    if (thread >= threads) return;  // called more often than announced
    blocks.take([&](std::size_t begin, std::size_t end) { work(thread, begin, end); });
  };
  executor.run([&take_part] { take_part(); });  // one pointer: a std::function holds it without memory of its own
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_EXECUTOR_HPP

// shortshot/batch/normal_estimator.hpp: the normals of a few points that follow each other, estimated together. Hosted
// only: allocates.
#ifndef SHORTSHOT_BATCH_NORMAL_ESTIMATOR_HPP
#define SHORTSHOT_BATCH_NORMAL_ESTIMATOR_HPP

// shortshot/batch/growing_workspace.hpp: a workspace that grows: one per thread. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_GROWING_WORKSPACE_HPP
#define SHORTSHOT_BATCH_GROWING_WORKSPACE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

class GrowingWorkspace {
 public:
  [[nodiscard]] Neighborhood neighborhood() noexcept {
    const std::size_t n = index_.size();
    float* p = floats_.data();
    return {p, p + n, p + 2 * n, p + 3 * n, index_.data(), static_cast<std::uint32_t>(n), 0, 0, {}};
  }

  /// A search's gather(); grows until the neighbors fit.
  template <class Search>
  [[nodiscard]] Status gather(const Search& search, const Point& center, Radius radius, Neighborhood& n) {
    n = neighborhood();
    const Status status = search.gather(center, radius, n);
    if (status != Status::too_many_neighbors || n.found > max_neighbors) return status;
    reserve(n.found);
    n = neighborhood();
    return search.gather(center, radius, n);
  }

  /// Room for `neighbors`; half as much again where it has to grow, so that it seldom does.
  void reserve(std::size_t neighbors) {
    if (neighbors <= index_.size()) return;
    const std::size_t capacity = neighbors + neighbors / 2;
    floats_.resize(4 * capacity);
    index_.resize(capacity);
  }

 private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> index_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_GROWING_WORKSPACE_HPP

// shortshot/batch/known_normals.hpp: normals of places where points lie on top of each other, to be computed once.
// Hosted only.
#ifndef SHORTSHOT_BATCH_KNOWN_NORMALS_HPP
#define SHORTSHOT_BATCH_KNOWN_NORMALS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t place_slots = 256;

/// Which of them a place has; -0 is 0.
[[nodiscard]] inline std::size_t slot_of_place(const Point& p, std::uint32_t seed = 0) noexcept {
  std::uint32_t hash = seed;
  for (const float v : {p.x, p.y, p.z}) hash = (hash ^ math::bits_of(v + 0.0f)) * 2654435769u;
  return hash >> 24;
}

/// The normals of the last few crowded places. Many drivers write (0, 0, 0) for "no measurement": as many points in one
/// place, each of which has all the others as neighbors. One per thread and call; of two places that meet in an entry
/// the later one stays.
class KnownNormals {
 public:
  /// Points that are looked at together, all of them in one place, may get other roundings than one alone.
  enum class Way : std::uint8_t { none, together, alone };

  /// Fewest neighbors of a place that is worth an entry: all others leave the entries to those.
  static constexpr std::uint32_t crowd = 64;

  /// Null if it is not known.
  [[nodiscard]] const SurfaceNormal* find(const Point& p, Way way) const noexcept {
    const Entry& entry = entries_[slot_of_place(p, static_cast<std::uint32_t>(way))];
    const bool is_it = entry.way == way && entry.at.x == p.x && entry.at.y == p.y && entry.at.z == p.z;
    return is_it ? &entry.normal : nullptr;
  }

  void keep(const Point& p, Way way, std::uint32_t neighbors, const SurfaceNormal& normal) noexcept {
    if (neighbors >= crowd) entries_[slot_of_place(p, static_cast<std::uint32_t>(way))] = {p, normal, way};
  }

 private:
  struct Entry {
    Point at;
    SurfaceNormal normal;
    Way way;
  };

  std::array<Entry, place_slots> entries_{};
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_KNOWN_NORMALS_HPP

// shortshot/batch/plausible.hpp: what can be seen of numbers that cannot work, at next to no cost: a search over
// another cloud, and coordinates too large for float to hold the shape. Hosted only.
#ifndef SHORTSHOT_BATCH_PLAUSIBLE_HPP
#define SHORTSHOT_BATCH_PLAUSIBLE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Are up to eight of the neighbors where the cloud has them? The search says where they lie and which points they are:
/// one over another cloud, or over what was in this memory before, says it of other places. To the last bit, but for
/// compilers that compute in longer registers.
[[nodiscard]] inline bool is_of(const CloudView& cloud, const Point& center, const Neighborhood& n) noexcept {
  constexpr std::uint32_t most = 8;
  const std::uint32_t looked_at = n.size < most ? n.size : most;
  const auto agree = [](float a, float b) { return __builtin_fabsf(a - b) <= 1e-6f * __builtin_fabsf(a); };
  for (std::uint32_t k = 0; k < looked_at; ++k) {
    const auto i = static_cast<std::uint32_t>(std::uint64_t{n.size} * k / looked_at);
    if (n.index[i] >= cloud.size) return false;
    const Neighbor v = neighbor_from(center, point(cloud, n.index[i]), n.index[i]);
    if (!agree(n.dx[i], v.dx) || !agree(n.dy[i], v.dy) || !agree(n.dz[i], v.dz)) return false;
  }
  return true;
}

/// Does the search know the cloud's first valid point? For the case that it has found nothing anywhere.
template <class Search>
[[nodiscard]] bool finds_a_point(const CloudView& cloud, const Search& search, Radius radius,
                                 GrowingWorkspace& workspace) {
  Point p;
  Neighborhood n;
  if (next_valid(cloud, 0, p) == cloud.size) return true;
  return workspace.gather(search, p, radius, n) != Status::ok || (n.found > 0 && is_of(cloud, p, n));
}

/// How far apart floats lie at a point's largest coordinate.
[[nodiscard]] inline float float_spacing(const Point& p) noexcept {
  float largest = 0.0f;
  for (const float v : {p.x, p.y, p.z}) {
    if (__builtin_fabsf(v) > largest) largest = __builtin_fabsf(v);
  }
  return math::float_of(math::bits_of(largest) & 0x7F800000u) * 1.1920929e-7f;
}

/// Is what float can tell apart there more than a 64th of the radius? Measured on frames of a depth camera, R = 4 cm:
/// of coordinates rounded to a 1000th of R, one local frame in 100 turns; to a 100th, 1 in 17; to a 64th, 1 in 9; to a
/// 32nd, 1 in 5; to a 16th, 1 in 3, and half of all matches are lost, as by a millimeter of noise.
[[nodiscard]] inline bool is_coarse(const Point& p, Radius radius) noexcept {
  return float_spacing(p) > radius.value * (1.0f / 64.0f);
}

/// All valid points of a cloud: the first one that is not answers.
[[nodiscard]] inline bool all_are_coarse(const CloudView& cloud, Radius radius) noexcept {
  Point p;
  std::size_t i = next_valid(cloud, 0, p);
  const bool any = i < cloud.size;
  while (i < cloud.size && is_coarse(p, radius)) i = next_valid(cloud, i + 1, p);
  return i == cloud.size && any;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_PLAUSIBLE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a thread keeps from block to block.
struct NormalMemory {
  GrowingWorkspace workspace;
  KnownNormals known;
  bool other_cloud = false;  ///< the search has named points that lie elsewhere in the cloud
};

/// Estimates normals of a few points at a time. Points that follow each other in a cloud mostly lie side by side: one
/// search, a little wider, finds the neighbors of all, and what a neighbor adds to moments about their middle is
/// computed once for all of them.
template <class Search>
class NormalEstimator {
 public:
  NormalEstimator(const CloudView& cloud, const Search& search, Radius radius, const Viewpoint& viewpoint,
                  const std::uint8_t* needed, NormalMemory& memory, SurfaceNormal* normals) noexcept
      : cloud_(cloud),
        search_(search),
        radius_(radius),
        viewpoint_(viewpoint),
        needed_(needed),
        memory_(memory),
        normals_(normals) {
    row_ = is_image(cloud) ? cloud.width : 0;
  }

  /// Of the k-th to the one before the end-th point; `normals` has NaN for all of them before.
  void estimate(std::size_t begin, std::size_t end) {
    std::size_t used = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = in_zigzag(k);
      const Point p = point(cloud_, i);
      if (!is_finite(p)) continue;
      index_[used] = i;
      x_[used] = p.x;
      y_[used] = p.y;
      z_[used] = p.z;
      if (++used < group) continue;
      estimate_part(0, group);
      used = 0;
    }
    for (std::size_t k = 0; k < used; ++k) {
      if (is_needed(k, 1)) estimate_alone(k);
    }
  }

 private:
  static constexpr std::size_t group = PlaceGroup::most;
  static constexpr std::size_t smallest_part = 8;
  static constexpr float largest_shared = 1e18f;  // radius: CandidateChunk needs room beyond it
  static_assert(smallest_part % simd::lanes == 0, "whole registers");

  /// The k-th point, where four rows of an image are walked at once: a group then lies in a square.
  [[nodiscard]] std::size_t in_zigzag(std::size_t k) const noexcept {
    constexpr std::size_t rows = 4;
    if (row_ == 0) return k;
    const std::size_t first = k - k % (rows * row_);
    return cloud_.size - first < rows * row_ ? k : first + (k - first) / rows + k % rows * row_;
  }

  /// Is any of these points? Groups are made of all points, needed or not: so normals have the bits that they have
  /// among those of the whole cloud.
  [[nodiscard]] bool is_needed(std::size_t first, std::size_t count) const noexcept {
    if (needed_ == nullptr) return true;
    const std::size_t* const index = index_ + first;
    return std::any_of(index, index + count, [this](std::size_t i) { return needed_[i] != 0; });
  }

  /// Points [first, first + count) of the group, or each half of them if they lie too far apart.
  void estimate_part(std::size_t first, std::size_t count) {
    if (!is_needed(first, count)) return;
    SurfaceNormal found[group] = {};
    const bool one_place = are_in_one_place(first, count);
    const SurfaceNormal* const known =
        one_place ? memory_.known.find(place(first), KnownNormals::Way::together) : nullptr;
    Neighborhood candidates;
    Radius wide = radius_;
    if (known != nullptr) {
      std::fill_n(found + first, count, *known);
    } else if (gather_for_all(first, count, candidates, wide)) {
      const PlaceGroup places{x_ + first, y_ + first, z_ + first, count};
      normals_widest(cloud_, candidates, wide, radius_, viewpoint_, places, &found[first].x);
      if (one_place) memory_.known.keep(place(first), KnownNormals::Way::together, candidates.found, found[first]);
    } else if (count > smallest_part) {
      estimate_part(first, count / 2);
      estimate_part(first + count / 2, count / 2);
      return;
    }
    for (std::size_t k = first; k < first + count; ++k) {
      if (is_zero(found[k])) {
        estimate_alone(k);
      } else {
        normals_[index_[k]] = found[k];
      }
    }
  }

  /// Candidates for the neighbors of all these points, and the radius that it takes; false if it is not worth while.
  [[nodiscard]] bool gather_for_all(std::size_t first, std::size_t count, Neighborhood& candidates, Radius& wide) {
    const auto middle = [=](const float(&v)[group]) {
      const auto ends = std::minmax_element(v + first, v + first + count);
      return 0.5f * (*ends.first + *ends.second);
    };
    const Point center{middle(x_), middle(y_), middle(z_)};
    float farthest_d2 = 0.0f;
    for (std::size_t k = first; k < first + count; ++k) {
      const float dx = x_[k] - center.x;
      const float dy = y_[k] - center.y;
      const float dz = z_[k] - center.z;
      farthest_d2 = std::max(farthest_d2, unfused(dx * dx) + unfused(dy * dy) + unfused(dz * dz));
    }
    wide = Radius((radius_.value + simd::sqrt(farthest_d2)) * 1.00001f);  // more than all roundings
    const float widest = (count > smallest_part ? 1.75f : 3.0f) * radius_.value;
    return wide.value < widest && wide.value < largest_shared && validate(wide) == Status::ok &&
           gather(center, wide, candidates) == Status::ok;
  }

  void estimate_alone(std::size_t k) {
    const Point p = place(k);
    SurfaceNormal& normal = normals_[index_[k]];
    if (const SurfaceNormal* const known = memory_.known.find(p, KnownNormals::Way::alone)) {
      normal = *known;
      return;
    }
    Neighborhood n;
    SurfaceNormal found{};
    const bool is_found =
        gather(p, radius_, n) == Status::ok && estimate_normal(n, radius_, found, viewpoint_) == Status::ok;
    if (is_found) normal = found;
    memory_.known.keep(p, KnownNormals::Way::alone, n.found, normal);
  }

  /// Also notes whether the search is one over another cloud.
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighborhood& n) {
    const Status status = memory_.workspace.gather(search_, center, radius, n);
    if (status == Status::ok && !is_of(cloud_, center, n)) memory_.other_cloud = true;
    return status;
  }

  [[nodiscard]] Point place(std::size_t k) const noexcept { return {x_[k], y_[k], z_[k]}; }

  [[nodiscard]] bool are_in_one_place(std::size_t first, std::size_t count) const noexcept {
    for (std::size_t k = first + 1; k < first + count; ++k) {
      if (!(x_[k] == x_[first] && y_[k] == y_[first] && z_[k] == z_[first])) return false;
    }
    return true;
  }

  const CloudView cloud_;
  const Search& search_;
  const Radius radius_;
  const Viewpoint viewpoint_;
  const std::uint8_t* const needed_;  // one per point; null: all are
  NormalMemory& memory_;
  SurfaceNormal* const normals_;
  std::size_t index_[group];
  float x_[group];
  float y_[group];
  float z_[group];
  std::size_t row_;  // of an image, in points; 0 for other clouds
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_NORMAL_ESTIMATOR_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points that a thread takes at a time: about a quarter of a millisecond of work.
inline constexpr std::size_t normal_block = 512;

/// estimate_normals() where `needed` is not 0; null: everywhere.
template <class Search, class Threads>
[[nodiscard]] Status estimate_needed_normals(const CloudView& cloud, const Search& search, Radius radius,
                                             const Viewpoint& viewpoint, const std::uint8_t* needed,
                                             std::vector<SurfaceNormal>& normals, Threads& threads) {
  normals.clear();
  Status status = validate_search(cloud, search);
  if (status == Status::ok) status = validate(radius);
  if (status == Status::ok) status = validate(viewpoint);
  if (status == Status::ok && all_are_coarse(cloud, radius)) status = Status::coarse_coordinates;
  if (status != Status::ok) return status;

  auto&& executor = executor_of(threads, (cloud.size + normal_block - 1) / normal_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  std::vector<NormalMemory> memories(team);
  for (NormalMemory& memory : memories) memory.workspace.reserve(1024);
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  normals.assign(cloud.size, {none, none, none});  // and so they stay where an executor throws before their turn
  for_blocks(executor, team, cloud.size, normal_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    NormalEstimator<Search>(cloud, search, radius, viewpoint, needed, memories[thread], normals.data())
        .estimate(begin, end);
  });
  bool other_cloud = false;
  for (const NormalMemory& memory : memories) other_cloud = other_cloud || memory.other_cloud;
  const auto has_one = [](const SurfaceNormal& n) { return n.x == n.x; };
  if (!other_cloud && std::none_of(normals.begin(), normals.end(), has_one)) {
    other_cloud = !finds_a_point(cloud, search, radius, memories[0].workspace);
  }
  if (other_cloud) normals.clear();
  return other_cloud ? Status::other_cloud : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The surface normal at each point of a cloud, as estimate_normal() gives it but for the rounding of sums: points that
/// follow each other are looked at together.
///
/// `search`     any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `radius`     of the neighborhoods, in meters
/// `viewpoint`  to which side of the surface normals point: Viewpoint::towards({0, 0, 0}) for what a depth camera gives
///              in its own coordinates; Viewpoint{} leaves them as they come
/// `normals`    one per point, all three components NaN where the point is not finite or has no normal: fewer than
///              three neighbors, or all of them on a line. with_normals(cloud, normals.data()) puts them into a view
/// `threads`    how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///              for any number, and for any search
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint (not
/// finite), what the search's build() returned, coarse_coordinates (at every point floats lie farther apart than a 64th
/// of the radius), or other_cloud (as in extract()); `normals` is empty then.
///
/// The cost is points times neighbors: with a radius as large as the cloud, the square of its points. Points that lie
/// on top of each other in crowded places, as (0, 0, 0) for "no measurement", are looked at once for each place.
/// Allocates the normals (none, if they fit already), and for each thread 8 KB and about 30 bytes for each neighbor of
/// the largest neighborhood. May throw what extract() may; `normals` is empty then, or NaN where none was estimated by
/// then.
template <class Search, class Threads = unsigned>
[[nodiscard]] Status estimate_normals(const CloudView& cloud, const Search& search, Radius radius,
                                      const Viewpoint& viewpoint, std::vector<SurfaceNormal>& normals,
                                      Threads&& threads = 1u) {
  return detail::estimate_needed_normals(cloud, search, radius, viewpoint, nullptr, normals, threads);
}

/// The same where normals are needed: `needed` has a number for each point (see mark_neighbors()). Points where it is
/// not 0 have the normals that they have among those of the whole cloud, bit for bit; others may have NaN. sizes_differ
/// if there are not as many.
template <class Search, class Threads = unsigned>
[[nodiscard]] Status estimate_normals(const CloudView& cloud, const Search& search, Radius radius,
                                      const Viewpoint& viewpoint, const std::vector<std::uint8_t>& needed,
                                      std::vector<SurfaceNormal>& normals, Threads&& threads = 1u) {
  normals.clear();
  const Status usable = detail::validate_search(cloud, search);
  if (usable != Status::ok) return usable;
  if (needed.size() != cloud.size) return Status::sizes_differ;
  return detail::estimate_needed_normals(cloud, search, radius, viewpoint, needed.data(), normals, threads);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_ESTIMATE_NORMALS_HPP

// shortshot/batch/estimate_image_normals.hpp: the surface normals of a depth image, fast. Hosted only: allocates,
// starts threads.
#ifndef SHORTSHOT_BATCH_ESTIMATE_IMAGE_NORMALS_HPP
#define SHORTSHOT_BATCH_ESTIMATE_IMAGE_NORMALS_HPP

// shortshot/batch/image_geometry.hpp: how many pixels of a depth image a radius in meters spans. Hosted only.
#ifndef SHORTSHOT_BATCH_IMAGE_GEOMETRY_HPP
#define SHORTSHOT_BATCH_IMAGE_GEOMETRY_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Windows reach from 1 pixel to so many beyond their middle. No sum over a window leaves 32 bits then: coordinates
/// are in 32nds of the radius, and those of pixels side by side differ by a radius at most, or there is an edge.
inline constexpr std::size_t widest_window = 29;

/// Of an image whose camera is fitted to its points.
struct ImageGeometry {
  float columns;  ///< of half a window, times the depth
  float rows;
  float slope;    ///< how much the depth of the steepest surface changes from pixel to pixel, as a share of it
  float nearest;  ///< of all depths

  /// How many pixels a window reaches beyond its middle: squares with the second moments of a disc of the radius. A
  /// square of 2 h + 1 pixels has h (h + 1) / 3, a disc a quarter of the square of its own.
  [[nodiscard]] static simd::F32 half_of_window(float extent, simd::F32 depth) noexcept {
    const simd::F32 half = simd::all(extent) / depth - simd::all(0.5f);
    const simd::F32 bounded = simd::max(simd::min(half, simd::all(static_cast<float>(widest_window))), simd::all(1.0f));
    return simd::to_whole(bounded);
  }

  [[nodiscard]] std::size_t most_rows() const noexcept {
    return static_cast<std::size_t>(simd::largest(half_of_window(rows, simd::all(nearest))));
  }
};

/// empty_cloud; not_organized: not an image, or not a pinhole camera's, which is looked for in some thousand of the
/// points.
[[nodiscard]] inline Status measure_image(const CloudView& cloud, Radius radius, ImageGeometry& geometry) noexcept {
  if (!is_image(cloud) || cloud.width < 2) return Status::not_organized;
  simd::F32 farthest = simd::all(0.0f);
  simd::F32 behind = simd::all(0.0f);
  simd::F32 nearest = simd::all(3e38f);
  for_each_valid_register(cloud, [&](std::size_t, const PointLanes& p, simd::Mask) {
    farthest = simd::max(farthest, p.z);
    behind = simd::max(behind, simd::all(0.0f) - p.z);
    nearest = simd::min(nearest, select(p.z != simd::all(0.0f), simd::abs(p.z), simd::all(3e38f)));
  });
  const bool in_front = simd::largest(farthest) > 0.0f;
  const bool at_back = simd::largest(behind) > 0.0f;
  if (!in_front && !at_back) return Status::empty_cloud;
  if (in_front && at_back) return Status::not_organized;

  constexpr std::size_t most_looked_at = 4096;
  const std::size_t step = cloud.size / most_looked_at | 1;  // odd: it meets all columns of most widths
  Projection columns{};
  Projection rows{};
  Status status = fit_pinhole(cloud, step, columns, rows);
  if (!(columns.focal * rows.focal != 0.0f)) status = fit_pinhole(cloud, 1, columns, rows);
  if (status != Status::ok) return status;
  constexpr float half_of_square = 0.8660254f;  // of a disc's radius
  constexpr float steepest = 8.0f;              // 83 degrees: noise and steps of the depth look steep, too
  const float reach = radius.value * half_of_square;
  const float focal[2] = {__builtin_fabsf(columns.focal), __builtin_fabsf(rows.focal)};
  const float shorter = focal[0] < focal[1] ? focal[0] : focal[1];
  geometry = {reach * focal[0], reach * focal[1], shorter > steepest ? steepest / shorter : 1.0f,
              0.0f - simd::largest(simd::all(0.0f) - nearest)};
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_IMAGE_GEOMETRY_HPP

// shortshot/batch/image_sums.hpp: sums over any window of a depth image, at the same cost for all sizes. Hosted only:
// allocates.
#ifndef SHORTSHOT_BATCH_IMAGE_SUMS_HPP
#define SHORTSHOT_BATCH_IMAGE_SUMS_HPP

// shortshot/batch/pixel_sums.hpp: sums over the pixels of a window, modulo 2^32. Hosted only.
//
// A window's sum is made of four sums over rectangles that begin at the image's corner. Those may be as large as they
// like: they wrap, and so do their differences, and what is left, which does not fit 32 bits only if the window's own
// sum does not, is exact. So is what comes of moving the origin of moments afterwards.
#ifndef SHORTSHOT_BATCH_PIXEL_SUMS_HPP
#define SHORTSHOT_BATCH_PIXEL_SUMS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Integers that may wrap: in each lane, and four side by side.
using WrappingLanes = std::uint32_t __attribute__((vector_size(4 * simd::lanes)));
inline constexpr int lane_count = static_cast<int>(simd::lanes);
using WrappingQuad = std::uint32_t __attribute__((vector_size(16)));

/// What pixels add up to.
struct PixelSums {
  static constexpr int quads = 3;
  static constexpr int kinds = 4 * quads;
  WrappingQuad places;   ///< count, x, y, z
  WrappingQuad squares;  ///< xx, xy, xz, yy
  WrappingQuad others;   ///< yz, zz, edges, xx + yy + zz

  [[nodiscard, gnu::always_inline]] WrappingQuad& quad(int k) noexcept {
    return k == 0 ? places : k == 1 ? squares : others;
  }
};

[[nodiscard, gnu::always_inline]] inline PixelSums operator+(const PixelSums& a, const PixelSums& b) noexcept {
  return {a.places + b.places, a.squares + b.squares, a.others + b.others};
}
[[nodiscard, gnu::always_inline]] inline PixelSums operator-(const PixelSums& a, const PixelSums& b) noexcept {
  return {a.places - b.places, a.squares - b.squares, a.others - b.others};
}

[[nodiscard, gnu::always_inline]] inline bool has_edges(const PixelSums& sums) noexcept { return sums.others[2] != 0; }

/// Points of a register in whole numbers, zeros where there is none.
struct PixelLanes {
  simd::Mask valid;
  simd::F32 x, y, z;
};

[[nodiscard, gnu::always_inline]] inline WrappingLanes wrapping(simd::F32 whole) noexcept {
  return same_bits<WrappingLanes>(round_to_int(whole));
}

/// The terms of each lane's pixel.
[[gnu::always_inline]] inline void terms_of(const PixelLanes& p, simd::Mask edges,
                                            PixelSums (&terms)[simd::lanes]) noexcept {
  const WrappingLanes x = wrapping(p.x);
  const WrappingLanes y = wrapping(p.y);
  const WrappingLanes z = wrapping(p.z);
  const WrappingLanes xx = x * x;
  const WrappingLanes yy = y * y;
  const WrappingLanes zz = z * z;
  const auto number = [](simd::Mask m) { return same_bits<WrappingLanes>(increment(m, simd::all_int(0))); };
  const WrappingLanes of[PixelSums::kinds] = {number(p.valid), x,           y, z, xx, x * y, x * z, yy, y * z, zz,
                                              number(edges),   xx + yy + zz};
  unroll<PixelSums::quads>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    const auto kind = [&](int i) { return same_bits<simd::I32>(of[4 * k + i]); };
    simd::Quad quads[simd::lanes];
    transpose(kind(0), kind(1), kind(2), kind(3), quads);
    unroll<lane_count>([&](auto lane)
                           SHORTSHOT_INLINE_LAMBDA { terms[lane].quad(k) = same_bits<WrappingQuad>(quads[lane]); });
  });
}

/// Each kind of sum in a register.
struct SumLanes {
  WrappingLanes of[PixelSums::kinds];
};

/// A template, so that the branch of several lanes is none of one lane's.
template <std::size_t Lanes>
[[nodiscard, gnu::always_inline]] inline SumLanes lanes_of(PixelSums* sums) noexcept {
  SumLanes result;
  if constexpr (Lanes == 1) {
    std::memcpy(&result, sums, sizeof result);
  } else {
    // In each part of four lanes, four of whose kinds become four registers' parts.
    constexpr int count = static_cast<int>(Lanes / 4);
    unroll<PixelSums::quads>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      struct Parts {
        WrappingQuad of[Lanes / 4];
      };
      const auto row = [&](int i) SHORTSHOT_INLINE_LAMBDA {
        Parts parts;
        unroll<count>([&](auto part) { parts.of[part] = sums[i + 4 * part].quad(k); });
        return same_bits<simd::I32>(parts);
      };
      simd::Quad quads[Lanes];
      transpose(row(0), row(1), row(2), row(3), quads);
      unroll<4>([&](auto i) SHORTSHOT_INLINE_LAMBDA {
        Parts parts;
        unroll<count>([&](auto part) { parts.of[part] = same_bits<WrappingQuad>(quads[i + 4 * part]); });
        result.of[4 * k + i] = same_bits<WrappingLanes>(parts);
      });
    });
  }
  return result;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_PIXEL_SUMS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A window's first and past its last column and row.
struct Window {
  std::size_t left, right, top, bottom;
};

/// A pixel's point in whole numbers.
struct WholePoint {
  std::int32_t x, y, z;
};

/// The whole numbers that a radius counts for: what is lost in rounding means nothing next to any camera's noise.
inline constexpr std::int32_t steps_of_radius = 32;

/// Points in these steps. Those that float does not hold as finely are none, and those in the camera's own plane: many
/// drivers write (0, 0, 0) for "no measurement".
[[nodiscard, gnu::always_inline]] inline PixelLanes in_steps(const ValidLanes& p, simd::F32 scale) noexcept {
  const simd::F32 x = p.points.x * scale;
  const simd::F32 y = p.points.y * scale;
  const simd::F32 z = p.points.z * scale;
  const simd::F32 most = simd::all(4194303.0f);  // what to_whole() can take
  const simd::Mask usable = p.valid & (p.points.z != simd::all(0.0f)) &
                            (simd::max(simd::max(simd::abs(x), simd::abs(y)), simd::abs(z)) < most);
  return {usable, to_whole(keep(usable, x)), to_whole(keep(usable, y)), to_whole(keep(usable, z))};
}

/// Do the points of a part of a window lie within the radius of the window's middle, by root mean square? Where the
/// part has an edge itself, half of the squares must do.
struct Nearness {
  std::uint32_t x, y, z, squares;  ///< of the middle

  [[nodiscard, gnu::always_inline]] bool holds(const PixelSums& part) const noexcept {
    const WrappingQuad& places = part.places;
    const std::uint32_t count = places[0];
    const std::uint32_t along = places[1] * x + places[2] * y + places[3] * z;
    const std::uint32_t distances = part.others[3] + count * squares - 2 * along;
    // Squares of points very far from the middle wrap; but then their mean depth is far from its, too.
    const std::uint32_t within = count * static_cast<std::uint32_t>(steps_of_radius);
    const std::uint32_t limit = within * static_cast<std::uint32_t>(steps_of_radius);
    return distances <= (has_edges(part) ? limit / 2 : limit) && places[3] - count * z + within <= 2 * within;
  }
};

/// Rows of sums over all pixels above and to the left of a pixel, in a ring.
struct SummedRows {
  const PixelSums* rows;
  std::size_t last_slot;
  std::size_t stride;

  [[nodiscard, gnu::always_inline]] PixelSums over(const Window& w) const noexcept {
    const PixelSums* const top = row(w.top);
    const PixelSums* const bottom = row(w.bottom);
    return (bottom[w.right] - bottom[w.left]) - (top[w.right] - top[w.left]);
  }

  /// Over those of nine parts of a window that are near its middle: where there are edges, on this side of them.
  [[nodiscard]] PixelSums over_near_parts(const Window& window, const Window& middle,
                                          const WholePoint& center) const noexcept {
    const std::uint32_t x = static_cast<std::uint32_t>(center.x);
    const std::uint32_t y = static_cast<std::uint32_t>(center.y);
    const std::uint32_t z = static_cast<std::uint32_t>(center.z);
    const Nearness near{x, y, z, x * x + y * y + z * z};
    const std::size_t bounds[4] = {window.top, middle.top, middle.bottom, window.bottom};
    PixelSums sums{};
    for (std::size_t r = 0; r < 3; ++r) {
      const PixelSums* const top = row(bounds[r]);
      const PixelSums* const bottom = row(bounds[r + 1]);
      PixelSums left = bottom[window.left] - top[window.left];
      const auto add_part = [&](std::size_t end) SHORTSHOT_INLINE_LAMBDA {
        const PixelSums right = bottom[end] - top[end];
        const PixelSums part = right - left;
        if (near.holds(part)) sums = sums + part;
        left = right;
      };
      add_part(middle.left);
      add_part(middle.right);
      add_part(window.right);
    }
    return sums;
  }

 private:
  [[nodiscard, gnu::always_inline]] const PixelSums* row(std::size_t r) const noexcept {
    return rows + (r & last_slot) * stride;
  }
};

/// Sums over all pixels above and to the left of each pixel, for as many rows as the highest window has; rows are added
/// as the windows move down. Several of them may work on bands of one image: any window has the same sums in each.
class ImageSums {
 public:
  /// Room for an image of so many columns: 48 bytes for each pixel of 64 rows, if it has not had it before.
  void reserve(std::size_t columns) {
    const std::size_t most = stride_of(columns);
    rows_.resize(std::max(rows_.size(), most_slots * most));
    for (std::vector<float>* depths : {&depths_, &depths_above_}) depths->resize(std::max(depths->size(), most));
  }

  /// For windows of rows from `first` on, which reach `reach` rows beyond their middle; `slope` is that of
  /// ImageGeometry. There must be room.
  void begin(const CloudView& cloud, float scale, float slope, std::size_t first, std::size_t reach) noexcept {
    cloud_ = cloud;
    scale_ = scale;
    slope_ = slope;
    stride_ = stride_of(cloud.width);
    slots_ = 4;
    while (slots_ < 2 * reach + 2) slots_ *= 2;
    next_ = first > reach ? first - reach : 0;
    if (next_ > 0) {
      --next_;
      add_row(false);
    }
    std::fill_n(row(next_), stride_, PixelSums{});
  }

  /// Makes sure that all rows above `end` are there.
  void add_rows(std::size_t end) noexcept {
    while (next_ < end) add_row(true);
  }

  [[nodiscard, gnu::always_inline]] SummedRows rows() const noexcept { return {rows_.data(), slots_ - 1, stride_}; }

 private:
  static constexpr std::size_t most_slots = 64;
  static_assert(most_slots >= 2 * widest_window + 2, "the highest window");
  static constexpr float no_depth = 1e9f;  // of rows without a point: an edge to all others

  /// Whole registers, and what is before the first column.
  [[nodiscard]] static std::size_t stride_of(std::size_t columns) noexcept {
    return (columns + simd::lanes - 1) / simd::lanes * simd::lanes + 1;
  }

  [[nodiscard]] PixelSums* row(std::size_t r) noexcept { return rows_.data() + (r & (slots_ - 1)) * stride_; }

  [[nodiscard]] PixelLanes read_register(std::size_t column) const noexcept {
    const std::size_t left = std::min(simd::lanes, cloud_.width - column);
    return in_steps(read_valid(cloud_.points, next_ * cloud_.width + column, left), simd::all(scale_));
  }

  /// The depth that a hole at the row's beginning has: the first one that there is.
  [[nodiscard]] float first_depth() const noexcept {
    for (std::size_t column = 0; column < cloud_.width; column += simd::lanes) {
      const PixelLanes p = read_register(column);
      if (!any(p.valid)) continue;
      float z[simd::lanes];
      store(z, p.z);
      for (const float depth : z) {
        if (depth != 0.0f) return depth;
      }
    }
    return no_depth;
  }

  /// Depths of a register, and those of holes: what is to the left of them.
  [[nodiscard]] static simd::F32 without_holes(const PixelLanes& p, float& last) noexcept {
    float z[simd::lanes];
    store(z, p.z);
    if (!every(p.valid)) {
      float valid[simd::lanes];
      store(valid, keep(p.valid, simd::all(1.0f)));
      for (std::size_t lane = 0; lane < simd::lanes; ++lane) {
        if (valid[lane] == 0.0f) z[lane] = lane == 0 ? last : z[lane - 1];
      }
    }
    last = z[simd::lanes - 1];
    return simd::load(z);
  }

  /// The next row of the image; only its depths, if `with_sums` is false. An edge is where the depth differs from that
  /// to the left or that above by more than the radius and more than any slope does, holes filled with what is to the
  /// left.
  void add_row(bool with_sums) noexcept {
    std::swap(depths_, depths_above_);
    float last = first_depth();
    depths_[0] = last;
    const bool is_first = next_ == 0;
    const PixelSums* above = row(next_) + 1;
    PixelSums* to = row(next_ + 1);
    *to++ = PixelSums{};
    PixelSums sums{};
    for (std::size_t column = 0; column < cloud_.width; column += simd::lanes) {
      const PixelLanes p = read_register(column);
      const simd::F32 depth = without_holes(p, last);
      simd::store(depths_.data() + column + 1, depth);
      if (!with_sums) continue;
      const simd::F32 over = is_first ? depth : simd::load(depths_above_.data() + column + 1);
      const simd::F32 beside = simd::load(depths_.data() + column);
      PixelSums terms[simd::lanes];
      const simd::F32 step =
          simd::max(simd::abs(depth) * simd::all(slope_), simd::all(static_cast<float>(steps_of_radius)));
      terms_of(p, simd::max(simd::abs(depth - beside), simd::abs(depth - over)) > step, terms);
      unroll<lane_count>([&](auto lane) SHORTSHOT_INLINE_LAMBDA {
        sums = sums + terms[lane];
        *to++ = sums + *above++;
      });
    }
    ++next_;
  }

  CloudView cloud_{};
  float scale_ = 0.0f;
  float slope_ = 0.0f;               // the steepest one, as a share of the depth from pixel to pixel
  std::vector<PixelSums> rows_;      // a ring
  std::vector<float> depths_;        // of the last row: one before the first column, then all
  std::vector<float> depths_above_;  // of the one before
  std::size_t stride_ = 0;
  std::size_t slots_ = 0;
  std::size_t next_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_IMAGE_SUMS_HPP

// shortshot/batch/plane_of_sums.hpp: the normals of planes through the pixels of windows. Hosted only.
#ifndef SHORTSHOT_BATCH_PLANE_OF_SUMS_HPP
#define SHORTSHOT_BATCH_PLANE_OF_SUMS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The upper triangle of a symmetric matrix in each lane.
struct SymmetricTriangle {
  simd::F32 xx, xy, xz, yy, yz, zz;

  [[nodiscard]] simd::F32 trace() const noexcept { return xx + yy + zz; }
};

[[nodiscard, gnu::always_inline]] inline SymmetricTriangle operator*(const SymmetricTriangle& m,
                                                                     simd::F32 factor) noexcept {
  return {m.xx * factor, m.xy * factor, m.xz * factor, m.yy * factor, m.yz * factor, m.zz * factor};
}

/// Its eigenvectors are those of the matrix, the products of the other two's eigenvalues its eigenvalues.
[[nodiscard, gnu::always_inline]] inline SymmetricTriangle adjugate(const SymmetricTriangle& m) noexcept {
  return {m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
          m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
}

[[nodiscard, gnu::always_inline]] inline SymmetricTriangle square(const SymmetricTriangle& m) noexcept {
  return {m.xx * m.xx + m.xy * m.xy + m.xz * m.xz, m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
          m.xx * m.xz + m.xy * m.yz + m.xz * m.zz, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
          m.xy * m.xz + m.yy * m.yz + m.yz * m.zz, m.xz * m.xz + m.yz * m.yz + m.zz * m.zz};
}

/// How points scatter about their centroid, times their number, of sums about an origin that may be far away: they are
/// moved to `center`, which lies among the points, before they become floats.
[[nodiscard, gnu::always_inline]] inline SymmetricTriangle scatter_of(const SumLanes& sums,
                                                                      const WrappingLanes (&center)[3]) noexcept {
  const auto to_floats = [](WrappingLanes v) { return to_float(same_bits<simd::I32>(v)); };
  const WrappingLanes(&of)[PixelSums::kinds] = sums.of;
  const WrappingLanes moved[3] = {of[1] - of[0] * center[0], of[2] - of[0] * center[1], of[3] - of[0] * center[2]};
  const simd::F32 weight = simd::all(1.0f) / simd::max(to_floats(of[0]), simd::all(1.0f));
  const auto entry = [&](int a, int b, int kind) SHORTSHOT_INLINE_LAMBDA {
    const WrappingLanes about_center = a == b ? of[kind] - center[a] * (of[1 + a] + moved[a])
                                              : of[kind] - center[a] * of[1 + b] - center[b] * moved[a];
    return to_floats(about_center) - to_floats(moved[a]) * (to_floats(moved[b]) * weight);
  };
  return {entry(0, 0, 4), entry(0, 1, 5), entry(0, 2, 6), entry(1, 1, 7), entry(1, 2, 8), entry(2, 2, 9)};
}

/// A direction in each lane, and where there is one.
struct DirectionLanes {
  PointLanes direction;
  simd::Mask exists;
};

/// Along which `members` points scatter least: unit vectors; none for fewer than three, or if they lie on a line within
/// a step of whole numbers. The adjugate is the inverse but for a factor: its powers' columns turn to it, as in a power
/// iteration. Off by the fourth power of how much less the points scatter along it than along the next direction.
[[nodiscard, gnu::always_inline]] inline DirectionLanes least_scatter(const SymmetricTriangle& scatter,
                                                                      simd::F32 members) noexcept {
  using simd::all;
  using simd::F32;
  const F32 extent = simd::max(scatter.trace(), all(1.0f));
  SymmetricTriangle power = adjugate(scatter * (all(1.0f) / extent));
  const F32 second = power.trace() * extent;  // the second eigenvalue, or a little more
  power = square(square(power * (all(1.0f) / simd::max(power.trace(), all(1e-12f)))));
  const F32 trace = power.trace();  // from a 27th to 1, if the sums did not wrap
  const simd::Mask exists = (members > all(2.5f)) & (second > members) & (trace > all(0.015625f)) & (trace < all(2.0f));

  const simd::Mask y_leads = power.yy > power.xx;
  const F32 leading = simd::max(power.xx, power.yy);
  const simd::Mask z_leads = power.zz > leading;
  const auto column = [&](F32 of_x, F32 of_y, F32 of_z)
                          SHORTSHOT_INLINE_LAMBDA { return select(z_leads, of_z, select(y_leads, of_y, of_x)); };
  const F32 x = column(power.xx, power.xy, power.xz);
  const F32 y = column(power.xy, power.yy, power.yz);
  const F32 z = column(power.xz, power.yz, power.zz);
  const F32 shortened = all(1.0f) / simd::sqrt(simd::max(x * x + y * y + z * z, all(1e-30f)));
  return {{x * shortened, y * shortened, z * shortened}, exists};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_PLANE_OF_SUMS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Fewest rows that a thread takes: it sums up those above and below them, too.
inline constexpr std::size_t rows_of_band = 32;

/// What an image is asked for.
struct ImageTask {
  CloudView cloud;
  Radius radius;
  Viewpoint viewpoint;
  ImageGeometry geometry;
  const std::uint8_t* needed;  // one per point; null: all are
};

/// Normals of rows of an image, on one thread.
class ImageBand {
 public:
  void reserve(std::size_t columns) { sums_.reserve(columns); }

  /// Of rows [begin, end). There must be room for the image's columns.
  void estimate(const ImageTask& task, std::size_t begin, std::size_t end, SurfaceNormal* normals) noexcept {
    scale_ = static_cast<float>(steps_of_radius) / task.radius.value;
    const std::size_t reach = task.geometry.most_rows();
    sums_.begin(task.cloud, scale_, task.geometry.slope, begin, reach);
    for (std::size_t row = begin; row < end; ++row) {
      sums_.add_rows(std::min(task.cloud.height, row + reach + 1));
      for (std::size_t column = 0; column < task.cloud.width; column += simd::lanes) {
        estimate_register(task, row, column, normals + row * task.cloud.width + column);
      }
    }
  }

 private:
  /// Columns or rows of the windows around a register of pixels: the first, past the last, and how many they reach
  /// beyond the middle.
  struct Spans {
    std::uint32_t first[simd::lanes], end[simd::lanes], half[simd::lanes];
  };

  /// Those of holes are empty.
  [[nodiscard, gnu::always_inline]] static Spans spans(simd::F32 middle, simd::F32 half, std::size_t size,
                                                       simd::Mask valid) noexcept {
    Spans result;
    const simd::F32 first = simd::max(middle - half, simd::all(0.0f));
    const simd::F32 end = simd::min(middle + half + simd::all(1.0f), simd::all(static_cast<float>(size)));
    simd::store(result.first, round_to_int(first));
    simd::store(result.end, round_to_int(select(valid, end, first)));
    simd::store(result.half, round_to_int(half));
    return result;
  }

  void estimate_register(const ImageTask& task, std::size_t row, std::size_t column,
                         SurfaceNormal* normals) const noexcept {
    const CloudView& cloud = task.cloud;
    const std::size_t count = std::min(simd::lanes, cloud.width - column);
    const std::size_t first = row * cloud.width + column;
    const ValidLanes read = read_valid(cloud.points, first, count);
    const PixelLanes pixels = in_steps(read, simd::all(scale_));
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    if (!any(pixels.valid) || !is_needed(task, first, count)) {
      std::fill_n(normals, count, SurfaceNormal{none, none, none});
      return;
    }
    const SumLanes sums = sums_of_windows(task, row, column, pixels, simd::abs(read.points.z));
    const WrappingLanes center[3] = {wrapping(pixels.x), wrapping(pixels.y), wrapping(pixels.z)};
    const DirectionLanes least = least_scatter(scatter_of(sums, center), to_float(same_bits<simd::I32>(sums.of[0])));
    const PointLanes found = turned(least, pixels.valid, directions(task.viewpoint, read.points));
    if (count == simd::lanes) {
      store(normals, found);
    } else {
      SurfaceNormal few[simd::lanes];
      store(few, found);
      std::copy_n(few, count, normals);
    }
  }

  /// Towards the viewpoint; NaN where there is none.
  [[nodiscard, gnu::always_inline]] static PointLanes turned(const DirectionLanes& found, simd::Mask valid,
                                                             const PointLanes& towards) noexcept {
    const PointLanes& n = found.direction;
    const simd::F32 none = simd::all(std::numeric_limits<float>::quiet_NaN());
    const simd::Mask exists = found.exists & valid;
    const simd::Mask away = (n.x * towards.x + n.z * towards.z) + n.y * towards.y < simd::all(0.0f);
    const auto component = [&](simd::F32 v) {
      return select(exists, negate(away, v) + simd::all(0.0f), none);  // no negative zeros
    };
    return {component(n.x), component(n.y), component(n.z)};
  }

  [[nodiscard]] static bool is_needed(const ImageTask& task, std::size_t first, std::size_t count) noexcept {
    if (task.needed == nullptr) return true;
    const std::uint8_t* const marks = task.needed + first;
    return std::any_of(marks, marks + count, [](std::uint8_t mark) { return mark != 0; });
  }

  [[nodiscard, gnu::always_inline]] SumLanes sums_of_windows(const ImageTask& task, std::size_t row, std::size_t column,
                                                             const PixelLanes& pixels, simd::F32 depth) const noexcept {
    const ImageGeometry& geometry = task.geometry;
    const simd::F32 safe = select(pixels.valid, depth, simd::all(1.0f));
    const simd::F32 number = simd::from_lanes([](std::size_t lane) { return static_cast<float>(lane); });
    const Spans columns = spans(simd::all(static_cast<float>(column)) + number,
                                geometry.half_of_window(geometry.columns, safe), task.cloud.width, pixels.valid);
    const Spans rows = spans(simd::all(static_cast<float>(row)), geometry.half_of_window(geometry.rows, safe),
                             task.cloud.height, pixels.valid);
    const SummedRows summed = sums_.rows();
    PixelSums sums[simd::lanes];
    unroll<lane_count>([&](auto lane) SHORTSHOT_INLINE_LAMBDA {
      const Window window{columns.first[lane], columns.end[lane], rows.first[lane], rows.end[lane]};
      sums[lane] = summed.over(window);
      if (has_edges(sums[lane])) {
        sums[lane] = near_parts(window, column + static_cast<std::size_t>(lane), columns.half[lane], row,
                                rows.half[lane], pixels, lane);
      }
    });
    return lanes_of<simd::lanes>(sums);
  }

  [[nodiscard, gnu::noinline]] PixelSums near_parts(const Window& window, std::size_t column, std::size_t half_columns,
                                                    std::size_t row, std::size_t half_rows, const PixelLanes& pixels,
                                                    int lane) const noexcept {
    const std::size_t across = (2 * half_columns + 1) / 6;  // half of a third
    const std::size_t along = (2 * half_rows + 1) / 6;
    const Window middle{std::max(window.left, column - std::min(column, across)),
                        std::min(window.right, column + across + 1), std::max(window.top, row - std::min(row, along)),
                        std::min(window.bottom, row + along + 1)};
    std::int32_t at[3][simd::lanes];
    simd::store(at[0], round_to_int(pixels.x));
    simd::store(at[1], round_to_int(pixels.y));
    simd::store(at[2], round_to_int(pixels.z));
    return sums_.rows().over_near_parts(window, middle, {at[0][lane], at[1][lane], at[2][lane]});
  }

  ImageSums sums_;
  float scale_ = 0.0f;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Estimates the normals of depth image after depth image, and owns the scratch memory that this takes.
///
/// For each thread 48 bytes a pixel of 64 rows, and the normals; with the same estimator and vector again, nothing,
/// until an image is wider than those before it, or more threads work. Starting threads, however, costs small
/// allocations of the C++ runtime's in every call; an executor has none.
class ImageNormalEstimator {
 public:
  /// See the function estimate_image_normals() below.
  template <class Threads = unsigned>
  [[nodiscard]] Status estimate(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                std::vector<SurfaceNormal>& normals, Threads&& threads = 1u) {
    return estimate_needed(cloud, radius, viewpoint, nullptr, normals, threads);
  }

  /// The same where normals are needed: `needed` has a number for each point (see mark_neighbors()), and points where
  /// it is 0 may get NaN. sizes_differ if there are not as many.
  template <class Threads = unsigned>
  [[nodiscard]] Status estimate(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                const std::vector<std::uint8_t>& needed, std::vector<SurfaceNormal>& normals,
                                Threads&& threads = 1u) {
    if (validate(cloud) == Status::ok && needed.size() != cloud.size) {
      normals.clear();
      return Status::sizes_differ;
    }
    return estimate_needed(cloud, radius, viewpoint, needed.data(), normals, threads);
  }

 private:
  template <class Threads>
  [[nodiscard]] Status estimate_needed(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                       const std::uint8_t* needed, std::vector<SurfaceNormal>& normals,
                                       Threads& threads) {
    normals.clear();
    detail::ImageTask task{cloud, radius, viewpoint, {}, needed};
    Status status = validate(cloud);
    if (status == Status::ok) status = validate(radius);
    if (status == Status::ok) status = validate(viewpoint);
    if (status == Status::ok) status = detail::measure_image(cloud, radius, task.geometry);
    if (status == Status::ok && detail::all_are_coarse(cloud, radius)) status = Status::coarse_coordinates;
    if (status != Status::ok) return status;

    auto&& executor = detail::executor_of(threads, (cloud.height + detail::rows_of_band - 1) / detail::rows_of_band);
    const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
    if (bands_.size() < team) bands_.resize(team);
    for (std::size_t t = 0; t < team; ++t) bands_[t].reserve(cloud.width);  // whichever thread gets work this time
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    normals.assign(cloud.size, {none, none, none});  // and so they stay where an executor throws before their turn
    const std::size_t rows = std::max(detail::rows_of_band, (cloud.height + team - 1) / team);
    detail::for_blocks(executor, team, cloud.height, rows, [&](std::size_t thread, std::size_t begin, std::size_t end) {
      bands_[thread].estimate(task, begin, end, normals.data());
    });
    return Status::ok;
  }

  std::vector<detail::ImageBand> bands_;  // one per thread
};

/// The surface normal at each point of a depth image, at a cost that does not depend on how many neighbors it has: of a
/// frame of 640 x 480, within 1 cm, a tenth of estimate_normals()' instructions, and no index. Not the same normals,
/// but near them, 1 to 2 degrees on surfaces: bench/RESULTS.md says how near, by depth and by distance from an edge.
///
/// A normal is that of the plane through the points of a square window, whose sums come from running sums over the
/// image, of points rounded to a 32nd of the radius. The window has the second moments of a disc of the radius that
/// faces the camera at the point's depth, and at most 59 x 59 pixels. Where it has an edge (depths side by side, or
/// across a hole, that differ by more than the radius and more than on any slope up to 83 degrees), those of its nine
/// parts count whose points lie within the radius of the middle by root mean square; half of the square, if the part
/// has an edge.
///
/// `cloud`      an image (width and height) that a pinhole camera took, in its own coordinates: z is the depth. Points
///              that are not finite, or whose z is 0, are holes
/// `radius`     what estimate_normals() would be given, in meters
/// `viewpoint`  to which side of the surface normals point, as in estimate_normals()
/// `normals`    one per point, all three components NaN where the point is a hole or has no normal: fewer than three
///              points in the window, or all of them on a line within a 32nd of the radius
/// `threads`    how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///              for any number
///
/// Statuses: empty_cloud, bad_view, bad_radius, bad_viewpoint (not finite), not_organized (height 1, width * height is
/// not the size, points in front of and behind the camera, or points that deviate from every pinhole by more than a
/// quarter of the image, as after moving the cloud into another coordinate system), coarse_coordinates (as in
/// estimate_normals()); `normals` is empty then. Allocates what ImageNormalEstimator does, anew in every call. May
/// throw what extract() may.
template <class Threads = unsigned>
[[nodiscard]] Status estimate_image_normals(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                            std::vector<SurfaceNormal>& normals, Threads&& threads = 1u) {
  return ImageNormalEstimator().estimate(cloud, radius, viewpoint, normals, threads);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_ESTIMATE_IMAGE_NORMALS_HPP

// shortshot/batch/extract.hpp: many key points at once, in one call. Hosted only: allocates, starts threads.
#ifndef SHORTSHOT_BATCH_EXTRACT_HPP
#define SHORTSHOT_BATCH_EXTRACT_HPP

// shortshot/batch/extractor.hpp: many key points at once, with memory that is used again for the next cloud. Hosted
// only: allocates, starts threads.
#ifndef SHORTSHOT_BATCH_EXTRACTOR_HPP
#define SHORTSHOT_BATCH_EXTRACTOR_HPP

// shortshot/color/lab_table.hpp: sRGB bytes -> CIELAB by tables, for whole clouds. Hosted only: allocates.
#ifndef SHORTSHOT_COLOR_LAB_TABLE_HPP
#define SHORTSHOT_COLOR_LAB_TABLE_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// to_lab<Rule>() with the same bits and without its powers: what each byte adds to the three CIE ratios of a color is
/// in a table, and so is the root of each step that a ratio can have. 28 KB. Reentrant once it is filled.
template <class Rule>
class LabTable {
 public:
  /// To be called before the first color; does nothing where it was called before. May throw std::bad_alloc.
  void fill() {
    if (!roots_.empty()) return;
    std::vector<Ratios> shares(3 * std::size_t{bytes});
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t byte = 0; byte < bytes; ++byte) {
        const float linear = detail::srgb_to_linear[byte];
        for (int ratio = 0; ratio < 3; ++ratio) {
          shares[c * bytes + byte][ratio] = extend::unfused(linear * detail::xyz_of_rgb[ratio][c]);
        }
      }
    }
    std::vector<float> roots;
    roots.reserve(detail::last_ratio_step + 1);
    for (int step = 0; step <= detail::last_ratio_step; ++step) roots.push_back(detail::root_of_step<Rule>(step));
    shares_.swap(shares);
    roots_.swap(roots);
  }

  /// What to_lab<Rule>() gives, bit for bit; after fill().
  [[nodiscard]] Lab operator()(Rgb color) const noexcept {
    constexpr Ratios white{detail::white_xyz[0], detail::white_xyz[1], detail::white_xyz[2], 1.0f};
    const Ratios* const shares = shares_.data();
    const Ratios sum = (shares[color.r] + shares[bytes + color.g]) + shares[2 * bytes + color.b];
    const auto steps = __builtin_convertvector(sum / white * 4000.0f, extend::simd::Quad);  // as ratio_step() has them
    const float* const roots = roots_.data();
    const float f[3] = {roots[steps[0]], roots[steps[1]], roots[steps[2]]};
    Lab lab;
    detail::lab_of_roots<Rule>(f, lab);
    return lab;
  }

 private:
  using Ratios = extend::simd::FloatQuad;
  static constexpr std::size_t bytes = 256;

  std::vector<Ratios> shares_;  // of red, of green, of blue
  std::vector<float> roots_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_COLOR_LAB_TABLE_HPP

// shortshot/batch/features.hpp: rows of descriptors with where and how they were made. Hosted only.
#ifndef SHORTSHOT_BATCH_FEATURES_HPP
#define SHORTSHOT_BATCH_FEATURES_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What extract() and describe_cloud() give: one row per key point, in their order. Rows only: copying it copies no
/// scratch memory. Keep it from frame to frame and its memory is used again.
///
/// A descriptor that needs no frame has none here either: train() and recognize(), which cast votes from frames, say
/// bad_frame. Give extract() frames of your own then, and it keeps them.
template <class D>
struct Features {
  std::vector<float> values;        ///< size() * D::size, row by row; zeros where the status is not ok
  std::vector<Status> status;       ///< one per key point
  std::vector<KeyPoint> keypoints;  ///< what was described; zeros for an index outside of the cloud
  std::vector<Frame> frames;        ///< of each; zeros where the status is not ok, or if D::needs_frame is false
  std::vector<FrameConfidence> frame_confidence;  ///< how sure each of them is; zeros: not ok, or the caller's frame
  std::vector<std::uint32_t> neighbors;           ///< found within the larger radius, the key point itself included
                                                  ///< (the frame's counts if there is one)

  /// Number of rows.
  [[nodiscard, gnu::always_inline]] std::size_t size() const noexcept { return status.size(); }
  /// Row `row`: D::size values.
  [[nodiscard, gnu::always_inline]] const float* operator[](std::size_t row) const noexcept {
    return values.data() + row * static_cast<std::size_t>(D::size);
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a row holds whose status is not ok.
template <class D>
void clear_row(Features<D>& features, std::size_t row) noexcept {
  constexpr auto row_size = static_cast<std::size_t>(D::size);
  features.frames[row] = Frame{};
  features.frame_confidence[row] = FrameConfidence{};
  std::fill_n(features.values.data() + row * row_size, row_size, 0.0f);
}

/// `count` rows without a descriptor, all with one status. Whatever is thrown while memory is asked for, no row of
/// before is left.
template <class D>
void clear_rows(Features<D>& out, std::size_t count, Status status) {
  out.status.clear();
  out.values.assign(count * static_cast<std::size_t>(D::size), 0.0f);
  out.keypoints.assign(count, KeyPoint{});
  out.frames.assign(count, Frame{});
  out.frame_confidence.assign(count, FrameConfidence{});
  out.neighbors.assign(count, 0);
  out.status.assign(count, status);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_FEATURES_HPP

// shortshot/batch/known_rows.hpp: rows of key points that lie on top of each other, to be computed once. Hosted only.
#ifndef SHORTSHOT_BATCH_KNOWN_ROWS_HPP
#define SHORTSHOT_BATCH_KNOWN_ROWS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

[[nodiscard]] inline bool are_same(const KeyPoint& a, const KeyPoint& b) noexcept {
  return a.position.x == b.position.x && a.position.y == b.position.y && a.position.z == b.position.z &&
         a.intensity == b.intensity && a.color.r == b.color.r && a.color.g == b.color.g && a.color.b == b.color.b &&
         a.has_color == b.has_color && a.has_intensity == b.has_intensity;
}

/// The rows of the last few crowded key points of one thread in one call; see KnownNormals.
class KnownRows {
 public:
  /// An earlier row of the same key point, or `row` if none is known.
  template <class D>
  [[nodiscard]] std::size_t find(const Features<D>& features, std::size_t row) const noexcept {
    const KeyPoint& key = features.keypoints[row];
    const std::size_t known = rows_[slot_of_place(key.position)];
    return known != 0 && are_same(features.keypoints[known - 1], key) ? known - 1 : row;
  }

  template <class D>
  void keep(const Features<D>& features, std::size_t row) noexcept {
    if (features.neighbors[row] < KnownNormals::crowd) return;
    rows_[slot_of_place(features.keypoints[row].position)] = row + 1;
  }

 private:
  std::array<std::size_t, place_slots> rows_{};  // 1 more than the number of a row; 0: none
};

/// All of a row but its key point.
template <class D>
void copy_row(Features<D>& features, std::size_t from, std::size_t to) noexcept {
  float* const values = features.values.data();
  std::memcpy(values + to * std::size_t{D::size}, values + from * std::size_t{D::size}, D::size_bytes);
  features.status[to] = features.status[from];
  features.frames[to] = features.frames[from];
  features.frame_confidence[to] = features.frame_confidence[from];
  features.neighbors[to] = features.neighbors[from];
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_BATCH_KNOWN_ROWS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Key points that a thread takes at a time. Few, since one at the rim of an object has a hundredth of the neighbors
/// of one on a table, and whoever takes the last block keeps the others waiting: of 1000 key points on 8 threads that
/// cost 1 % with blocks of 2, 2.5 % with 4, 10 % with 16 (measured), and a block costs 30 nanoseconds at worst.
inline constexpr std::size_t keypoint_block = 2;

/// Colors that a thread converts at a time: about 20 microseconds of work.
inline constexpr std::size_t color_block = 4096;

/// Key point `row` of those that are to be described: false for an index outside of the cloud.
[[nodiscard]] inline bool keypoint_at(const CloudView&, const std::vector<KeyPoint>& keypoints, std::size_t row,
                                      KeyPoint& key) noexcept {
  key = keypoints[row];
  return true;
}
template <class Index>
[[nodiscard]] bool keypoint_at(const CloudView& cloud, const std::vector<Index>& keypoints, std::size_t row,
                               KeyPoint& key) noexcept {
  static_assert(std::is_integral<Index>::value, "extract() supports key points as indices or as KeyPoints");
  const Index index = keypoints[row];
  if (!is_index(cloud, index)) return false;
  key = keypoint(cloud, static_cast<std::size_t>(index));
  return true;
}

/// A copy where an argument is a part of the output, which is cleared first; else the argument.
template <class Argument, class D>
class SafeFrom {
 public:
  SafeFrom(const Argument& argument, const Features<D>& out) : argument_(argument) {
    const void* const parts[] = {&out.keypoints, &out.frames, &out.neighbors};
    is_part_ = std::find(std::begin(parts), std::end(parts), static_cast<const void*>(&argument)) != std::end(parts);
    if (is_part_) copy_ = argument;
  }
  [[nodiscard]] const Argument& get() const noexcept { return is_part_ ? copy_ : argument_; }

 private:
  const Argument& argument_;
  Argument copy_;
  bool is_part_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describes many key points of one cloud after the other, and owns the scratch memory that this takes. `Color` is how
/// a cloud's colors are kept meanwhile: Lab, 12 bytes a point, or PackedLab, 4 bytes a point and less exact.
///
/// Allocates those and 16 KB for colors, for each thread 2 KB and about 30 bytes for each neighbor of the largest
/// neighborhood, and the rows; with the same extractor and features again, nothing, until a cloud needs more than those
/// before it. Starting threads, however, costs small allocations of the C++ runtime's in every call; an executor has
/// none. May throw what std::vector, std::thread and the executor throw (on a thread started here that ends the
/// program); rows that were not described by then have the status out_of_memory.
template <class D, class Color = Lab>
class Extractor {
  static_assert(std::is_same<Color, Lab>::value || std::is_same<Color, PackedLab>::value,
                "Extractor<D, Color> supports Lab and PackedLab");

 public:
  /// See the function extract() below.
  template <class Search, class Key, class Threads = unsigned, class... Own>
  [[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                               const Support& support, Features<D>& out, Threads&& threads = 1u, const Own&... own) {
    const auto finish = [&](const Neighborhood& n, const auto& sources, std::size_t row, float* values) {
      return detail::describe_widest<D>(n, sources, out.keypoints[row].position, support, out.frames[row], values,
                                        out.frame_confidence[row]);
    };
    const detail::SafeFrom<std::vector<Key>, D> keys(keypoints, out);
    return extract_all<true>(cloud, search, keys.get(), support, out, threads, finish, own...);
  }

  /// The same in frames that the caller knows, one for each key point: bad_rows if there are not as many; bad_frame for
  /// a key point whose frame is not orthonormal.
  template <class Search, class Key, class Threads = unsigned, class... Own>
  [[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                               const std::vector<Frame>& frames, Radius radius, Features<D>& out,
                               Threads&& threads = 1u, const Own&... own) {
    if (frames.size() != keypoints.size()) {
      detail::clear_rows(out, keypoints.size(), Status::bad_rows);
      return Status::bad_rows;
    }
    const detail::SafeFrom<std::vector<Frame>, D> kept(frames, out);
    const detail::SafeFrom<std::vector<Key>, D> keys(keypoints, out);
    const auto finish = [&](const Neighborhood& n, const auto& sources, std::size_t row, float* values) {
      out.frames[row] = kept.get()[row];
      return detail::describe_widest<D>(n, sources, out.frames[row], radius, values);
    };
    return extract_all<false>(cloud, search, keys.get(), radius, out, threads, finish, own...);
  }

 private:
  /// finish(neighborhood, sources, row, values) makes row `row` of a key point's neighborhood. `SameRows`: the same key
  /// point has the same row.
  template <bool SameRows, class Search, class Key, class Threads, class Finish, class... Own>
  [[nodiscard]] Status extract_all(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                                   const Support& support, Features<D>& out, Threads& threads, const Finish& finish,
                                   const Own&... own) {
    const std::size_t count = keypoints.size();
    auto&& executor = detail::executor_of(threads, (count + detail::keypoint_block - 1) / detail::keypoint_block);
    const Status usable = validate<D>(cloud, search, support);
    detail::clear_rows(out, count, usable == Status::ok ? Status::out_of_memory : usable);
    if (usable != Status::ok) return usable;
    const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
    if (workspaces_.size() < team) {
      workspaces_.resize(team);
      leveled_for_ = 0;
    }
    if (SameRows) known_rows_.assign(team, {});
    convert_colors(cloud, executor, team);
    const auto extract_rows = [&](std::size_t thread, std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        KeyPoint& key = out.keypoints[row];
        Status& status = out.status[row];
        if (!detail::keypoint_at(cloud, keypoints, row, key)) {
          status = Status::bad_keypoint;
          continue;
        }
        const std::size_t same = SameRows ? known_rows_[thread].find(out, row) : row;
        if (same != row) {
          detail::copy_row(out, same, row);
          continue;
        }
        status = extract_row(cloud, search, support, workspaces_[thread], out, row, finish, own...);
        if (status != Status::ok) detail::clear_row(out, row);
        if (SameRows) known_rows_[thread].keep(out, row);
      }
    };
    detail::for_blocks(executor, team, count, detail::keypoint_block, extract_rows);
    level(out.neighbors);
    const Status sense = verdict(cloud, search, support, out);
    if (sense != Status::ok) detail::clear_rows(out, count, sense);
    return sense;
  }

  /// other_cloud if one row shows it: no other one can be believed then. coarse_coordinates if all rows are. Else ok.
  template <class Search>
  [[nodiscard]] Status verdict(const CloudView& cloud, const Search& search, const Support& support,
                               const Features<D>& out) {
    const auto rows = static_cast<std::ptrdiff_t>(out.size());
    const auto count = [&](Status status) { return std::count(out.status.begin(), out.status.end(), status); };
    if (rows == 0) return Status::ok;
    if (count(Status::other_cloud) > 0) return Status::other_cloud;
    if (count(Status::coarse_coordinates) == rows) return Status::coarse_coordinates;
    if (std::count(out.neighbors.begin(), out.neighbors.end(), 0u) < rows) return Status::ok;
    const Radius reach = detail::reach_of<D>(support);
    return detail::finds_a_point(cloud, search, reach, workspaces_[0]) ? Status::ok : Status::other_cloud;
  }

  /// One row but for the zeros of a failure. The workspace grows until the neighbors fit.
  template <class Search, class Finish, class... Own>
  [[nodiscard]] Status extract_row(const CloudView& cloud, const Search& search, const Support& support,
                                   detail::GrowingWorkspace& workspace, Features<D>& out, std::size_t row,
                                   const Finish& finish, const Own&... own) const {
    using Kinds = typename D::Sources;
    const KeyPoint& key = out.keypoints[row];
    if (!is_finite(key.position)) return Status::invalid_keypoint;
    if (detail::is_coarse(key.position, support.radius)) return Status::coarse_coordinates;
    const Color* const converted = lab_.data();
    const auto sources = detail::sources_at(Kinds{}, cloud, detail::key_for<D>(key), own..., converted);
    Status status = detail::status_of(Kinds{}, sources);
    if (status != Status::ok) return status;
    Neighborhood n;
    status = workspace.gather(search, key.position, detail::reach_of<D>(support), n);
    out.neighbors[row] = n.found;
    if (status != Status::ok) return status;
    if (n.size > max_neighbors) return Status::too_many_neighbors;
    if (!detail::is_of(cloud, key.position, n)) return Status::other_cloud;
    return finish(n, sources, row, row_of(out, row));
  }

  template <class Executor>
  void convert_colors(const CloudView& cloud, Executor& executor, std::size_t team) {
    if constexpr (D::needs_colors) {
      to_lab_.fill();
      lab_.resize(cloud.size);
      detail::for_blocks(executor, team, cloud.size, detail::color_block,
                         [&](std::size_t, std::size_t begin, std::size_t end) {
                           detail::convert_range(cloud, begin, end, to_lab_, lab_.data());
                         });
    }
  }

  /// Room in all workspaces for a quarter more neighbors than the largest neighborhood had, whichever thread gets it
  /// next time. Nothing is done about clouds up to an eighth denser than that: a little difference needs no memory.
  void level(const std::vector<std::uint32_t>& neighbors) {
    if (neighbors.empty()) return;
    const std::size_t most = std::min(*std::max_element(neighbors.begin(), neighbors.end()), max_neighbors);
    if (most <= leveled_for_) return;
    for (detail::GrowingWorkspace& workspace : workspaces_) workspace.reserve(most + most / 4);
    leveled_for_ = most + most / 8;
  }

  [[nodiscard]] static float* row_of(Features<D>& out, std::size_t row) noexcept {
    return out.values.data() + row * static_cast<std::size_t>(D::size);
  }

  LabTable<typename D::LabRule> to_lab_;
  std::vector<Color> lab_;                            // the cloud's colors
  std::vector<detail::GrowingWorkspace> workspaces_;  // one per thread
  std::vector<detail::KnownRows> known_rows_;         // one per thread, of one call
  std::size_t leveled_for_ = 0;                       // neighbors that each of them has had room made for
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_EXTRACTOR_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describe many key points of a cloud. Whoever describes cloud after cloud keeps an Extractor, whose extract() is the
/// same and uses its memory again.
///
/// `search`     any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `keypoints`  indices into the cloud (of any integer type; pcl::Indices, too), or KeyPoints, which need not be points
///              of it, each with its own color and intensity; out.keypoints, too (they are copied before)
/// `support`    radii and viewpoint; a plain float is the radius in meters
/// `out`        one row and one Status per key point; a key point that cannot be described spoils no other
/// `threads`    how many threads share the work, or an executor, which runs it on threads that are there already; the
///              result is the same, bit for bit, for any number
/// `own`        sources of yours for D's signals, which come before those that the cloud has
///
/// An executor is any object with `threads()`, the most threads that it runs on, and `run(work)`, which calls work() on
/// each of them, or on fewer, but on one at least, and returns when all calls have returned. OpenMP's, with n threads:
///
///     struct OpenMp {
///       int n;
///       int threads() const { return n; }
///       template <class Work> void run(const Work& work) {
///         #pragma omp parallel num_threads(n)
///         work();
///       }
///     };
///
/// and TBB's run() is `tbb::parallel_for(0, n, [&](int) { work(); });`. A call runs at most two pieces of work on it.
///
/// Returns ok if key points could be looked at at all, else why not, and every row has that status: empty_cloud,
/// bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint, missing_colors,
/// missing_normals, missing_intensities, what the search's build() returned, other_cloud (neighbors do not lie where
/// the cloud has them: the search is over another one, or its memory was written to since) or coarse_coordinates (those
/// of all key points; else of the row alone). For allocation and exceptions see Extractor.
///
/// Key points on top of each other in a crowded place are described once for each thread, but not in frames of the
/// caller's.
template <class D, class Search, class Key, class Threads = unsigned, class... Own>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                             const Support& support, Features<D>& out, Threads&& threads = 1u, const Own&... own) {
  return Extractor<D>().extract(cloud, search, keypoints, support, out, threads, own...);
}

/// The same in frames that the caller knows, one for each key point: bad_rows if there are not as many; bad_frame for a
/// key point whose frame is not orthonormal.
template <class D, class Search, class Key, class Threads = unsigned, class... Own>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                             const std::vector<Frame>& frames, Radius radius, Features<D>& out, Threads&& threads = 1u,
                             const Own&... own) {
  return Extractor<D>().extract(cloud, search, keypoints, frames, radius, out, threads, own...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_EXTRACT_HPP

// shortshot/batch/mark_neighbors.hpp: which points of a cloud lie near its key points. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_MARK_NEIGHBORS_HPP
#define SHORTSHOT_BATCH_MARK_NEIGHBORS_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Marks the points within `radius` of a key point: `marks` has one number for each point of the cloud, 1 there, else
/// 0. The normals of these are all that SHOT and CSHOT of that radius need: estimate_normals() and
/// ImageNormalEstimator::estimate() take such marks. It pays where key points are so few that their neighborhoods leave
/// most of the cloud out.
///
/// `search`     any search over this cloud
/// `keypoints`  as extract() takes them: indices or KeyPoints. Those that cannot be described mark nothing
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, what the search's
/// build() returned, or other_cloud (as in extract()); `marks` is empty then. Allocates the marks (none, if they fit
/// already) and about 30 bytes for each neighbor of the largest neighborhood; one thread.
template <class Search, class Key>
[[nodiscard]] Status mark_neighbors(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                                    Radius radius, std::vector<std::uint8_t>& marks) {
  marks.clear();
  Status status = detail::validate_search(cloud, search);
  if (status == Status::ok) status = validate(radius);
  if (status != Status::ok) return status;
  marks.assign(cloud.size, 0);
  detail::GrowingWorkspace workspace;
  workspace.reserve(1024);
  for (std::size_t row = 0; row < keypoints.size(); ++row) {
    KeyPoint key{};
    Neighborhood n;
    if (!detail::keypoint_at(cloud, keypoints, row, key) || !is_finite(key.position)) continue;
    if (workspace.gather(search, key.position, radius, n) != Status::ok) continue;
    if (!detail::is_of(cloud, key.position, n)) {
      marks.clear();
      return Status::other_cloud;
    }
    for (std::uint32_t i = 0; i < n.size; ++i) marks[n.index[i]] = 1;
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_MARK_NEIGHBORS_HPP

// shortshot/batch/describe_cloud.hpp: a whole cloud in one call: key points, search, frames, descriptors. Hosted only:
// allocates, starts threads.
#ifndef SHORTSHOT_BATCH_DESCRIBE_CLOUD_HPP
#define SHORTSHOT_BATCH_DESCRIBE_CLOUD_HPP

// shortshot/batch/keep_best_frames.hpp: the key points whose frames are surest, and no others. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_KEEP_BEST_FRAMES_HPP
#define SHORTSHOT_BATCH_KEEP_BEST_FRAMES_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Leave out all but the best share of the rows whose status is ok: those whose frames have most confidence(), of
/// equals the first (all are, if the frames are the caller's or there are none). The others become unsure_frame, and
/// zeros: rows keep their places and their key points, and matching, training and recognition pass over them. It saves
/// their time, and on frames of a room the rows that stay are right more often; elsewhere what it brings is little or
/// nothing: bench/paper/README.md, "Frame confidence". Thin out both clouds of a pair alike, or one of them alone.
///
/// `share`  above 0, at most 1 (bad_option; nothing is changed); the number is rounded to the nearest, and one row
///          stays at least. Called twice with 1/2 it leaves a quarter
///
/// O(rows); allocates 4 bytes a row. The same rows on every machine.
template <class D>
[[nodiscard]] Status keep_best_frames(Features<D>& features, float share) {
  if (!(share > 0.0f && share <= 1.0f)) return Status::bad_option;
  std::vector<std::uint32_t> rows;
  for (std::size_t row = 0; row < features.size(); ++row) {
    if (features.status[row] == Status::ok) rows.push_back(static_cast<std::uint32_t>(row));
  }
  const float wanted = __builtin_roundf(share * static_cast<float>(rows.size()));
  const auto kept = std::max<std::size_t>(1, static_cast<std::size_t>(wanted));
  if (share == 1.0f || kept >= rows.size()) return Status::ok;
  const auto end = rows.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(rows.begin(), end, rows.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float of_a = confidence(features.frame_confidence[a]);
    const float of_b = confidence(features.frame_confidence[b]);
    return of_a != of_b ? of_a > of_b : a < b;
  });
  for (auto row = end; row != rows.end(); ++row) {
    features.status[*row] = Status::unsure_frame;
    detail::clear_row(features, *row);
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_KEEP_BEST_FRAMES_HPP

// shortshot/batch/suggest.hpp: lengths that fit a cloud: the support's radius, the leaf of its key points, the radius
// of normals. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_SUGGEST_HPP
#define SHORTSHOT_BATCH_SUGGEST_HPP

// shortshot/batch/diagnose.hpp: numbers that cannot work are named: units, radii, searches, normals, colors. Hosted
// only: allocates.
#ifndef SHORTSHOT_BATCH_DIAGNOSE_HPP
#define SHORTSHOT_BATCH_DIAGNOSE_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What diagnose() sees. Shares are 0 to 1, lengths are in the cloud's unit. Trivially copyable.
struct Diagnosis {
  Status status;       ///< ok; or why nothing more can be said (all that extract() says of a cloud, a search and radii)
  float not_finite;    ///< share of the points that are no measurement: NaN or infinite
  float at_origin;     ///< share of the points at (0, 0, 0): many of them mean "no measurement"
  Point low;           ///< least coordinates of the valid points that are not at the origin
  Point high;          ///< largest ones
  bool one_color;      ///< there are colors, and they are the same at all points
  float no_normal;     ///< share of the valid points that have no normal; 1 if the cloud has none
  float other_length;  ///< share of the normals whose length is not 1, within a hundredth

  std::size_t sampled;     ///< points that were looked at for what follows, at most 1000; none at the origin
  float float_step;        ///< median distance of floats at their largest coordinates: what these cannot tell apart
  float spacing;           ///< median distance to the nearest point elsewhere; 0 if there is none near
  float doubles;           ///< share of them on which another point lies exactly
  float neighbors;         ///< median number within the support's radius, the point itself included
  float few_neighbors;     ///< share of them with fewer than five others there: too few for a frame
  float no_frame;          ///< share of them without a frame, for whatever reason
  float frame_confidence;  ///< median of confidence() of the others

  std::size_t off_surface;  ///< key points without a point within a quarter of the radius, or twice the spacing
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The lower one of the two in the middle; 0 of none.
[[nodiscard]] inline float median(std::vector<float>& values) noexcept {
  if (values.empty()) return 0.0f;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

[[nodiscard]] inline float share(std::size_t part, std::size_t whole) noexcept {
  return whole == 0 ? 0.0f : static_cast<float>(part) / static_cast<float>(whole);
}

[[nodiscard]] inline bool is_at_origin(const Point& p) noexcept { return p.x == 0.0f && p.y == 0.0f && p.z == 0.0f; }

/// The first half: everything that one look at each point tells.
inline void look_at_all(const CloudView& cloud, Diagnosis& out) noexcept {
  std::size_t valid = 0;
  std::size_t at_origin = 0;
  std::size_t with_normal = 0;
  std::size_t of_other_length = 0;
  bool is_first = true;
  for_each_valid(cloud, [&](std::size_t i, const Point& p) {
    ++valid;
    if (has_normals(cloud)) {
      const SurfaceNormal n = normal(cloud, i);
      const float squared = squared_distance({n.x, n.y, n.z}, {});
      const bool is_there = math::is_finite(squared) && squared > 0.0f;
      if (is_there) ++with_normal;
      if (is_there && !(squared > 0.98f && squared < 1.02f)) ++of_other_length;
    }
    if (is_at_origin(p)) {
      ++at_origin;
      return;
    }
    out.low = is_first ? p : Point{std::min(out.low.x, p.x), std::min(out.low.y, p.y), std::min(out.low.z, p.z)};
    out.high = is_first ? p : Point{std::max(out.high.x, p.x), std::max(out.high.y, p.y), std::max(out.high.z, p.z)};
    is_first = false;
  });
  out.not_finite = share(cloud.size - valid, cloud.size);
  out.at_origin = share(at_origin, cloud.size);
  out.no_normal = 1.0f - share(with_normal, valid);
  out.other_length = share(of_other_length, with_normal);
  out.one_color = has_colors(cloud);
  for (std::size_t i = 1; i < cloud.size && out.one_color; ++i) {
    const Rgb a = color(cloud, 0);
    const Rgb b = color(cloud, i);
    out.one_color = a.r == b.r && a.g == b.g && a.b == b.b;
  }
}

/// The second half: the neighborhoods of some points.
template <class Search>
class Examination {
 public:
  Examination(const CloudView& cloud, const Search& neighbors, const Support& support) noexcept
      : cloud_(cloud), search_(neighbors), support_(support) {}

  void look_at_some(Diagnosis& out) {
    std::size_t looked_at = 0;  // neighbors
    const std::size_t tries = std::min(cloud_.size, 2 * most_samples);
    for (std::size_t k = 0; k < tries && out.sampled < most_samples; ++k) {
      if (out.sampled >= least_samples && looked_at > most_neighbors) break;
      const Point p = point(cloud_, tries == cloud_.size ? k : scattered(k));
      if (!is_finite(p) || is_at_origin(p)) continue;
      Neighborhood n;
      const Status status = workspace_.gather(search_, p, gather_radius(support_), n);
      if (status == Status::ok && (n.found == 0 || !is_of(cloud_, p, n))) out.status = Status::other_cloud;
      if (out.status != Status::ok) return;
      looked_at += n.size;
      ++out.sampled;
      steps_.push_back(float_spacing(p));
      if (status == Status::ok) look_at(p, n);
    }
    out.float_step = median(steps_);
    out.spacing = median(spacings_);
    out.doubles = share(doubles_, out.sampled);
    out.neighbors = median(counts_);
    out.few_neighbors = share(few_, out.sampled);
    out.no_frame = 1.0f - share(confidences_.size(), out.sampled);
    out.frame_confidence = median(confidences_);
  }

  [[nodiscard]] bool has_point_within(const Point& p, Radius radius) {
    Neighborhood n;
    return is_finite(p) && (workspace_.gather(search_, p, radius, n) != Status::ok || n.found > 0);
  }

 private:
  static constexpr std::size_t most_samples = 1000;
  static constexpr std::size_t least_samples = 32;
  static constexpr std::size_t most_neighbors = 10000000;

  /// Points all over the cloud, whatever their order: multiples of the golden ratio.
  [[nodiscard]] std::size_t scattered(std::size_t k) const noexcept {
    const auto turn = static_cast<std::uint32_t>(k) * 2654435769u;
    return static_cast<std::size_t>(std::uint64_t{turn} * cloud_.size >> 32);
  }

  void look_at(const Point& p, Neighborhood& n) {
    const std::uint32_t within = count_within(n, support_.radius);
    counts_.push_back(static_cast<float>(within));
    if (within <= 5) ++few_;
    Frame frame;
    FrameConfidence sure;
    if (estimate_frame(n, support_.frame_radius, frame, sure, support_.viewpoint) == Status::ok) {
      confidences_.push_back(confidence(sure));
    }
    if (std::count(n.d2, n.d2 + n.size, 0.0f) > 1) ++doubles_;
    look_for_nearest(p, n);
  }

  /// In spheres that grow, at few points, where the support holds none elsewhere.
  void look_for_nearest(const Point& p, Neighborhood& n) {
    Radius radius = gather_radius(support_);
    for (int doubled = 0; doubled <= 16; ++doubled) {
      float nearest = radius.squared;
      for (std::uint32_t i = 0; i < n.size; ++i) {
        if (n.d2[i] > 0.0f) nearest = std::min(nearest, n.d2[i]);
      }
      if (nearest < radius.squared) return spacings_.push_back(simd::sqrt(nearest));
      radius = Radius(2.0f * radius.value);
      if (wide_searches_ >= least_samples * 16 || validate(radius) != Status::ok) return;
      ++wide_searches_;
      if (workspace_.gather(search_, p, radius, n) != Status::ok) return;
    }
  }

  const CloudView cloud_;
  const Search& search_;
  const Support support_;
  GrowingWorkspace workspace_;
  std::vector<float> steps_;
  std::vector<float> spacings_;
  std::vector<float> counts_;
  std::vector<float> confidences_;
  std::size_t doubles_ = 0;
  std::size_t few_ = 0;
  std::size_t wide_searches_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Looks at what is about to be described: is the search one over this cloud, has the radius the cloud's unit, can
/// float hold its coordinates, are there points that are none? Numbers for a program to check once, when a sensor or a
/// data set is new; the demo's option `--diagnose` says in sentences what they mean.
///
/// `keypoints`  what will be described, as for extract(); an index outside of the cloud counts as off the surface
///
/// Looks once at each point, at the neighborhoods of 1000 points (fewer, but 32 at least, once ten million neighbors
/// were seen), always the same ones, and near each key point. Allocates 20 KB, and 30 bytes for each neighbor of the
/// largest neighborhood; may throw std::bad_alloc. Reentrant; starts no threads.
template <class Search, class Key = std::uint32_t>
[[nodiscard]] Diagnosis diagnose(const CloudView& cloud, const Search& search, const Support& support,
                                 const std::vector<Key>& keypoints = {}) {
  Diagnosis out{};
  out.status = detail::validate_search(cloud, search);
  if (out.status == Status::ok) out.status = validate(support.radius);
  if (out.status == Status::ok) out.status = validate(support.frame_radius);
  if (out.status == Status::ok) out.status = validate(support.viewpoint);
  if (out.status != Status::ok) return out;
  detail::look_at_all(cloud, out);
  detail::Examination<Search> examination(cloud, search, support);
  examination.look_at_some(out);
  if (out.status != Status::ok) return out;
  const Radius near = std::max(0.25f * support.radius.value, 2.0f * out.spacing);
  for (std::size_t row = 0; row < keypoints.size(); ++row) {
    KeyPoint key;
    const bool exists = detail::keypoint_at(cloud, keypoints, row, key);
    if (!exists || !examination.has_point_within(key.position, near)) ++out.off_surface;
  }
  return out;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_DIAGNOSE_HPP

// shortshot/batch/frame_agreement.hpp: how well local frames repeat, from one cloud alone. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_FRAME_AGREEMENT_HPP
#define SHORTSHOT_BATCH_FRAME_AGREEMENT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The even or the odd points of a cloud: x y z.
[[nodiscard]] inline std::vector<float> half_of(const CloudView& cloud, std::size_t first) {
  std::vector<float> xyz;
  xyz.reserve(3 * (cloud.size / 2 + 1));
  for (std::size_t i = first; i < cloud.size; i += 2) {
    const Point p = point(cloud, i);
    for (const float v : {p.x, p.y, p.z}) xyz.push_back(v);
  }
  return xyz;
}

/// Axes less than 20 degrees apart.
[[nodiscard]] inline bool agree(const Frame& a, const Frame& b) noexcept {
  const auto cosine = [](const float(&u)[3], const float(&v)[3]) {
    return (unfused(u[0] * v[0]) + unfused(u[1] * v[1])) + unfused(u[2] * v[2]);
  };
  return cosine(a.x, b.x) > 0.94f && cosine(a.y, b.y) > 0.94f && cosine(a.z, b.z) > 0.94f;
}

/// Frames from one half of a cloud.
class HalfCloudFrames {  // stays where it is: the search views its coordinates
 public:
  HalfCloudFrames(const CloudView& cloud, std::size_t first, const Support& support)
      : xyz_(half_of(cloud, first)),
        search_(view_xyz(xyz_.data(), xyz_.size() / 3), support.radius.value),
        support_(support) {}

  [[nodiscard]] Status estimate(const Point& at, Frame& frame) {
    Neighborhood n;
    const Status status = workspace_.gather(search_, at, support_.frame_radius, n);
    return status == Status::ok ? estimate_frame(n, support_.frame_radius, frame, support_.viewpoint) : status;
  }

 private:
  std::vector<float> xyz_;
  GridSearch search_;
  Support support_;
  GrowingWorkspace workspace_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Share of the key points whose local frames from the even and from the odd points of the cloud have axes less than 20
/// degrees apart; negative if there are none to compare. Of up to 200 key points, one in a voxel of `leaf` meters.
/// Allocates both halves and a GridSearch over each.
[[nodiscard]] inline float frame_agreement(const CloudView& cloud, float radius, float leaf,
                                           const Viewpoint& viewpoint = {}) {
  constexpr std::size_t most = 200;
  std::vector<KeyPoint> keypoints;
  Support support = radius;
  support.viewpoint = viewpoint;
  if (validate(support.radius) != Status::ok || sample_centroids(cloud, leaf, keypoints) != Status::ok) return -1.0f;
  detail::HalfCloudFrames even(cloud, 0, support);
  detail::HalfCloudFrames odd(cloud, 1, support);
  std::size_t both = 0;
  std::size_t alike = 0;
  const std::size_t count = std::min(most, keypoints.size());
  for (std::size_t k = 0; k < count; ++k) {
    const Point at = keypoints[k * keypoints.size() / count].position;
    Frame a;
    Frame b;
    if (even.estimate(at, a) != Status::ok || odd.estimate(at, b) != Status::ok) continue;
    ++both;
    alike += detail::agree(a, b) ? 1u : 0u;
  }
  return both == 0 ? -1.0f : static_cast<float>(alike) / static_cast<float>(both);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_FRAME_AGREEMENT_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What suggest() says; lengths are in the cloud's unit. Trivially copyable.
struct Suggestion {
  Status status;          ///< ok; or why there is nothing to suggest, and all else is 0
  float radius;           ///< of the support
  float leaf;             ///< of the key points: half the radius
  float normal_radius;    ///< for SHOT and CSHOT: a quarter of it
  float spacing;          ///< from a point to the nearest one elsewhere, median
  float frame_agreement;  ///< at this radius, see frame_agreement(); negative if there are no frames to compare
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Two digits: nobody wants to type more. 0 for what is no positive number.
[[nodiscard]] inline float in_two_digits(float length) noexcept {
  if (!(length > 0.0f) || !math::is_finite(length)) return 0.0f;
  float tens = 1.0f;  // 10 to 99 of these
  float tenths = 1.0f;
  while (length >= 99.5f * tens) tens *= 10.0f;
  while (length * tenths < 9.95f && tenths < 1e37f) tenths *= 10.0f;
  return __builtin_roundf(length / tens * tenths) / tenths * tens;
}

[[nodiscard]] inline float largest_extent(const Diagnosis& d) noexcept {
  return std::max({d.high.x - d.low.x, d.high.y - d.low.y, d.high.z - d.low.z});
}

/// The median distance from a point to the nearest one, whatever the cloud's unit: as diagnose() sees it. 0 if it sees
/// none.
[[nodiscard]] inline Status find_spacing(const CloudView& cloud, float& extent, float& spacing) {
  extent = spacing = 0.0f;
  Diagnosis d{};
  const Status usable = validate(cloud);
  if (usable != Status::ok) return usable;
  look_at_all(cloud, d);
  if (d.not_finite == 1.0f) return Status::empty_cloud;
  extent = largest_extent(d);
  if (extent > 0.0f && extent < 64.0f * std::max(float_spacing(d.low), float_spacing(d.high))) {
    return Status::coarse_coordinates;
  }
  // Points of a surface that fills its box lie that far apart; where they are sparser the search widens by itself.
  const float guess = extent / simd::sqrt(static_cast<float>(cloud.size));
  if (validate(Radius(guess)) != Status::ok) return Status::bad_radius;
  const GridSearch search(cloud, 2.0f * guess);
  if (search.status() != Status::ok) return search.status();
  Examination<GridSearch>(cloud, search, 2.0f * guess).look_at_some(d);
  spacing = d.spacing;
  if (d.status != Status::ok) return d.status;
  if (!(spacing > 0.0f)) return Status::bad_radius;
  return spacing < 8.0f * d.float_step ? Status::coarse_coordinates : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Lengths for a cloud of which nothing is known, not even its unit. Another cloud gets others: two clouds that are to
/// be compared, and all views that a recognizer sees, must be described with the same ones.
///
/// The radius is 20 spacings, which hold a thousand points of a surface, as 4 cm do of what a depth camera sees a meter
/// away; at most a third of the cloud's largest extent, beyond which all key points see the same, but 5 spacings at
/// least. Where fewer than half of the frames repeat (frame_agreement()) it grows in two steps up to twice as much, as
/// long as that helps. All in two digits.
///
/// `viewpoint`  what the frames will be turned to
///
/// Statuses: empty_cloud, bad_view, coarse_coordinates and what a GridSearch has; bad_radius where points have no
/// distance: there are fewer than two places. Takes some milliseconds for each 100,000 points. Allocates a GridSearch
/// and a copy of the cloud's coordinates. Reentrant; the same numbers on every machine.
[[nodiscard]] inline Suggestion suggest(const CloudView& cloud, const Viewpoint& viewpoint = {}) {
  Suggestion out{};
  float extent = 0.0f;
  out.status = validate(viewpoint);
  if (out.status == Status::ok) out.status = detail::find_spacing(cloud, extent, out.spacing);
  if (out.status != Status::ok) return {out.status, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  constexpr float enough = 0.5f;
  for (const float times : {1.0f, 1.4f, 2.0f}) {
    const float least = 5.0f * out.spacing;
    const float radius = detail::in_two_digits(std::max(least, std::min(20.0f * times * out.spacing, extent / 3.0f)));
    const float agreement = frame_agreement(cloud, radius, 0.5f * radius, viewpoint);
    if (times == 1.0f || agreement > out.frame_agreement) {
      out.radius = radius;
      out.frame_agreement = agreement;
    }
    if (agreement >= enough) break;
  }
  out.leaf = detail::in_two_digits(0.5f * out.radius);
  out.normal_radius = detail::in_two_digits(0.25f * out.radius);
  return out;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_SUGGEST_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// How describe_cloud() describes. Defaults for objects on a table, seen by a depth camera at one meter: they are not
/// taken from the cloud, so that two clouds are described alike. A radius of 0 asks for what suggest() says of this
/// one.
struct CloudOptions {
  float radius = 0.04f;       ///< of the support, in the cloud's unit: meters; 0: suggested
  float leaf = 0.0f;          ///< one key point in each occupied voxel of that size, its points' centroid; 0: half the
                              ///< radius
  float frame_radius = 0.0f;  ///< of the local reference frame; 0: the support's
  float best_frames = 1.0f;   ///< above 0, at most 1: share of the key points that is kept, those with surest frames
  Viewpoint viewpoint;        ///< turns the frames' z; Viewpoint::towards({0, 0, 0}): a camera at the origin
  unsigned threads = 1;       ///< that share the work
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What the options say of supports of this radius.
[[nodiscard]] inline Support support_of(const CloudOptions& options, float radius) noexcept {
  Support support = radius;
  if (options.frame_radius != 0.0f) support.frame_radius = Radius(options.frame_radius);
  support.viewpoint = options.viewpoint;
  return support;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describes a whole cloud: key points by sample_centroids(), neighbors by a GridSearch, rows by an Extractor. `out`
/// has the key points, too.
///
/// Statuses: empty_cloud, bad_view, bad_leaf, bad_radius, bad_viewpoint, missing_colors, missing_normals (for SHOT and
/// CSHOT: estimate_normals() first), missing_intensities, coarse_coordinates, bad_option (best_frames); `out` is empty,
/// or all its rows have that status. Each row has a status of its own. Allocates what those three do, anew in every
/// call; for cloud after cloud take them one by one.
template <class D>
[[nodiscard]] Status describe_cloud(const CloudView& cloud, const CloudOptions& options, Features<D>& out) {
  detail::clear_rows(out, 0, Status::ok);
  float radius = options.radius;
  if (radius == 0.0f) {
    const Suggestion suggested = suggest(cloud, options.viewpoint);
    if (suggested.status != Status::ok) return suggested.status;
    radius = suggested.radius;
  }
  const Support support = detail::support_of(options, radius);
  std::vector<KeyPoint> keypoints;
  Status status = validate(support.radius);
  const float leaf = options.leaf == 0.0f ? 0.5f * radius : options.leaf;
  if (status == Status::ok) status = sample_centroids(cloud, leaf, keypoints);
  if (status != Status::ok) return status;
  const GridSearch search(cloud, radius);
  status = Extractor<D>().extract(cloud, search, keypoints, support, out, options.threads);
  return status == Status::ok ? keep_best_frames(out, options.best_frames) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_DESCRIBE_CLOUD_HPP

// shortshot/batch/copy_point_cloud2.hpp: copies of sensor_msgs/PointCloud2-shaped messages that cannot be viewed as
// they are: padded rows, the other byte order, doubles and integers. Hosted only: allocates.
#ifndef SHORTSHOT_BATCH_COPY_POINT_CLOUD2_HPP
#define SHORTSHOT_BATCH_COPY_POINT_CLOUD2_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A cloud with memory of its own, one after the other: what copy_point_cloud2() copies into. Empty: there is none.
struct CloudCopy {
  std::vector<float> xyz;              ///< 3 a point
  std::vector<std::uint8_t> rgb;       ///< 3 a point
  std::vector<SurfaceNormal> normals;  ///< 1 a point
  std::vector<float> intensities;      ///< 1 a point
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Number>
[[nodiscard]] Number number_of(const unsigned char (&bytes)[8]) noexcept {
  Number number{};
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// The float nearest to a FLOAT64 of these bits, the even one of two; NaN for what is no finite float. In integers: a
/// program that traps floating-point exceptions sees none.
[[nodiscard]] inline float narrowed(std::uint64_t bits) noexcept {
  constexpr std::uint32_t smallest = 1023 - 126;  // exponent of floats with all their digits
  constexpr std::uint32_t largest = 1023 + 127;
  const auto sign = static_cast<std::uint32_t>(bits >> 63 << 31);
  const auto exponent = static_cast<std::uint32_t>(bits >> 52 & 0x7FFu);
  if (exponent > largest) return std::numeric_limits<float>::quiet_NaN();
  const std::uint32_t shift = 29 + (exponent < smallest ? smallest - exponent : 0);
  if (shift > 54) return math::float_of(sign);  // less than half of the smallest float
  const std::uint64_t digits = (bits & 0xFFFFFFFFFFFFFu) | std::uint64_t{1} << 52;
  const std::uint64_t half = std::uint64_t{1} << (shift - 1);
  const std::uint64_t rest = digits & (2 * half - 1);
  auto rounded = static_cast<std::uint32_t>(digits >> shift);
  if (rest > half || (rest == half && (rounded & 1u) != 0)) ++rounded;
  const std::uint32_t magnitude = rounded + (exponent < smallest ? 0 : (exponent - smallest) << 23);
  return magnitude < 0x7F800000u ? math::float_of(sign | magnitude) : std::numeric_limits<float>::quiet_NaN();
}

/// The number at a place, of a type that there is.
[[nodiscard]] inline float field_at(const unsigned char* at, int type, bool is_swapped) noexcept {
  const auto size = static_cast<std::size_t>(size_of_type(static_cast<std::uint64_t>(type)));
  unsigned char bytes[8] = {};
  for (std::size_t k = 0; k < size; ++k) bytes[k] = at[is_swapped ? size - 1 - k : k];
  switch (type) {
    case field_int8: return static_cast<float>(number_of<std::int8_t>(bytes));
    case field_uint8: return static_cast<float>(number_of<std::uint8_t>(bytes));
    case field_int16: return static_cast<float>(number_of<std::int16_t>(bytes));
    case field_uint16: return static_cast<float>(number_of<std::uint16_t>(bytes));
    case field_int32: return static_cast<float>(number_of<std::int32_t>(bytes));
    case field_uint32: return static_cast<float>(number_of<std::uint32_t>(bytes));
    case field_float64: return narrowed(number_of<std::uint64_t>(bytes));
    default: return number_of<float>(bytes);
  }
}

/// Can a copy be made of it?
[[nodiscard]] inline bool is_copied(const MessageChannel& channel) noexcept {
  return channel.status == Status::ok || channel.status == Status::needs_conversion;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Copies a message as view_point_cloud2() takes it into `storage`, and makes a view of that, organized as the message;
/// the message may go then. Also reads padded rows, either byte order, coordinates and intensities of any type, and
/// normals of FLOAT64. Numbers are rounded to the nearest float (move coordinates of a map's size to their middle
/// before); what is not finite or too large is NaN.
///
/// Statuses: unread_channel: the message has colors, normals or intensities that are not read: the view has the rest,
/// and point_cloud2_channels() says which. All others leave an empty view and empty storage: those of
/// view_point_cloud2() but for the ones that it leaves to this one, and out_of_memory (more points than a vector has
/// room for). Allocates the storage (3 to 31 bytes a point, of which 12 for coordinates), and nothing if it was as
/// large before. May throw std::bad_alloc; the view is empty then. Reentrant.
template <class Message>
[[nodiscard]] Status copy_point_cloud2(const Message& message, CloudCopy& storage, CloudView& view) {
  view = CloudView{};
  storage.xyz.clear();
  storage.rgb.clear();
  storage.normals.clear();
  storage.intensities.clear();
  const detail::MessageParts parts = detail::parts_of(message);
  if (parts.status != Status::ok) return parts.status;
  const detail::MessageRows& rows = parts.rows;
  const std::size_t count = rows.width * rows.height;
  if (count > storage.xyz.max_size() / 3) return Status::out_of_memory;

  const auto* data = reinterpret_cast<const unsigned char*>(message.data.data());
  const auto for_each_point = [&](auto&& take) {
    std::size_t i = 0;
    for (std::size_t row = 0; row < rows.height; ++row) {
      const unsigned char* const first = data + row * rows.row_bytes;
      for (std::size_t column = 0; column < rows.width; ++column) take(i++, first + column * rows.step);
    }
  };
  const auto number = [&](const unsigned char* point, const detail::MessageChannel& channel, std::size_t k) {
    return detail::field_at(point + channel.offset[k], channel.type[k], parts.has_other_order);
  };
  storage.xyz.resize(3 * count);
  for_each_point([&](std::size_t i, const unsigned char* point) {
    for (std::size_t k = 0; k < 3; ++k) storage.xyz[3 * i + k] = number(point, parts.points, k);
  });
  if (detail::is_copied(parts.colors)) {
    storage.rgb.resize(3 * count);
    for_each_point([&](std::size_t i, const unsigned char* point) {
      for (std::size_t k = 0; k < 3; ++k) storage.rgb[3 * i + k] = point[parts.colors.offset[k]];
    });
  }
  if (detail::is_copied(parts.normals)) {
    storage.normals.resize(count);
    for_each_point([&](std::size_t i, const unsigned char* point) {
      const detail::MessageChannel& from = parts.normals;
      storage.normals[i] = {number(point, from, 0), number(point, from, 1), number(point, from, 2)};
    });
  }
  if (detail::is_copied(parts.intensities)) {
    storage.intensities.resize(count);
    for_each_point([&](std::size_t i, const unsigned char* point) {
      storage.intensities[i] = number(point, parts.intensities, 0);
    });
  }
  const auto memory_of = [](const auto& vector) { return vector.empty() ? nullptr : vector.data(); };
  view = view_xyz_rgb(storage.xyz.data(), memory_of(storage.rgb), count);
  view = with_intensities(with_normals(view, memory_of(storage.normals)), memory_of(storage.intensities));
  view = organized(view, rows.width, rows.height);
  bool all_read = true;
  for (const detail::MessageChannel* channel : {&parts.colors, &parts.normals, &parts.intensities}) {
    all_read = all_read && channel->status != Status::unread_channel;
  }
  return all_read ? Status::ok : Status::unread_channel;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_COPY_POINT_CLOUD2_HPP

// shortshot/batch/to_pcl.hpp: descriptors as PCL's clouds of signatures, without including PCL. Hosted only.
//
// The other way needs nothing: of a pcl::PointCloud<pcl::SHOT352> `cloud`, the floats of row i are cloud[i].descriptor,
// in the layout of PclShot352, for binarize() and for comparing with rows of Features.
#ifndef SHORTSHOT_BATCH_TO_PCL_HPP
#define SHORTSHOT_BATCH_TO_PCL_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Copies features into a cloud shaped as pcl::PointCloud<pcl::SHOT352> or <pcl::SHOT1344>: `points` of structs with
/// float descriptor[D::size] and rf[9], `width`, `height`, `is_dense`. One point per key point, in order; rf is the
/// frame's axes x, y and z.
///
/// A key point without descriptor is NaN in all its floats, as in PCL, and the cloud is not dense then. Allocates the
/// points; may throw what their resize() does.
template <class D, class PclCloud>
void to_pcl(const Features<D>& features, PclCloud& cloud) {
  using Signature = std::remove_reference_t<decltype(cloud.points[0])>;
  static_assert(sizeof(Signature::descriptor) == D::size_bytes && sizeof(Signature::rf) == sizeof(Frame),
                "to_pcl() supports clouds of structs with float descriptor[D::size] and rf[9]");
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  cloud.points.resize(features.size());
  cloud.width = static_cast<std::uint32_t>(features.size());
  cloud.height = 1;
  cloud.is_dense = true;
  for (std::size_t row = 0; row < features.size(); ++row) {
    Signature& out = cloud.points[row];
    if (features.status[row] == Status::ok) {
      std::copy_n(features[row], D::size, out.descriptor);
      const Frame& frame = features.frames[row];
      std::copy_n(frame.z, 3, std::copy_n(frame.y, 3, std::copy_n(frame.x, 3, out.rf)));
    } else {
      std::fill_n(out.descriptor, D::size, not_a_number);
      std::fill_n(out.rf, 9, not_a_number);
      cloud.is_dense = false;
    }
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_BATCH_TO_PCL_HPP

// shortshot/store/features_file.hpp: what extract() gives as bytes, or in a file. Hosted only: allocates.
//
// Between what byte_stream.hpp puts around it ("SSHOTFEA", the version and the checksum), n rows of s values:
//
//     layout (length, characters), s, n
//     values: n * s floats, row by row; or what they are stored as (stored_features.hpp), which the layout says then
//     statuses: n bytes
//     key points, for each: 3 floats position, float intensity, 3 bytes red, green, blue, 1 byte: 1 if there is a color
//       plus 2 if there is an intensity
//     frames: n * 9 floats, the x axis first
//     frames' confidences: n * 3 floats (gap, margin of x, margin of z)
//     neighbors: n * 4 bytes
//
// Numbers of statuses are part of the format: Status only ever grows at its end.
#ifndef SHORTSHOT_STORE_FEATURES_FILE_HPP
#define SHORTSHOT_STORE_FEATURES_FILE_HPP

#include <string_view>

// shortshot/store/byte_stream.hpp: what all of the library's files have in common. Hosted only: allocates.
//
// All numbers are little-endian, floats by their bits, counts and lengths 8 bytes:
//
//     8 characters that say what it is, 4 bytes format version
//     what is saved
//     8 bytes checksum of all bytes before it
#ifndef SHORTSHOT_STORE_BYTE_STREAM_HPP
#define SHORTSHOT_STORE_BYTE_STREAM_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a file is: its first characters, and the version of the format.
struct FileKind {
  std::string_view magic;
  std::uint32_t version;

  [[nodiscard]] std::size_t header_bytes() const noexcept { return magic.size() + sizeof version; }
};

/// Writes a file into bytes. It is complete after finish().
class ByteWriter {
 public:
  /// In place of whatever was there; `expected_bytes` saves allocations.
  ByteWriter(std::vector<std::uint8_t>& bytes, const FileKind& kind, std::size_t expected_bytes) : bytes_(bytes) {
    bytes.clear();
    bytes.reserve(expected_bytes);
    characters(kind.magic);
    number(kind.version);
  }
  void finish() { number(checksum(bytes_.data(), bytes_.size())); }

  template <class Unsigned>
  void number(Unsigned value) {
    append(value, sizeof value);
  }
  void count(std::size_t value) { append(value, 8); }
  void real(float value) { append(math::bits_of(value), sizeof value); }
  [[gnu::noinline]] void reals(const float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) real(values[i]);
  }
  void point(const Point& p) {
    const float values[3] = {p.x, p.y, p.z};
    reals(values, 3);
  }
  /// Zeros up to a place.
  void pad(std::size_t place) {
    while (bytes_.size() < place) number(std::uint8_t{0});
  }
  void name(std::string_view text) {
    count(text.size());
    characters(text);
  }

 private:
  void characters(std::string_view text) {
    for (const char c : text) append(static_cast<std::uint8_t>(c), 1);
  }
  [[gnu::noinline]] void append(std::uint64_t value, std::size_t bytes) {
    for (std::size_t k = 0; k < bytes; ++k) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * k) & 0xFFu));
  }

  std::vector<std::uint8_t>& bytes_;
};

/// Reads what may be damaged: from the first thing on that cannot be, all is zero and good() false.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* bytes, std::size_t size) noexcept : at_(bytes), left_(size) {}

  [[nodiscard]] bool good() const noexcept { return good_; }
  [[nodiscard]] std::size_t left() const noexcept { return left_; }
  void require(bool condition) noexcept { good_ = good_ && condition; }

  template <class Unsigned>
  [[nodiscard]] Unsigned number() noexcept {
    return static_cast<Unsigned>(number_of(sizeof(Unsigned)));
  }
  /// Any bits, those of NaN too.
  [[nodiscard]] float any_real() noexcept { return math::float_of(number<std::uint32_t>()); }
  [[nodiscard]] float real() noexcept {
    const float value = any_real();
    require(math::is_finite(value));
    return good_ ? value : 0.0f;
  }
  [[gnu::noinline]] void reals(float* values, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) values[i] = real();
  }
  [[nodiscard]] Point point() noexcept {
    float values[3];
    reals(values, 3);
    return {values[0], values[1], values[2]};
  }
  /// How many there are of something that takes `least` bytes or more each: no more than the bytes that are left hold.
  [[nodiscard]] std::size_t count(std::size_t least) noexcept {
    const std::uint64_t value = number_of(8);
    require(value <= left_ / least);
    return good_ ? static_cast<std::size_t>(value) : 0;
  }
  /// One of `count` things.
  [[nodiscard]] std::uint32_t index(std::size_t count) noexcept {
    const auto value = number<std::uint32_t>();
    require(value < count);
    return good_ ? value : 0;
  }
  [[nodiscard]] std::string name() {
    const std::size_t length = count(1);
    const std::uint8_t* const characters = take(length);
    return {characters, characters + length};
  }

 private:
  [[nodiscard, gnu::noinline]] std::uint64_t number_of(std::size_t size) noexcept {
    const std::uint8_t* const bytes = take(size);
    std::uint64_t value = 0;
    for (std::size_t k = size; good_ && k-- > 0;) value = value << 8 | bytes[k];
    return value;
  }
  [[nodiscard]] const std::uint8_t* take(std::size_t size) noexcept {
    require(size <= left_);
    if (!good_) return at_;
    left_ -= size;
    at_ += size;
    return at_ - size;
  }

  const std::uint8_t* at_;
  std::size_t left_;
  bool good_ = true;
};

/// Leaves `body` at what is saved, if the bytes around it are right; not_a_model, other_version or damaged_model (the
/// bytes end early, or the checksum is wrong) if not, the first that applies.
[[nodiscard]] inline Status open_checked(const std::uint8_t* bytes, std::size_t size, const FileKind& kind,
                                         ByteReader& body) noexcept {
  const std::size_t magic_bytes = kind.magic.size();
  if (bytes == nullptr || size < magic_bytes) return Status::not_a_model;
  for (std::size_t i = 0; i < magic_bytes; ++i) {
    if (bytes[i] != static_cast<std::uint8_t>(kind.magic[i])) return Status::not_a_model;
  }
  ByteReader header(bytes + magic_bytes, size - magic_bytes);
  const auto version = header.number<std::uint32_t>();
  if (header.good() && version != kind.version) return Status::other_version;
  if (header.left() < checksum_bytes) return Status::damaged_model;
  const std::size_t checked_bytes = size - checksum_bytes;
  ByteReader sum(bytes + checked_bytes, checksum_bytes);
  if (sum.number<std::uint64_t>() != checksum(bytes, checked_bytes)) return Status::damaged_model;
  body = ByteReader(bytes + kind.header_bytes(), checked_bytes - kind.header_bytes());
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_STORE_BYTE_STREAM_HPP

// shortshot/store/replace_file.hpp: files as a whole: all bytes of one, or new ones in its place. Hosted only.
//
// A file is never written to where it lies: a disk that is full, or a program that ends, would leave half of the new
// file and nothing of the old one. What is new is written beside it, and then takes its name, which is one step.
//
// By the C library: `<fstream>` takes more time to compile than all that would be used of it.
#ifndef SHORTSHOT_STORE_REPLACE_FILE_HPP
#define SHORTSHOT_STORE_REPLACE_FILE_HPP

#include <cerrno>
#include <cstdio>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Makes a file that was not there before, of a name that nobody else has: "x" fails for one that is. Null, and no
/// name, if there can be none. What programs that ended in between have left is never touched.
[[nodiscard]] inline std::FILE* create_beside(const std::string& path, std::string& name) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    name = path;
    name += ".tmp-";
    name += static_cast<char>('0' + attempt / 10);
    name += static_cast<char>('0' + attempt % 10);
    std::FILE* const file = std::fopen(name.c_str(), "wbx");
    if (file != nullptr) return file;
    if (errno != EEXIST) break;
  }
  name.clear();
  return nullptr;
}

/// Can a file take that name? Not where a folder or a device is: a program with all rights could replace /dev/null.
/// Whoever could read the old file can read the new one.
[[nodiscard]] inline bool adopt_rights(const std::string& path, std::FILE* file) noexcept {
#if defined(__unix__) || defined(__APPLE__)
  struct stat old;
  if (::stat(path.c_str(), &old) != 0) return true;  // there is none
  return S_ISREG(old.st_mode) && ::fchmod(::fileno(file), old.st_mode & 07777) == 0;
#else
  static_cast<void>(path);
  static_cast<void>(file);
  return true;
#endif
}

/// Only when the disk has it: a full one may say so as late as that.
[[nodiscard]] inline bool flush_to_disk(std::FILE* file) noexcept {
  if (std::fflush(file) != 0) return false;
#if defined(__unix__) || defined(__APPLE__)
  return ::fsync(::fileno(file)) == 0 || errno == EINVAL;  // EINVAL: a file system without
#else
  return true;
#endif
}

/// Puts a file that has `bytes` in place of what is at `path`, or where nothing is. ok or no_file; then what was there
/// still is, as it was, and nothing else is left. A symbolic link is replaced, not the file that it leads to.
[[nodiscard]] inline Status replace_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::string name;
  std::FILE* const file = create_beside(path, name);
  if (file == nullptr) return Status::no_file;
  bool is_written = adopt_rights(path, file) && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() &&
                    flush_to_disk(file);
  is_written = std::fclose(file) == 0 && is_written;
  if (is_written && std::rename(name.c_str(), path.c_str()) == 0) return Status::ok;
#if defined(_WIN32)  // where a name that is in use cannot be taken over
  if (is_written && std::remove(path.c_str()) == 0 && std::rename(name.c_str(), path.c_str()) == 0) return Status::ok;
#endif
  static_cast<void>(std::remove(name.c_str()));
  return Status::no_file;
}

/// All bytes of a file. ok or no_file; `bytes` may be the first ones then.
[[nodiscard]] inline Status read_file(const std::string& path, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return Status::no_file;
  struct Closer {
    std::FILE* file;
    ~Closer() { static_cast<void>(std::fclose(file)); }
  } const closer{file};  // memory may be short
  std::uint8_t block[4096];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file)) {
    bytes.insert(bytes.end(), block, block + count);
  }
  return std::ferror(file) == 0 ? Status::ok : Status::no_file;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_STORE_REPLACE_FILE_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr FileKind features_file{"SSHOTFEA", 1};

/// Values of a row may be floats, halves or bytes.
[[nodiscard]] inline bool is_value(float value) noexcept { return math::is_finite(value); }
[[nodiscard]] inline bool is_value(std::uint16_t half) noexcept { return (half & 0x7C00u) != 0x7C00u; }
[[nodiscard]] inline bool is_value(std::uint8_t) noexcept { return true; }
inline void write_value(ByteWriter& to, float value) { to.real(value); }
inline void write_value(ByteWriter& to, std::uint16_t half) { to.number(half); }
inline void write_value(ByteWriter& to, std::uint8_t byte) { to.number(byte); }
inline void read_value(ByteReader& from, float& value) noexcept { value = from.any_real(); }
inline void read_value(ByteReader& from, std::uint16_t& half) noexcept { half = from.number<std::uint16_t>(); }
inline void read_value(ByteReader& from, std::uint8_t& byte) noexcept { byte = from.number<std::uint8_t>(); }

/// Of a row, without its values.
inline constexpr std::size_t feature_bytes = 1 + (3 + 1) * sizeof(float) + 4 + (9 + 3) * sizeof(float) + 4;

/// The vectors of a Features<D>, or of a const one: what follows is compiled once for all D, and, being templates, not
/// at all where no features are saved.
template <template <class> class MaybeConst, class Number>
struct FeatureColumns {
  using Value = Number;
  std::string_view layout;
  std::size_t row_size;
  MaybeConst<std::vector<Value>>& values;
  MaybeConst<std::vector<Status>>& status;
  MaybeConst<std::vector<KeyPoint>>& keypoints;
  MaybeConst<std::vector<Frame>>& frames;
  MaybeConst<std::vector<FrameConfidence>>& confidence;
  MaybeConst<std::vector<std::uint32_t>>& neighbors;
};
template <class T>
using Same = T;
template <class Value>
using ColumnsToSave = FeatureColumns<std::add_const_t, Value>;
template <class Value>
using ColumnsToLoad = FeatureColumns<Same, Value>;

template <class Columns, class SomeFeatures, class Values>
[[nodiscard]] Columns columns_of(SomeFeatures& features, Values& values, std::string_view layout,
                                 std::size_t row_size) noexcept {
  return {layout,
          row_size,
          values,
          features.status,
          features.keypoints,
          features.frames,
          features.frame_confidence,
          features.neighbors};
}

/// What load() would take: as many of everything, and no value that is not finite. A key point's position and intensity
/// may be anything: that is what its status says.
template <class Columns>
[[nodiscard]] bool can_be_saved(const Columns& from) noexcept {
  const std::size_t count = from.status.size();
  bool can = from.values.size() == count * from.row_size && from.keypoints.size() == count &&
             from.frames.size() == count && from.confidence.size() == count && from.neighbors.size() == count;
  for (const auto value : from.values) can = can && is_value(value);
  for (const Status status : from.status) can = can && static_cast<int>(status) < status_count;
  for (const Frame& frame : from.frames) {
    can = can && math::is_finite(frame.x) && math::is_finite(frame.y) && math::is_finite(frame.z);
  }
  for (const FrameConfidence& c : from.confidence) {
    can = can && is_finite(Point{c.eigenvalue_gap, c.x_margin, c.z_margin});
  }
  return can;
}

template <class Columns>
void write_columns(ByteWriter& to, const Columns& from) {
  to.name(from.layout);
  to.count(from.row_size);
  to.count(from.status.size());
  for (const auto value : from.values) write_value(to, value);
  for (const Status status : from.status) to.number(static_cast<std::uint8_t>(status));
  for (const KeyPoint& key : from.keypoints) {
    to.point(key.position);
    to.real(key.intensity);
    for (const std::uint8_t channel : {key.color.r, key.color.g, key.color.b}) to.number(channel);
    to.number(static_cast<std::uint8_t>((key.has_color ? 1 : 0) + (key.has_intensity ? 2 : 0)));
  }
  for (const Frame& frame : from.frames) {
    to.reals(frame.x, 3);
    to.reals(frame.y, 3);
    to.reals(frame.z, 3);
  }
  for (const FrameConfidence& c : from.confidence) to.point({c.eigenvalue_gap, c.x_margin, c.z_margin});
  for (const std::uint32_t count : from.neighbors) to.number(count);
}

[[nodiscard]] inline Status read_status(ByteReader& from) noexcept {
  const auto number = from.number<std::uint8_t>();
  from.require(number < status_count);
  return from.good() ? static_cast<Status>(number) : Status::ok;
}

[[nodiscard]] inline KeyPoint read_keypoint(ByteReader& from) noexcept {
  KeyPoint key{};
  for (float* value : {&key.position.x, &key.position.y, &key.position.z, &key.intensity}) *value = from.any_real();
  for (std::uint8_t* channel : {&key.color.r, &key.color.g, &key.color.b}) *channel = from.number<std::uint8_t>();
  const auto has = from.number<std::uint8_t>();
  from.require(has < 4);
  key.has_color = (has & 1u) != 0;
  key.has_intensity = (has & 2u) != 0;
  return key;
}

/// ok, other_descriptor or damaged_model; what is not ok may leave anything.
template <class Columns>
[[nodiscard]] Status read_columns(ByteReader& from, const Columns& to) {
  const std::string layout = from.name();
  const auto row_size = from.number<std::uint64_t>();
  if (!from.good()) return Status::damaged_model;
  if (layout != to.layout) return Status::other_descriptor;
  from.require(row_size == to.row_size);
  const std::size_t row_bytes = to.row_size * sizeof(typename Columns::Value) + feature_bytes;
  const std::size_t count = from.count(row_bytes);
  from.require(from.left() == count * row_bytes);
  if (!from.good()) return Status::damaged_model;
  to.values.resize(count * to.row_size);
  for (auto& value : to.values) {
    read_value(from, value);
    from.require(is_value(value));
  }
  to.status.reserve(count);
  while (to.status.size() < count) to.status.push_back(read_status(from));
  to.keypoints.reserve(count);
  while (to.keypoints.size() < count) to.keypoints.push_back(read_keypoint(from));
  to.frames.resize(count);
  for (Frame& frame : to.frames) {
    from.reals(frame.x, 3);
    from.reals(frame.y, 3);
    from.reals(frame.z, 3);
  }
  to.confidence.reserve(count);
  while (to.confidence.size() < count) {
    const Point c = from.point();
    to.confidence.push_back({c.x, c.y, c.z});
  }
  to.neighbors.reserve(count);
  while (to.neighbors.size() < count) to.neighbors.push_back(from.number<std::uint32_t>());
  return from.good() ? Status::ok : Status::damaged_model;
}

template <class Columns>
[[nodiscard]] Status save_columns(const Columns& from, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  if (!can_be_saved(from)) return Status::bad_rows;
  const std::size_t row_bytes = from.row_size * sizeof(typename Columns::Value) + feature_bytes;
  ByteWriter to(bytes, features_file, 4096 + from.status.size() * row_bytes);
  write_columns(to, from);
  to.finish();
  return Status::ok;
}
template <class Columns>
[[nodiscard]] Status load_columns(const std::uint8_t* bytes, std::size_t size, const Columns& to) {
  ByteReader body(nullptr, 0);
  const Status status = open_checked(bytes, size, features_file, body);
  return status == Status::ok ? read_columns(body, to) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// What extract() gave, as bytes: the same ones on every machine, 4 * D::size + 73 for a row and some hundred more.
///
/// Statuses: bad_rows (vectors that are not as long as each other, as extract() makes them; values, frames or
/// confidences that are not finite); `bytes` is empty then. Allocates the bytes. Reentrant.
template <class D>
[[nodiscard]] Status save(const Features<D>& features, std::vector<std::uint8_t>& bytes) {
  const std::string layout = layout_of<D>();
  using Columns = detail::ColumnsToSave<float>;
  return detail::save_columns(detail::columns_of<Columns>(features, features.values, layout, std::size_t{D::size}),
                              bytes);
}

/// The features that save() made these bytes of, bit for bit. What layout_of<D>() does not say (radii, how frames were
/// turned) is for the caller to know.
///
/// Statuses, the first one that applies: not_a_model (no features' bytes), other_version, damaged_model (the bytes end
/// early, or go on; the checksum is wrong), other_descriptor (of another layout than D's), damaged_model (the bytes are
/// not what save() writes). `out` has not changed then. Allocates about as much as there are bytes, whatever they say.
/// Reentrant.
template <class D>
[[nodiscard]] Status load(const std::uint8_t* bytes, std::size_t size, Features<D>& out) {
  const std::string layout = layout_of<D>();
  Features<D> loaded;
  using Columns = detail::ColumnsToLoad<float>;
  const Status status = detail::load_columns(
      bytes, size, detail::columns_of<Columns>(loaded, loaded.values, layout, std::size_t{D::size}));
  if (status == Status::ok) out = std::move(loaded);
  return status;
}

/// The same in a file. Also no_file: it cannot be opened, or not all of it written or read. If that happens to save()
/// (the disk is full), what was in the file still is: the new one is written beside it, as `path` + ".tmp-00" (or 01,
/// ...), and takes its name when it is complete. So there must be room for both, and its folder must be writable.
template <class D>
[[nodiscard]] Status save(const Features<D>& features, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  const Status status = save(features, bytes);
  return status == Status::ok ? detail::replace_file(path, bytes) : status;
}
template <class D>
[[nodiscard]] Status load(const std::string& path, Features<D>& out) {
  std::vector<std::uint8_t> bytes;
  const Status status = detail::read_file(path, bytes);
  return status == Status::ok ? load(bytes.data(), bytes.size(), out) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_STORE_FEATURES_FILE_HPP

// shortshot/store/stored_features.hpp: what extract() gives with its descriptors stored smaller, in memory and in
// files. Hosted only: allocates.
#ifndef SHORTSHOT_STORE_STORED_FEATURES_HPP
#define SHORTSHOT_STORE_STORED_FEATURES_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Features with descriptors in a storage: HalfDescriptor, CodedDescriptor (bytes, nibbles), BinaryDescriptor or
/// SumBits of a D. One row per key point, in the order of the features that they were made of.
template <class Stored>
struct StoredFeatures {
  std::vector<Stored> descriptors;                ///< of zeros where the status is not ok
  std::vector<Status> status;                     ///< the others as Features have them
  std::vector<KeyPoint> keypoints;                ///< what was described
  std::vector<Frame> frames;                      ///< of each
  std::vector<FrameConfidence> frame_confidence;  ///< how sure each of them is
  std::vector<std::uint32_t> neighbors;           ///< found within the larger radius

  /// Number of rows.
  [[nodiscard, gnu::always_inline]] std::size_t size() const noexcept { return status.size(); }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Descriptors as the numbers that they are made of.
template <class Stored>
inline constexpr std::size_t stored_values = sizeof(Stored) / sizeof(typename Storage<Stored>::Value);

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The layout of the descriptor and how it is stored, with all that belongs to it (bits, steps, groups): what two
/// files, or two rows, must have in common. Allocates.
template <class Stored>
[[nodiscard]] std::string storage_layout() {
  detail::StringText text;
  detail::add_storage_layout<Stored>(text);
  return text.string;
}

/// Features in a storage. Rows whose status is not ok are of zeros. ok or bad_rows (vectors that are not as long as
/// each other); `out` is empty then. Allocates `out`. Reentrant.
template <class D, class Stored>
[[nodiscard]] Status store(const Features<D>& features, StoredFeatures<Stored>& out) {
  static_assert(std::is_same<typename detail::Storage<Stored>::Descriptor, D>::value,
                "store() supports storages of the descriptor that the features are of");
  out = StoredFeatures<Stored>{};
  if (features.values.size() != features.size() * std::size_t{D::size}) return Status::bad_rows;
  out.descriptors.resize(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) detail::Storage<Stored>::make(features[i], out.descriptors[i]);
  out.keypoints = features.keypoints;
  out.frames = features.frames;
  out.frame_confidence = features.frame_confidence;
  out.neighbors = features.neighbors;
  out.status = features.status;  // last: whatever is thrown before, there is no row
  return Status::ok;
}

/// A whole cloud's descriptors in a storage: describe_cloud(), then store(). Statuses as of describe_cloud(). Allocates
/// the features in floats, too, for as long as it lasts.
template <class Stored>
[[nodiscard]] Status describe_cloud(const CloudView& cloud, const CloudOptions& options, StoredFeatures<Stored>& out) {
  Features<typename detail::Storage<Stored>::Descriptor> features;
  const Status status = describe_cloud(cloud, options, features);
  const Status stored = store(features, out);
  return status != Status::ok ? status : stored;
}

/// As features are saved: the same bytes on every machine, and so many for a row as the storage has, and 73 more. The
/// file says storage_layout<Stored>().
///
/// Statuses: bad_rows (vectors that are not as long as each other; halves, frames or confidences that are not finite);
/// `bytes` is empty then. Allocates the bytes, and the descriptors once more. Reentrant.
template <class Stored>
[[nodiscard]] Status save(const StoredFeatures<Stored>& features, std::vector<std::uint8_t>& bytes) {
  using Value = typename detail::Storage<Stored>::Value;
  using Columns = detail::ColumnsToSave<Value>;
  constexpr std::size_t row_size = detail::stored_values<Stored>;
  std::vector<Value> values(features.descriptors.size() * row_size);
  if (!values.empty()) std::memcpy(values.data(), features.descriptors.data(), values.size() * sizeof(Value));
  const std::string layout = storage_layout<Stored>();
  const auto& const_values = values;
  return detail::save_columns(detail::columns_of<Columns>(features, const_values, layout, row_size), bytes);
}

/// What save() made these bytes of. Statuses as for features: those of another descriptor, of another storage or scale,
/// or of floats are other_descriptor. `out` has not changed if it is not ok.
template <class Stored>
[[nodiscard]] Status load(const std::uint8_t* bytes, std::size_t size, StoredFeatures<Stored>& out) {
  using Value = typename detail::Storage<Stored>::Value;
  using Columns = detail::ColumnsToLoad<Value>;
  constexpr std::size_t row_size = detail::stored_values<Stored>;
  StoredFeatures<Stored> loaded;
  std::vector<Value> values;
  const std::string layout = storage_layout<Stored>();
  const Status status =
      detail::load_columns(bytes, size, detail::columns_of<Columns>(loaded, values, layout, row_size));
  if (status != Status::ok) return status;
  loaded.descriptors.resize(loaded.size());
  if (!values.empty()) std::memcpy(loaded.descriptors.data(), values.data(), values.size() * sizeof(Value));
  out = std::move(loaded);
  return Status::ok;
}

/// The same in a file: also no_file, as for features.
template <class Stored>
[[nodiscard]] Status save(const StoredFeatures<Stored>& features, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  const Status status = save(features, bytes);
  return status == Status::ok ? detail::replace_file(path, bytes) : status;
}
template <class Stored>
[[nodiscard]] Status load(const std::string& path, StoredFeatures<Stored>& out) {
  std::vector<std::uint8_t> bytes;
  const Status status = detail::read_file(path, bytes);
  return status == Status::ok ? load(bytes.data(), bytes.size(), out) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_STORE_STORED_FEATURES_HPP

// shortshot/recognition/flash_model_file.hpp: models for flash: written, as bytes or as a C++ header, and read back.
// Hosted only: allocates.
#ifndef SHORTSHOT_RECOGNITION_FLASH_MODEL_FILE_HPP
#define SHORTSHOT_RECOGNITION_FLASH_MODEL_FILE_HPP

// shortshot/recognition/codebook.hpp: what a recognizer has learnt. Hosted only: allocates.
#ifndef SHORTSHOT_RECOGNITION_CODEBOOK_HPP
#define SHORTSHOT_RECOGNITION_CODEBOOK_HPP

// shortshot/recognition/descriptor_rows.hpp: borrowed rows of descriptors, as matching and recognition take them.
// Hosted only.
#ifndef SHORTSHOT_RECOGNITION_DESCRIPTOR_ROWS_HPP
#define SHORTSHOT_RECOGNITION_DESCRIPTOR_ROWS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// `count` descriptors of `size` floats each, row by row without gaps. Borrowed, like everything here.
struct DescriptorRows {
  const float* values;   ///< count * size
  std::size_t count;     ///< number of rows
  std::size_t size;      ///< floats in a row
  const Status* status;  ///< one per row: those that are not ok are left out; null: all are ok
};

/// Descriptors with the places and frames that they were made at.
struct FeatureRows {
  DescriptorRows descriptors;  ///< the rows
  const KeyPoint* keypoints;   ///< one per row
  const Frame* frames;         ///< one per row
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// The rows of extract()'s result; the features must outlive them.
template <class D>
[[nodiscard]] DescriptorRows rows_of(const Features<D>& features) noexcept {
  return {features.values.data(), features.size(), static_cast<std::size_t>(D::size), features.status.data()};
}

/// The same with key points and frames.
template <class D>
[[nodiscard]] FeatureRows feature_rows_of(const Features<D>& features) noexcept {
  const bool complete = features.keypoints.size() == features.size() && features.frames.size() == features.size();
  return {rows_of(features), complete ? features.keypoints.data() : nullptr, features.frames.data()};
}

/// Can these rows be used: no null pointer where there are rows, and at least one value in each? ok or bad_rows.
[[nodiscard]] inline Status validate(const DescriptorRows& rows) noexcept {
  return rows.size > 0 && (rows.count == 0 || rows.values != nullptr) ? Status::ok : Status::bad_rows;
}

[[nodiscard]] inline Status validate(const FeatureRows& rows) noexcept {
  const bool complete = rows.descriptors.count == 0 || (rows.keypoints != nullptr && rows.frames != nullptr);
  return complete ? validate(rows.descriptors) : Status::bad_rows;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Rows>
[[nodiscard]] bool is_ok(const Rows& rows, std::size_t row) noexcept {
  return rows.status == nullptr || rows.status[row] == Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_DESCRIPTOR_ROWS_HPP

// shortshot/recognition/match.hpp: the nearest descriptors of another set, exactly; pairs that are each other's
// nearest; and those that are nearer than all others by far. Hosted only: allocates, starts threads.
#ifndef SHORTSHOT_RECOGNITION_MATCH_HPP
#define SHORTSHOT_RECOGNITION_MATCH_HPP

// shortshot/recognition/compare_packed.hpp: which pairs of packed rows are near each other, for match.hpp. Hosted only:
// allocates, starts threads.
//
// The distances of a row of the database from a panel of queries are summed up at the same time, a chunk of codes after
// the other, exactly. After each chunk the sum is as far as they are apart at least: where no query of the panel can
// be nearer than the best so far, the other chunks are left out. Of rows of a scene four out of five are.
#ifndef SHORTSHOT_RECOGNITION_COMPARE_PACKED_HPP
#define SHORTSHOT_RECOGNITION_COMPARE_PACKED_HPP

// shortshot/base/simd_sums.hpp: how far packed rows are from each other, for many of them at once: lanes are rows of a
// panel, which all meet the same row of the database. For hosts; the compiler's own macros choose, as in simd.hpp.
//
// There are three kinds of sums, each a struct of the same form:
//
//     SmallCodes   products of numbers from 0 to 15, two at a time (a step); for up to 64 of them
//     LargeCodes   products of numbers from 0 to 255, two at a time; modulo 2^32, hence for any number of them
//     HalfBytes    bits in which half bytes differ, one half byte at a time; for up to 62 of them
//
//     Code         an element of the database's rows: a number, or a half byte times 16
//     Cell         an element of a panel
//     rows         of a panel, that one `Sums` has sums of
//     step_codes   codes of a row, and
//     step_cells   cells of a panel, in one step
//     pack()       one step of as many rows of codes as a panel
//     none()       no step
//     add()        one step more, of a panel and a row
//     Limit        a number of the size of a sum
//     any_near()   is any product above, or number of bits below, what a row of the panel and the other row say? That
//                  is limits + of_row for products, limits - of_row for bits, or as near to it as a Limit can be; sums
//                  must be less than the largest Limit
//     widen()      as 32-bit integers, in the order of the rows, in rows / lanes registers
#ifndef SHORTSHOT_BASE_SIMD_SUMS_HPP
#define SHORTSHOT_BASE_SIMD_SUMS_HPP

// shortshot/base/half_bytes.hpp: how many bits half a byte differs in from another.
#ifndef SHORTSHOT_BASE_HALF_BYTES_HPP
#define SHORTSHOT_BASE_HALF_BYTES_HPP

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// For every two of them. (Registers are loaded from it.)
struct HalfByteDistances {
  alignas(16) std::uint8_t of[16][16];  ///< of[a][b]: the bits in which half bytes a and b differ
  constexpr HalfByteDistances() noexcept : of{} {
    for (unsigned a = 0; a < 16; ++a) {
      for (unsigned b = 0; b < 16; ++b) {
        for (unsigned differ = a ^ b; differ != 0; differ &= differ - 1) ++of[a][b];
      }
    }
  }
};
inline constexpr HalfByteDistances half_byte_distances{};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
#endif  // SHORTSHOT_BASE_HALF_BYTES_HPP

#if defined(__AVX2__)

// shortshot/base/simd_sums_avx2.hpp: sums over packed rows on AVX2. Included by simd_sums.hpp, which says what it must
// do.
#ifndef SHORTSHOT_BASE_SIMD_SUMS_AVX2_HPP
#define SHORTSHOT_BASE_SIMD_SUMS_AVX2_HPP

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

struct SmallCodes {
  using Code = std::uint8_t;
  using Limit = std::int16_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 16, step_codes = 2, step_cells = 32;
  struct Sums {
    __m256i v;  // 16 bits each
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 2);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm256_setzero_si256()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::int16_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const __m256i cells = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(panel));
    return {_mm256_add_epi16(sums.v, _mm256_maddubs_epi16(cells, _mm256_set1_epi16(pair)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m256i of_rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(limits));
    const __m256i above = _mm256_cmpgt_epi16(sums.v, _mm256_adds_epi16(of_rows, _mm256_set1_epi16(of_row)));
    return _mm256_movemask_epi8(above) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    to[0] = {_mm256_cvtepi16_epi32(_mm256_castsi256_si128(sums.v))};
    to[1] = {_mm256_cvtepi16_epi32(_mm256_extracti128_si256(sums.v, 1))};
  }
};

struct LargeCodes {
  using Code = std::uint16_t;
  using Limit = std::int32_t;
  using Cell = std::uint16_t;
  static constexpr std::size_t rows = 8, step_codes = 2, step_cells = 16;
  struct Sums {
    __m256i v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm256_setzero_si256()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::int32_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const __m256i cells = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(panel));
    return {_mm256_add_epi32(sums.v, _mm256_madd_epi16(cells, _mm256_set1_epi32(pair)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m256i of_rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(limits));
    const __m256i above = _mm256_cmpgt_epi32(sums.v, _mm256_add_epi32(of_rows, _mm256_set1_epi32(of_row)));
    return _mm256_movemask_epi8(above) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept { to[0] = {sums.v}; }
};

struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 32, step_codes = 1, step_cells = 32;
  struct Sums {
    __m256i v;  // 8 bits each
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) to[k] = static_cast<Cell>(*of_rows[k] >> 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm256_setzero_si256()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    const std::uint8_t* const distances = &half_byte_distances.of[0][0] + *codes;  // from the row's half byte
    const __m128i table = _mm_load_si128(reinterpret_cast<const __m128i*>(distances));
    const __m256i cells = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(panel));
    return {_mm256_add_epi8(sums.v, _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(table), cells))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m256i of_rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(limits));
    const __m256i all_limits = _mm256_subs_epu8(of_rows, _mm256_set1_epi8(static_cast<char>(of_row)));
    return _mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_max_epu8(sums.v, all_limits), sums.v)) != -1;
  }
  static void widen(Sums sums, I32* to) noexcept {
    const __m128i low = _mm256_castsi256_si128(sums.v);
    const __m128i high = _mm256_extracti128_si256(sums.v, 1);
    to[0] = {_mm256_cvtepu8_epi32(low)};
    to[1] = {_mm256_cvtepu8_epi32(_mm_srli_si128(low, 8))};
    to[2] = {_mm256_cvtepu8_epi32(high)};
    to[3] = {_mm256_cvtepu8_epi32(_mm_srli_si128(high, 8))};
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
#endif  // SHORTSHOT_BASE_SIMD_SUMS_AVX2_HPP
#elif defined(__SSE2__)

// shortshot/base/simd_sums_sse2.hpp: sums over packed rows on SSE2. Included by simd_sums.hpp, which says what it must
// do.
#ifndef SHORTSHOT_BASE_SIMD_SUMS_SSE2_HPP
#define SHORTSHOT_BASE_SIMD_SUMS_SSE2_HPP

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

struct LargeCodes {
  using Code = std::uint16_t;
  using Limit = std::int32_t;
  using Cell = std::uint16_t;
  static constexpr std::size_t rows = 4, step_codes = 2, step_cells = 8;
  struct Sums {
    __m128i v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm_setzero_si128()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::int32_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const __m128i cells = _mm_loadu_si128(reinterpret_cast<const __m128i*>(panel));
    return {_mm_add_epi32(sums.v, _mm_madd_epi16(cells, _mm_set1_epi32(pair)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m128i of_rows = _mm_loadu_si128(reinterpret_cast<const __m128i*>(limits));
    const __m128i above = _mm_cmpgt_epi32(sums.v, _mm_add_epi32(of_rows, _mm_set1_epi32(of_row)));
    return _mm_movemask_epi8(above) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept { to[0] = {sums.v}; }
};

using SmallCodes = LargeCodes;  // products of bytes came with SSSE3

/// Nor are there tables in registers: a panel has the distances from each of the 16 half bytes.
struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 16, step_codes = 1, step_cells = 256;
  struct Sums {
    __m128i v;  // 8 bits each
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t half = 0; half < 16; ++half) {
      for (std::size_t k = 0; k < rows; ++k) to[rows * half + k] = half_byte_distances.of[half][*of_rows[k] >> 4];
    }
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm_setzero_si128()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    const __m128i distances = _mm_loadu_si128(reinterpret_cast<const __m128i*>(panel + *codes));
    return {_mm_add_epi8(sums.v, distances)};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m128i of_rows = _mm_loadu_si128(reinterpret_cast<const __m128i*>(limits));
    const __m128i all_limits = _mm_subs_epu8(of_rows, _mm_set1_epi8(static_cast<char>(of_row)));
    return _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(sums.v, all_limits), sums.v)) != 0xFFFF;
  }
  static void widen(Sums sums, I32* to) noexcept {
    const __m128i zero = _mm_setzero_si128();
    const __m128i low = _mm_unpacklo_epi8(sums.v, zero);
    const __m128i high = _mm_unpackhi_epi8(sums.v, zero);
    to[0] = {_mm_unpacklo_epi16(low, zero)};
    to[1] = {_mm_unpackhi_epi16(low, zero)};
    to[2] = {_mm_unpacklo_epi16(high, zero)};
    to[3] = {_mm_unpackhi_epi16(high, zero)};
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
#endif  // SHORTSHOT_BASE_SIMD_SUMS_SSE2_HPP
#elif defined(__aarch64__)

// shortshot/base/simd_sums_neon.hpp: sums over packed rows on NEON. Included by simd_sums.hpp, which says what it must
// do.
#ifndef SHORTSHOT_BASE_SIMD_SUMS_NEON_HPP
#define SHORTSHOT_BASE_SIMD_SUMS_NEON_HPP

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

struct SmallCodes {
  using Code = std::uint8_t;
  using Limit = std::int16_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 8, step_codes = 2, step_cells = 16;
  struct Sums {
    uint16x8_t first, second;  // of four rows each, of their even and odd codes apart
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 2);
  }
  [[nodiscard]] static Sums none() noexcept { return {vdupq_n_u16(0), vdupq_n_u16(0)}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::uint16_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const uint8x8_t pairs = vreinterpret_u8_u16(vdup_n_u16(pair));
    const uint8x16_t cells = vld1q_u8(panel);
    return {vmlal_u8(sums.first, vget_low_u8(cells), pairs), vmlal_u8(sums.second, vget_high_u8(cells), pairs)};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const int16x8_t all_sums = vreinterpretq_s16_u16(vpaddq_u16(sums.first, sums.second));
    return vmaxvq_u16(vcgtq_s16(all_sums, vqaddq_s16(vld1q_s16(limits), vdupq_n_s16(of_row)))) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    to[0] = {vreinterpretq_s32_u32(vpaddlq_u16(sums.first))};
    to[1] = {vreinterpretq_s32_u32(vpaddlq_u16(sums.second))};
  }
};

struct LargeCodes {
  using Code = std::uint16_t;
  using Limit = std::int32_t;
  using Cell = std::uint16_t;
  static constexpr std::size_t rows = 4, step_codes = 2, step_cells = 8;
  struct Sums {
    uint32x4_t first, second;  // of two rows each, of their even and odd codes apart
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {vdupq_n_u32(0), vdupq_n_u32(0)}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::uint32_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const uint16x4_t pairs = vreinterpret_u16_u32(vdup_n_u32(pair));
    const uint16x8_t cells = vld1q_u16(panel);
    return {vmlal_u16(sums.first, vget_low_u16(cells), pairs), vmlal_u16(sums.second, vget_high_u16(cells), pairs)};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const int32x4_t all_sums = vreinterpretq_s32_u32(vpaddq_u32(sums.first, sums.second));
    return vmaxvq_u32(vcgtq_s32(all_sums, vaddq_s32(vld1q_s32(limits), vdupq_n_s32(of_row)))) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    to[0] = {vreinterpretq_s32_u32(vpaddq_u32(sums.first, sums.second))};
  }
};

struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 16, step_codes = 1, step_cells = 16;
  struct Sums {
    uint8x16_t v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) to[k] = static_cast<Cell>(*of_rows[k] >> 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {vdupq_n_u8(0)}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    const uint8x16_t table = vld1q_u8(&half_byte_distances.of[0][0] + *codes);  // from the row's half byte
    return {vaddq_u8(sums.v, vqtbl1q_u8(table, vld1q_u8(panel)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    return vmaxvq_u8(vcltq_u8(sums.v, vqsubq_u8(vld1q_u8(limits), vdupq_n_u8(of_row)))) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    const uint16x8_t low = vmovl_u8(vget_low_u8(sums.v));
    const uint16x8_t high = vmovl_u8(vget_high_u8(sums.v));
    to[0] = {vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(low)))};
    to[1] = {vreinterpretq_s32_u32(vmovl_u16(vget_high_u16(low)))};
    to[2] = {vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(high)))};
    to[3] = {vreinterpretq_s32_u32(vmovl_u16(vget_high_u16(high)))};
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
#endif  // SHORTSHOT_BASE_SIMD_SUMS_NEON_HPP
#else

// shortshot/base/simd_sums_scalar.hpp: sums over packed rows, one row at a time. Included by simd_sums.hpp, which says
// what it must do.
#ifndef SHORTSHOT_BASE_SIMD_SUMS_SCALAR_HPP
#define SHORTSHOT_BASE_SIMD_SUMS_SCALAR_HPP

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// Sums of products, and of bits that differ; simd_sums.hpp says what their members are.
struct LargeCodes {
  using Code = std::uint16_t;  ///< an element of the database's rows
  using Limit = std::int32_t;  ///< a number of the size of a sum
  using Cell = std::uint16_t;  ///< an element of a panel
  /// Rows of one Sums; codes and cells of one step.
  static constexpr std::size_t rows = 1, step_codes = 2, step_cells = 2;
  /// The sums of `rows` rows.
  struct Sums {
    std::uint32_t v;  ///< the sum
  };

  /// One step of as many rows of codes as a panel has.
  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    to[0] = of_rows[0][0];
    to[1] = of_rows[0][1];
  }
  /// The sums before the first step.
  [[nodiscard]] static Sums none() noexcept { return {0}; }
  /// One step more, of a panel and a row.
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    return {sums.v + std::uint32_t{panel[0]} * codes[0] + std::uint32_t{panel[1]} * codes[1]};
  }
  /// Is any product above, or number of bits below, what the panel's row and the other row say?
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    return static_cast<std::int32_t>(sums.v) > *limits + of_row;
  }
  /// As 32-bit integers, in the order of the rows.
  static void widen(Sums sums, I32* to) noexcept { to[0] = all_int(static_cast<std::int32_t>(sums.v)); }
};

/// Products of numbers from 0 to 15, for up to 64 of them.
using SmallCodes = LargeCodes;

/// Bits in which half bytes differ, one half byte at a time, for up to 62 of them.
struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 1, step_codes = 1, step_cells = 1;
  /// The sums of `rows` rows.
  struct Sums {
    std::int32_t v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept { *to = static_cast<Cell>(*of_rows[0] >> 4); }
  [[nodiscard]] static Sums none() noexcept { return {0}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    return {sums.v + half_byte_distances.of[*codes >> 4][*panel]};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    return sums.v < *limits - of_row;
  }
  static void widen(Sums sums, I32* to) noexcept { to[0] = all_int(sums.v); }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
#endif  // SHORTSHOT_BASE_SIMD_SUMS_SCALAR_HPP
#endif
#endif  // SHORTSHOT_BASE_SIMD_SUMS_HPP

// shortshot/recognition/compare_rows.hpp: which pairs of rows may be near each other, for match.hpp. Hosted only:
// allocates, starts threads.
//
// |a - b|^2 = |a|^2 + |b|^2 - 2 ab makes of all distances of floats one matrix product, 1.4 (SSE2) to 1.7 (AVX2) times
// as fast as squared differences blocked in the same way, but cancellation costs it digits where rows are close. So the
// product only rules out: where, by a bound on its rounding, a row may be nearer than the best so far, the distance is
// computed again as a sum of squared differences, and that decides. In rows of no particular order that is so for about
// log(count) rows of each query.
//
// Packed rows have compare_packed.hpp. Of rows in any other format every pair is compared.
#ifndef SHORTSHOT_RECOGNITION_COMPARE_ROWS_HPP
#define SHORTSHOT_RECOGNITION_COMPARE_ROWS_HPP

// shortshot/recognition/l2_distance.hpp: the distance of two rows of floats, with the same bits on every machine.
#ifndef SHORTSHOT_RECOGNITION_L2_DISTANCE_HPP
#define SHORTSHOT_RECOGNITION_L2_DISTANCE_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The sum of (a[i] - b[i])^2 for two rows of `size` floats. In eight sums, whatever the number of lanes, for the same
/// bits on every machine: sum k has values k, k + 8, ...; then ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)). 0 for a size
/// of 0. No allocation, no error, reentrant; NaN and infinity go through.
[[nodiscard]] inline float squared_l2_distance(const float* a, const float* b, std::size_t size) noexcept {
  namespace simd = extend::simd;
  constexpr std::size_t width = 8;
  static_assert(width % simd::lanes == 0, "whole registers");
  simd::F32 lanes[width / simd::lanes] = {};
  const auto add = [&lanes](const float* x, const float* y) {
    for (std::size_t k = 0; k < width; k += simd::lanes) {
      const simd::F32 difference = simd::load(x + k) - simd::load(y + k);
      lanes[k / simd::lanes] = lanes[k / simd::lanes] + difference * difference;
    }
  };
  const std::size_t whole = size - size % width;
  for (std::size_t i = 0; i < whole; i += width) add(a + i, b + i);
  float rest[2][width] = {};
  for (std::size_t i = whole; i < size; ++i) {
    rest[0][i - whole] = a[i];
    rest[1][i - whole] = b[i];
  }
  add(rest[0], rest[1]);
  float sums[width];
  for (std::size_t k = 0; k < width; k += simd::lanes) simd::store(sums + k, lanes[k / simd::lanes]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// The L2 distance, which is Match::distance for rows of floats: the root of it, exactly rounded.
[[nodiscard]] inline float l2_distance(const float* a, const float* b, std::size_t size) noexcept {
  return extend::simd::sqrt(squared_l2_distance(a, b, size));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_L2_DISTANCE_HPP

// shortshot/recognition/row_format.hpp: what rows of descriptors must have to be matched: for who stores them in a
// format of their own.
#ifndef SHORTSHOT_RECOGNITION_ROW_FORMAT_HPP
#define SHORTSHOT_RECOGNITION_ROW_FORMAT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

template <class Rows, class = void>
struct HasCount : std::false_type {};
template <class Rows>
struct HasCount<Rows, std::void_t<decltype(static_cast<std::size_t>(std::declval<const Rows&>().count))>>
    : std::true_type {};

template <class Rows, class = void>
struct HasStatus : std::false_type {};
template <class Rows>
struct HasStatus<Rows, std::void_t<decltype(std::declval<const Rows&>().status)>>
    : std::is_convertible<decltype(std::declval<const Rows&>().status), const Status*> {};

template <class Rows, class = void>
struct HasFits : std::false_type {};
template <class Rows>
struct HasFits<Rows, std::void_t<decltype(std::declval<const Rows&>().fits(std::declval<const Rows&>()))>>
    : std::is_convertible<decltype(std::declval<const Rows&>().fits(std::declval<const Rows&>())), bool> {};

template <class Rows, class = void>
struct RowsNumber {
  using type = void;
};
template <class Rows>
struct RowsNumber<Rows, std::void_t<decltype(std::declval<const Rows&>().compare(
                            std::size_t{}, std::declval<const Rows&>(), std::size_t{}))>> {
  using type = decltype(std::declval<const Rows&>().compare(std::size_t{}, std::declval<const Rows&>(), std::size_t{}));
};

template <class Rows, class = void>
struct HasDistance : std::false_type {};
template <class Rows>
struct HasDistance<
    Rows, std::void_t<decltype(std::declval<const Rows&>().distance(std::declval<typename RowsNumber<Rows>::type>()))>>
    : std::is_convertible<
          decltype(std::declval<const Rows&>().distance(std::declval<typename RowsNumber<Rows>::type>())), float> {};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// Can Rows be given to nearest(), reciprocal_correspondences() and ratio_correspondences()? They take whatever has
///
///     struct Rows {  // borrowed: copied, and asked by several threads at the same time
///       std::size_t count;                   // how many there are
///       const shortshot::Status* status;     // one per row: those that are not ok are left out; null: all are ok
///       bool fits(const Rows& other) const;  // can they be compared? bad_rows if not
///       Number compare(std::size_t row, const Rows& other, std::size_t others_row) const;
///       float distance(Number compared) const;  // what Match::distance says of it
///     };
///
/// compare() gives an integer or a float that is the larger the farther away: a sum of squares saves the root of each
/// pair. It is less than the largest one of its type; a row for which it is that, or NaN, is nobody's match. The
/// library's own rows are made like that, and compared faster than pair by pair.
template <class Rows>
inline constexpr bool is_row_format =
    std::conjunction<detail::HasCount<Rows>, detail::HasStatus<Rows>, detail::HasFits<Rows>,
                     std::is_arithmetic<typename detail::RowsNumber<Rows>::type>, detail::HasDistance<Rows>>::value;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Says what is missing.
template <class Rows>
constexpr void require_row_format() noexcept {
  static_assert(HasCount<Rows>::value, "matching supports rows with `std::size_t count`: see extend::is_row_format");
  static_assert(HasStatus<Rows>::value,
                "matching supports rows with `const Status* status`: see extend::is_row_format");
  static_assert(HasFits<Rows>::value,
                "matching supports rows with `bool fits(const Rows& other) const`: see extend::is_row_format");
  static_assert(std::is_arithmetic<typename RowsNumber<Rows>::type>::value,
                "matching supports rows with `Number compare(std::size_t row, const Rows& other, std::size_t "
                "others_row) const`, an integer or a float: see extend::is_row_format");
  static_assert(!std::is_arithmetic<typename RowsNumber<Rows>::type>::value || HasDistance<Rows>::value,
                "matching supports rows with `float distance(Number compared) const`: see extend::is_row_format");
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_ROW_FORMAT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Queries that a thread takes at a time, and rows of the database that meet them at a time: few enough for a CPU's
/// second cache, many enough to be worth their way there.
inline constexpr std::size_t query_block = 128;
inline constexpr std::size_t row_block = 96;
static_assert(query_block % panel_rows == 0 && row_block % tile_rows == 0, "whole tiles");

/// A match before what was compared became a distance.
template <class Number>
struct Candidate {
  std::uint32_t row;
  Number compared;
};

/// More than twice any squared distance; finite, so that nothing here depends on how infinities compare.
inline constexpr float out_of_reach = std::numeric_limits<float>::max();

/// Rows with half of their squared norms, each less its share of the rounding: half_norm(a) + half_norm(b) - (the
/// product ab) is not above half of squared_l2_distance(a, b), in whatever order the product was summed up.
///
/// A sum of n products errs by n 2^-24 |a| |b| at most (to first order), hence the two norms and twice the product
/// together by 2 n 2^-24 (|a|^2 + |b|^2), and squared_l2_distance(), which is not above 2 (|a|^2 + |b|^2), by as much
/// again. 5 instead of 4 makes up for higher orders, 16 for the few other operations, min() for squares that underflow.
class ComparedRows {
 public:
  using Number = float;
  static constexpr Number farthest = out_of_reach;

  explicit ComparedRows(const DescriptorRows& rows)
      : rows_(rows), origin_(rows.size), half_norms_(whole_panels(rows.count), out_of_reach) {
    const auto size = static_cast<float>(rows.size);
    const float kept = 1.0f - 5.0f * (size + 16.0f) * (1.0f / 16777216.0f);
    const float underflow = size * std::numeric_limits<float>::min();
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (!is_ok(rows, i)) continue;
      const float norm = squared_l2_distance(at(i), origin_.data(), rows.size);
      if (math::is_finite(8.0f * norm)) half_norms_[i] = unfused(0.5f * kept * norm) - underflow;
    }
  }

  /// A multiple of the rows of a panel: what is behind the last row takes no part.
  [[nodiscard]] static std::size_t whole_panels(std::size_t count) noexcept {
    return (count + panel_rows - 1) / panel_rows * panel_rows;
  }
  [[nodiscard]] std::size_t count() const noexcept { return rows_.count; }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size; }
  [[nodiscard]] const float* half_norm(std::size_t row) const noexcept { return half_norms_.data() + row; }
  [[nodiscard]] bool takes_part(std::size_t row) const noexcept { return half_norms_[row] < out_of_reach; }
  [[nodiscard]] float compare(std::size_t row, const ComparedRows& other, std::size_t others_row) const noexcept {
    return squared_l2_distance(at(row), other.at(others_row), rows_.size);
  }

  /// Zeros for rows that take no part.
  void pack_panel(std::size_t first, float* panel) const noexcept {
    const float* rows[panel_rows];
    for (std::size_t k = 0; k < panel_rows; ++k) rows[k] = takes_part(first + k) ? at(first + k) : origin_.data();
    pack(rows, rows_.size, panel);
  }
  /// With rows from `first` on; the last one's again where there are no more.
  void multiply_tile(const float* panel, std::size_t first, float (&products)[tile_rows][panel_rows]) const noexcept {
    const float* rows[tile_rows];
    for (std::size_t k = 0; k < tile_rows; ++k) rows[k] = at(std::min(first + k, rows_.count - 1));
    multiply_widest(panel, rows, rows_.size, products);
  }

 private:
  [[nodiscard]] const float* at(std::size_t row) const noexcept { return rows_.values + row * rows_.size; }

  DescriptorRows rows_;
  std::vector<float> origin_;
  std::vector<float> half_norms_;
};

/// Shares blocks of queries among threads. compare(thread, first, row, products) is called for panels of queries, from
/// `first` on, with their products with a row of the database that takes part; one thread gets queries in ascending
/// order for each row, and rows for each query.
template <class Executor, class Compare>
void for_products(Executor& executor, std::size_t team, const ComparedRows& queries, const ComparedRows& database,
                  const Compare& compare) {
  const std::size_t size = queries.size();
  const std::size_t block_values = std::min(ComparedRows::whole_panels(queries.count()), query_block) * size;
  std::vector<float> panels(team * block_values);
  const auto compare_block = [&](std::size_t thread, std::size_t begin, std::size_t end) {
    float* const block = panels.data() + thread * block_values;
    for (std::size_t q = begin; q < end; q += panel_rows) queries.pack_panel(q, block + (q - begin) * size);
    for (std::size_t first = 0; first < database.count(); first += row_block) {
      const std::size_t last = std::min(first + row_block, database.count());
      for (std::size_t q = begin; q < end; q += panel_rows) {
        for (std::size_t tile = first; tile < last; tile += tile_rows) {
          float products[tile_rows][panel_rows];
          database.multiply_tile(block + (q - begin) * size, tile, products);
          for (std::size_t row = tile; row < std::min(tile + tile_rows, last); ++row) {
            if (database.takes_part(row)) compare(thread, q, row, products[row - tile]);
          }
        }
      }
    }
  };
  for_blocks(executor, team, queries.count(), query_block, compare_block);
}

/// Calls consider(query) for those queries of a panel, from `first` on, whose squared distance from a row, of which
/// there is a half norm, may be below twice the limits(query), which are in a register for each query and those next.
template <class Limits, class Consider>
void for_candidates(const ComparedRows& queries, std::size_t first, float half_norm,
                    const float (&products)[panel_rows], const Limits& limits, const Consider& consider) {
  for (std::size_t k = 0; k < panel_rows; k += simd::lanes) {
    const std::size_t query = first + k;
    const simd::F32 half_norms = simd::load(queries.half_norm(query));
    const simd::F32 half_distances = (half_norms - simd::load(products + k)) + simd::all(half_norm);
    const simd::Mask near = half_distances < limits(query);
    if (!any(near)) continue;
    std::int32_t is_near[simd::lanes];
    simd::store(is_near, keep(near, simd::all_int(1)));
    for (std::size_t lane = 0; lane < simd::lanes; ++lane) {
      if (is_near[lane] != 0 && queries.takes_part(query + lane)) consider(query + lane);
    }
  }
}

/// What of each query's best so far its products are compared with.
class QueryLimits {
 public:
  explicit QueryLimits(const ComparedRows& queries)
      : halves_(ComparedRows::whole_panels(queries.count()), 0.5f * out_of_reach) {}
  void set(std::size_t query, float squared_distance) noexcept { halves_[query] = 0.5f * squared_distance; }
  [[nodiscard]] simd::F32 halves(std::size_t query) const noexcept { return simd::load(halves_.data() + query); }

 private:
  std::vector<float> halves_;
};

/// Of the products that for_products() calls it with, those of pairs that may be near: nearer than `limits` has for the
/// query, or what `best_of_rows` (null: nothing) has for the row. One type for all that is done with them, because they
/// are few, and what is around them takes a compiler its time.
struct NearPairs {
  const ComparedRows& queries;
  const ComparedRows& database;
  const QueryLimits& limits;
  const Candidate<float>* best_of_rows;  // as many for each thread as there are rows
  void (*consider)(const void* considering, std::size_t thread, std::size_t query, std::size_t row);
  const void* considering;

  void operator()(std::size_t thread, std::size_t first, std::size_t row, const float (&products)[panel_rows]) const {
    const float of_row = best_of_rows != nullptr ? best_of_rows[thread * database.count() + row].compared : 0.0f;
    const simd::F32 half_of_row = simd::all(0.5f * of_row);
    const auto halves = [&](std::size_t query) { return simd::max(limits.halves(query), half_of_row); };
    for_candidates(queries, first, *database.half_norm(row), products, halves,
                   [&](std::size_t query) { consider(considering, thread, query, row); });
  }
};

/// Calls consider(thread, query, row) for all pairs that take part and are nearer than the best so far, of the query or
/// (if there is one) of the row, and for others; in the order of for_products().
template <class Executor, class Consider>
void for_near(Executor& executor, std::size_t team, const ComparedRows& queries, const ComparedRows& database,
              const QueryLimits& limits, const Candidate<float>* best_of_rows, const Consider& consider) {
  const auto call = [](const void* considering, std::size_t thread, std::size_t query, std::size_t row) {
    (*static_cast<const Consider*>(considering))(thread, query, row);
  };
  for_products(executor, team, queries, database, NearPairs{queries, database, limits, best_of_rows, call, &consider});
}

/// Rows in any format, with the same functions.
template <class Rows>
class AnyRows {
 public:
  using Number = typename RowsNumber<Rows>::type;
  static constexpr Number farthest = std::numeric_limits<Number>::max();

  explicit AnyRows(const Rows& rows) noexcept : rows_(rows) {}
  [[nodiscard]] const Rows& rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t count() const noexcept { return rows_.count; }
  [[nodiscard]] bool takes_part(std::size_t row) const noexcept { return is_ok(rows_, row); }
  [[nodiscard]] Number compare(std::size_t row, const AnyRows& other, std::size_t others_row) const {
    return rows_.compare(row, other.rows_, others_row);
  }

 private:
  const Rows& rows_;
};

struct NoLimits {
  template <class Rows>
  explicit NoLimits(const AnyRows<Rows>&) noexcept {}
  template <class Number>
  void set(std::size_t, Number) noexcept {}
};

template <class Executor, class Rows, class Consider>
void for_near(Executor& executor, std::size_t team, const AnyRows<Rows>& queries, const AnyRows<Rows>& database,
              const NoLimits&, const Candidate<typename AnyRows<Rows>::Number>*, const Consider& consider) {
  const auto compare_block = [&](std::size_t thread, std::size_t begin, std::size_t end) {
    for (std::size_t first = 0; first < database.count(); first += row_block) {
      const std::size_t last = std::min(first + row_block, database.count());
      for (std::size_t query = begin; query < end; ++query) {
        if (!queries.takes_part(query)) continue;
        for (std::size_t row = first; row < last; ++row) {
          if (database.takes_part(row)) consider(thread, query, row);
        }
      }
    }
  };
  for_blocks(executor, team, queries.count(), query_block, compare_block);
}

/// How rows of a format are compared.
template <class Rows>
struct PairComparison {
  using Compared = AnyRows<Rows>;
  using Limits = NoLimits;
  [[nodiscard]] static bool fit(const Rows& a, const Rows& b) { return a.fits(b); }
  template <class Number>
  [[nodiscard]] static float distance(const Rows& rows, Number compared) {
    return rows.distance(compared);
  }
};
template <class Rows>
struct Comparison : PairComparison<Rows> {};
/// Rows of floats, or of what stands for them.
template <class Rows, class SomeCompared>
struct FloatComparison {
  using Compared = SomeCompared;
  using Limits = QueryLimits;
  [[nodiscard]] static bool fit(const Rows& a, const Rows& b) noexcept {
    return validate(a) == Status::ok && validate(b) == Status::ok && a.size == b.size;
  }
  [[nodiscard]] static float distance(const Rows&, float compared) noexcept { return simd::sqrt(compared); }
};
template <>
struct Comparison<DescriptorRows> : FloatComparison<DescriptorRows, ComparedRows> {};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_COMPARE_ROWS_HPP

// shortshot/recognition/packed_panels.hpp: packed rows where compare_packed.hpp wants them: those of a database as
// codes one after the other, queries side by side in panels. Hosted only: allocates.
#ifndef SHORTSHOT_RECOGNITION_PACKED_PANELS_HPP
#define SHORTSHOT_RECOGNITION_PACKED_PANELS_HPP

// shortshot/recognition/row_codes.hpp: packed rows as the codes that compare_packed.hpp works on. Hosted only:
// allocates.
//
// A row of bytes or nibbles is a row of numbers, and one of bits a row of half bytes. They are put in an order in which
// those come first that differ most from row to row: then the first of them tell most pairs apart.
#ifndef SHORTSHOT_RECOGNITION_ROW_CODES_HPP
#define SHORTSHOT_RECOGNITION_ROW_CODES_HPP

// shortshot/recognition/packed_rows.hpp: borrowed rows of codes and of bits, which are matched as rows of floats
// are. Hosted only.
//
// Their distances are integers before they become Match::distance, hence the same on every machine, and ties are
// exactly that.
#ifndef SHORTSHOT_RECOGNITION_PACKED_ROWS_HPP
#define SHORTSHOT_RECOGNITION_PACKED_ROWS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Can packed rows be compared? Sums of as many squares as this fit 32 bits.
template <class Rows>
[[nodiscard, gnu::always_inline]] inline bool fit(const Rows& a, const Rows& b) noexcept {
  return a.size == b.size && a.size > 0 && a.size <= 66051 && (a.count == 0 || a.bytes != nullptr) &&
         (b.count == 0 || b.bytes != nullptr);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// `count` descriptors of `size` bytes of codes each (1 to 66051), row by row without gaps, as quantize() makes them,
/// all with steps of the same length. Borrowed. Their distance is the L2 distance of the descriptors, `step` times the
/// root of the sum of squares.
template <int Bits>
struct CodedRows {
  const std::uint8_t* bytes;  ///< count * size
  std::size_t count;          ///< number of rows
  std::size_t size;           ///< bytes in a row
  float step;                 ///< CodedDescriptor's
  const Status* status;       ///< one per row: those that are not ok are left out; null: all are ok

  /// Can they be compared: of the same size and step?
  [[nodiscard, gnu::always_inline]] bool fits(const CodedRows& other) const noexcept {
    return detail::fit(*this, other) && step == other.step;
  }
  /// The squared distance in steps.
  [[nodiscard, gnu::always_inline]] std::uint32_t compare(std::size_t row, const CodedRows& other,
                                                          std::size_t others_row) const noexcept {
    return detail::squared_code_distance<Bits>(bytes + row * size, other.bytes + others_row * size, size);
  }
  /// The L2 distance, from what compare() gave.
  [[nodiscard, gnu::always_inline]] float distance(std::uint32_t compared) const noexcept {
    return step * extend::simd::sqrt(static_cast<float>(compared));
  }
};
/// Rows of 8 bits a value, and of 4.
using ByteRows = CodedRows<8>;
using NibbleRows = CodedRows<4>;

/// `count` descriptors of `size` bytes of bits each (1 to 66051), row by row without gaps, as binarize() makes them.
/// Borrowed. Their distance is the number of bits in which they differ (Hamming).
struct BitRows {
  const std::uint8_t* bytes;  ///< count * size
  std::size_t count;          ///< number of rows
  std::size_t size;           ///< bytes in a row
  const Status* status;       ///< one per row: those that are not ok are left out; null: all are ok

  /// Can they be compared: of the same size?
  [[nodiscard, gnu::always_inline]] bool fits(const BitRows& other) const noexcept { return detail::fit(*this, other); }
  /// The number of bits that differ.
  [[nodiscard, gnu::always_inline]] std::uint32_t compare(std::size_t row, const BitRows& other,
                                                          std::size_t others_row) const noexcept {
    return static_cast<std::uint32_t>(hamming_distance(bytes + row * size, other.bytes + others_row * size, size));
  }
  /// The same as a float.
  [[nodiscard, gnu::always_inline]] float distance(std::uint32_t compared) const noexcept {
    return static_cast<float>(compared);
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Descriptors as codes or as bits, which must outlive the rows. `status` has one for each, as Features::status of what
/// they were made from: rows that are not ok hold zeros, which should not match. Null: all are ok.
template <class D, int Bits, int Scale>
[[nodiscard]] CodedRows<Bits> rows_of(const std::vector<CodedDescriptor<D, Bits, Scale>>& descriptors,
                                      const Status* status = nullptr) noexcept {
  using Coded = CodedDescriptor<D, Bits, Scale>;
  static_assert(sizeof(Coded) == Coded::size_bytes, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Coded::size_bytes, Coded::step,
          status};
}
template <class D, int Group>
[[nodiscard]] BitRows rows_of(const std::vector<BinaryDescriptor<D, Group>>& descriptors,
                              const Status* status = nullptr) noexcept {
  using Bits = BinaryDescriptor<D, Group>;
  static_assert(sizeof(Bits) == Bits::size_bytes, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Bits::size_bytes, status};
}
template <class D, int Bits, int Draws>
[[nodiscard]] BitRows rows_of(const std::vector<SumBits<D, Bits, Draws>>& descriptors,
                              const Status* status = nullptr) noexcept {
  static_assert(sizeof(SumBits<D, Bits, Draws>) == Bits / 8, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Bits / 8, status};
}

/// Those of features, with their statuses; also of halves.
template <class Stored>
[[nodiscard]] auto rows_of(const StoredFeatures<Stored>& features) noexcept {
  return rows_of(features.descriptors, features.status.data());
}

/// ok or bad_rows, as for rows of floats.
template <int Bits>
[[nodiscard]] Status validate(const CodedRows<Bits>& rows) noexcept {
  return rows.fits(rows) ? Status::ok : Status::bad_rows;
}
[[nodiscard]] inline Status validate(const BitRows& rows) noexcept {
  return rows.fits(rows) ? Status::ok : Status::bad_rows;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_PACKED_ROWS_HPP

// shortshot/recognition/telling_numbers.hpp: which numbers of descriptors tell most of them apart. Hosted only:
// allocates.
#ifndef SHORTSHOT_RECOGNITION_TELLING_NUMBERS_HPP
#define SHORTSHOT_RECOGNITION_TELLING_NUMBERS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The numbers of rows, those first that differ most from row to row, by up to 256 pairs: an order in which it is known
/// early that two rows are too far apart. `count` rows of `size` bytes, of numbers of `Bits` bits; difference(a, b) of
/// two numbers.
template <int Bits, class Difference>
[[nodiscard]] std::vector<std::uint32_t> most_telling_first(const std::uint8_t* bytes, std::size_t count,
                                                            std::size_t size, const Difference& difference) {
  constexpr std::size_t most_pairs = 256;
  const std::size_t numbers = size * 8 / Bits;
  std::vector<std::uint64_t> differences(numbers);
  const std::size_t stride = std::max<std::size_t>(1, count / most_pairs);
  for (std::size_t row = stride; row < count; row += stride) {
    const std::uint8_t* const a = bytes + row * size;
    const std::uint8_t* const b = a - stride * size;
    for (std::size_t i = 0; i < numbers; ++i)
      differences[i] += difference(number_at<Bits>(a, i), number_at<Bits>(b, i));
  }
  std::vector<std::uint32_t> order(numbers);
  for (std::size_t i = 0; i < numbers; ++i) order[i] = static_cast<std::uint32_t>(i);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
    return differences[i] != differences[k] ? differences[i] > differences[k] : i < k;
  });
  return order;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_TELLING_NUMBERS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Distances that are sums of squared differences of numbers: |a|^2 + |b|^2 - 2 ab, with the norms known beforehand.
template <class SomeOps, int Bits>
struct NumberCodes {
  using Ops = SomeOps;
  using Code = typename Ops::Code;
  static constexpr int bits = Bits;
  /// After so many steps it is asked whether going on is worth it.
  static constexpr std::size_t chunk_steps = 32;
  [[nodiscard]] static Code code_of(unsigned number) noexcept { return static_cast<Code>(number); }
  [[nodiscard]] static std::uint32_t distance(unsigned a, unsigned b) noexcept { return (a - b) * (a - b); }
  [[nodiscard]] static std::uint32_t squared(Code code) noexcept { return std::uint32_t{code} * code; }
  [[nodiscard, gnu::always_inline]] static simd::I32 distances(simd::I32 norms, simd::I32 sums) noexcept {
    return norms - (sums + sums);
  }

  /// Of a chunk: |a|^2 + |b|^2 - 2 ab < limit only if ab > limit_of(|a|^2, limit) + limit_of(|b|^2, 0).
  using Limit = typename Ops::Limit;
  [[nodiscard]] static Limit query_limit(std::uint32_t norm, std::uint32_t limit) noexcept {
    return limit_of(norm, limit);
  }
  [[nodiscard]] static Limit no_query_limit(std::uint32_t norm) noexcept { return limit_of(norm, 0); }
  [[nodiscard]] static Limit row_limit(std::uint32_t norm, std::uint32_t limit) noexcept {
    return limit_of(norm, limit);
  }
  [[nodiscard]] static Limit no_row_limit(std::uint32_t norm) noexcept { return limit_of(norm, 0); }

 private:
  [[nodiscard]] static Limit limit_of(std::uint32_t norm, std::uint32_t limit) noexcept {
    constexpr std::int64_t least = std::numeric_limits<Limit>::min() / 2;
    return static_cast<Limit>(std::max(least, (std::int64_t{norm} - std::int64_t{limit}) >> 1));
  }
};

/// Distances that are sums of bits that differ.
struct BitCodes {
  using Ops = simd::HalfBytes;
  using Code = Ops::Code;
  static constexpr int bits = 4;
  static constexpr std::size_t chunk_steps = 60;
  [[nodiscard]] static Code code_of(unsigned half) noexcept { return static_cast<Code>(half << 4); }
  [[nodiscard]] static std::uint32_t distance(unsigned a, unsigned b) noexcept {
    return simd::half_byte_distances.of[a][b];
  }
  [[nodiscard]] static std::uint32_t squared(Code) noexcept { return 0; }
  [[nodiscard, gnu::always_inline]] static simd::I32 distances(simd::I32 norms, simd::I32 sums) noexcept {
    return norms + sums;
  }

  /// A chunk has less than 255 bits.
  using Limit = Ops::Limit;
  [[nodiscard]] static Limit query_limit(std::uint32_t, std::uint32_t limit) noexcept {
    return static_cast<Limit>(std::min(limit, 255u));
  }
  [[nodiscard]] static Limit no_query_limit(std::uint32_t) noexcept { return 255; }
  [[nodiscard]] static Limit row_limit(std::uint32_t, std::uint32_t limit) noexcept {
    return static_cast<Limit>(255u - std::min(limit, 255u));
  }
  [[nodiscard]] static Limit no_row_limit(std::uint32_t) noexcept { return 0; }
};

/// Which codes rows of a format are made of; for those formats that it is specialized for.
template <class Rows>
struct CodesOf {};
template <int Bits>
struct CodesOf<CodedRows<Bits>> : NumberCodes<std::conditional_t<Bits <= 4, simd::SmallCodes, simd::LargeCodes>, Bits> {
};
template <>
struct CodesOf<BitRows> : BitCodes {};

/// Turns rows that fit each other into codes, in the order that is best for one set of them.
template <class Rows>
class RowCodes {
 public:
  using Format = CodesOf<Rows>;
  using Ops = typename Format::Ops;
  using Code = typename Format::Code;

  explicit RowCodes(const Rows& rows)
      : order_(most_telling_first<Format::bits>(rows.bytes, rows.count, rows.size, &Format::distance)) {}

  [[nodiscard]] std::size_t steps() const noexcept { return (order_.size() + Ops::step_codes - 1) / Ops::step_codes; }
  [[nodiscard]] std::size_t codes() const noexcept { return steps() * Ops::step_codes; }
  [[nodiscard]] std::size_t chunks() const noexcept {
    return (steps() + Format::chunk_steps - 1) / Format::chunk_steps;
  }

  /// codes() of a row, and chunks() parts of its squared norm. What the last step lacks is left as it is: zeros.
  void encode(const Rows& rows, std::size_t row, Code* codes, std::uint32_t* norms) const noexcept {
    constexpr std::size_t chunk_codes = Format::chunk_steps * Ops::step_codes;
    const std::uint8_t* const bytes = rows.bytes + row * rows.size;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      codes[i] = Format::code_of(number_at<Format::bits>(bytes, order_[i]));
      norms[i / chunk_codes] += Format::squared(codes[i]);
    }
  }

 private:
  std::vector<std::uint32_t> order_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_ROW_CODES_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Rows of the database that meet a panel at the same time, and registers of sums for each: few enough for the
/// registers that there are, many enough for each load to serve several.
inline constexpr std::size_t packed_tile = 4;
inline constexpr std::size_t packed_sums = 2;

/// All rows of a database as codes.
template <class Rows>
class PackedDatabase {
 public:
  using Format = CodesOf<Rows>;
  using Code = typename Format::Code;
  static constexpr std::size_t chunk_codes = Format::chunk_steps * Format::Ops::step_codes;

  explicit PackedDatabase(const Rows& rows)
      : codes_(rows), values_(rows.count * codes_.codes()), norms_(rows.count * codes_.chunks()) {
    for (std::size_t i = 0; i < rows.count; ++i) {
      codes_.encode(rows, i, values_.data() + i * row_codes(), norms_.data() + i * chunks());
    }
  }
  [[nodiscard]] const RowCodes<Rows>& codes() const noexcept { return codes_; }
  [[nodiscard]] std::size_t row_codes() const noexcept { return codes_.codes(); }
  [[nodiscard]] std::size_t chunks() const noexcept { return codes_.chunks(); }
  [[nodiscard]] std::size_t chunk_steps(std::size_t chunk) const noexcept {
    return std::min(Format::chunk_steps, codes_.steps() - chunk * Format::chunk_steps);
  }
  /// The codes of a row in a chunk.
  [[nodiscard]] const Code* at(std::size_t row, std::size_t chunk) const noexcept {
    return values_.data() + row * row_codes() + chunk * chunk_codes;
  }
  [[nodiscard]] std::uint32_t norm(std::size_t row, std::size_t chunk) const noexcept {
    return norms_[row * chunks() + chunk];
  }

 private:
  RowCodes<Rows> codes_;
  std::vector<Code> values_;
  std::vector<std::uint32_t> norms_;
};

/// The sums of a panel and one row.
template <class Ops>
struct PanelSums {
  typename Ops::Sums of[packed_sums];
};

/// Some queries side by side. Lanes without a query have codes 0.
template <class Rows>
class Panel {
 public:
  using Format = CodesOf<Rows>;
  using Ops = typename Format::Ops;
  using Code = typename Ops::Code;
  static constexpr std::size_t rows = packed_sums * Ops::rows;
  static constexpr std::size_t registers = rows / simd::lanes;
  static constexpr std::size_t step_cells = packed_sums * Ops::step_cells;
  static_assert(query_block % rows == 0, "whole panels");

  explicit Panel(const RowCodes<Rows>& codes)
      : codes_(&codes), cells_(codes.steps() * step_cells), norms_(codes.chunks() * rows), limits_(rows), all_(rows) {}

  void pack(const Rows& queries, std::size_t first) {
    std::vector<Code> row_codes(rows * codes_->codes());
    std::vector<std::uint32_t> row_norms(codes_->chunks());
    std::fill(norms_.begin(), norms_.end(), 0u);
    for (std::size_t k = 0; k < rows && first + k < queries.count; ++k) {
      std::fill(row_norms.begin(), row_norms.end(), 0u);
      codes_->encode(queries, first + k, row_codes.data() + k * codes_->codes(), row_norms.data());
      for (std::size_t c = 0; c < row_norms.size(); ++c) norms_[c * rows + k] = row_norms[c];
    }
    for (std::size_t step = 0; step < codes_->steps(); ++step) {
      for (std::size_t s = 0; s < packed_sums; ++s) {
        const Code* of_rows[Ops::rows];
        for (std::size_t k = 0; k < Ops::rows; ++k) {
          of_rows[k] = row_codes.data() + (s * Ops::rows + k) * codes_->codes() + step * Ops::step_codes;
        }
        Ops::pack(of_rows, cells_.data() + step * step_cells + s * Ops::step_cells);
      }
    }
  }
  /// To what the distance of one of the queries is to be below.
  void set_limit(std::size_t k, std::uint32_t limit) noexcept {
    limits_[k] = Format::query_limit(norms_[k], limit);
    all_[k] = Format::no_query_limit(norms_[k]);
  }
  /// May any of the queries be nearer to a row than its limit, or than the row's (0: that does not count), by the sums
  /// of the first chunk?
  [[nodiscard, gnu::always_inline]] bool any_near(const PanelSums<Ops>& sums, std::uint32_t norm,
                                                  std::uint32_t limit) const noexcept {
    return any_near(sums, limits_.data(), Format::no_row_limit(norm)) ||
           (limit > 0 && any_near(sums, all_.data(), Format::row_limit(norm, limit)));
  }
  [[nodiscard]] const typename Ops::Cell* cells(std::size_t chunk) const noexcept {
    return cells_.data() + chunk * Format::chunk_steps * step_cells;
  }
  [[nodiscard]] const std::uint32_t* norms(std::size_t chunk) const noexcept { return norms_.data() + chunk * rows; }

 private:
  using Limit = typename Format::Limit;
  [[nodiscard, gnu::always_inline]] static bool any_near(const PanelSums<Ops>& sums, const Limit* limits,
                                                         Limit of_row) noexcept {
    bool any = false;
    unroll<int{packed_sums}>([&](auto k) { any = any || Ops::any_near(sums.of[k], limits + k * Ops::rows, of_row); });
    return any;
  }

  const RowCodes<Rows>* codes_;
  std::vector<typename Ops::Cell> cells_;
  std::vector<std::uint32_t> norms_;
  std::vector<Limit> limits_;  // of the queries by themselves,
  std::vector<Limit> all_;     // and if only the row's counts
};

/// Some steps of a panel and of a tile of rows, from these codes on.
template <class Ops>
[[gnu::noinline]] void sum_up(const typename Ops::Cell* cells, const typename Ops::Code* const (&codes)[packed_tile],
                              std::size_t steps, PanelSums<Ops> (&out)[packed_tile]) noexcept {
  constexpr int tile = packed_tile;
  constexpr int width = packed_sums;
  typename Ops::Sums sums[packed_tile][packed_sums];
  const typename Ops::Code* row[packed_tile];
  unroll<tile>([&](auto r) {
    row[r] = codes[r];
    unroll<width>([&](auto k) { sums[r][k] = Ops::none(); });
  });
  for (std::size_t step = 0; step < steps; ++step) {
    unroll<tile>([&](auto r) SHORTSHOT_INLINE_LAMBDA {
      unroll<width>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
        sums[r][k] = Ops::add(sums[r][k], cells + k * Ops::step_cells, row[r] + step * Ops::step_codes);
      });
    });
    cells += packed_sums * Ops::step_cells;
  }
  unroll<tile>([&](auto r) { unroll<width>([&](auto k) { out[r].of[k] = sums[r][k]; }); });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_PACKED_PANELS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Rows of the database that meet a block of queries at a time.
inline constexpr std::size_t packed_row_block = 512;

/// Distances from 0 to 2^32 - 1 in the order of signed numbers, which is what registers compare.
[[nodiscard]] inline std::int32_t ordered(std::uint32_t distance) noexcept {
  return static_cast<std::int32_t>(distance ^ 0x80000000u);
}

/// What the distances of each query are compared with: the best so far. Queries that take no part have the least.
class PackedLimits {
 public:
  template <class Rows>
  explicit PackedLimits(const AnyRows<Rows>& queries)
      : limits_((queries.count() + query_block - 1) / query_block * query_block, 0x80000000u) {
    for (std::size_t q = 0; q < queries.count(); ++q) {
      if (queries.takes_part(q)) set(q, AnyRows<Rows>::farthest);
    }
  }
  void set(std::size_t query, std::uint32_t distance) noexcept { limits_[query] = distance ^ 0x80000000u; }
  [[nodiscard]] std::uint32_t of(std::size_t query) const noexcept { return limits_[query] ^ 0x80000000u; }
  [[nodiscard]] const std::uint32_t* from(std::size_t query) const noexcept { return limits_.data() + query; }

 private:
  std::vector<std::uint32_t> limits_;
};

/// Finds the pairs that are near: nearer than `limits` has for the query, or what `best_of_rows` (null: nothing) has
/// for the row.
template <class Rows>
struct NearPackedPairs {
  using Format = CodesOf<Rows>;
  using Ops = typename Format::Ops;
  static constexpr std::size_t registers = Panel<Rows>::registers;

  const AnyRows<Rows>& queries;
  const AnyRows<Rows>& database;
  const PackedDatabase<Rows>& codes;
  const PackedLimits& limits;
  const Candidate<std::uint32_t>* best_of_rows;  // as many for each thread as there are rows
  void (*consider)(const void* considering, std::size_t thread, std::size_t query, std::size_t row);
  const void* considering;

  /// What a thread needs: panels, and of the rows that are at a panel those that may be near, with how far they are
  /// from the queries at least.
  struct Memory {
    std::vector<Panel<Rows>> panels;
    std::vector<std::size_t> rows;
    std::vector<simd::I32> distances;

    explicit Memory(const RowCodes<Rows>& codes)
        : panels(query_block / Panel<Rows>::rows, Panel<Rows>(codes)),
          rows(packed_row_block),
          distances(packed_row_block * registers) {}
  };

  /// A block of queries and all rows.
  void meet_all(Memory& memory, std::size_t thread, std::size_t begin, std::size_t end) const {
    const std::size_t used = (end - begin + Panel<Rows>::rows - 1) / Panel<Rows>::rows;
    for (std::size_t i = 0; i < used; ++i) {
      const std::size_t query = begin + i * Panel<Rows>::rows;
      memory.panels[i].pack(queries.rows(), query);
      for (std::size_t k = 0; k < Panel<Rows>::rows; ++k) memory.panels[i].set_limit(k, limits.of(query + k));
    }
    for (std::size_t first = 0; first < database.count(); first += packed_row_block) {
      const std::size_t last = std::min(first + packed_row_block, database.count());
      for (std::size_t i = 0; i < used; ++i) {
        meet(memory, memory.panels[i], thread, begin + i * Panel<Rows>::rows, first, last);
      }
    }
  }

 private:
  /// The queries of a panel, which are those from `query` on, and a block of rows.
  void meet(Memory& memory, Panel<Rows>& panel, std::size_t thread, std::size_t query, std::size_t first,
            std::size_t last) const {
    std::size_t count = 0;
    for (std::size_t row = first; row < last; ++row) {
      if (database.takes_part(row)) memory.rows[count++] = row;
    }
    for (std::size_t chunk = 0; chunk < codes.chunks() && count > 0; ++chunk) {
      count = go_on(memory, panel, count, chunk, thread, query);
    }
    for (std::size_t i = 0; i < count; ++i) {
      consider_lanes(panel, thread, query, memory.rows[i], memory.distances.data() + i * registers);
    }
  }

  /// Adds a chunk for the first `count` rows; keeps those that may still be near.
  [[nodiscard]] std::size_t go_on(Memory& memory, const Panel<Rows>& panel, std::size_t count, std::size_t chunk,
                                  std::size_t thread, std::size_t query) const {
    std::size_t* const rows = memory.rows.data();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; i += packed_tile) {
      const typename Ops::Code* tile[packed_tile];
      for (std::size_t r = 0; r < packed_tile; ++r) tile[r] = codes.at(rows[std::min(i + r, count - 1)], chunk);
      PanelSums<Ops> sums[packed_tile];
      sum_up<Ops>(panel.cells(chunk), tile, codes.chunk_steps(chunk), sums);
      for (std::size_t r = 0; r < packed_tile && i + r < count; ++r) {
        const std::size_t row = rows[i + r];
        const std::uint32_t of_row = limit_of_row(thread, row);
        if (chunk == 0 && !panel.any_near(sums[r], codes.norm(row, 0), of_row)) continue;
        const simd::I32* const before = memory.distances.data() + (i + r) * registers;
        simd::I32 distances[registers];
        unroll<int{registers}>([&](auto k) { distances[k] = chunk == 0 ? simd::all_int(ordered(0)) : before[k]; });
        add(panel, row, chunk, sums[r], distances);
        if (chunk > 0 && !any(near(query, of_row, distances))) continue;
        simd::I32* const after = memory.distances.data() + kept * registers;
        unroll<int{registers}>([&](auto k) { after[k] = distances[k]; });
        rows[kept++] = row;
      }
    }
    return kept;
  }

  /// 0 if it does not count.
  [[nodiscard]] std::uint32_t limit_of_row(std::size_t thread, std::size_t row) const noexcept {
    return best_of_rows != nullptr ? best_of_rows[thread * database.count() + row].compared : 0;
  }

  /// Adds what a chunk adds to the distances.
  [[gnu::always_inline]] void add(const Panel<Rows>& panel, std::size_t row, std::size_t chunk,
                                  const PanelSums<Ops>& sums, simd::I32 (&distances)[registers]) const {
    constexpr std::size_t widened = Ops::rows / simd::lanes;
    const simd::I32 row_norm = simd::all_int(static_cast<std::int32_t>(codes.norm(row, chunk)));
    const std::uint32_t* const norms = panel.norms(chunk);
    unroll<int{packed_sums}>([&](auto s) {
      simd::I32 wide[widened];
      Ops::widen(sums.of[s], wide);
      unroll<int{widened}>([&](auto w) {
        constexpr std::size_t k = s * widened + w;
        const simd::I32 both = simd::load(norms + k * simd::lanes) + row_norm;
        distances[k] = distances[k] + Format::distances(both, wide[w]);
      });
    });
  }

  [[nodiscard, gnu::always_inline]] simd::Mask near(std::size_t query, std::uint32_t of_row,
                                                    const simd::I32 (&distances)[registers]) const {
    const std::uint32_t* const of_queries = limits.from(query);
    simd::Mask near = simd::load(of_queries) > distances[0];
    unroll<int{registers - 1}>(
        [&](auto k) { near = near | (simd::load(of_queries + (k + 1) * simd::lanes) > distances[k + 1]); });
    const simd::I32 limit = simd::all_int(ordered(of_row));
    if (of_row > 0) unroll<int{registers}>([&](auto k) { near = near | (limit > distances[k]); });
    return near;
  }

  /// All queries of a panel that are near.
  void consider_lanes(Panel<Rows>& panel, std::size_t thread, std::size_t query, std::size_t row,
                      const simd::I32* of_queries) const {
    const simd::I32 of_row = simd::all_int(ordered(limit_of_row(thread, row)));
    for (std::size_t k = 0; k < Panel<Rows>::rows; k += simd::lanes) {
      const simd::I32 distances = of_queries[k / simd::lanes];
      const simd::Mask near = (simd::load(limits.from(query + k)) > distances) | (of_row > distances);
      if (!any(near)) continue;
      float is_near[simd::lanes];
      simd::store(is_near, simd::keep(near, simd::all(1.0f)));
      for (std::size_t lane = 0; lane < simd::lanes && query + k + lane < queries.count(); ++lane) {
        if (is_near[lane] == 0.0f || !queries.takes_part(query + k + lane)) continue;
        consider(considering, thread, query + k + lane, row);
        panel.set_limit(k + lane, limits.of(query + k + lane));
      }
    }
  }
};

/// Calls consider(thread, query, row) for all pairs that take part and are nearer than the best so far, of the query or
/// (if there is one) of the row; one thread gets queries in ascending order for each row, and rows for each query.
template <class Executor, class Rows, class Consider>
void for_near(Executor& executor, std::size_t team, const AnyRows<Rows>& queries, const AnyRows<Rows>& database,
              const PackedLimits& limits, const Candidate<std::uint32_t>* best_of_rows, const Consider& consider) {
  const auto call = [](const void* considering, std::size_t thread, std::size_t query, std::size_t row) {
    (*static_cast<const Consider*>(considering))(thread, query, row);
  };
  const PackedDatabase<Rows> codes(database.rows());
  const NearPackedPairs<Rows> pairs{queries, database, codes, limits, best_of_rows, call, &consider};
  std::vector<typename NearPackedPairs<Rows>::Memory> memory;
  for (std::size_t t = 0; t < team; ++t) memory.emplace_back(codes.codes());
  for_blocks(executor, team, queries.count(), query_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    pairs.meet_all(memory[thread], thread, begin, end);
  });
}

template <class Rows>
struct PackedComparison : PairComparison<Rows> {
  using Limits = PackedLimits;
};
template <int Bits>
struct Comparison<CodedRows<Bits>> : PackedComparison<CodedRows<Bits>> {};
template <>
struct Comparison<BitRows> : PackedComparison<BitRows> {};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_COMPARE_PACKED_HPP

// shortshot/recognition/half_rows.hpp: borrowed rows of 16-bit floats, which are matched as the floats that they stand
// for. Hosted only: allocates.
#ifndef SHORTSHOT_RECOGNITION_HALF_ROWS_HPP
#define SHORTSHOT_RECOGNITION_HALF_ROWS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// `count` descriptors of `size` halves each, row by row without gaps, as quantize() makes them. Borrowed. Matching
/// makes floats of them, for as long as it lasts: of the queries and of the database.
struct HalfRows {
  const std::uint16_t* values;  ///< count * size
  std::size_t count;            ///< number of rows
  std::size_t size;             ///< halves in a row
  const Status* status;         ///< one per row: those that are not ok are left out; null: all are ok
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Descriptors as halves, which must outlive the rows; `status` as for codes.
template <class D>
[[nodiscard]] HalfRows rows_of(const std::vector<HalfDescriptor<D>>& descriptors,
                               const Status* status = nullptr) noexcept {
  static_assert(sizeof(HalfDescriptor<D>) == HalfDescriptor<D>::size_bytes, "rows without gaps");
  const auto* const values = reinterpret_cast<const std::uint16_t*>(descriptors.data());
  return {values, descriptors.size(), static_cast<std::size_t>(D::size), status};
}

/// ok or bad_rows, as for rows of floats.
[[nodiscard]] inline Status validate(const HalfRows& rows) noexcept {
  return rows.size > 0 && (rows.count == 0 || rows.values != nullptr) ? Status::ok : Status::bad_rows;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

struct HalvesAsFloats {
  std::vector<float> values;

  explicit HalvesAsFloats(const HalfRows& rows) : values(rows.count * rows.size) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = float_of_half(rows.values[i]);
  }
};

/// Rows of floats that own what they borrow.
class ComparedHalves : private HalvesAsFloats, public ComparedRows {
 public:
  explicit ComparedHalves(const HalfRows& rows)
      : HalvesAsFloats(rows), ComparedRows(DescriptorRows{values.data(), rows.count, rows.size, rows.status}) {}
  ComparedHalves(const ComparedHalves&) = delete;
  ComparedHalves& operator=(const ComparedHalves&) = delete;
};

template <>
struct Comparison<HalfRows> : FloatComparison<HalfRows, ComparedHalves> {};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_HALF_ROWS_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// In place of a row's number where there is none.
inline constexpr std::uint32_t no_row = 0xFFFFFFFFu;

/// A row of the database and its distance from the query.
struct Match {
  std::uint32_t row;  ///< in the database; no_row: none
  float distance;     ///< from the query, as its format counts; larger: farther
};

/// A row of each of two sets, and their distance.
struct MatchedPair {
  std::uint32_t source;  ///< row of the first set
  std::uint32_t target;  ///< row of the second set
  float distance;        ///< as their format counts
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Rows, class Number>
[[nodiscard]] float distance_of(const Rows& rows, const Candidate<Number>& candidate) {
  if (candidate.row == no_row) return std::numeric_limits<float>::infinity();
  return Comparison<Rows>::distance(rows, candidate.compared);
}

/// ok or bad_rows.
template <class Rows>
[[nodiscard]] Status check_comparable(const Rows& a, const Rows& b) {
  constexpr bool is_float = std::is_same<Rows, DescriptorRows>::value || std::is_same<Rows, HalfRows>::value;
  if constexpr (!is_float) require_row_format<Rows>();
  const bool numbered = a.count < no_row && b.count < no_row;
  return numbered && Comparison<Rows>::fit(a, b) ? Status::ok : Status::bad_rows;
}

template <class Executor>
[[nodiscard]] std::size_t team_of(const Executor& executor) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
}

/// Blocks of queries, of which there are `count`.
[[nodiscard]] inline std::size_t query_blocks(std::size_t count) noexcept {
  return (count + query_block - 1) / query_block;
}

/// Puts a candidate that is nearer than the last of k, which are in ascending order, behind those that are as near.
template <class Number>
void insert(Candidate<Number>* best, std::size_t k, const Candidate<Number>& candidate) noexcept {
  std::size_t at = k - 1;
  for (; at > 0 && candidate.compared < best[at - 1].compared; --at) best[at] = best[at - 1];
  best[at] = candidate;
}

/// The nearest candidate of each of `count` rows, among those that all threads have seen, to where the first one's is.
template <class Number>
void merge(std::vector<Candidate<Number>>& seen, std::size_t count) noexcept {
  for (std::size_t i = count; i < seen.size(); ++i) {
    const Candidate<Number>& candidate = seen[i];
    Candidate<Number>& best = seen[i % count];
    const bool nearer = candidate.compared < best.compared;
    if (nearer || (candidate.compared == best.compared && candidate.row < best.row)) best = candidate;
  }
}

/// k for each query, nearest first; no_row where there is none.
template <class Rows, class Executor>
[[nodiscard]] auto nearest_candidates(const Rows& queries, const Rows& database, std::size_t k, Executor& executor) {
  using Compared = typename Comparison<Rows>::Compared;
  using Number = typename Compared::Number;
  const Compared from(queries);
  const Compared to(database);
  typename Comparison<Rows>::Limits limits(from);
  std::vector<Candidate<Number>> best(queries.count * k, {no_row, Compared::farthest});
  for_near(executor, team_of(executor), from, to, limits, nullptr, [&](std::size_t, std::size_t q, std::size_t row) {
    Candidate<Number>* const of_query = best.data() + q * k;
    const Number compared = from.compare(q, to, row);
    if (!(compared < of_query[k - 1].compared)) return;
    insert(of_query, k, {static_cast<std::uint32_t>(row), compared});
    limits.set(q, of_query[k - 1].compared);
  });
  return best;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The k nearest rows of the database for each query, nearest first; of rows at the same distance the first ones come
/// first. Exact: as if all distances were computed.
///
/// `queries`, `database`  DescriptorRows, HalfRows, CodedRows (ByteRows, NibbleRows) or BitRows (see rows_of()), or
/// rows
///            in a format of your own
///            (extend::is_row_format). Distances are L2 for floats (sums of squared differences in float, in a fixed
///            order: l2_distance()), for bytes and nibbles, Hamming for bits
/// `k`        from 1 on; meant to be small (an insertion costs O(k))
/// `out`      queries.count * k: those of query i from out[i * k] on. {no_row, infinity} where the database has too few
///            rows that take part, or where the query does not. A row takes part if its status is ok; one of floats, if
///            its squared norm is finite and below 4e37 besides
/// `threads`  how many threads share the work, or an executor (see extract()); the result is the same, bit for bit, for
///            any number, and on every machine
///
/// Statuses: bad_rows (null pointers, rows of different or no length, 2^32 - 1 rows or more), bad_option (k, or more
/// results than memory has room for); `out` is empty then. O(queries.count * database.count * size), for floats at the
/// speed of Eigen's matrix product, for bytes, nibbles and bits in blocks as well, which stop early where all are far;
/// a database in the order of falling distances, or of copies, costs the distance of each pair on top of it. Allocates
/// `out` twice; for floats also 8 bytes for each query, 4 for each row of the database, and 512 for each value of a row
/// and each thread; for bytes, nibbles and bits 4 bytes for each query, 1 or 2 for each value (or 4 bits) of the
/// database, and for each thread some hundred KB and 256 bytes (SSE2, bits: 2 KB) for each value. May throw what
/// extract() may.
template <class Rows = DescriptorRows, class Threads = unsigned>
[[nodiscard]] Status nearest(const Rows& queries, const Rows& database, std::size_t k, std::vector<Match>& out,
                             Threads&& threads = 1u) {
  out.clear();
  const Status usable = detail::check_comparable(queries, database);
  if (usable != Status::ok) return usable;
  if (k == 0 || queries.count > out.max_size() / 2 / k) return Status::bad_option;

  auto&& executor = detail::executor_of(threads, detail::query_blocks(queries.count));
  const auto best = detail::nearest_candidates(queries, database, k, executor);
  out.assign(best.size(), {no_row, std::numeric_limits<float>::infinity()});  // distances of one's own may throw
  for (std::size_t i = 0; i < best.size(); ++i) out[i] = {best[i].row, detail::distance_of(queries, best[i])};
  return Status::ok;
}

/// The pairs of rows that are each other's nearest neighbor as nearest() has it, in ascending order of the source: one
/// pass over all pairs gives both directions.
///
/// Formats of rows, `threads`, statuses, the rows that take part and cost: as for nearest(). Allocates `out`, 8 bytes
/// for each row of the source, and for each row of the target and each thread; besides what nearest() does.
template <class Rows = DescriptorRows, class Threads = unsigned>
[[nodiscard]] Status reciprocal_correspondences(const Rows& source, const Rows& target, std::vector<MatchedPair>& out,
                                                Threads&& threads = 1u) {
  using Compared = typename detail::Comparison<Rows>::Compared;
  using Number = typename Compared::Number;
  out.clear();
  const Status usable = detail::check_comparable(source, target);
  if (usable != Status::ok) return usable;

  const Compared from(source);
  const Compared to(target);
  auto&& executor = detail::executor_of(threads, detail::query_blocks(source.count));
  const std::size_t team = detail::team_of(executor);
  const detail::Candidate<Number> none{no_row, Compared::farthest};
  typename detail::Comparison<Rows>::Limits limits(from);
  std::vector<detail::Candidate<Number>> of_source(source.count, none);
  std::vector<detail::Candidate<Number>> of_target(team * target.count, none);  // what each thread has seen
  const auto consider = [&](std::size_t thread, std::size_t s, std::size_t t) {
    const Number compared = from.compare(s, to, t);
    detail::Candidate<Number>& nearest_source = of_target[thread * target.count + t];
    if (compared < nearest_source.compared) nearest_source = {static_cast<std::uint32_t>(s), compared};
    if (!(compared < of_source[s].compared)) return;
    of_source[s] = {static_cast<std::uint32_t>(t), compared};
    limits.set(s, compared);
  };
  detail::for_near(executor, team, from, to, limits, of_target.data(), consider);
  detail::merge(of_target, target.count);
  for (std::size_t s = 0; s < source.count; ++s) {
    const detail::Candidate<Number>& candidate = of_source[s];
    if (candidate.row == no_row || of_target[candidate.row].row != s) continue;
    out.push_back({static_cast<std::uint32_t>(s), candidate.row, detail::distance_of(source, candidate)});
  }
  return Status::ok;
}

/// The pairs of each row of the source with its nearest one of the target, as nearest() has it, that are told from all
/// others: the distance is below `ratio` times that of the second nearest. In ascending order of the source.
///
/// After D. Lowe: Distinctive image features from scale-invariant keypoints (IJCV 60, 2004), where 0.8 is the ratio.
///
/// `ratio`  above 0, at most 1, which leaves out only rows whose two nearest are as near. Distances are compared as
///          Match has them, the product rounded to float: the same pairs on every machine. A target of fewer than two
///          rows that take part has no second nearest, and there is no pair: nothing says that one would be right
///
/// Formats of rows, `threads`, the rows that take part and cost: as for nearest(). Statuses: bad_rows, as there, and
/// bad_option (ratio); `out` is empty then. Allocates `out`, 16 bytes for each row of the source, and what nearest()
/// does besides.
template <class Rows = DescriptorRows, class Threads = unsigned>
[[nodiscard]] Status ratio_correspondences(const Rows& source, const Rows& target, float ratio,
                                           std::vector<MatchedPair>& out, Threads&& threads = 1u) {
  out.clear();
  const Status usable = detail::check_comparable(source, target);
  if (usable != Status::ok) return usable;
  if (!(ratio > 0.0f && ratio <= 1.0f)) return Status::bad_option;

  auto&& executor = detail::executor_of(threads, detail::query_blocks(source.count));
  const auto best = detail::nearest_candidates(source, target, 2, executor);
  for (std::size_t s = 0; s < source.count; ++s) {
    const auto& first = best[2 * s];
    const auto& second = best[2 * s + 1];
    if (second.row == no_row) continue;
    const float distance = detail::distance_of(source, first);
    if (!(distance < extend::unfused(ratio * detail::distance_of(source, second)))) continue;
    out.push_back({static_cast<std::uint32_t>(s), first.row, distance});
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_MATCH_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Every descriptor of a training view is a codeword.
struct Codebook {
  struct Codeword {
    std::uint32_t instance;
    Point center;  // of the training view, in the key point's frame
  };

  std::string layout;
  std::size_t row_size = 0;
  std::vector<std::string> classes;
  std::vector<std::string> instances;
  std::vector<std::uint32_t> class_of;  // of each instance
  std::vector<Codeword> codewords;
  std::vector<float> values;         // codewords.size() * row_size, or
  std::vector<std::uint8_t> packed;  // as many bytes, if descriptors are stored as codes or bits
};

/// Rows in any format, with places and frames: one of each a row.
template <class Rows>
struct PlacedRows {
  Rows descriptors;
  const KeyPoint* keypoints;
  const Frame* frames;
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

[[nodiscard]] inline bool is_finite(const float* values, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    if (!math::is_finite(values[i])) return false;
  }
  return true;
}

/// Rows that there are, and descriptors that can be compared: all of their values are finite. ok or bad_rows.
[[nodiscard]] inline Status check_values(const DescriptorRows& rows) noexcept {
  Status status = validate(rows);
  for (std::size_t row = 0; row < rows.count && status == Status::ok; ++row) {
    if (is_ok(rows, row) && !is_finite(rows.values + row * rows.size, rows.size)) status = Status::bad_rows;
  }
  return status;
}

template <int Bits>
[[nodiscard]] Status check_values(const CodedRows<Bits>& rows) noexcept {
  return validate(rows);
}
[[nodiscard]] inline Status check_values(const BitRows& rows) noexcept { return validate(rows); }

/// The same, with places and frames that one can cast a vote from: also invalid_keypoint and bad_frame.
template <class Rows>
[[nodiscard]] Status check_values(const PlacedRows<Rows>& rows) noexcept {
  const bool is_complete = rows.descriptors.count == 0 || (rows.keypoints != nullptr && rows.frames != nullptr);
  Status status = is_complete ? check_values(rows.descriptors) : Status::bad_rows;
  for (std::size_t row = 0; row < rows.descriptors.count && status == Status::ok; ++row) {
    if (!is_ok(rows.descriptors, row)) continue;
    status = is_finite(rows.keypoints[row].position) ? validate(rows.frames[row]) : Status::invalid_keypoint;
  }
  return status;
}

/// The codewords as rows that can be compared with these, which are of the same layout.
[[nodiscard]] inline DescriptorRows rows_like(const DescriptorRows&, const Codebook& codebook) noexcept {
  return {codebook.values.data(), codebook.codewords.size(), codebook.row_size, nullptr};
}
template <int Bits>
[[nodiscard]] CodedRows<Bits> rows_like(const CodedRows<Bits>& rows, const Codebook& codebook) noexcept {
  return {codebook.packed.data(), codebook.codewords.size(), codebook.row_size, rows.step, nullptr};
}
[[nodiscard]] inline BitRows rows_like(const BitRows&, const Codebook& codebook) noexcept {
  return {codebook.packed.data(), codebook.codewords.size(), codebook.row_size, nullptr};
}

/// Appends a row to what the codebook has.
inline void append(Codebook& codebook, const DescriptorRows& rows, std::size_t row) {
  const float* const values = rows.values + row * rows.size;
  codebook.values.insert(codebook.values.end(), values, values + rows.size);
}
template <class Rows>
void append(Codebook& codebook, const Rows& rows, std::size_t row) {
  const std::uint8_t* const bytes = rows.bytes + row * rows.size;
  codebook.packed.insert(codebook.packed.end(), bytes, bytes + rows.size);
}

/// Are these the descriptors that it was made of?
[[nodiscard]] inline Status validate_queries(const Codebook& codebook, std::size_t row_size, bool are_packed,
                                             std::string_view layout) noexcept {
  if (codebook.codewords.empty()) return Status::not_trained;
  const bool alike = row_size == codebook.row_size && are_packed == !codebook.packed.empty();
  return alike && layout == codebook.layout ? Status::ok : Status::other_descriptor;
}

/// The number of a class, or of an instance; a new one if there is none of that name.
[[nodiscard]] inline std::uint32_t class_number(Codebook& codebook, std::string_view name) {
  const std::size_t count = codebook.classes.size();
  std::size_t number = 0;
  while (number < count && codebook.classes[number] != name) ++number;
  if (number == count) codebook.classes.push_back(std::string(name));
  return static_cast<std::uint32_t>(number);
}
[[nodiscard]] inline std::uint32_t instance_number(Codebook& codebook, std::uint32_t object_class,
                                                   std::string_view name) {
  const std::size_t count = codebook.instances.size();
  const auto is_it = [&](std::size_t i) {
    return codebook.class_of[i] == object_class && codebook.instances[i] == name;
  };
  std::size_t number = 0;
  while (number < count && !is_it(number)) ++number;
  if (number == count) {
    codebook.instances.push_back(std::string(name));
    codebook.class_of.push_back(object_class);
  }
  return static_cast<std::uint32_t>(number);
}

/// Adds the rows, which were validated, of an object of which `center` is the center. All or nothing.
template <class Rows>
[[nodiscard]] Status add(Codebook& codebook, const PlacedRows<Rows>& rows, const Point& center,
                         std::string_view object_class, std::string_view instance) {
  const Rows& descriptors = rows.descriptors;
  std::vector<Point> centers(descriptors.count);
  std::size_t added = 0;
  for (std::size_t row = 0; row < descriptors.count; ++row) {
    if (!is_ok(descriptors, row)) continue;
    centers[row] = to_local(center, rows.keypoints[row].position, rows.frames[row]);
    if (!shortshot::is_finite(centers[row])) return Status::invalid_keypoint;  // farther away than floats reach
    ++added;
  }
  if (added == 0) return Status::ok;
  if (added >= no_row - codebook.codewords.size()) return Status::bad_rows;

  const std::string name(instance);  // a copy: the view may be of a name in the codebook, which a new class moves
  const std::uint32_t number = instance_number(codebook, class_number(codebook, object_class), name);
  for (std::size_t row = 0; row < descriptors.count; ++row) {
    if (!is_ok(descriptors, row)) continue;
    append(codebook, descriptors, row);
    codebook.codewords.push_back({number, centers[row]});
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_CODEBOOK_HPP

// shortshot/recognition/recognizer.hpp: what has been learned of objects: an implicit shape model, whose descriptors
// vote for the centers of objects. recognize.hpp trains and asks it. Hosted only.
//
// After B. Leibe, A. Leonardis, B. Schiele: Robust object detection with interleaved categorization and segmentation
// (IJCV 77, 2008), with local reference frames in 3-D as in F. Tombari, L. Di Stefano: Object recognition in 3D scenes
// with occlusions and clutter by Hough voting (PSIVT 2010).
#ifndef SHORTSHOT_RECOGNITION_RECOGNIZER_HPP
#define SHORTSHOT_RECOGNITION_RECOGNIZER_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

struct RecognizerAccess;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// The share that each class, and each instance, has in the codewords that were activated: 0 to 1, all of them 1
/// together, or all zero if none was.
struct ActivationShares {
  std::vector<float> classes;    ///< one per class, by number
  std::vector<float> instances;  ///< one per instance, by number
};

/// Recognizes objects by their descriptors. Every descriptor of the training views is a codeword. One of a new view
/// activates those that are nearest (L2), and each of these votes for the place where its object's center would be: as
/// it lay in the key point's local reference frame in training. Votes for a class gather at the centers of its objects;
/// mean shift finds where they are densest.
///
/// Objects have a class ("mug") and an instance ("red mug"); an instance is known by both names together. For which
/// descriptor a recognizer is, is said by the first training view: the text `layout` (layout_of(), with whatever else
/// two descriptors must have in common to be compared) and the number of values. Radii, and how frames are turned, must
/// be the same in training and afterwards.
///
/// Descriptors may be stored smaller (StoredFeatures); then they are compared as they are stored.
///
/// train() makes one, recognize() and activation_shares() ask it, save() and load() keep it. Calls that do not change
/// it may run at the same time. All may throw what extract() may; a recognizer that ran out of memory in train() can
/// only be assigned to or destroyed.
class Recognizer {
 public:
  Recognizer() = default;
  /// Not trained yet. Wrong options are bad_option when it is asked.
  explicit Recognizer(const RecognizerOptions& options) noexcept : options_(options) {}

  /// One that was moved from has its options still, and was never trained.
  Recognizer(Recognizer&& other) noexcept : options_(other.options_) { std::swap(codebook_, other.codebook_); }
  Recognizer(const Recognizer& other) = default;
  Recognizer& operator=(Recognizer other) noexcept {
    std::swap(options_, other.options_);
    std::swap(codebook_, other.codebook_);
    return *this;
  }
  ~Recognizer() = default;

  /// What it was made with, or set_options() gave.
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return options_; }
  /// For calls to come; the training stays as it is.
  void set_options(const RecognizerOptions& options) noexcept { options_ = options; }

  /// Classes, instances and codewords of all training so far.
  [[nodiscard]] std::size_t class_count() const noexcept { return codebook_.classes.size(); }
  [[nodiscard]] std::size_t instance_count() const noexcept { return codebook_.instances.size(); }
  [[nodiscard]] std::size_t codeword_count() const noexcept { return codebook_.codewords.size(); }
  /// For numbers below class_count() and instance_count(), in the order of training.
  [[nodiscard]] const std::string& class_name(std::size_t object_class) const {
    return codebook_.classes[object_class];
  }
  [[nodiscard]] const std::string& instance_name(std::size_t instance) const { return codebook_.instances[instance]; }
  [[nodiscard]] std::uint32_t class_of(std::size_t instance) const { return codebook_.class_of[instance]; }

  /// What the first training view's descriptors were, and how many values they had; empty and 0 before it.
  [[nodiscard]] const std::string& layout() const noexcept { return codebook_.layout; }
  [[nodiscard]] std::size_t row_size() const noexcept { return codebook_.row_size; }

 private:
  friend struct detail::RecognizerAccess;

  RecognizerOptions options_;
  detail::Codebook codebook_;
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The inside of a recognizer, for train(), recognize(), save() and load().
struct RecognizerAccess {
  [[nodiscard]] static const Codebook& codebook(const Recognizer& recognizer) noexcept { return recognizer.codebook_; }
  [[nodiscard]] static Codebook& codebook(Recognizer& recognizer) noexcept { return recognizer.codebook_; }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_RECOGNIZER_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr FileKind flash_model_file{{flash_model_magic, 8}, flash_model_version};

/// The smallest power of two of which 16 bits reach all centers; at least 2^-100.
[[nodiscard]] inline float unit_of_centers(const std::vector<Codebook::Codeword>& codewords) noexcept {
  float farthest = 0.0f;
  for (const Codebook::Codeword& codeword : codewords) {
    for (const float c : {codeword.center.x, codeword.center.y, codeword.center.z})
      farthest = std::max(farthest, std::abs(c));
  }
  float unit = std::ldexp(1.0f, -99);
  while (32767.0f * unit < farthest && unit < 1e29f) unit *= 2.0f;
  return unit;
}

[[nodiscard]] inline bool fits_flash(const Codebook& codebook) noexcept {
  const auto has_zero = [](const std::string& text) { return text.find(char{0}) != std::string::npos; };
  for (const std::vector<std::string>* const names : {&codebook.classes, &codebook.instances}) {
    if (names->size() > 65536) return false;
    for (const std::string& name : *names) {
      if (has_zero(name)) return false;
    }
  }
  return !has_zero(codebook.layout);
}

/// What stands behind the codewords.
[[nodiscard]] inline std::string flash_text(const Codebook& codebook) {
  std::string text = codebook.layout + char{0};
  for (const std::string& name : codebook.classes) text += name + char{0};
  for (const std::string& name : codebook.instances) text += name + char{0};
  return text;
}

/// How many codewords a model has that is no larger, with all names.
template <class Stored>
[[nodiscard]] std::size_t codewords_in_flash(const Codebook& codebook, std::size_t most_bytes) {
  constexpr auto row_bytes = static_cast<std::uint32_t>(sizeof(Stored));
  constexpr std::uint32_t numbers = 8 * row_bytes / Storage<Stored>::number_bits;
  const auto text_bytes = static_cast<std::uint32_t>(flash_text(codebook).size());
  const FlashLayout empty(row_bytes, numbers, 0, static_cast<std::uint32_t>(codebook.instances.size()), text_bytes);
  const std::uint64_t most = most_bytes / 4 * 4;
  if (most < empty.checksum + checksum_bytes) return 0;
  return static_cast<std::size_t>((most - checksum_bytes - empty.text - text_bytes) /
                                  (FlashLayout::before_row + row_bytes));
}

/// Is the order of a row's numbers one? (On a board, an order that is none does no harm.)
template <class Stored>
[[nodiscard]] bool is_permutation(const ModelView<Stored>& model) {
  std::vector<bool> known(model.number_count());
  for (std::uint32_t i = 0; i < model.number_count(); ++i) known[model.place_of(i)] = true;
  return std::find(known.begin(), known.end(), false) == known.end();
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A trained recognizer of descriptors in a storage of bytes (StoredFeatures of codes or bits), as ModelView reads it:
/// one byte sequence, the same on every machine (see flash_model.hpp). A codeword takes its descriptor and 8 bytes: its
/// center is kept in 16 bits a coordinate, in steps of at most a 32,000th of how far the farthest center lies from its
/// key point.
///
/// Statuses: not_trained, bad_option, other_descriptor (than storage_layout<Stored>()), bad_rows (2^32 bytes or
/// more, more than 65536 names of a kind, a name with a character 0, a center farther away than 1e33 m); `bytes` is
/// empty then. Allocates the bytes.
template <class Stored>
[[nodiscard]] Status save_for_flash(const Recognizer& recognizer, std::vector<std::uint8_t>& bytes) {
  const detail::Codebook& codebook = detail::RecognizerAccess::codebook(recognizer);
  bytes.clear();
  if (codebook.codewords.empty()) return Status::not_trained;
  if (validate(recognizer.options()) != Status::ok) return Status::bad_option;
  if (codebook.layout != storage_layout<Stored>()) return Status::other_descriptor;
  if (!detail::fits_flash(codebook)) return Status::bad_rows;
  const float unit = detail::unit_of_centers(codebook.codewords);
  if (unit > 1e29f) return Status::bad_rows;

  constexpr int bits = detail::Storage<Stored>::number_bits;
  const std::vector<std::uint32_t> order =
      detail::most_telling_first<bits>(codebook.packed.data(), codebook.codewords.size(), sizeof(Stored),
                                       [](unsigned a, unsigned b) { return (a - b) * (a - b); });
  const std::string text = detail::flash_text(codebook);
  const std::uint64_t most = 0xFFFFFFFFu;
  if (codebook.codewords.size() > most || text.size() > most) return Status::bad_rows;
  detail::FlashHeader header{0,
                             detail::storage_number<Stored>,
                             recognizer.options(),
                             sizeof(Stored),
                             bits,
                             static_cast<std::uint32_t>(codebook.codewords.size()),
                             static_cast<std::uint32_t>(codebook.instances.size()),
                             static_cast<std::uint32_t>(codebook.classes.size()),
                             static_cast<std::uint32_t>(text.size()),
                             unit};
  const detail::FlashLayout layout = header.layout();
  const std::uint64_t size_bytes = layout.checksum + detail::checksum_bytes;
  if (size_bytes > most) return Status::bad_rows;

  detail::ByteWriter to(bytes, detail::flash_model_file, static_cast<std::size_t>(size_bytes));
  header.size_bytes = static_cast<std::uint32_t>(size_bytes);
  detail::write(to, header);
  for (const std::uint32_t object_class : codebook.class_of) to.number(static_cast<std::uint16_t>(object_class));
  to.pad(static_cast<std::size_t>(layout.order));
  for (const std::uint32_t place : order) to.number(static_cast<std::uint16_t>(place));
  to.pad(static_cast<std::size_t>(layout.codewords));
  const std::uint8_t* row = codebook.packed.data();
  for (const detail::Codebook::Codeword& codeword : codebook.codewords) {
    detail::write_codeword(to, codeword.instance, codeword.center, unit);
    Stored arranged;
    detail::arrange<bits>(row, arranged.bytes, sizeof arranged.bytes, [&](std::size_t i) { return order[i]; });
    for (const std::uint8_t byte : arranged.bytes) to.number(byte);
    row += sizeof(Stored);
  }
  for (const char c : text) to.number(static_cast<std::uint8_t>(c));
  to.pad(static_cast<std::size_t>(layout.checksum));
  to.finish();
  return Status::ok;
}

/// The recognizer that gives the hypotheses that a MicroRecognizer gives with the model, also with what was learned on
/// the spot (LearnedObjects::model()), bit for bit: of its codewords, with centers as they were rounded.
///
/// Statuses: not_trained (no model is open), damaged_model (the order of a row's numbers is none); `out` has not
/// changed then. Allocates a few times the bytes at the most.
template <class Stored>
[[nodiscard]] Status load_from_flash(const ModelView<Stored>& model, Recognizer& out) {
  if (model.codeword_count() == 0) return Status::not_trained;
  if (!detail::is_permutation(model)) return Status::damaged_model;
  Recognizer loaded(model.options());
  detail::Codebook& codebook = detail::RecognizerAccess::codebook(loaded);
  codebook.layout = storage_layout<Stored>();
  codebook.row_size = sizeof(Stored);
  for (std::uint32_t i = 0; i < model.class_count(); ++i) codebook.classes.emplace_back(model.class_name(i));
  for (std::uint32_t i = 0; i < model.instance_count(); ++i) {
    codebook.instances.emplace_back(model.instance_name(i));
    codebook.class_of.push_back(model.class_of(i));
  }
  for (std::uint32_t i = 0; i < model.codeword_count(); ++i) {
    codebook.codewords.push_back({model.instance_of(i), model.center_of(i)});
    const Stored stored = model.descriptor(i);
    codebook.packed.insert(codebook.packed.end(), stored.bytes, stored.bytes + sizeof stored.bytes);
  }
  out = std::move(loaded);
  return Status::ok;
}

/// The same of the bytes that save_for_flash() has written. Also not_a_model, other_version, other_descriptor.
template <class Stored>
[[nodiscard]] Status load_from_flash(const std::uint8_t* bytes, std::size_t size_bytes, Recognizer& out) {
  ModelView<Stored> model;
  const Status status = model.open(bytes, size_bytes);
  return status == Status::ok ? load_from_flash(model, out) : status;
}

/// The bytes of a model as a C++ header: `alignas(4) constexpr unsigned char NAME[] = {...};`. `name` is a C++
/// identifier. Allocates some four times the bytes.
[[nodiscard]] inline std::string flash_model_header(const std::vector<std::uint8_t>& bytes, std::string_view name) {
  std::string text =
      "// A model for shortshot::ModelView, by save_for_flash().\n#pragma once\n\nalignas(4) inline constexpr unsigned "
      "char ";
  text += name;
  text += "[] = {";
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += i % 24 == 0 ? "\n    " : " ";
    text += std::to_string(bytes[i]);
    text += ',';
  }
  text += "\n};\n";
  return text;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_FLASH_MODEL_FILE_HPP

// shortshot/recognition/pose.hpp: the rigid motion that takes points to their correspondences, some of which are wrong,
// by RANSAC. Hosted only: allocates.
#ifndef SHORTSHOT_RECOGNITION_POSE_HPP
#define SHORTSHOT_RECOGNITION_POSE_HPP

// shortshot/recognition/fit_pose.hpp: the rigid motion that takes points to their correspondences, by least squares.
// Hosted only.
#ifndef SHORTSHOT_RECOGNITION_FIT_POSE_HPP
#define SHORTSHOT_RECOGNITION_FIT_POSE_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A rigid motion: target = rotation * source + translation, in meters. Trivial type.
struct Pose {
  float rotation[9];     ///< row by row; orthonormal, determinant +1
  float translation[3];  ///< meters
};

/// Two points that may be the same one of an object, before and after its motion.
struct PointPair {
  Point source;  ///< before
  Point target;  ///< after
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Where a motion takes a point.
[[nodiscard]] inline Point transform_point(const Pose& pose, const Point& p) noexcept {
  const auto component = [&](std::size_t row) {
    const float* const r = pose.rotation + 3 * row;
    return ((extend::unfused(r[0] * p.x) + extend::unfused(r[1] * p.y)) + extend::unfused(r[2] * p.z)) +
           pose.translation[row];
  };
  return {component(0), component(1), component(2)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Pairs, borrowed.
class PairsView {
 public:
  template <class Pairs>
  explicit PairsView(const Pairs& pairs) noexcept : data_(pairs.data()), size_(pairs.size()) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const PointPair& operator[](std::size_t i) const noexcept { return data_[i]; }
  [[nodiscard]] const PointPair* begin() const noexcept { return data_; }
  [[nodiscard]] const PointPair* end() const noexcept { return data_ + size_; }

 private:
  const PointPair* data_;
  std::size_t size_;
};

/// ok, too_few_pairs or invalid_keypoint.
[[nodiscard]] inline Status check_pairs(const PairsView& pairs) noexcept {
  if (pairs.size() < 3) return Status::too_few_pairs;
  for (const PointPair& pair : pairs) {
    if (!is_finite(pair.source) || !is_finite(pair.target)) return Status::invalid_keypoint;
  }
  return Status::ok;
}

[[nodiscard]] inline Point operator-(const Point& a, const Point& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// The mean of one of the points of each pair. Offsets from the first are summed up: clouds may lie far from the
/// origin.
[[nodiscard]] inline Point centroid(const PairsView& pairs, Point PointPair::*point) noexcept {
  const Point first = pairs[0].*point;
  Point sum{};
  for (const PointPair& pair : pairs) {
    const Point offset = pair.*point - first;
    sum = {sum.x + offset.x, sum.y + offset.y, sum.z + offset.z};
  }
  const auto n = static_cast<float>(pairs.size());
  return {first.x + sum.x / n, first.y + sum.y / n, first.z + sum.z / n};
}

/// The rotation that a unit quaternion (w, x, y, z) stands for, row by row.
inline void rotation_of(const float (&q)[4], float (&rotation)[9]) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;  // the axes after axis i, in cyclic order
    const std::size_t k = (i + 2) % 3;
    const auto product = [&q](std::size_t a, std::size_t b) { return unfused(q[a] * q[b]); };
    rotation[3 * i + i] = 1.0f - unfused(2.0f * (product(1 + j, 1 + j) + product(1 + k, 1 + k)));
    rotation[3 * i + j] = 2.0f * (product(1 + i, 1 + j) - product(0, 1 + k));
    rotation[3 * i + k] = 2.0f * (product(1 + i, 1 + k) + product(0, 1 + j));
  }
}

/// The rotation that best aligns points with a given covariance, source by target: of the unit quaternions that with
/// the largest value of a quadratic form (Horn 1987), hence an eigenvector. ok or no_pose.
[[nodiscard]] inline Status best_rotation(const float (&covariance)[3][3], float (&rotation)[9]) noexcept {
  using simd::all;
  float scale = 0.0f;
  for (const auto& row : covariance) {
    for (const float value : row) scale += __builtin_fabsf(value);
  }
  if (!math::is_finite(scale) || !(scale >= std::numeric_limits<float>::min())) return Status::no_pose;
  const auto c = [&](std::size_t i, std::size_t k) { return covariance[i][k] / scale; };
  const SymmetricMatrices<4> form{{all((c(0, 0) + c(1, 1)) + c(2, 2)), all(c(1, 2) - c(2, 1)), all(c(2, 0) - c(0, 2)),
                                   all(c(0, 1) - c(1, 0)), all((c(0, 0) - c(1, 1)) - c(2, 2)), all(c(0, 1) + c(1, 0)),
                                   all(c(2, 0) + c(0, 2)), all((c(1, 1) - c(0, 0)) - c(2, 2)), all(c(1, 2) + c(2, 1)),
                                   all((c(2, 2) - c(0, 0)) - c(1, 1))}};
  const Eigenvectors<4> eigen = decompose(form);
  const auto number = [](simd::F32 lanes) { return simd::largest(lanes); };  // all of them are the same

  // Two rotations that align equally well: points on a line, or the mirror image of something symmetric.
  const float quality = number(eigen.value(3));
  constexpr float tolerance = 1e-5f;  // a hundred times float's rounding
  if (!(quality - number(eigen.value(2)) > tolerance * quality)) return Status::no_pose;
  rotation_of(
      {number(eigen.vector(3, 0)), number(eigen.vector(3, 1)), number(eigen.vector(3, 2)), number(eigen.vector(3, 3))},
      rotation);
  return Status::ok;
}

/// Least squares for three pairs or more, all finite.
[[nodiscard]] inline Status align(const PairsView& pairs, Pose& pose) noexcept {
  pose = Pose{};
  const Point source = centroid(pairs, &PointPair::source);
  const Point target = centroid(pairs, &PointPair::target);
  if (!is_finite(source) || !is_finite(target)) return Status::no_pose;
  float covariance[3][3] = {};
  for (const PointPair& pair : pairs) {
    const Point s = pair.source - source;
    const Point t = pair.target - target;
    for (std::size_t k = 0; k < 9; ++k) {
      covariance[k / 3][k % 3] += unfused(coordinate(s, k / 3) * coordinate(t, k % 3));
    }
  }
  Pose aligned{};
  const Status status = best_rotation(covariance, aligned.rotation);
  if (status != Status::ok) return status;
  const Point translation = target - transform_point(aligned, source);
  if (!is_finite(translation)) return Status::no_pose;
  for (std::size_t k = 0; k < 3; ++k) aligned.translation[k] = coordinate(translation, k);
  pose = aligned;
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The rigid motion with the least sum of squared distances between targets and moved sources: Kabsch's problem, solved
/// with quaternions, so that a reflection is never an answer (B. Horn, "Closed-form solution of absolute orientation
/// using unit quaternions", 1987).
///
/// `pairs`   PointPairs, all of the same weight: a std::vector, a std::array or the like
///
/// Statuses: too_few_pairs (fewer than three), invalid_keypoint (a coordinate is not finite), no_pose (all points on a
/// line, or squares outside of float's range). `pose` is all zeros then. The same bits on every machine, for pairs in
/// the same order. O(pairs); allocates nothing.
template <class Pairs>
[[nodiscard]] Status fit_pose(const Pairs& pairs, Pose& pose) noexcept {
  pose = Pose{};
  const Status usable = detail::check_pairs(detail::PairsView(pairs));
  return usable == Status::ok ? detail::align(detail::PairsView(pairs), pose) : usable;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_FIT_POSE_HPP

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Options of estimate_pose().
struct RansacOptions {
  std::uint32_t iterations = 5000;  ///< samples of three pairs, from 1 on
  float inlier_distance = 0.01f;    ///< meters between target and moved source; above 0, and its square a normal float
  float edge_similarity = 0.9f;     ///< 0 to 1: samples with an edge whose lengths differ by more are skipped
  std::uint32_t seed = 1;           ///< of the samples' sequence
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// ok or bad_option.
[[nodiscard]] inline Status validate(const RansacOptions& options) noexcept {
  const bool similarity = extend::math::is_finite(options.edge_similarity) && options.edge_similarity >= 0.0f &&
                          options.edge_similarity <= 1.0f;
  const bool distance = validate(Radius(options.inlier_distance)) == Status::ok;
  return options.iterations > 0 && similarity && distance ? Status::ok : Status::bad_option;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Samples of three different numbers below `count`, from 3 on: the same on every machine, which the standard library's
/// distributions are not. From SplitMix64 (G. Steele, D. Lea, C. Flood: Fast splittable pseudorandom number generators,
/// 2014), which takes any seed; <random> alone would cost whoever includes this a third of a second.
class Samples {
 public:
  Samples(std::uint32_t seed, std::size_t count) noexcept : state_(seed), count_(count) {}

  [[nodiscard]] std::array<std::size_t, 3> draw() noexcept {
    const std::size_t a = below(count_);
    std::size_t b = below(count_ - 1);
    b += b >= a ? 1 : 0;
    std::size_t c = below(count_ - 2);
    c += c >= std::min(a, b) ? 1u : 0u;
    c += c >= std::max(a, b) ? 1u : 0u;
    return {a, b, c};
  }

 private:
  [[nodiscard]] std::size_t below(std::size_t n) noexcept {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t mixed = (state_ ^ state_ >> 30) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ mixed >> 27) * 0x94D049BB133111EBu;
    return static_cast<std::size_t>((((mixed ^ mixed >> 31) >> 32) * n) >> 32);
  }

  std::uint64_t state_;
  std::size_t count_;
};

/// Has each edge about the same length in source and target? Motions keep lengths, so that most samples with a wrong
/// pair are found out here, for a hundredth of the cost.
[[nodiscard]] inline bool has_similar_edges(const std::array<PointPair, 3>& sample, float similarity) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const PointPair& a = sample[i];
    const PointPair& b = sample[(i + 1) % 3];
    const float source = squared_distance(a.source, b.source);
    const float target = squared_distance(a.target, b.target);
    if (!(std::min(source, target) >= similarity * similarity * std::max(source, target))) return false;
  }
  return true;
}

/// Pairs, and how near to its target a motion must take a source.
struct Consensus {
  PairsView pairs;
  Radius reach;

  [[nodiscard]] bool agrees(const Pose& pose, const PointPair& pair) const noexcept {
    return squared_distance(pair.target, transform_point(pose, pair.source)) < reach.squared;
  }
  [[nodiscard]] std::size_t count(const Pose& pose) const noexcept {
    std::size_t count = 0;
    for (const PointPair& pair : pairs) count += agrees(pose, pair) ? 1u : 0u;
    return count;
  }
  void find(const Pose& pose, std::vector<std::uint32_t>& inliers) const {
    inliers.clear();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (agrees(pose, pairs[i])) inliers.push_back(static_cast<std::uint32_t>(i));
    }
  }

  /// Fits the pose to its inliers, and again while their number grows.
  void refine(Pose& pose, std::vector<std::uint32_t>& inliers) const {
    constexpr int most_fits = 5;
    std::vector<PointPair> agreeing;
    std::vector<std::uint32_t> refined_inliers;
    bool grows = true;
    for (int fit = 0; fit < most_fits && grows; ++fit) {
      agreeing.clear();
      for (const std::uint32_t i : inliers) agreeing.push_back(pairs[i]);
      Pose refined;
      if (align(PairsView(agreeing), refined) != Status::ok) return;
      find(refined, refined_inliers);
      if (refined_inliers.size() < inliers.size()) return;
      grows = refined_inliers.size() > inliers.size();
      pose = refined;
      inliers.swap(refined_inliers);
    }
  }
};

/// estimate_pose() for options and pairs that were checked.
[[nodiscard]] inline Status find_pose(const PairsView& pairs, const RansacOptions& options, Pose& pose,
                                      std::vector<std::uint32_t>& inliers) {
  const Consensus consensus{pairs, options.inlier_distance};
  Samples samples(options.seed, pairs.size());
  std::size_t most = 0;
  for (std::uint32_t iteration = 0; iteration < options.iterations; ++iteration) {
    const auto index = samples.draw();
    const std::array<PointPair, 3> sample{pairs[index[0]], pairs[index[1]], pairs[index[2]]};
    Pose candidate;
    if (!has_similar_edges(sample, options.edge_similarity)) continue;
    if (align(PairsView(sample), candidate) != Status::ok) continue;
    const std::size_t agreeing = consensus.count(candidate);
    if (agreeing <= most) continue;
    most = agreeing;
    pose = candidate;
  }
  if (most < 3) {
    pose = Pose{};
    return Status::no_pose;
  }
  consensus.find(pose, inliers);
  consensus.refine(pose, inliers);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The rigid motion that most of the pairs agree on, others being wrong: RANSAC (Fischler and Bolles 1981) over samples
/// of three whose edges have similar lengths, then a least-squares fit to the inliers, repeated while their number
/// grows.
///
/// `pairs`     up to 2^32 - 1 PointPairs: a std::vector, a std::array or the like
/// `inliers`   numbers of the pairs that the pose takes closer to their targets than the inlier distance, ascending.
///             Three pairs often agree by chance: judge a pose by how many they are
///
/// The same samples, inliers and pose for a seed, bit for bit, on every machine.
///
/// Statuses: bad_option, too_few_pairs (fewer than three), invalid_keypoint (a coordinate is not finite), no_pose (no
/// sample has a pose that three pairs agree on). `pose` is all zeros and `inliers` empty then. O(iterations * pairs) at
/// worst. Allocates the inliers, twice, and a copy of their pairs. Calls may run at the same time.
template <class Pairs>
[[nodiscard]] Status estimate_pose(const Pairs& pairs, const RansacOptions& options, Pose& pose,
                                   std::vector<std::uint32_t>& inliers) {
  pose = Pose{};
  inliers.clear();
  const detail::PairsView view(pairs);
  Status usable = validate(options);
  if (usable == Status::ok) usable = detail::check_pairs(view);
  return usable == Status::ok ? detail::find_pose(view, options, pose, inliers) : usable;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_POSE_HPP

// shortshot/recognition/recognize.hpp: what a recognizer does: learn views, and say which objects are where. Hosted
// only: allocates, starts threads.
#ifndef SHORTSHOT_RECOGNITION_RECOGNIZE_HPP
#define SHORTSHOT_RECOGNITION_RECOGNIZE_HPP

// shortshot/recognition/mean_shift.hpp: the maxima of a density of many votes in space. Hosted only: allocates.
#ifndef SHORTSHOT_RECOGNITION_MEAN_SHIFT_HPP
#define SHORTSHOT_RECOGNITION_MEAN_SHIFT_HPP

// shortshot/recognition/vote_cells.hpp: which votes may be close to a place, without a look at all of them. Hosted
// only: allocates.
#ifndef SHORTSHOT_RECOGNITION_VOTE_CELLS_HPP
#define SHORTSHOT_RECOGNITION_VOTE_CELLS_HPP

// shortshot/recognition/vote_centers_list.hpp: a list of centers of votes. Hosted only: allocates.
#ifndef SHORTSHOT_RECOGNITION_VOTE_CENTERS_LIST_HPP
#define SHORTSHOT_RECOGNITION_VOTE_CENTERS_LIST_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The centers of votes[i] for each index, as columns.
inline void write_centers(const Vote* votes, const std::vector<std::size_t>& indices, float* x, float* y,
                          float* z) noexcept {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const Point& center = votes[indices[k]].center;
    x[k] = center.x;
    y[k] = center.y;
    z[k] = center.z;
  }
  pad(x, y, z, indices.size());
}

/// A list of its own, of up to `most` centers; only the constructor allocates: 12 bytes for each.
class VoteCentersList {
 public:
  explicit VoteCentersList(std::size_t most) : room_(most + 2 * simd::lanes), xyz_(3 * room_) {}

  [[nodiscard]] VoteCenters centers() const noexcept {
    return {xyz_.data(), xyz_.data() + room_, xyz_.data() + 2 * room_, padded(count_)};
  }

  /// The centers of votes[i] for each index.
  void assign(const Vote* votes, const std::vector<std::size_t>& indices) noexcept {
    count_ = indices.size();
    write_centers(votes, indices, x(), y(), z());
  }

  /// Those of others that lie within a distance of a place, as they are ordered.
  void assign_close(const VoteCenters& others, const Point& place, float distance) noexcept {
    count_ = 0;
    for (std::size_t i = 0; i < others.padded; i += simd::lanes) {
      const simd::Mask close = offsets(others, i, place).d2 < simd::all(distance * distance);
      if (!any(close)) continue;
      const simd::Packing packing = simd::packing(close);
      store(x() + count_, simd::load(others.x + i), packing);
      store(y() + count_, simd::load(others.y + i), packing);
      store(z() + count_, simd::load(others.z + i), packing);
      count_ += packing.count;
    }
    pad(x(), y(), z(), count_);
  }

 private:
  [[nodiscard]] float* x() noexcept { return xyz_.data(); }
  [[nodiscard]] float* y() noexcept { return xyz_.data() + room_; }
  [[nodiscard]] float* z() noexcept { return xyz_.data() + 2 * room_; }

  std::size_t room_;  // a register may be stored behind the last one
  std::vector<float> xyz_;
  std::size_t count_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_VOTE_CENTERS_LIST_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes (borrowed, finite) in cubic cells. For each cell that has votes, those in it and in the cells next to it are
/// listed once, as they are ordered.
///
/// A cell is known by the number of its row and its place in it. Rows that are far from each other may have the same
/// number, and 2^53 cells from the origin and beyond there is but one: some votes too many are found then, but none is
/// missing. Allocates about 70 bytes for each vote, and 12 for each list that a vote is in: one where votes are sparse,
/// at most 27 (twice as much for a moment, as vectors grow).
class VoteCells {
 public:
  /// What a search for votes needs, without allocating.
  struct Memory {
    explicit Memory(std::size_t most) : centers(most) { indices.reserve(most); }
    std::vector<std::size_t> indices;
    VoteCentersList centers;
  };

  VoteCells(const Vote* begin, const Vote* end, float distance)
      : votes_(begin),
        units_per_meter_(extend::math::power_of_two_below(512.0f / distance)),
        farthest_(most_units / units_per_meter_),
        cell_(static_cast<std::int64_t>(distance * units_per_meter_) + 2) {
    const auto count = static_cast<std::size_t>(end - begin);
    members_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) members_.push_back({cell_of(begin[i].center), i});
    std::sort(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
      return a.cell < b.cell || (!(b.cell < a.cell) && a.vote < b.vote);
    });
    std::vector<std::size_t> indices;
    indices.reserve(count);
    for (const Member& member : members_) {
      if (lists_.empty() || lists_.back().cell < member.cell) write_list(member.cell, indices);
    }
  }

  /// All votes within the distance of a place, and others, as they are ordered; here or in `memory`.
  [[nodiscard]] VoteCenters around(const Point& place, Memory& memory) const noexcept {
    const Cell cell = cell_of(place);
    const auto list = std::lower_bound(lists_.begin(), lists_.end(), cell,
                                       [](const List& one, const Cell& other) { return one.cell < other; });
    if (list != lists_.end() && !(cell < list->cell)) {
      const float* const x = xyz_.data() + list->begin;
      return {x, x + list->padded, x + 2 * list->padded, list->padded};
    }
    find_around(cell, memory.indices);
    memory.centers.assign(votes_, memory.indices);
    return memory.centers.centers();
  }

  /// The votes' indices, cell by cell.
  template <class Function>
  void for_each_by_cells(const Function& f) const {
    for (const Member& member : members_) f(member.vote);
  }

 private:
  struct Cell {
    std::uint64_t row;
    std::int64_t x;
    [[nodiscard]] bool operator<(const Cell& other) const noexcept {
      return row < other.row || (row == other.row && x < other.x);
    }
  };
  struct Member {
    Cell cell;
    std::size_t vote;
  };
  struct List {
    Cell cell;
    std::size_t begin;
    std::size_t padded;
  };

  /// Rounded down to whole units exactly, and then to whole cells: how far from the origin does not matter.
  [[nodiscard]] std::int64_t along(float coordinate) const noexcept {
    const float near_by = coordinate > farthest_ ? farthest_ : coordinate < -farthest_ ? -farthest_ : coordinate;
    const float position = near_by * units_per_meter_;
    auto units = static_cast<std::int64_t>(position);
    if (static_cast<float>(units) > position) --units;
    return (units < 0 ? units - (cell_ - 1) : units) / cell_;
  }

  /// Modulo 2^64, with steps of which no sum of a few is zero.
  [[nodiscard]] static std::uint64_t row(std::int64_t y, std::int64_t z) noexcept {
    return static_cast<std::uint64_t>(y) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(z) * 0xC2B2AE3D27D4EB4Fu;
  }

  [[nodiscard]] Cell cell_of(const Point& p) const noexcept { return {row(along(p.y), along(p.z)), along(p.x)}; }

  /// The votes in a cell and in the 26 next to it.
  void find_around(const Cell& cell, std::vector<std::size_t>& indices) const noexcept {
    indices.clear();
    for (std::int64_t z = -1; z <= 1; ++z) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        const Cell first{cell.row + row(y, z), cell.x - 1};
        const Cell last{first.row, cell.x + 1};
        auto member = std::lower_bound(members_.begin(), members_.end(), first,
                                       [](const Member& one, const Cell& other) { return one.cell < other; });
        for (; member != members_.end() && !(last < member->cell); ++member) indices.push_back(member->vote);
      }
    }
    std::sort(indices.begin(), indices.end());
  }

  void write_list(const Cell& cell, std::vector<std::size_t>& indices) {
    find_around(cell, indices);
    const List list{cell, xyz_.size(), padded(indices.size())};
    xyz_.resize(list.begin + 3 * list.padded);
    float* const x = xyz_.data() + list.begin;
    write_centers(votes_, indices, x, x + list.padded, x + 2 * list.padded);
    lists_.push_back(list);
  }

  static constexpr float most_units = 4611686018427387904.0f;  // 2^62

  const Vote* votes_;
  float units_per_meter_;  // a power of two
  float farthest_;
  std::int64_t cell_;            // how wide, in units: the distance, and 2 for what is rounded
  std::vector<Member> members_;  // in ascending order of cells, then of votes
  std::vector<List> lists_;      // in ascending order of cells
  std::vector<float> xyz_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_VOTE_CELLS_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Climbs from votes (finite, borrowed, of one class) to the maxima of their density. The result is that of a look at
/// all votes for each step, bit for bit. Only constructors allocate; see VoteCells.
class MeanShift {
 public:
  /// What a thread needs for climbs among up to `most` votes, and keeps from one to the next: those close to a place.
  /// Not to be used after the end of a MeanShift that has used it.
  class Memory {
   public:
    explicit Memory(std::size_t most) : search_(most), close_(most) {}
    Memory(Memory&&) = default;  // a copy would have no room
    Memory(const Memory&) = delete;

   private:
    friend class MeanShift;
    VoteCells::Memory search_;
    VoteCentersList close_;
    Point middle_{};
    const MeanShift* owner_ = nullptr;
  };

  MeanShift(const Vote* begin, const Vote* end, float bandwidth)
      : density_(bandwidth), cells_(begin, end, close * bandwidth) {}

  /// The maximum where the mean shift from a vote ends, after 100 steps at the most. Cheapest where the last climb with
  /// the same memory, since this was made, began or ended close by.
  [[nodiscard]] Peak climb(const Vote& vote, Memory& memory) const noexcept {
    return detail::climb(density_, vote.center, [&](const Point& at) { return reachable(at, memory); });
  }

  /// The votes' indices, those that are close to each other one after the other.
  template <class Function>
  void for_each_vote(const Function& f) const {
    cells_.for_each_by_cells(f);
  }

 private:
  static constexpr float margin = 0.75f;  // how far from its middle a list of what is close is good, in bandwidths
  static constexpr float close = 1.001f * (VoteDensity::reach + margin);

  /// All votes in reach of a place, and few others.
  [[nodiscard]] VoteCenters reachable(const Point& at, Memory& memory) const noexcept {
    const float bandwidth = density_.bandwidth();
    const bool known = memory.owner_ == this &&
                       squared_distance(at, memory.middle_) < extend::unfused(margin * bandwidth * margin * bandwidth);
    if (!known) {
      memory.close_.assign_close(cells_.around(at, memory.search_), at, close * bandwidth);
      memory.middle_ = at;
      memory.owner_ = this;
    }
    return memory.close_.centers();
  }

  VoteDensity density_;
  VoteCells cells_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
#endif  // SHORTSHOT_RECOGNITION_MEAN_SHIFT_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Votes that a thread takes at a time: enough for some that are close to each other.
inline constexpr std::size_t vote_block = 32;

/// Are these rows of a storage?
template <class Rows>
inline constexpr bool are_packed = !std::is_same<Rows, DescriptorRows>::value;

template <class Rows, class Threads>
[[nodiscard]] Status activate(const Recognizer& recognizer, const Rows& rows, std::string_view layout,
                              std::vector<Match>& matches, Threads& threads) {
  const Codebook& codebook = RecognizerAccess::codebook(recognizer);
  Status status = validate(recognizer.options());
  if (status == Status::ok) status = validate_queries(codebook, rows.size, are_packed<Rows>, layout);
  if (status != Status::ok) return status;
  return nearest(rows, rows_like(rows, codebook), recognizer.options().neighbors, matches, threads);
}

/// In ascending order of classes.
[[nodiscard]] inline std::vector<Vote> cast_votes(const Recognizer& recognizer, const KeyPoint* keypoints,
                                                  const Frame* frames, const std::vector<Match>& matches) {
  const auto& codewords = RecognizerAccess::codebook(recognizer).codewords;
  std::vector<Vote> votes;
  std::vector<std::size_t> places(recognizer.class_count() + 1);  // where the next vote for each class goes
  votes.reserve(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].row == no_row) continue;
    const Codebook::Codeword& codeword = codewords[matches[i].row];
    const std::size_t row = i / recognizer.options().neighbors;
    const Point center = from_local(codeword.center, keypoints[row].position, frames[row]);
    if (!is_finite(center)) continue;  // farther away than floats reach
    votes.push_back({center, recognizer.class_of(codeword.instance), codeword.instance});
    ++places[votes.back().object_class + 1];
  }
  for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
  std::vector<Vote> sorted(votes.size());
  for (const Vote& vote : votes) sorted[places[vote.object_class]++] = vote;
  return sorted;
}

/// The first of the votes whose class is not below another.
[[nodiscard]] inline const Vote* first_of_class(const std::vector<Vote>& votes, std::uint32_t object_class) noexcept {
  std::size_t low = 0;
  std::size_t high = votes.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    votes[middle].object_class < object_class ? low = middle + 1 : high = middle;
  }
  return votes.data() + low;
}

/// The peak that each vote climbs to.
template <class Threads>
[[nodiscard]] std::vector<Peak> climb_from_all(const std::vector<Vote>& votes, float bandwidth, Threads& threads) {
  struct Start {
    std::size_t shift;
    std::size_t vote;
  };
  std::vector<MeanShift> shifts;  // one for each class that has votes
  std::vector<Start> starts;      // those that are close to each other one after the other
  starts.reserve(votes.size());
  for (std::size_t begin = 0; begin < votes.size(); begin = starts.size()) {
    shifts.emplace_back(votes.data() + begin, first_of_class(votes, votes[begin].object_class + 1), bandwidth);
    shifts.back().for_each_vote([&](std::size_t vote) { starts.push_back({shifts.size() - 1, begin + vote}); });
  }
  std::vector<Peak> peaks(votes.size());
  auto&& executor = executor_of(threads, (votes.size() + vote_block - 1) / vote_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  std::vector<MeanShift::Memory> memories;
  memories.reserve(team);
  while (memories.size() < team) memories.emplace_back(votes.size());
  for_blocks(executor, team, votes.size(), vote_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      peaks[starts[i].vote] = shifts[starts[i].shift].climb(votes[starts[i].vote], memories[thread]);
  });
  return peaks;
}

/// The instance of a class whose votes have the largest sum of weights at a place; the first trained one of those.
[[nodiscard]] inline std::uint32_t heaviest_instance(const Recognizer& recognizer, const std::vector<Vote>& votes,
                                                     std::uint32_t object_class, const Point& at) {
  const VoteDensity density(recognizer.options().bandwidth);
  std::vector<float> sums(recognizer.instance_count(), 0.0f);
  const Vote* const end = first_of_class(votes, object_class + 1);
  for (const Vote* vote = first_of_class(votes, object_class); vote != end; ++vote)
    sums[vote->instance] += density.weight(*vote, at);
  std::size_t heaviest = 0;
  for (std::size_t i = 1; i < sums.size(); ++i) heaviest = sums[i] > sums[heaviest] ? i : heaviest;
  return static_cast<std::uint32_t>(heaviest);
}

/// Hypotheses from the peak that each vote has climbed to, densest first; of equal ones, as the votes are ordered.
inline void choose(const Recognizer& recognizer, const std::vector<Vote>& votes, const std::vector<Peak>& peaks,
                   std::vector<Hypothesis>& out) {
  const float bandwidth = recognizer.options().bandwidth;
  std::vector<std::size_t> order(peaks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return peaks[a].density > peaks[b].density || (peaks[a].density == peaks[b].density && a < b);
  });
  for (const std::size_t i : order) {
    if (out.size() == recognizer.options().most) break;
    const std::uint32_t object_class = votes[i].object_class;
    const Point& at = peaks[i].at;
    if (is_known(out.data(), out.size(), object_class, at, bandwidth)) continue;
    out.push_back({object_class, heaviest_instance(recognizer, votes, object_class, at), at, peaks[i].density});
  }
}

[[nodiscard]] inline PlacedRows<DescriptorRows> placed(const FeatureRows& rows) noexcept {
  return {rows.descriptors, rows.keypoints, rows.frames};
}

template <class Rows>
[[nodiscard]] Status train_rows(Recognizer& recognizer, const PlacedRows<Rows>& rows, std::string_view layout,
                                const Point& center, std::string_view object_class, std::string_view instance) {
  Codebook& codebook = RecognizerAccess::codebook(recognizer);
  Status status = check_values(rows);
  if (status == Status::ok && !is_finite(center)) status = Status::invalid_keypoint;
  if (status == Status::ok && recognizer.codeword_count() > 0)
    status = validate_queries(codebook, rows.descriptors.size, are_packed<Rows>, layout);
  if (status == Status::ok) status = add(codebook, rows, center, object_class, instance);
  if (status == Status::ok && codebook.row_size == 0 && recognizer.codeword_count() > 0) {
    codebook.layout = layout;
    codebook.row_size = rows.descriptors.size;
  }
  return status;
}

template <class Rows, class Threads>
[[nodiscard]] Status recognize_rows(const Recognizer& recognizer, const PlacedRows<Rows>& rows, std::string_view layout,
                                    std::vector<Hypothesis>& out, Threads& threads) {
  out.clear();
  std::vector<Match> matches;
  Status status = check_values(rows);
  if (status == Status::ok) status = activate(recognizer, rows.descriptors, layout, matches, threads);
  if (status != Status::ok) return status;
  const std::vector<Vote> votes = cast_votes(recognizer, rows.keypoints, rows.frames, matches);
  const std::vector<Peak> peaks = climb_from_all(votes, recognizer.options().bandwidth, threads);
  choose(recognizer, votes, peaks, out);
  return Status::ok;
}

template <class Rows, class Threads>
[[nodiscard]] Status shares_of_rows(const Recognizer& recognizer, const Rows& rows, std::string_view layout,
                                    ActivationShares& out, Threads& threads) {
  out.classes.clear();
  out.instances.clear();
  std::vector<Match> matches;
  Status status = check_values(rows);
  if (status == Status::ok) status = activate(recognizer, rows, layout, matches, threads);
  if (status != Status::ok) return status;
  out.classes.assign(recognizer.class_count(), 0.0f);
  out.instances.assign(recognizer.instance_count(), 0.0f);
  float activations = 0.0f;
  for (const Match& match : matches) {
    if (match.row == no_row) continue;
    const std::uint32_t instance = RecognizerAccess::codebook(recognizer).codewords[match.row].instance;
    out.classes[recognizer.class_of(instance)] += 1.0f;
    out.instances[instance] += 1.0f;
    activations += 1.0f;
  }
  for (float& share : out.classes) share /= std::max(activations, 1.0f);
  for (float& share : out.instances) share /= std::max(activations, 1.0f);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Learns a view of an object. `center` is a point at the same place of the object in all of its views, best in its
/// middle, in the view's coordinates. Rows whose status is not ok are left out; a view that has no other adds
/// nothing, not even its names.
///
/// Statuses: bad_rows (null pointers, rows without values, values that are not finite, 2^32 - 1 codewords or more),
/// invalid_keypoint (a key point or the center is not finite, or they lie 1e38 m apart), bad_frame, other_descriptor.
/// Nothing has changed then. Allocates 16 bytes for a codeword and 4 for each of its values.
[[nodiscard]] inline Status train(Recognizer& recognizer, const FeatureRows& rows, std::string_view layout,
                                  const Point& center, std::string_view object_class, std::string_view instance) {
  return detail::train_rows(recognizer, detail::placed(rows), layout, center, object_class, instance);
}

/// The same for what extract() gives.
template <class D>
[[nodiscard]] Status train(Recognizer& recognizer, const Features<D>& features, const Point& center,
                           std::string_view object_class, std::string_view instance) {
  return train(recognizer, feature_rows_of(features), layout_of<D>(), center, object_class, instance);
}

/// Finds the objects in a view: the maxima of the density of votes, densest first. The first one's class is what the
/// view shows if it shows one object. Its instance is the one whose votes count for most there.
///
/// `out`      of each class, maxima that lie farther than the bandwidth from any denser one; options().most in all.
///            Empty if no row has the status ok
/// `threads`  how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///            for any number, and on every machine
///
/// Statuses: what train() has, bad_option and not_trained; `out` is empty then. The cost is that of nearest(), of mean
/// shift from every vote, and of a look at all votes for each hypothesis. Mean shift takes some ten steps, each of them
/// 20 instructions (SSE2) for every vote of the class that is less than seven bandwidths away: 25 million for 2000
/// votes, half of them spread over two cubic meters. Allocates what nearest() does, 250 bytes for each vote and 32 more
/// for each thread, and up to 700 more where many votes lie closer together than that.
template <class Threads = unsigned>
[[nodiscard]] Status recognize(const Recognizer& recognizer, const FeatureRows& rows, std::string_view layout,
                               std::vector<Hypothesis>& out, Threads&& threads = 1u) {
  return detail::recognize_rows(recognizer, detail::placed(rows), layout, out, threads);
}

template <class D, class Threads = unsigned>
[[nodiscard]] Status recognize(const Recognizer& recognizer, const Features<D>& features, std::vector<Hypothesis>& out,
                               Threads&& threads = 1u) {
  return recognize(recognizer, feature_rows_of(features), layout_of<D>(), out, threads);
}

/// The simpler way, without places: by which classes' and instances' codewords the descriptors are matched. A single
/// object is what has the largest share. Statuses and `threads` as for recognize(); `out` is empty then.
template <class Threads = unsigned>
[[nodiscard]] Status activation_shares(const Recognizer& recognizer, const DescriptorRows& rows,
                                       std::string_view layout, ActivationShares& out, Threads&& threads = 1u) {
  return detail::shares_of_rows(recognizer, rows, layout, out, threads);
}

template <class D, class Threads = unsigned>
[[nodiscard]] Status activation_shares(const Recognizer& recognizer, const Features<D>& features, ActivationShares& out,
                                       Threads&& threads = 1u) {
  return activation_shares(recognizer, rows_of(features), layout_of<D>(), out, threads);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_RECOGNIZE_HPP

// shortshot/recognition/recognize_stored.hpp: recognizers of descriptors that are stored smaller: they are trained with
// them, compare and save them as they are. Hosted only: allocates, starts threads.
#ifndef SHORTSHOT_RECOGNITION_RECOGNIZE_STORED_HPP
#define SHORTSHOT_RECOGNITION_RECOGNIZE_STORED_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What `use` makes of the rows: of codes or bits as they are, of halves as the floats that they stand for.
template <class Stored, class Use>
[[nodiscard]] Status with_rows(const StoredFeatures<Stored>& features, const Use& use) {
  const bool is_complete = features.descriptors.size() == features.size() &&
                           features.keypoints.size() == features.size() && features.frames.size() == features.size();
  if (!is_complete) return Status::bad_rows;
  if constexpr (std::is_same<typename Storage<Stored>::Value, std::uint16_t>::value) {
    constexpr auto row_size = static_cast<std::size_t>(Stored::size);
    std::vector<float> values(features.size() * row_size);
    for (std::size_t i = 0; i < features.size(); ++i) dequantize(features.descriptors[i], values.data() + i * row_size);
    const DescriptorRows rows{values.data(), features.size(), row_size, features.status.data()};
    return use(PlacedRows<DescriptorRows>{rows, features.keypoints.data(), features.frames.data()});
  } else {
    const auto rows = rows_of(features);
    return use(PlacedRows<std::decay_t<decltype(rows)>>{rows, features.keypoints.data(), features.frames.data()});
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// As for features, with the distances of the storage. What a recognizer is for is a descriptor and its storage, which
/// is said by storage_layout<Stored>(), also to load(): others are other_descriptor. Also bad_rows: vectors that are
/// not as long as each other. Allocates 16 bytes for a codeword, and the stored descriptor (of halves the floats).
template <class Stored>
[[nodiscard]] Status train(Recognizer& recognizer, const StoredFeatures<Stored>& features, const Point& center,
                           std::string_view object_class, std::string_view instance) {
  return detail::with_rows(features, [&](const auto& rows) {
    return detail::train_rows(recognizer, rows, storage_layout<Stored>(), center, object_class, instance);
  });
}
template <class Stored, class Threads = unsigned>
[[nodiscard]] Status recognize(const Recognizer& recognizer, const StoredFeatures<Stored>& features,
                               std::vector<Hypothesis>& out, Threads&& threads = 1u) {
  out.clear();
  return detail::with_rows(features, [&](const auto& rows) {
    return detail::recognize_rows(recognizer, rows, storage_layout<Stored>(), out, threads);
  });
}
template <class Stored, class Threads = unsigned>
[[nodiscard]] Status activation_shares(const Recognizer& recognizer, const StoredFeatures<Stored>& features,
                                       ActivationShares& out, Threads&& threads = 1u) {
  out.classes.clear();
  out.instances.clear();
  return detail::with_rows(features, [&](const auto& rows) {
    return detail::shares_of_rows(recognizer, rows.descriptors, storage_layout<Stored>(), out, threads);
  });
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_RECOGNIZE_STORED_HPP

// shortshot/recognition/recognizer_model.hpp: a trained recognizer as bytes, or in a file. Hosted only: allocates.
//
// Between what byte_stream.hpp puts around it ("SSHOTREC", the version and the checksum):
//
//     layout (length, characters), values of a row
//     options: 4 bytes each bandwidth, neighbors, most
//     count of classes, for each: name (length, characters)
//     count of instances, for each: 4 bytes class, name (length, characters)
//     count of codewords, for each: 4 bytes instance, 3 floats center in the key point's frame
//     values, row by row: floats; of version 2 bytes, which are codes or bits, as the layout says
#ifndef SHORTSHOT_RECOGNITION_RECOGNIZER_MODEL_HPP
#define SHORTSHOT_RECOGNITION_RECOGNIZER_MODEL_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr FileKind recognizer_file{"SSHOTREC", 1};
inline constexpr FileKind packed_recognizer_file{"SSHOTREC", 2};

inline void write(ByteWriter& to, const RecognizerOptions& options, const Codebook& codebook) {
  to.name(codebook.layout);
  to.count(codebook.row_size);
  to.real(options.bandwidth);
  to.number(options.neighbors);
  to.number(options.most);
  to.count(codebook.classes.size());
  for (const std::string& name : codebook.classes) to.name(name);
  to.count(codebook.instances.size());
  for (std::size_t i = 0; i < codebook.instances.size(); ++i) {
    to.number(codebook.class_of[i]);
    to.name(codebook.instances[i]);
  }
  to.count(codebook.codewords.size());
  for (const Codebook::Codeword& codeword : codebook.codewords) {
    to.number(codeword.instance);
    to.point(codeword.center);
  }
  to.reals(codebook.values.data(), codebook.values.size());
  for (const std::uint8_t byte : codebook.packed) to.number(byte);
}

/// False if not all of it can be: then what has been read is of no use.
[[nodiscard]] inline bool read(ByteReader& from, bool is_packed, RecognizerOptions& options, Codebook& codebook) {
  const std::size_t value_bytes = is_packed ? 1 : sizeof(float);
  codebook.layout = from.name();
  codebook.row_size = from.count(value_bytes);
  options.bandwidth = from.real();
  options.neighbors = from.number<std::uint32_t>();
  options.most = from.number<std::uint32_t>();
  from.require(validate(options) == Status::ok);
  for (std::size_t i = from.count(8); i > 0 && from.good(); --i) codebook.classes.push_back(from.name());
  for (std::size_t i = from.count(12); i > 0 && from.good(); --i) {
    codebook.class_of.push_back(from.index(codebook.classes.size()));
    codebook.instances.push_back(from.name());
  }
  const std::size_t codewords = from.count(16);
  from.require(codewords > 0 && codewords < no_row);
  codebook.codewords.reserve(codewords);
  for (std::size_t i = codewords; i > 0 && from.good(); --i) {
    const std::uint32_t instance = from.index(codebook.instances.size());
    codebook.codewords.push_back({instance, from.point()});
  }
  const std::size_t row_bytes = value_bytes * codebook.row_size;
  from.require(row_bytes > 0 && from.left() % row_bytes == 0 && from.left() / row_bytes == codewords);
  if (!from.good()) return false;
  if (is_packed) {
    codebook.packed.resize(codewords * codebook.row_size);
    for (std::uint8_t& byte : codebook.packed) byte = from.number<std::uint8_t>();
  } else {
    codebook.values.resize(codewords * codebook.row_size);
    from.reals(codebook.values.data(), codebook.values.size());
  }
  return from.good();
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A trained recognizer, with its options, as bytes: the same ones on every machine. Statuses: not_trained, bad_option;
/// `bytes` is empty then. Allocates the bytes.
[[nodiscard]] inline Status save(const Recognizer& recognizer, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  if (recognizer.codeword_count() == 0) return Status::not_trained;
  if (validate(recognizer.options()) != Status::ok) return Status::bad_option;
  const std::size_t codeword_bytes = 16 + sizeof(float) * recognizer.row_size();
  const bool is_packed = !detail::RecognizerAccess::codebook(recognizer).packed.empty();
  const detail::FileKind& kind = is_packed ? detail::packed_recognizer_file : detail::recognizer_file;
  detail::ByteWriter to(bytes, kind, 4096 + recognizer.codeword_count() * codeword_bytes);
  detail::write(to, recognizer.options(), detail::RecognizerAccess::codebook(recognizer));
  to.finish();
  return Status::ok;
}

/// The recognizer that save() made these bytes of, for descriptors of a layout (see Recognizer; layout_of()).
///
/// Statuses, the first one that applies: not_a_model, other_version, damaged_model (the bytes end early, or go on; the
/// checksum is wrong; or they are not what save() writes), other_descriptor. `out` has not changed then. Allocates a
/// few times the bytes at the most, whatever they say.
[[nodiscard]] inline Status load(const std::uint8_t* bytes, std::size_t size, std::string_view layout,
                                 Recognizer& out) {
  detail::ByteReader body(nullptr, 0);
  Status status = detail::open_checked(bytes, size, detail::recognizer_file, body);
  const bool is_packed = status == Status::other_version;
  if (is_packed) status = detail::open_checked(bytes, size, detail::packed_recognizer_file, body);
  if (status != Status::ok) return status;
  Recognizer loaded;
  detail::Codebook& codebook = detail::RecognizerAccess::codebook(loaded);
  RecognizerOptions options;
  if (!detail::read(body, is_packed, options, codebook)) return Status::damaged_model;
  if (codebook.layout != layout) return Status::other_descriptor;
  loaded.set_options(options);
  out = std::move(loaded);
  return Status::ok;
}

/// The same in a file. Also no_file: it cannot be opened, or not all of it written or read. If that happens to save()
/// (the disk is full), what was in the file still is: the new one is written beside it, as `path` + ".tmp-00" (or 01,
/// ...), and takes its name when it is complete. So there must be room for both, and its folder must be writable.
[[nodiscard]] inline Status save(const Recognizer& recognizer, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  const Status status = save(recognizer, bytes);
  return status == Status::ok ? detail::replace_file(path, bytes) : status;
}

[[nodiscard]] inline Status load(const std::string& path, std::string_view layout, Recognizer& out) {
  std::vector<std::uint8_t> bytes;
  const Status status = detail::read_file(path, bytes);
  return status == Status::ok ? load(bytes.data(), bytes.size(), layout, out) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_RECOGNIZER_MODEL_HPP

// shortshot/recognition/thin.hpp: a trained recognizer with fewer codewords, for small memories. Hosted only:
// allocates.
//
// Each codeword is asked for as if it were seen: without it, which is nearest, and does that vote for the same instance
// at the same place? Codewords go one after the other, always the one that costs fewest right votes. After the idea of
// decremental reduction: D. R. Wilson, T. R. Martinez: Reduction techniques for instance-based learning algorithms
// (Machine Learning 38, 2000).
#ifndef SHORTSHOT_RECOGNITION_THIN_HPP
#define SHORTSHOT_RECOGNITION_THIN_HPP

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What is left of a codebook, and whom each of its codewords, also those that are gone, would activate.
template <class Rows>
class Thinning {
 public:
  Thinning(const Codebook& codebook, const Rows& rows, float bandwidth)
      : codebook_(codebook),
        rows_(rows),
        squared_bandwidth_(unfused(bandwidth * bandwidth)),
        is_left_(rows.count, true),
        left_of_(codebook.instances.size(), 0),
        nearest_(rows.count) {
    for (const Codebook::Codeword& codeword : codebook.codewords) ++left_of_[codeword.instance];
    for (std::size_t i = 0; i < rows.count; ++i) find_nearest(i);
  }

  [[nodiscard]] bool is_left(std::size_t codeword) const { return is_left_[codeword]; }

  /// Takes one of the instance that has most: the one that costs fewest right votes; of those, who is activated least;
  /// of those, the last one.
  void remove_one() {
    std::vector<Loss> losses(rows_.count);
    for (std::size_t i = 0; i < rows_.count; ++i) {
      const TwoNearest& two = nearest_[i];
      if (two.first == no_row) continue;
      losses[two.first].right_votes += two.lost;
      ++losses[two.first].votes;
    }
    std::uint32_t most = 0;
    for (const std::uint32_t left : left_of_) most = left > most ? left : most;
    std::size_t least = rows_.count;
    for (std::size_t i = rows_.count; i-- > 0;) {
      if (!is_left_[i] || left_of_[codebook_.codewords[i].instance] != most) continue;
      if (least == rows_.count || losses[i] < losses[least]) least = i;
    }
    is_left_[least] = false;
    --left_of_[codebook_.codewords[least].instance];
    for (std::size_t i = 0; i < rows_.count; ++i) {
      if (nearest_[i].first == least || nearest_[i].second == least) find_nearest(i);
    }
  }

 private:
  struct TwoNearest {
    std::size_t first = no_row;
    std::size_t second = no_row;
    int lost = 0;  // right votes, if the first one goes
  };
  struct Loss {
    std::int64_t right_votes = 0;
    std::size_t votes = 0;
    [[nodiscard]] bool operator<(const Loss& other) const {
      return right_votes != other.right_votes ? right_votes < other.right_votes : votes < other.votes;
    }
  };

  /// Of those that are left, but for itself; the first ones of those that are as near.
  void find_nearest(std::size_t i) {
    TwoNearest two;
    typename RowsNumber<Rows>::type first{};
    typename RowsNumber<Rows>::type second{};
    for (std::size_t k = 0; k < rows_.count; ++k) {
      if (k == i || !is_left_[k]) continue;
      const auto distance = rows_.compare(i, rows_, k);
      if (two.first == no_row || distance < first) {
        two = {k, two.first, 0};
        second = std::exchange(first, distance);
      } else if (two.second == no_row || distance < second) {
        two.second = k;
        second = distance;
      }
    }
    two.lost = (is_right(i, two.first) ? 1 : 0) - (is_right(i, two.second) ? 1 : 0);
    nearest_[i] = two;
  }

  /// Would k vote as i does, where i is seen?
  [[nodiscard]] bool is_right(std::size_t i, std::size_t k) const {
    if (k == no_row) return false;
    const Codebook::Codeword& a = codebook_.codewords[i];
    const Codebook::Codeword& b = codebook_.codewords[k];
    return a.instance == b.instance && squared_distance(a.center, b.center) <= squared_bandwidth_;
  }

  const Codebook& codebook_;
  const Rows rows_;
  const float squared_bandwidth_;
  std::vector<bool> is_left_;
  std::vector<std::uint32_t> left_of_;  // of each instance
  std::vector<TwoNearest> nearest_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A recognizer of StoredFeatures<Stored> (codes or bits) with at most so many codewords: those that contribute most to
/// right votes. Each instance keeps as many as any other, or all that it has; they keep their order. So instances with
/// many views do not outvote those with few any more, either. The same on every machine.
///
/// Statuses: not_trained, bad_option (of the recognizer, or fewer codewords than there are instances),
/// other_descriptor. `out`, which may be the same recognizer, has not changed then. Compares each codeword with all
/// others some four times: 6 s for 10,000 of 44 bytes. Allocates 25 bytes for each, and the copy.
template <class Stored>
[[nodiscard]] Status thin(const Recognizer& recognizer, std::size_t most_codewords, Recognizer& out) {
  const detail::Codebook& codebook = detail::RecognizerAccess::codebook(recognizer);
  Status status = validate(recognizer.options());
  if (codebook.codewords.empty()) status = Status::not_trained;
  if (status == Status::ok) status = detail::validate_queries(codebook, sizeof(Stored), true, storage_layout<Stored>());
  if (status == Status::ok && most_codewords < codebook.instances.size()) status = Status::bad_option;
  if (status != Status::ok) return status;
  Recognizer thinned(recognizer);
  if (codebook.codewords.size() > most_codewords) {
    const auto rows = detail::rows_like(rows_of(StoredFeatures<Stored>()), codebook);
    detail::Thinning<std::decay_t<decltype(rows)>> thinning(codebook, rows, recognizer.options().bandwidth);
    for (std::size_t left = rows.count; left > most_codewords; --left) thinning.remove_one();
    detail::Codebook& kept = detail::RecognizerAccess::codebook(thinned);
    kept.codewords.clear();
    kept.packed.clear();
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (!thinning.is_left(i)) continue;
      kept.codewords.push_back(codebook.codewords[i]);
      detail::append(kept, rows, i);
    }
  }
  out = std::move(thinned);
  return Status::ok;
}

/// The same with as many codewords as a model for flash of at most so many bytes has: save_for_flash(out, ...).
/// Also out_of_memory, in place of bad_option: it has not one for each instance.
template <class Stored>
[[nodiscard]] Status thin_for_flash(const Recognizer& recognizer, std::size_t most_bytes, Recognizer& out) {
  const detail::Codebook& codebook = detail::RecognizerAccess::codebook(recognizer);
  const std::size_t most = detail::codewords_in_flash<Stored>(codebook, most_bytes);
  if (!codebook.codewords.empty() && most < codebook.instances.size()) return Status::out_of_memory;
  return thin<Stored>(recognizer, most, out);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_RECOGNITION_THIN_HPP
#endif

#if defined(NANOFLANN_VERSION)

// shortshot/search/nanoflann.hpp: neighbors from nanoflann's k-d tree. Hosted only: building it allocates, and may
// throw std::bad_alloc. A leaf: nothing else in the library includes it. Written for what nanoflann 1.4.0
// to 1.12 have in common.
#ifndef SHORTSHOT_SEARCH_NANOFLANN_HPP
#define SHORTSHOT_SEARCH_NANOFLANN_HPP

#include <nanoflann.hpp>
#include <vector>

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The valid points of a cloud, as nanoflann wants to see them: NaN would spoil the tree.
struct NanoflannCloud {
  CloudView cloud;
  std::vector<std::uint32_t> valid;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return valid.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return coordinate(point(cloud, valid[i]), axis);
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

/// Parameters of a tree that buildIndex() builds. From 1.4.3 on constructors do it unless they are told not to, by
/// flags that did not exist before.
template <class Parameters>
[[nodiscard]] auto not_built_yet(std::size_t leaf_size, int) -> decltype(Parameters().flags, Parameters()) {
  Parameters parameters(leaf_size);
  parameters.flags = decltype(parameters.flags)::SkipInitialBuildIndex;
  return parameters;
}
template <class Parameters>
[[nodiscard]] Parameters not_built_yet(std::size_t leaf_size, long) {
  return Parameters(leaf_size);
}

/// A nanoflann result set that passes candidates straight on to a neighborhood: queries allocate nothing, and whether
/// a candidate is a neighbor is decided by the same rule, in the same arithmetic, as in every other search.
template <class Neighbors>
class NanoflannSink {
 public:
  using DistanceType = float;
  using IndexType = std::uint32_t;

  NanoflannSink(const NanoflannCloud& points, const Point& center, Radius radius, Neighbors& out)
      : points_(points), center_(center), radius_(radius), worst_(worst_of(radius)), out_(out) {}

  bool addPoint(float, std::uint32_t i) {
    const std::uint32_t index = points_.valid[i];
    offer(out_, point(points_.cloud, index), index, center_, radius_.squared);
    return true;
  }
  [[nodiscard]] float worstDist() const { return worst_; }
  [[nodiscard]] std::size_t size() const { return out_.size; }
  [[nodiscard]] bool empty() const { return out_.size == 0; }
  [[nodiscard]] bool full() const { return true; }
  void sort() {}

 private:
  /// A little more than the radius, so that the tree's own rounding loses nobody on the rim. The tree adds up to three
  /// such numbers: where they may leave float's range, it is to look everywhere.
  [[nodiscard]] static float worst_of(Radius radius) {
    return radius.squared < 0.25f * std::numeric_limits<float>::max() ? radius.squared * 1.00001f
                                                                      : std::numeric_limits<float>::infinity();
  }

  const NanoflannCloud& points_;
  Point center_;
  Radius radius_;
  float worst_;
  Neighbors& out_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A k-d tree over a cloud; a search (see search.hpp). The cloud must outlive it. Queries are thread-safe.
class NanoflannSearch {
 public:
  /// Builds the tree: O(n log n), allocates. `leaf_size` is the most points in a leaf. An empty or bad view gives a
  /// search that finds nothing; status() says why.
  explicit NanoflannSearch(const CloudView& cloud, std::size_t leaf_size = 10)
      : points_{cloud, valid_points(cloud)},
        tree_(3, points_, detail::not_built_yet<nanoflann::KDTreeSingleIndexAdaptorParams>(leaf_size, 0)) {
    if (!points_.valid.empty()) tree_.buildIndex();
  }
  NanoflannSearch(const NanoflannSearch&) = delete;  // the tree refers to points_
  NanoflannSearch& operator=(const NanoflannSearch&) = delete;

  /// ok, empty_cloud (no valid point), or why the cloud cannot be read.
  [[nodiscard]] Status status() const noexcept {
    const Status usable = validate(points_.cloud);
    return usable == Status::ok && points_.valid.empty() ? Status::empty_cloud : usable;
  }

  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return points_.cloud.size; }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    extend::clear(out, center);
    if (status() != Status::ok) return status();
    if (!is_finite(center)) return Status::ok;
    detail::NanoflannSink<Neighbors> sink(points_, center, radius, out);
    const float query[3] = {center.x, center.y, center.z};
    tree_.findNeighbors(sink, query, {});  // {}: SearchParams up to 1.4, SearchParameters from 1.5 on
    return extend::outcome(out);
  }

 private:
  using Distance = nanoflann::L2_Simple_Adaptor<float, detail::NanoflannCloud, float>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Distance, detail::NanoflannCloud, 3, std::uint32_t>;

  [[nodiscard]] static std::vector<std::uint32_t> valid_points(const CloudView& cloud) {
    std::vector<std::uint32_t> valid;
    if (validate(cloud) != Status::ok) return valid;
    valid.reserve(cloud.size);
    extend::for_each_valid(cloud, [&](std::size_t i, const Point&) { valid.push_back(static_cast<std::uint32_t>(i)); });
    return valid;
  }

  detail::NanoflannCloud points_;
  Tree tree_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_SEARCH_NANOFLANN_HPP
#else

// shortshot/search/nanoflann_missing.hpp: what stands for NanoflannSearch until <nanoflann.hpp> is there.
#ifndef SHORTSHOT_SEARCH_NANOFLANN_MISSING_HPP
#define SHORTSHOT_SEARCH_NANOFLANN_MISSING_HPP

namespace shortshot::detail::not_included {
inline namespace SHORTSHOT_CODE {

class NanoflannSearch {
 public:
  template <class... Options>
  explicit NanoflannSearch(const CloudView&, const Options&...) {
    static_assert(sizeof...(Options) > 999,
                  "NanoflannSearch needs <nanoflann.hpp> included before shortshot.hpp (which may be included again)");
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail::not_included

namespace shortshot {
// A directive, not a declaration: the class itself, as soon as it is there, comes before what a directive shows.
using namespace detail::not_included;
}  // namespace shortshot
#endif  // SHORTSHOT_SEARCH_NANOFLANN_MISSING_HPP
#endif

#if defined(EIGEN_WORLD_VERSION)

// shortshot/cloud/view_eigen.hpp: views of Eigen matrices and maps, points as columns or as rows. Works with Eigen 3.4
// to 5.
#ifndef SHORTSHOT_CLOUD_VIEW_EIGEN_HPP
#define SHORTSHOT_CLOUD_VIEW_EIGEN_HPP

#include <Eigen/Core>

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Where component `c` of point 0 lies in a matrix whose points are its columns (3xN) or its rows (Nx3).
template <class Matrix>
struct EigenPoints {
  static constexpr bool columns = Matrix::RowsAtCompileTime == 3;
  static_assert(columns || Matrix::ColsAtCompileTime == 3,
                "Eigen views support 3 x N and N x 3 matrices and maps, with the 3 in their types, as in Matrix3Xf");

  [[nodiscard]] static std::size_t count(const Matrix& m) noexcept {
    return static_cast<std::size_t>(columns ? m.cols() : m.rows());
  }
  /// Elements from one component, or one point, to the next.
  [[nodiscard]] static std::size_t component_step(const Matrix& m) noexcept {
    return static_cast<std::size_t>(columns != static_cast<bool>(Matrix::IsRowMajor) ? m.innerStride()
                                                                                     : m.outerStride());
  }
  [[nodiscard]] static std::size_t point_step(const Matrix& m) noexcept {
    return static_cast<std::size_t>(columns != static_cast<bool>(Matrix::IsRowMajor) ? m.outerStride()
                                                                                     : m.innerStride());
  }
};

/// Matrices own their memory; maps and blocks borrow it. Of arguments that a function takes as Argument&&: is this one
/// a matrix that dies at the end of the statement?
template <class Argument>
struct IsDyingMatrix : std::is_base_of<Eigen::PlainObjectBase<std::remove_cv_t<Argument>>, std::remove_cv_t<Argument>> {
};
template <class Argument>
struct IsDyingMatrix<Argument&> : std::false_type {};

/// Bytes are colors, floats are normals.
template <class Channel>
void add_channel(CloudView& view, const Channel& matrix) noexcept {
  using Scalar = typename Channel::Scalar;
  static_assert(sizeof(Scalar) == 1 || std::is_same<Scalar, float>::value,
                "view_eigen() supports colors of one byte each, and normals of floats");
  using Rows = EigenPoints<Channel>;
  const std::size_t step = Rows::component_step(matrix) * sizeof(Scalar);
  const std::size_t stride = Rows::point_step(matrix) * sizeof(Scalar);
  if constexpr (sizeof(Scalar) == 1) {
    view.colors = color_channel(reinterpret_cast<const unsigned char*>(matrix.data()), step, stride);
  } else {
    view.normals = float3_channel(matrix.data(), step, stride);
  }
  if (Rows::count(matrix) != view.size) view = unusable_view(Status::sizes_differ);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// View of float points: Matrix3Xf, MatrixX3f, row- or column-major, or a Map of them with any strides. Borrowed.
///
/// `channels`: a matrix of bytes r g b for colors, a matrix of floats for normals, or both, of either shape.
/// sizes_differ if the numbers of points do.
template <class Matrix, class... Channels>
[[nodiscard]] CloudView view_eigen(const Matrix& xyz, const Channels&... channels) noexcept {
  static_assert(std::is_same<typename Matrix::Scalar, float>::value, "view_eigen() supports float coordinates");
  using Points = detail::EigenPoints<Matrix>;
  CloudView view{};
  view.size = Points::count(xyz);
  view.width = view.size;
  view.height = 1;
  view.points = detail::float3_channel(xyz.data(), Points::component_step(xyz) * sizeof(float),
                                       Points::point_step(xyz) * sizeof(float));
  (detail::add_channel(view, channels), ...);
  return view;
}

/// A matrix (not a map) that dies at the end of the statement cannot be viewed.
template <class... Matrices, class = std::enable_if_t<(detail::IsDyingMatrix<Matrices>::value || ...)>>
CloudView view_eigen(Matrices&&... matrices) = delete;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_CLOUD_VIEW_EIGEN_HPP
#else

// shortshot/cloud/view_eigen_missing.hpp: what stands for view_eigen() until <Eigen/Core> is there.
#ifndef SHORTSHOT_CLOUD_VIEW_EIGEN_MISSING_HPP
#define SHORTSHOT_CLOUD_VIEW_EIGEN_MISSING_HPP

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The worst of all matches: where Eigen is there, view_eigen.hpp's is taken.
template <class... Arguments>
CloudView view_eigen(const Arguments&...) noexcept {
  static_assert(sizeof...(Arguments) > 999,
                "view_eigen() needs <Eigen/Core> included before shortshot.hpp (which may be included again)");
  return {};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
#endif  // SHORTSHOT_CLOUD_VIEW_EIGEN_MISSING_HPP
#endif

#endif

// shortshot/macros_on.hpp: the macros that macros_off.hpp set aside, as they were.

#pragma pop_macro("abs")
#pragma pop_macro("round")
#pragma pop_macro("min")
#pragma pop_macro("max")
#pragma pop_macro("near")
#pragma pop_macro("far")
#pragma pop_macro("small")
#pragma pop_macro("check")
#pragma pop_macro("require")
#pragma pop_macro("verify")
#pragma pop_macro("Status")
#pragma pop_macro("Success")
#pragma pop_macro("None")
#pragma pop_macro("Always")
#pragma pop_macro("Bool")
#pragma pop_macro("True")
#pragma pop_macro("False")
#pragma pop_macro("Complex")
#pragma pop_macro("constrain")
#pragma pop_macro("radians")
#pragma pop_macro("degrees")
#pragma pop_macro("sq")
#pragma pop_macro("bit")
#pragma pop_macro("word")
#pragma pop_macro("PI")
#pragma pop_macro("DEFAULT")
#pragma pop_macro("ERROR")
#pragma pop_macro("OPTIONAL")
#pragma pop_macro("IN")
#pragma pop_macro("OUT")
#pragma pop_macro("I")
#pragma pop_macro("C")
#pragma pop_macro("D")
#pragma pop_macro("G")
#pragma pop_macro("K")
#pragma pop_macro("L")
#pragma pop_macro("N")
#pragma pop_macro("P")
#pragma pop_macro("R")
#pragma pop_macro("S")
#pragma pop_macro("T")
#pragma pop_macro("X")
#pragma pop_macro("Y")
#pragma pop_macro("Z")
// clang-format on
