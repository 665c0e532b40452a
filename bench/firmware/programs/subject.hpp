// What an image describes, chosen by the macros CONFIGURATION, CHUNK and COMPACT: types, and the functions that
// subject.cpp compiles for it. Size, stack and work are all measured on these functions.
#pragma once

#include "shortshot.hpp"

using Configuration = shortshot::CONFIGURATION;

inline constexpr std::size_t most_points = 2048;
inline constexpr std::size_t most_cells = 4096;
inline constexpr std::size_t most_neighbors = 512;

#if defined(CHUNK)
inline constexpr std::uint32_t chunk_size = CHUNK;
#else
inline constexpr std::uint32_t chunk_size = shortshot::default_chunk_size;
#endif

#if defined(COMPACT)
using Workspace = shortshot::CompactWorkspace<most_neighbors>;
#else
using Workspace = shortshot::Workspace<most_neighbors>;
#endif
using Grid = shortshot::StaticGrid<most_points, most_cells>;

/// One call's arguments and the caller's memory.
struct Job {
  shortshot::CloudView cloud;
  std::size_t index;  ///< the key point
  float radius;
  Workspace* workspace;
  Grid* grid;
  shortshot::OrganizedSearch* image;
  const shortshot::Lab* colors;  ///< one per point
  std::uint32_t gathered;        ///< neighbors that lie in the workspace, for describe_given()
  float* out;
};

extern "C" {
shortshot::Status describe_brute(const Job* job);
shortshot::Status describe_second(const Job* job);  ///< by the second configuration of an image
shortshot::Status build_grid(const Job* job);
shortshot::Status describe_grid(const Job* job);
shortshot::Status build_organized(const Job* job);
shortshot::Status describe_organized(const Job* job);
shortshot::Status gather_brute(const Job* job);
shortshot::Status gather_grid(const Job* job);
shortshot::Status describe_given(const Job* job);
shortshot::Status describe_given_lab(const Job* job);
}
