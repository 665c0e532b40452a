// What the format says about each array it knows, and the descriptors that stand behind the descriptor
// arrays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/frame/frame.hpp"
#include "shortshot/search/neighborhood.hpp"
#include "shortshot/status.hpp"

namespace shortshot_bench::golden {

enum class Role {
  input,      // taken as it is: what the library is given
  reference,  // what the library must reproduce
  later,      // the reference of something that the library does not have yet
};

struct KnownArray {
  std::string dtype;
  std::string counted_by;              // it has one row per row of the array of this name; empty: any number
  std::vector<std::uint64_t> columns;  // the shape of one row
  Role role;
};

std::optional<KnownArray> find_known_array(const std::string& name);

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
