// shortshot/kernel.hpp: the part for firmware: no heap, no exceptions, no RTTI, no double, no static initialiser, no
// libm (but sqrtf on cores without a floating-point unit). Needs <array>, <cstddef>, <cstdint>, <cstring>,
// <type_traits> and <utility> of the standard library.
#pragma once

#include "binary.hpp"
#include "describe_at.hpp"
#include "normals.hpp"
#include "quantize.hpp"
#include "search/brute.hpp"
#include "search/grid.hpp"
#include "search/organized.hpp"
#include "self_check.hpp"
#include "version.hpp"
