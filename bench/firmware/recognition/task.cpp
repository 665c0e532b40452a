#include "firmware/recognition/task.hpp"

#include <cstring>

#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/object_views.hpp"

namespace shortshot_bench::firmware {
namespace {

namespace ss = shortshot;

LabeledView labeled(std::uint32_t object, const ObjectViewOptions& options) {
  const ObjectView view = make_object_view(object, options);
  return {view.cloud, view.center, generated_class(object), generated_instance(object)};
}

/// The recognizer's number of an instance; one that no instance has if it was not learned.
std::uint32_t instance_number(const ss::Recognizer& recognizer, const std::string& instance) {
  std::uint32_t number = 0;
  while (number < recognizer.instance_count() && recognizer.instance_name(number) != instance) ++number;
  return number;
}

}  // namespace

ss::RecognizerOptions recognizer_options() { return {0.02f, 1, 8}; }

RecognitionTask generated_task() {
  constexpr int turns = 4;
  RecognitionTask task{{}, {}, 0.025f, 0.01f, 33};
  for (std::uint32_t object = 0; object < generated_objects; ++object) {
    for (int turn = 0; turn < turns; ++turn) {
      const auto seed = 100 * object + static_cast<std::uint32_t>(turn) + 1;
      task.training.push_back(labeled(object, {4.0 * turn / turns, 0.36, seed, 320}));
    }
    task.test.push_back(labeled(object, {1.3, 0.40, 5000 + object, 320}));
    task.test.push_back(labeled(object, {3.6, 0.33, 6000 + object, 320}));
  }
  return task;
}

template <class D>
ss::Features<D> described(const RecognitionTask& task, const LabeledView& view, std::size_t most) {
  ss::CloudView cloud = view_of_cloud(view.cloud);
  const ss::GridSearch search(cloud, task.radius);
  std::vector<ss::SurfaceNormal> normals;
  if constexpr (D::needs_normals) {
    require(ss::estimate_normals(cloud, search, task.normal_radius, ss::Viewpoint::towards({}), normals));
    cloud = ss::with_normals(cloud, normals.data());
  }
  std::vector<std::uint32_t> keypoints;
  recognition::for_keypoints(cloud.size, most,
                             [&](std::size_t i) { keypoints.push_back(static_cast<std::uint32_t>(i)); });
  ss::Features<D> features;
  require(ss::extract<D>(cloud, search, keypoints, recognition::support(task.radius), features));
  return features;
}
template ss::Features<ss::Cshot1344> described(const RecognitionTask&, const LabeledView&, std::size_t);

ss::StoredFeatures<recognition::Stored> stored(const RecognitionTask& task, const LabeledView& view, std::size_t most) {
  ss::StoredFeatures<recognition::Stored> features;
  require(ss::store(described<recognition::Descriptor>(task, view, most), features));
  return features;
}

ss::Recognizer train_stored(const RecognitionTask& task) {
  ss::Recognizer recognizer(recognizer_options());
  for (const LabeledView& view : task.training) {
    require(ss::train(recognizer, stored(task, view, task.training_keypoints), view.center, view.object_class,
                      view.instance));
  }
  return recognizer;
}

std::size_t right_with_cshot(const RecognitionTask& task) {
  using D = ss::Cshot1344;
  ss::Recognizer recognizer(recognizer_options());
  for (const LabeledView& view : task.training) {
    require(ss::train(recognizer, described<D>(task, view, task.training_keypoints), view.center, view.object_class,
                      view.instance));
  }
  std::size_t right = 0;
  for (const LabeledView& view : task.test) {
    std::vector<ss::Hypothesis> found;
    require(ss::recognize(recognizer, described<D>(task, view, recognition::keypoints), found));
    right += is_right(recognizer, view, found) ? 1 : 0;
  }
  return right;
}

bool is_right(const ss::Recognizer& recognizer, const LabeledView& view, const std::vector<ss::Hypothesis>& found) {
  return !found.empty() && recognizer.instance_name(found[0].instance) == view.instance;
}

std::vector<std::uint32_t> views_of(const RecognitionTask& task, const ss::Recognizer& recognizer) {
  std::vector<std::uint32_t> words;
  const auto copy = [&](const void* bytes, std::size_t size) {
    const std::size_t begin = words.size();
    words.resize(begin + (size + 3) / 4);
    std::memcpy(words.data() + begin, bytes, size);
  };
  words.push_back(static_cast<std::uint32_t>(task.test.size()));
  copy(&task.radius, sizeof task.radius);
  for (const LabeledView& view : task.test) {
    words.push_back(static_cast<std::uint32_t>(view.cloud.xyz.size() / 3));
    words.push_back(instance_number(recognizer, view.instance));
    copy(view.cloud.xyz.data(), view.cloud.xyz.size() * sizeof(float));
    copy(view.cloud.rgb.data(), view.cloud.rgb.size());
  }
  return words;
}

}  // namespace shortshot_bench::firmware
