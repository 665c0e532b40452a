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
#pragma once

#include "half_bytes.hpp"
#include "simd.hpp"

#if defined(__AVX2__)
#include "simd_sums_avx2.hpp"
#elif defined(__SSE2__)
#include "simd_sums_sse2.hpp"
#elif defined(__aarch64__)
#include "simd_sums_neon.hpp"
#else
#include "simd_sums_scalar.hpp"
#endif
