// shortshot/store/code_scale.hpp: how fine the steps of coded descriptors are, for each descriptor.
#pragma once

#include "../config.hpp"
#include "../descriptor/compact.hpp"

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
