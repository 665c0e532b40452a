// A folder of golden vectors, read and checked: from here on every size and index in it can be relied on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "array.hpp"
#include "shortshot/cloud/cloud.hpp"

namespace shortshot_bench::golden {

struct Case {
  std::optional<double> radius;            // meters, > 0
  std::optional<double> lrf_radius;        // meters, > 0
  bool frames_are_pcl_lrf = true;          // false: a synthetic case with frames of its own
  std::vector<std::string> keypoint_kind;  // one per key point, or none at all
  std::vector<Array> arrays;               // as listed; without bytes where nothing can be checked yet

  // The inputs; empty if the folder has no such array.
  std::vector<float> points;
  std::vector<std::uint8_t> rgb;
  std::vector<float> normals;            // NaN where a point has none
  std::vector<std::uint32_t> keypoints;  // indices of finite points
  std::vector<float> frames;             // nine floats per key point

  const Array* find(const std::string& name) const;  // null if it is not listed
  shortshot::CloudView cloud() const;
};

// Throws InputError if case.json or a file it lists is missing or broken, whether or not it will be compared.
Case read_case(const std::string& folder);

}  // namespace shortshot_bench::golden
