// shortshot/version.hpp: the only place with a version number; CMake reads it from here.
#pragma once

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
