#include "firmware/recognition/segments.hpp"

#include <algorithm>
#include <set>

#include "tools/io/averaged_cloud.hpp"
#include "tools/io/input_error.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/labels/dataset_files.hpp"
#include "tools/labels/view_sets.hpp"

namespace shortshot_bench::firmware {
namespace {

namespace ss = shortshot;

constexpr float voxel = 0.004f;

RecognitionTask empty_task() { return {{}, {}, 0.04f, 0.015f, 33}; }

std::set<std::string> scenes_of(const std::vector<Segment>& segments) {
  std::set<std::string> scenes;
  for (const Segment& segment : segments) scenes.insert(segment.scene);
  return scenes;
}

std::vector<std::uint8_t> flash_of(const ss::Recognizer& recognizer) {
  std::vector<std::uint8_t> model;
  require(ss::save_for_flash<recognition::Stored>(recognizer, model));
  return model;
}

/// The recognizer that a board has of it.
ss::Recognizer as_on_board(const ss::Recognizer& recognizer) {
  const std::vector<std::uint8_t> model = flash_of(recognizer);
  ss::Recognizer loaded;
  require(ss::load_from_flash<recognition::Stored>(model.data(), model.size(), loaded));
  return loaded;
}

/// Trains with the segments that are not left out; the recognizer is finished(recognizer).
template <class Features, class IsLeftOut, class Finished>
ss::Recognizer train_without(const std::vector<Segment>& segments, const std::vector<Features>& learned,
                             const IsLeftOut& is_left_out, const Finished& finished) {
  ss::Recognizer recognizer(recognizer_options());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const LabeledView& view = segments[i].view;
    if (is_left_out(segments[i])) continue;
    require(ss::train(recognizer, learned[i], view.center, view.object_class, view.instance));
  }
  return finished(recognizer);
}

/// May it be one of the objects that were learned?
template <class Features>
bool is_one_of_these(const std::vector<ss::Hypothesis>& found, const Features& asked) {
  const auto votes = std::count(asked.status.begin(), asked.status.end(), ss::Status::ok);
  return !found.empty() && found[0].score >= recognition::least_share * static_cast<float>(votes);
}

/// Trains with all but one scene, and asks for that, scene by scene; then without the object that is asked for, too.
template <class Features, class Finished>
LeftOut leave_out(const std::vector<Segment>& segments, const std::vector<Features>& learned,
                  const std::vector<Features>& asked, const Finished& finished) {
  LeftOut out;
  std::vector<ss::Hypothesis> found;
  for (const std::string& scene : scenes_of(segments)) {
    const auto is_in_scene = [&](const Segment& segment) { return segment.scene == scene; };
    const ss::Recognizer recognizer = train_without(segments, learned, is_in_scene, finished);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const LabeledView& view = segments[i].view;
      if (!is_in_scene(segments[i])) continue;
      require(ss::recognize(recognizer, asked[i], found));
      const bool right = is_right(recognizer, view, found);
      const bool is_class = !found.empty() && recognizer.class_name(found[0].object_class) == view.object_class;
      out.instances_right += right ? 1 : 0;
      out.classes_right += is_class ? 1 : 0;
      out.right_kept += right && is_one_of_these(found, asked[i]) ? 1 : 0;
      const auto is_unknown = [&](const Segment& segment) {
        return is_in_scene(segment) || segment.view.instance == view.instance;
      };
      require(ss::recognize(train_without(segments, learned, is_unknown, finished), asked[i], found));
      out.unknown_refused += is_one_of_these(found, asked[i]) ? 0 : 1;
    }
  }
  return out;
}

/// Of all segments, with so many key points each.
ss::Recognizer trained(const std::vector<Segment>& segments, std::size_t keypoints) {
  RecognitionTask task = empty_task();
  task.training_keypoints = keypoints;
  for (const Segment& segment : segments) task.training.push_back(segment.view);
  return train_stored(task);
}

/// The most key points a view of which a model of all segments is not larger; at least 1.
std::size_t keypoints_in(const std::vector<Segment>& segments, std::size_t most_bytes) {
  std::size_t fit = 1, do_not = 1024;
  while (do_not - fit > 1) {
    const std::size_t middle = (fit + do_not) / 2;
    (flash_of(trained(segments, middle)).size() <= most_bytes ? fit : do_not) = middle;
  }
  return fit;
}

}  // namespace

std::vector<Segment> read_segments(const std::string& folder) {
  for (const datasets::ViewSet& set : datasets::open_view_sets(folder)) {
    if (set.split != datasets::Split::leave_one_sequence_out) continue;
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < set.views.size(); ++i) {
      const datasets::LabeledView& label = set.views[i];
      const RgbdCloud cloud = averaged(set.load(i), voxel);
      const ss::Point center = mean_point(view_of_cloud(cloud));
      segments.push_back({{cloud, center, label.object_class, label.instance}, label.sequence});
    }
    return segments;
  }
  throw datasets::not_recognized(folder, "labels.csv");
}

RecognitionTask segments_task(const std::vector<Segment>& segments) {
  RecognitionTask task = empty_task();
  const std::set<std::string> scenes = scenes_of(segments);
  for (const Segment& segment : segments) {
    const auto number = std::distance(scenes.begin(), scenes.find(segment.scene));
    (number % 4 == 3 ? task.test : task.training).push_back(segment.view);
  }
  return task;
}

LeftOut leave_scenes_out(const std::vector<Segment>& segments, std::size_t most_bytes, bool thinned) {
  const std::size_t keypoints = keypoints_in(segments, thinned ? 3 * most_bytes : most_bytes);
  const RecognitionTask task = empty_task();
  std::vector<ss::StoredFeatures<recognition::Stored>> learned, asked;
  for (const Segment& segment : segments) {
    learned.push_back(stored(task, segment.view, keypoints));
    asked.push_back(stored(task, segment.view, recognition::keypoints));
  }
  const auto smaller = [&](const ss::Recognizer& recognizer) {
    ss::Recognizer out = recognizer;
    if (thinned) require(ss::thin_for_flash<recognition::Stored>(recognizer, most_bytes, out));
    return out;
  };
  LeftOut out = leave_out(segments, learned, asked,
                          [&](const ss::Recognizer& recognizer) { return as_on_board(smaller(recognizer)); });
  const std::vector<std::uint8_t> model = flash_of(smaller(trained(segments, keypoints)));
  ss::ModelView<recognition::Stored> view;
  require(view.open(model.data(), model.size()));
  out.keypoints = keypoints;
  out.codewords = view.codeword_count();
  out.model_bytes = model.size();
  return out;
}

LeftOut leave_scenes_out_with_cshot(const std::vector<Segment>& segments, std::size_t keypoints) {
  const RecognitionTask task = empty_task();
  std::vector<ss::Features<ss::Cshot1344>> learned, asked;
  std::size_t codewords = 0;
  for (const Segment& segment : segments) {
    learned.push_back(described<ss::Cshot1344>(task, segment.view, keypoints));
    asked.push_back(described<ss::Cshot1344>(task, segment.view, recognition::keypoints));
    for (const ss::Status status : learned.back().status) codewords += status == ss::Status::ok ? 1 : 0;
  }
  LeftOut out = leave_out(segments, learned, asked, [](const ss::Recognizer& recognizer) { return recognizer; });
  out.keypoints = keypoints;
  out.codewords = codewords;
  out.model_bytes = codewords * (ss::Cshot1344::size * sizeof(float) + 16);
  return out;
}

}  // namespace shortshot_bench::firmware
