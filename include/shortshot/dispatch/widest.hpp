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
      auto twin_frame = as_twin<::shortshot_avx2::Frame>(frame);
      auto twin_confidence = as_twin<::shortshot_avx2::FrameConfidence>(confidence);
      const auto status = ::shortshot_avx2::detail::describe_gathered<TwinOf<D>, default_chunk_size>(
          as_twin<::shortshot_avx2::Neighborhood>(n), as_twin<TwinOf<Sources>>(sources),
          as_twin<::shortshot_avx2::Point>(center), as_twin<::shortshot_avx2::Support>(support), twin_frame, out,
          twin_confidence);
      frame = as_twin<Frame>(twin_frame);
      confidence = as_twin<FrameConfidence>(twin_confidence);
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
      return static_cast<Status>(::shortshot_avx2::describe<TwinOf<D>>(
          as_twin<::shortshot_avx2::Neighborhood>(n), as_twin<TwinOf<Sources>>(sources),
          as_twin<::shortshot_avx2::Frame>(frame), as_twin<::shortshot_avx2::Radius>(radius), out));
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
    return ::shortshot_avx2::detail::place_in_voxels(as_twin<::shortshot_avx2::CloudView>(cloud), leaf, begin, number,
                                                     d2);
  }
#endif
  return place_in_voxels(cloud, leaf, begin, number, d2);
}

/// normals_together().
inline void normals_widest(const CloudView& cloud, const Neighborhood& candidates, Radius wide, Radius radius,
                           const Viewpoint& viewpoint, const PlaceGroup& group, float* normals) noexcept {
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  if (has_wider_lanes()) {
    ::shortshot_avx2::detail::normals_together(
        as_twin<::shortshot_avx2::CloudView>(cloud), as_twin<::shortshot_avx2::Neighborhood>(candidates),
        as_twin<::shortshot_avx2::Radius>(wide), as_twin<::shortshot_avx2::Radius>(radius),
        as_twin<::shortshot_avx2::Viewpoint>(viewpoint), as_twin<::shortshot_avx2::detail::PlaceGroup>(group), normals);
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
  if constexpr (std::is_same<Neighbors, Neighborhood>::value) {
    if (has_wider_lanes()) {
      auto twin = as_twin<::shortshot_avx2::Neighborhood>(out);
      const auto status = ::shortshot_avx2::detail::gather_from(
          as_twin<::shortshot_avx2::detail::Grid<std::uint32_t>>(grid),
          as_twin<::shortshot_avx2::detail::GridContents<std::uint32_t>>(contents),
          as_twin<::shortshot_avx2::Point>(center), as_twin<::shortshot_avx2::Radius>(radius), twin);
      out = as_twin<Neighborhood>(twin);
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
    auto twin = as_twin<::shortshot_avx2::detail::Grid<std::uint32_t>>(grid);
    const auto status = twin.plan(as_twin<::shortshot_avx2::CloudView>(cloud), cell_size,
                                  as_twin<::shortshot_avx2::GridMemory<std::uint32_t>>(memory));
    grid = as_twin<HostGrid>(twin);
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
    as_twin<::shortshot_avx2::detail::Grid<std::uint32_t>>(grid).sort(
        as_twin<::shortshot_avx2::CloudView>(cloud), as_twin<::shortshot_avx2::GridMemory<std::uint32_t>>(memory));
    return;
  }
#endif
  grid.sort(cloud, memory);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
