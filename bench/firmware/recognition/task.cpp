#include "firmware/recognition/task.hpp"

#include <cstring>

#include "firmware/programs/recognition.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/object_views.hpp"

namespace shortshot_bench::firmware {
namespace {

namespace ss = shortshot;
using recognition::Stored;

constexpr std::size_t training_keypoints = 33;
constexpr int turns = 4;
constexpr float normal_radius = 0.01f;
const ss::RecognizerOptions recognizer_options{0.02f, 1, 8};

LabeledView labeled(std::uint32_t object, const ObjectViewOptions& options) {
  const ObjectView view = make_object_view(object, options);
  return {view.cloud, view.center, object};
}

template <class D>
ss::Features<D> described(const LabeledView& view, std::size_t most) {
  ss::CloudView cloud = view_of_cloud(view.cloud);
  const ss::GridSearch search(cloud, recognition::radius);
  std::vector<ss::SurfaceNormal> normals;
  if constexpr (D::needs_normals) {
    require(ss::estimate_normals(cloud, search, normal_radius, ss::Viewpoint::towards({}), normals));
    cloud = ss::with_normals(cloud, normals.data());
  }
  std::vector<std::uint32_t> keypoints;
  recognition::for_keypoints(cloud.size, most,
                             [&](std::size_t i) { keypoints.push_back(static_cast<std::uint32_t>(i)); });
  ss::Features<D> features;
  require(ss::extract<D>(cloud, search, keypoints, recognition::support(), features));
  return features;
}

ss::StoredFeatures<Stored> stored(const LabeledView& view, std::size_t most) {
  ss::StoredFeatures<Stored> features;
  require(ss::store(described<recognition::Descriptor>(view, most), features));
  return features;
}

bool is_right(const RecognitionTask& task, const ss::Recognizer& recognizer, const LabeledView& view,
              const std::vector<ss::Hypothesis>& found) {
  return !found.empty() && recognizer.instance_name(found[0].instance) == task.instances[view.object];
}

void append(std::string& to, const void* bytes, std::size_t size) { to.append(static_cast<const char*>(bytes), size); }

}  // namespace

RecognitionTask generated_task() {
  RecognitionTask task;
  for (std::uint32_t object = 0; object < generated_objects; ++object) {
    task.classes.push_back(generated_class(object));
    task.instances.push_back(generated_instance(object));
    for (int turn = 0; turn < turns; ++turn) {
      const auto seed = 100 * object + static_cast<std::uint32_t>(turn) + 1;
      task.training.push_back(labeled(object, {4.0 * turn / turns, 0.36, seed, 320}));
    }
    task.test.push_back(labeled(object, {1.3, 0.40, 5000 + object, 320}));
    task.test.push_back(labeled(object, {3.6, 0.33, 6000 + object, 320}));
  }
  return task;
}

ss::Recognizer train_stored(const RecognitionTask& task) {
  ss::Recognizer recognizer(recognizer_options);
  for (const LabeledView& view : task.training) {
    require(ss::train(recognizer, stored(view, training_keypoints), view.center, task.classes[view.object],
                      task.instances[view.object]));
  }
  return recognizer;
}

std::size_t right_with_cshot(const RecognitionTask& task) {
  using D = ss::Cshot1344;
  ss::Recognizer recognizer(recognizer_options);
  for (const LabeledView& view : task.training) {
    require(ss::train(recognizer, described<D>(view, training_keypoints), view.center, task.classes[view.object],
                      task.instances[view.object]));
  }
  std::size_t right = 0;
  for (const LabeledView& view : task.test) {
    std::vector<ss::Hypothesis> found;
    require(ss::recognize(recognizer, described<D>(view, recognition::keypoints), found));
    right += is_right(task, recognizer, view, found) ? 1 : 0;
  }
  return right;
}

std::string views_of(const RecognitionTask& task) {
  std::string bytes;
  const auto number = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255u);
  };
  number(task.test.size());
  for (const LabeledView& view : task.test) {
    const std::size_t points = view.cloud.xyz.size() / 3;
    number(points);
    number(view.object);
    for (const float value : view.cloud.xyz) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      number(bits);
    }
    append(bytes, view.cloud.rgb.data(), view.cloud.rgb.size());
    while (bytes.size() % 4 != 0) bytes += '\0';
  }
  return bytes;
}

}  // namespace shortshot_bench::firmware
