// How the library makes the descriptors that golden vectors may hold, and how far a row may be from the reference's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/frame/frame.hpp"
#include "shortshot/search/neighborhood.hpp"
#include "shortshot/status.hpp"

namespace shortshot_bench::golden {

// How votes are shared: by the rule of the published code or of PCL's SHOT, where they jump at the borders and in the
// middles of cells, or without jumps.
enum class Sharing { published, shot, continuous };

// A histogram of one signal in the cells of a spherical grid.
struct Histogram {
  int radial, elevation, azimuth;
  int bins;  // 0: of occupancy, one value a cell
  bool of_colors;
};

// The configuration of a descriptor whose output an array holds.
struct DescriptorOutput {
  const char* name;
  int size;
  bool needs_colors;
  bool needs_normals;
  double row_l2;  // how far a row may be from the reference's, as an L2 distance
  Sharing sharing;
  std::vector<Histogram> (*histograms)();  // none of continuous ones
  // describe() of the library; `key_color` and the cloud's colors and normals are looked at only if they are needed.
  shortshot::Status (*describe)(const shortshot::Neighborhood& n, const shortshot::CloudView& cloud,
                                shortshot::Rgb key_color, const shortshot::Frame& frame, shortshot::Radius radius,
                                float* out);
  double nibble_scale;                                          // steps in 1 of NibbleDescriptor
  void (*to_nibbles)(const float* row, std::uint8_t* nibbles);  // (size + 1) / 2 bytes
};

const DescriptorOutput* find_descriptor(const std::string& name);  // null if the name is none of a descriptor
const DescriptorOutput* find_nibbles(const std::string& name);     // the same of "<descriptor>_nibbles"

}  // namespace shortshot_bench::golden
