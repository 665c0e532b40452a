// Segments of real frames as a task: which objects they show is known, and in which scene they were seen.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware/recognition/task.hpp"

namespace shortshot_bench::firmware {

struct Segment {
  LabeledView view;
  std::string scene;
};

/// The "segments" of a folder (see tools/labels/view_sets.hpp), averaged in voxels of 4 mm. Throws InputError.
std::vector<Segment> read_segments(const std::string& folder);

/// Every fourth scene is asked for, the others are learned.
RecognitionTask segments_task(const std::vector<Segment>& segments);

/// How many are named rightly if each scene in turn is asked for and all others are learned.
struct LeftOut {
  std::size_t keypoints = 0;  // of a view that is learned
  std::size_t codewords = 0;  // of all views
  std::size_t model_bytes = 0;
  std::size_t instances_right = 0;
  std::size_t classes_right = 0;
  std::size_t right_kept = 0;       // of those whose instance is right, with a score above recognition::least_share
  std::size_t unknown_refused = 0;  // with one below it, if the view's instance was not learned at all
};

/// With models as the board reads them, of as many key points a view as fit in so many bytes if all views are learned;
/// `thinned`: of as many as fit in three times the bytes, of which those remain that contribute most. Throws
/// std::runtime_error.
LeftOut leave_scenes_out(const std::vector<Segment>& segments, std::size_t most_bytes, bool thinned);

/// With CSHOT-1344 in floats.
LeftOut leave_scenes_out_with_cshot(const std::vector<Segment>& segments, std::size_t keypoints);

}  // namespace shortshot_bench::firmware
