// shortshot/kernel.hpp: the part for firmware: no heap, no exceptions, no RTTI, no double, no libm, no static
// initialiser. Freestanding but for <array>, <cstddef>, <cstdint>, <cstring> and <type_traits>.
#pragma once

#include "describe_at.hpp"
#include "search/brute.hpp"
#include "search/grid.hpp"
#include "search/organized.hpp"
#include "version.hpp"
