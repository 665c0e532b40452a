// Labeled real views of single objects, for recognition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::datasets {

/// What a view shows, and its place in the set's own split (a view may be in neither part).
struct LabeledView {
  std::string file;  // in the set's folder
  std::string object_class;
  std::string instance;
  std::string sequence;  // views of one sequence may be almost the same
  bool is_training = false;
  bool is_test = false;
};

/// How a set is meant to be divided. leave_one_sequence_out: each sequence is recognized by all others; fixed: by
/// is_training and is_test.
enum class Split : std::uint8_t { leave_one_sequence_out, fixed };

struct ViewSet {
  std::string name;  // "segments", "w-rgbd" or "bigbird"
  Split split = Split::fixed;
  std::vector<LabeledView> views;

  /// Reads view i from its file, each time anew: meters, with colors, in the file's own axes. May be called from many
  /// threads at once. Throws InputError for a file that is missing or broken, std::out_of_range for i >= views.size().
  std::function<RgbdCloud(std::size_t)> load;
};

/// For messages.
inline constexpr const char* looked_for_views =
    "labels.csv, CLASS_INSTANCE_VIDEO_FRAME.pcd (three numbers) or OBJECT/clouds/NP1_0.pcd";

/// The sets that the folder holds; none if it holds none of `looked_for_views`. Files of other names are not looked at.
///
/// * labels.csv (file, object_class, instance, scene, scene_set): "segments" cut out of Kinect frames. A sequence is a
///   scene, which is left out in turn. Second split: scene_set `learn` trains, `test` tests; an instance may be in one
///   of them only.
/// * CLASS_INSTANCE_VIDEO_FRAME.pcd, three numbers, in this folder or in CLASS/CLASS_INSTANCE/: "w-rgbd", the
///   W-RGB-D object set (Lai et al. 2011). Ordered by class and numbers. A sequence is a video; 1 and 4 (30 and 60
///   degrees of elevation) train, 2 (45) tests. These files have y as the depth axis, and the camera in the origin.
/// * OBJECT/clouds/NP<camera>_<angle>.pcd: "bigbird", BigBIRD (Singh et al. 2014) and the YCB views taken with the same
///   rig. Ordered by object and numbers. Classes are those of classes.csv (object, object_class), without it each
///   object is its own. A sequence is a camera; NP1 and NP3 train, NP2 tests. NOT CHECKED against a real download, for
///   none was at hand: neither the layout nor where the files' coordinates have the camera.
///
/// Throws InputError for a table that is broken or lacks an object's class, and for clouds that are missing.
std::vector<ViewSet> open_view_sets(const std::string& directory);

}  // namespace shortshot_bench::datasets
