// shortshot/dispatch/widest.hpp: parts of the kernel with the widest lanes that the CPU has, whatever the compiler was
// told. Hosted only.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "../base/products.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/voxel_lanes.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../frame/normals_together.hpp"
#include "../frame/viewpoint.hpp"
#include "../kernel/chunk.hpp"
#include "../kernel/describe_at.hpp"
#include "../kernel/support.hpp"
#include "../search/cell_sort.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "twins.hpp"

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
