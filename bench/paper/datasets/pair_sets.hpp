// Pairs of real views with the true motion between them, for key-point matching.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "paper/datasets/rigid_motion.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::datasets {

/// Two clouds in meters, each as its camera sees it: target = truth * source.
struct ViewPair {
  std::string name;
  RgbdCloud source;
  RgbdCloud target;
  RigidMotion truth{};
  double rotation_deg = 0.0;  // of truth
};

struct PairSet {
  std::string name;                     // "object-scene", "views" or "frames"
  bool has_color = false;               // both clouds of each pair have colors
  std::vector<std::string> pair_names;  // one for each pair, as the next two
  std::vector<std::string> groups;      // pairs of one group share a cloud: no independent samples for a bootstrap
  std::vector<double> rotation_deg;     // by the true motion
  std::vector<RigidMotion> truths;      // target = truth * source
  std::vector<std::size_t> sources;     // the number of the source among the clouds
  std::vector<std::size_t> targets;

  std::size_t clouds = 0;

  /// Reads a cloud from its files, each time anew; may be called from many threads at once. Throws InputError for files
  /// that are broken, std::out_of_range for a cloud that does not exist.
  std::function<RgbdCloud(std::size_t)> load_cloud;

  /// Pair i with both of its clouds, likewise; std::out_of_range for i >= size().
  ViewPair load(std::size_t i) const {
    return {pair_names.at(i), load_cloud(sources[i]), load_cloud(targets[i]), truths[i], rotation_deg[i]};
  }

  std::size_t size() const { return pair_names.size(); }
};

/// The same set in meters, where a unit of its clouds and motions is `meters` long. Frames are in meters by their
/// format.
PairSet scaled(PairSet set, double meters);

/// Every `step`-th pair (from 1 on) in the order of rotation, the smallest first.
std::vector<std::size_t> every_nth_by_rotation(const PairSet& set, std::size_t step);

/// For messages.
inline constexpr const char* looked_for_pairs = "object_scene_pairs.csv, view_pairs.csv or frame_pairs.csv";

/// The sets that the folder holds; none if it holds none of `looked_for_pairs`. All motions are read at once, clouds by
/// load(), but that their files are there is asked at once.
///
/// * object_scene_pairs.csv (scene, object, model, gt): "object-scene", scenes of a Kinect without colors.
///   models_color/MODEL, scenes_xyz/SCENE.pcd, groundtruth/GT with scene = T * model. A group is a scene.
/// * view_pairs.csv (source, target, gt): "views", colored views of single objects. views_color/SOURCE and TARGET,
///   view_pairs_gt/GT with target = T * source. A group is a source view.
/// * frame_pairs.csv (frame_a, frame_b): "frames" of a room, from a to b. FRAME.color.jpg or .png, FRAME.depth.png,
///   FRAME.pose.txt (camera to world), camera-intrinsics.txt; see read_frame(). A group is a first frame. Depth beyond
///   `max_depth` meters is dropped: the protocol's 3 m, a Kinect's error grows with the square.
///
/// Throws InputError for a table or motion that is missing or broken, and for clouds that are missing.
std::vector<PairSet> open_pair_sets(const std::string& directory, double max_depth = 3.0);

}  // namespace shortshot_bench::datasets
