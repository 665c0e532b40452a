// What a user names as a cloud: a cloud file, or images of a depth camera.
#pragma once

#include <string>

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// What files do not say of themselves.
struct InputOptions {
  std::string intrinsics;   // of depth images: FX,FY,CX,CY, or a file with the matrix; empty: not given
  double unit = 0.001;      // meters in a count of a depth image
  bool drop_zeros = false;  // points of (0, 0, 0) are no measurements
};

/// A PCD or PLY file, "DEPTH.png", or "DEPTH.png,COLOR.png" (a JPEG, too); a PNG file is told by its content. Throws
/// InputError, also for a depth image without intrinsics.
RgbdCloud read_input(const std::string& input, const InputOptions& options);

/// A line for each note of the cloud, on stdout.
void print_notes(const RgbdCloud& cloud);

/// What a picture calls it: the name of the cloud's or the depth image's file, without its folder.
std::string name_of_input(const std::string& input);

/// Throws InputError if `output`, a file that is to be written, is one that is read.
void keep_input(const std::string& input, const std::string& output);

}  // namespace shortshot_bench
