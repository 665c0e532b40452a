// shortshot/dispatch/hot_kernel.hpp: the part of the kernel in which hosts spend their time: what kernel_for_avx2.hpp
// reads once more. All of it has include guards, which can be forgotten (forget_kernel.hpp).
#ifndef SHORTSHOT_DISPATCH_HOT_KERNEL_HPP
#define SHORTSHOT_DISPATCH_HOT_KERNEL_HPP

#include "../base/products.hpp"
#include "../cloud/voxel_lanes.hpp"
#include "../descriptor/compact.hpp"
#include "../frame/normals_together.hpp"
#include "../kernel/describe_at.hpp"
#include "../search/cell_sort.hpp"

#endif  // SHORTSHOT_DISPATCH_HOT_KERNEL_HPP
