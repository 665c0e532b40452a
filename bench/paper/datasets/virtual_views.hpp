// Virtual RGB-D views of scanned objects, for recognition: what a Kinect would have measured of each of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::datasets {

/// The protocol's numbers that may be changed. Those of the camera and of its places around the object may not: see
/// virtual_view_renderer.cpp.
struct VirtualViewOptions {
  double scale = 1.0;      // meters in a unit of the meshes
  char up = 'z';           // their axis that points up
  std::uint32_t seed = 1;  // draws all of what follows
  double nearest_m = 0.8;  // the distance of the camera from the object's center
  double farthest_m = 1.3;
  double azimuth_jitter_deg = 7.5;    // either way; the azimuths are 30 degrees apart
  double depth_noise_scale = 2.0;     // times the Kinect's deviation, 0.0012 + 0.0019 (z - 0.4)^2 m
  double disparity_step_px = 0.125;   // the disparity is rounded to multiples of it; 0: not at all
  double least_cos_incidence = 0.2;   // surfaces seen at a more grazing angle are not measured
  double dropped_share = 0.01;        // of the pixels are dropped at random
  double largest_hidden_share = 0.5;  // test views: a half plane hides at most so much of the object's pixels
  double gain_spread = 0.12;          // each channel of a view is multiplied by 1 - it to 1 + it
  double color_noise = 4.0;           // standard deviation, of 255
};

/// What a view shows.
struct VirtualView {
  std::string object;
  std::string object_class;
  int elevation_deg = 0;
  int azimuth_index = 0;  // times 30 degrees
  bool is_training = false;
};

struct VirtualViewSet {
  /// 24 for each object: for training 12 from 30 and from 60 degrees above, at every second azimuth, for testing 12
  /// from 45 degrees.
  std::vector<VirtualView> views;

  /// Renders a view: an unorganized cloud of the measured points of nothing but the object, in the camera's frame (x
  /// right, y down, z forward, meters, camera at the origin). It depends on the options and the view alone: the same
  /// view gives the same bytes whenever and in whichever thread it is made. Thread-safe. Throws std::out_of_range for a
  /// view that does not exist.
  ///
  /// Every pixel of the object uses up as many random numbers whatever happens to it, so that an option about noise,
  /// dropped or hidden pixels changes nothing else.
  std::function<RgbdCloud(std::size_t view)> load;
};

/// Is this a folder for open_virtual_views(): with a classes.csv and an OBJECT/textured.obj?
inline constexpr const char* looked_for_meshes = "classes.csv with OBJECT/textured.obj";
bool holds_meshes(const std::string& directory);

/// `directory` holds classes.csv, whose columns object and object_class list the objects, and OBJECT/textured.obj for
/// each of them, in meters and standing on its own z axis, as the YCB scans do, or as the options say. The meshes are
/// read at once and shared by all copies of the set. Throws InputError for anything that is missing or broken,
/// std::invalid_argument for options that are out of range.
VirtualViewSet open_virtual_views(const std::string& directory, const VirtualViewOptions& options = {});

}  // namespace shortshot_bench::datasets
