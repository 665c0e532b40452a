// What is measured: steps of work, and which of them make up a contender.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "speed/timing/clock.hpp"

namespace shortshot_bench::peers {

/// Work of a suite that is timed by itself, such as building a tree. Steps run in their order; one may use what those
/// before it have made.
struct Step {
  std::string name;
  std::function<void()> run;
  Clock clock = Clock::thread_cpu;
};

/// One way to describe all key points; or to make what descriptors are made of, as key points and normals.
struct Contender {
  std::string implementation;            // "shortshot", "naive double", "PCL ..."
  std::string descriptor;                // or key_points_made, normals_made, fast_normals_made
  std::string build;                     // of ours: "O2" or "avx2"
  std::string search;                    // "grid", "nanoflann", "FLANN", "voxels", "image"
  std::size_t describe = 0;              // the step that describes all key points, indices and one-off work left out
  std::vector<std::size_t> frame{};      // the steps from raw points to descriptors
  std::size_t output_bytes = 0;          // of all descriptors; not counted as memory that a contender needs
  std::vector<std::string> against{};    // of a peer: our descriptors that it is compared with
  std::function<const float*()> rows{};  // of ours: the descriptors that the last frame gave
  std::size_t made = 0;                  // how many come out; 0: one for each key point of the task
};

inline constexpr const char* key_points_made = "key points";
inline constexpr const char* normals_made = "normals of the image";
inline constexpr const char* fast_normals_made = "fast normals of the image";  // not of all neighbors in a radius
/// Added to a descriptor's name where those are its normals.
inline constexpr const char* with_fast_normals = ", fast normals";

/// Contenders that share steps.
struct Suite {
  std::string name;
  std::vector<Step> steps{};
  std::vector<Contender> contenders{};
  std::function<void()> release{};  // gives all memory back, as before the first step

  std::size_t add(std::string step, std::function<void()> run, Clock clock = Clock::thread_cpu) {
    steps.push_back({std::move(step), std::move(run), clock});
    return steps.size() - 1;
  }

  /// A contender of one step, which makes so many, each of so many bytes.
  void add_maker(Contender contender, std::size_t step, std::size_t made, std::size_t bytes_of_each) {
    contender.describe = step;
    contender.frame = {step};
    contender.made = made;
    contender.output_bytes = made * bytes_of_each;
    contenders.push_back(std::move(contender));
  }
};

}  // namespace shortshot_bench::peers
