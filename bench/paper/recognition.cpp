#include "paper/recognition.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace shortshot_bench::paper {
namespace {

ObjectLabel hough_label(const shortshot::Recognizer& recognizer, const Described& described,
                        const std::string& layout) {
  std::vector<shortshot::Hypothesis> hypotheses;
  require(shortshot::recognize(recognizer, described.rows(), layout, hypotheses));
  if (hypotheses.empty()) return {};
  const shortshot::Hypothesis& best = hypotheses.front();
  return {recognizer.class_name(best.object_class), recognizer.instance_name(best.instance)};
}

ObjectLabel nearest_label(const shortshot::Recognizer& recognizer, const Described& described,
                          const std::string& layout) {
  const auto largest = [](const std::vector<float>& shares) {
    return static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
  };
  shortshot::ActivationShares shares;
  require(shortshot::activation_shares(recognizer, described.rows().descriptors, layout, shares));
  const std::size_t object_class = largest(shares.classes);
  if (!(shares.classes[object_class] > 0.0f)) return {};
  return {recognizer.class_name(object_class), recognizer.instance_name(largest(shares.instances))};
}

}  // namespace

std::vector<Fold> folds_of(const RecognitionTask& task) {
  Fold fixed;
  std::set<std::string> sequences;
  for (std::size_t i = 0; i < task.views.size(); ++i) {
    if (task.views[i].is_training) fixed.training.push_back(i);
    if (task.views[i].is_test) fixed.test.push_back(i);
    sequences.insert(task.views[i].sequence);
  }
  if (!task.leave_one_sequence_out) return {fixed};
  std::vector<Fold> folds;
  for (const std::string& sequence : sequences) {
    Fold fold;
    for (std::size_t i = 0; i < task.views.size(); ++i) {
      (task.views[i].sequence == sequence ? fold.test : fold.training).push_back(i);
    }
    folds.push_back(fold);
  }
  return folds;
}

std::size_t RecognitionTask::tests() const {
  if (leave_one_sequence_out) return views.size();
  return static_cast<std::size_t>(std::count_if(views.begin(), views.end(), [](const auto& v) { return v.is_test; }));
}

std::vector<RecognitionTask> tasks_of(const datasets::ViewSet& set) {
  RecognitionTask task{set.name, {}, set.split == datasets::Split::leave_one_sequence_out, set.load};
  for (const datasets::LabeledView& v : set.views) {
    task.views.push_back({v.file, {v.object_class, v.instance}, v.sequence, v.is_training, v.is_test});
  }
  if (!task.leave_one_sequence_out) return {task};
  RecognitionTask second = task;
  second.name += ", learn to test";
  second.leave_one_sequence_out = false;
  std::set<std::pair<std::string, std::string>> learnt;
  for (const RecognitionView& v : second.views) {
    if (v.is_training) learnt.emplace(v.label.object_class, v.label.instance);
  }
  for (RecognitionView& v : second.views) {
    v.is_test = v.is_test && learnt.count({v.label.object_class, v.label.instance}) != 0;
  }
  return {task, second};
}

bool can_be_tested(const std::vector<RecognitionTask>& tasks, std::string& looked_for) {
  std::size_t tests = 0;
  for (const RecognitionTask& task : tasks) {
    for (const Fold& fold : folds_of(task)) tests += fold.training.empty() ? 0 : fold.test.size();
  }
  const std::string why = " (there are " + std::to_string(tasks.front().views.size()) + " views of the set '" +
                          tasks.front().name + "', but not both: some to train and some to test)";
  if (tests == 0 && looked_for.find(why) == std::string::npos) looked_for += why;
  return tests > 0;
}

RecognitionTask task_of(const datasets::VirtualViewSet& set, const std::string& name) {
  RecognitionTask task{name, {}, false, set.load};
  for (const datasets::VirtualView& v : set.views) {
    const std::string place = std::to_string(v.elevation_deg) + " degrees, azimuth " + std::to_string(v.azimuth_index);
    task.views.push_back({v.object + ", " + place,
                          {v.object_class, v.object},
                          std::to_string(v.elevation_deg),
                          v.is_training,
                          !v.is_training});
  }
  return task;
}

RecognitionTask every_nth(const RecognitionTask& task, std::size_t n) {
  RecognitionTask thinned = task;
  thinned.views.clear();
  for (std::size_t i = 0; i < task.views.size(); i += n) thinned.views.push_back(task.views[i]);
  thinned.load = [load = task.load, n](std::size_t i) { return load(i * n); };
  return thinned;
}

Views::Views(std::size_t count, std::function<RgbdCloud(std::size_t)> load, const ViewSettings& settings)
    : load_(std::move(load)), settings_(settings), slots_(count) {}

const View& Views::operator[](std::size_t i) const {
  Slot& slot = slots_[i];
  std::call_once(slot.once, [&] { slot.view = std::make_unique<View>(load_(i), settings_); });
  return *slot.view;
}

std::vector<Prediction> recognize_views(const RecognitionTask& task, const Views& views,
                                        const Configuration& configuration, const RecognitionSettings& settings) {
  const std::string& layout = configuration.layout;
  std::vector<Described> described;
  for (std::size_t i = 0; i < task.views.size(); ++i) described.push_back(views[i].describe(configuration));
  std::vector<Prediction> predictions;
  for (const Fold& fold : folds_of(task)) {
    shortshot::RecognizerOptions options;
    options.bandwidth = settings.bandwidth;
    shortshot::Recognizer recognizer(options);
    for (const std::size_t i : fold.training) {
      const ObjectLabel& label = task.views[i].label;
      require(shortshot::train(recognizer, described[i].rows(), layout, views[i].center(), label.object_class,
                               label.instance));
    }
    for (const std::size_t i : fold.test) {
      predictions.push_back({i, hough_label(recognizer, described[i], layout), {}});
      if (settings.nearest_votes) predictions.back().nearest = nearest_label(recognizer, described[i], layout);
    }
  }
  return predictions;
}

nlohmann::ordered_json to_json(const RecognitionTask& task, const std::vector<Prediction>& predictions) {
  auto list = nlohmann::ordered_json::array();
  const auto label = [](const ObjectLabel& l) { return nlohmann::ordered_json{l.object_class, l.instance}; };
  for (const Prediction& p : predictions) {
    const RecognitionView& view = task.views[p.view];
    list.push_back(
        {{"view", view.name}, {"truth", label(view.label)}, {"hough", label(p.hough)}, {"nearest", label(p.nearest)}});
  }
  return list;
}

std::vector<Judgement> judgements_of(const nlohmann::ordered_json& json) {
  std::vector<Judgement> judgements;
  const auto label = [](const nlohmann::ordered_json& l) { return ObjectLabel{l.at(0), l.at(1)}; };
  for (const auto& p : json) judgements.push_back({label(p.at("truth")), label(p.at("hough")), label(p.at("nearest"))});
  return judgements;
}

}  // namespace shortshot_bench::paper
