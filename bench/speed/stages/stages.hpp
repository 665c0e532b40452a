// The library's stages, each as something that a benchmark can call, in one build for each instruction set.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "shortshot/status.hpp"
#include "speed/stages/workload.hpp"

namespace shortshot_bench {

/// Key points of a whole frame, of those that are sampled.
inline constexpr std::size_t frame_keypoints = 1000;

/// Votes of mean shift.
inline constexpr std::size_t frame_votes = 2000;

struct Stage {
  std::string name;           // "search grid", "kernel Scsh336", ...
  std::size_t points = 0;     // how much one run goes through: points of the cloud, for stages that look at all of it,
  std::size_t keypoints = 0;  // key points, for the others,
  std::size_t neighbors = 0;  // and neighbors of these, or of those; 0: it looks at none
  std::size_t bytes = 0;      // size of what it makes: one descriptor, the index, the cloud's Lab; 0: not measured
  bool per_frame = false;     // its cost is told for a camera frame: that of all of it, or of its votes for objects
  std::function<shortshot::Status()> run;  // the first status that is not ok
};

struct StageBuild {
  std::string isa;  // as the library calls it: sse2, avx2, neon, scalar
  std::vector<Stage> stages;
};

/// All stages in all builds that this CPU can run; one for AVX2 that it cannot is left out with a line on stderr.
/// The workload must outlive the stages. Stages with color or intensity are left out for clouds without.
std::vector<StageBuild> build_stages(const Workload& workload);

bool cpu_has_avx2();

}  // namespace shortshot_bench
