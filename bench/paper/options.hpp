// What the experiments are asked to do.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "paper/campaign/shard.hpp"

namespace shortshot_bench::paper {

struct PaperOptions {
  std::string command;            // matching, registration, recognition, ablation or merge
  std::vector<std::string> data;  // folders: data sets; of merge: results
  std::string out;                // folder of the results
  std::vector<std::string> descriptors;
  std::vector<std::string> peers;  // registration: NAME=PROGRAM, see peer_program.hpp
  campaign::Shard shard;
  unsigned threads = 0;  // 0: as many as there are cores
  std::uint32_t seed = 1;
  std::optional<float> radius_m;         // of supports and frames; else the protocol's
  std::optional<float> leaf_m;           // one key point in each voxel of this size
  std::optional<float> normal_radius_m;  // of SHOT's and CSHOT's normals
  double scale = 1.0;                    // meters in a unit of the clouds, motions and meshes
  char up = 'z';                         // the axis of meshes that points up
  float tolerance_m = 0.0f;              // of correct matches and of inliers; 0: the protocol's
  bool all_of_target = false;            // matching: key points are left out of the source alone
  bool quick = false;                    // a small part of the data, to see that all works
  bool check = false;                    // against the bands of figures in bands.json
};

/// False if there is nothing to run: help was asked for, or the options are wrong (exit code 2), both said already.
bool parse_options(int argc, const char* const* argv, PaperOptions& options, int& exit_code);

}  // namespace shortshot_bench::paper
