// shortshot/base/quad.hpp: four numbers side by side in memory, for all lane shims.
#ifndef SHORTSHOT_BASE_QUAD_HPP
#define SHORTSHOT_BASE_QUAD_HPP

#include <cstdint>

#include "../config.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// One addition where there are lanes.
using Quad = std::int32_t __attribute__((vector_size(16)));
using FloatQuad = float __attribute__((vector_size(16)));

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_QUAD_HPP
