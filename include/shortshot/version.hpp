// shortshot/version.hpp: the only place with a version number; CMake reads it from here.
#pragma once

namespace shortshot {

inline constexpr int version_major = 0;
inline constexpr int version_minor = 1;
inline constexpr int version_patch = 0;

}  // namespace shortshot
