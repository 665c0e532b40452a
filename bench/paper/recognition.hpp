// Section VI-B of the paper: which object is it? Class and instance from an implicit-shape-model Hough vote, and from
// plain votes of nearest descriptors.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/configuration.hpp"
#include "paper/datasets/virtual_views.hpp"
#include "paper/view.hpp"
#include "tools/labels/view_sets.hpp"

namespace shortshot_bench::paper {

struct ObjectLabel {
  std::string object_class;
  std::string instance;
};

/// A view with its label, and what it may be used for.
struct RecognitionView {
  std::string name;
  ObjectLabel label;
  std::string sequence;  // views of one sequence never train each other
  bool is_training;
  bool is_test;
};

/// Views, and how they are split.
struct RecognitionTask {
  std::string name;
  std::vector<RecognitionView> views;
  bool leave_one_sequence_out;  // each sequence once as test, all others to train; else is_training and is_test say
  std::function<RgbdCloud(std::size_t)> load;

  std::size_t tests() const;  // views that are recognized
};

/// A set of real views by its own split. "segments" leaves out one sequence at a time and has a second task, its other
/// split, in which instances that occur in one part only are not tested.
std::vector<RecognitionTask> tasks_of(const datasets::ViewSet& set);

/// Has one of a set's tasks views to test and views to train? If not, what is wrong is added to `looked_for`.
bool can_be_tested(const std::vector<RecognitionTask>& tasks, std::string& looked_for);

/// Virtual views: lower and higher ones train, those between them test.
RecognitionTask task_of(const datasets::VirtualViewSet& set, const std::string& name);

/// Views that train, and views that are recognized then, as places in the task.
struct Fold {
  std::vector<std::size_t> training;
  std::vector<std::size_t> test;
};

/// One for each sequence that is left out, or a single one.
std::vector<Fold> folds_of(const RecognitionTask& task);

/// The task with every n-th of its views.
RecognitionTask every_nth(const RecognitionTask& task, std::size_t n);

/// Views, of a task for example, each made when it is first asked for and then kept. Thread-safe.
class Views {
 public:
  Views(std::size_t count, std::function<RgbdCloud(std::size_t)> load, const ViewSettings& settings);
  Views(const RecognitionTask& task, const ViewSettings& settings) : Views(task.views.size(), task.load, settings) {}

  const View& operator[](std::size_t i) const;

 private:
  std::function<RgbdCloud(std::size_t)> load_;
  ViewSettings settings_;
  struct Slot {
    std::once_flag once;
    std::unique_ptr<View> view;
  };
  mutable std::vector<Slot> slots_;
};

/// What the recognizers say of one test view; empty labels: nothing was recognized.
struct Prediction {
  std::size_t view = 0;  // of the task
  ObjectLabel hough;
  ObjectLabel nearest;
};

struct RecognitionSettings {
  float bandwidth = 0.03f;    // of the Hough vote, meters
  bool nearest_votes = true;  // the second recognizer, too; without, its labels are empty
};

/// One descriptor on all test views of a task.
std::vector<Prediction> recognize_views(const RecognitionTask& task, const Views& views,
                                        const Configuration& configuration, const RecognitionSettings& settings);

nlohmann::ordered_json to_json(const RecognitionTask& task, const std::vector<Prediction>& predictions);

/// A prediction with the truth, as a journal keeps it.
struct Judgement {
  ObjectLabel truth;
  ObjectLabel hough;
  ObjectLabel nearest;
};
std::vector<Judgement> judgements_of(const nlohmann::ordered_json& json);

}  // namespace shortshot_bench::paper
