// shortshot/kernel.hpp: the part for firmware: no heap, no exceptions, no RTTI, no double, no static initializer, no
// libm (but sqrtf on cores without a floating-point unit). Needs `<array>`, `<cstddef>`, `<cstdint>`, `<cstring>`,
// `<type_traits>` and `<utility>` of the standard library.
#pragma once

#include "descriptor/compact.hpp"
#include "frame/fixed_lamp_frame.hpp"
#include "frame/normal.hpp"
#include "kernel/describe_at.hpp"
#include "recognition/learned_objects.hpp"
#include "recognition/micro_recognizer.hpp"
#include "search/brute.hpp"
#include "search/cell_index.hpp"
#include "search/organized.hpp"
#include "self_check.hpp"
#include "store/binary.hpp"
#include "store/coded.hpp"
#include "store/half.hpp"
#include "store/sum_bits.hpp"
#include "version.hpp"
