#include "tradeoff/experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "paper/datasets/virtual_views.hpp"
#include "tradeoff/paint.hpp"
#include "tradeoff/pairs.hpp"
#include "tradeoff/views.hpp"

namespace shortshot_bench::tradeoff {
namespace {

using Candidates = std::shared_ptr<const std::vector<Candidate>>;

std::string millimeters(float meters) { return std::to_string(std::lround(1000.0f * meters)) + " mm"; }

/// "apc_lamp_moved" has a sibling under the lamp at rest, "apc_lamp_same".
std::string sibling_at_rest(const std::string& name) {
  const std::string end = "_moved";
  const std::size_t place = name.find(end);
  return place == std::string::npos ? "" : std::string(name).replace(place, end.size(), "_same");
}

/// The protocols of bench/TRADEOFF.md.
struct NamedLook {
  std::string name;
  PairLook look;
  Figure figure = Figure::match_rate;
  std::size_t step = 1;     // every so many pairs
  bool named_only = false;  // not the family
  const char* baseline = color_baseline;
};

constexpr std::array<double, 3> dark{38.0, 36.0, 34.0};
constexpr std::array<double, 3> gray{128.0, 128.0, 128.0};

std::vector<NamedLook> looks_at(const datasets::PairSet& set) {
  std::vector<NamedLook> looks;
  PairLook look;
  look.view.points_of_cloud = true;
  if (set.name == "frames") {
    look.view.voxel = 0.01f;
    look.view.radius = 0.2f;
    look.view.leaf = 0.02f;
    look.view.normal_radius = 0.03f;
    look.view.most_keypoints = 1800;
    look.correct_distance = 0.03f;
    looks.push_back({"R " + millimeters(look.view.radius), look, Figure::match_rate, 5, false});
    look.view.leaf = 0.04f;
    look.view.points_of_cloud = false;
    look.view.most_keypoints = 0;
    look.correct_distance = 0.06f;
    look.reciprocal = true;
    looks.push_back({"inliers", look, Figure::inlier_ratio, 1, true});
    return looks;
  }
  look.view.leaf = 0.01f;
  look.view.normal_radius = 0.01f;
  look.view.most_keypoints = 600;
  for (const float support : {0.045f, 0.07f}) {
    look.view.radius = support;
    looks.push_back({"R " + millimeters(support), look, Figure::match_rate, 1, false});
  }
  if (!set.has_color) return looks;
  look.view.radius = 0.045f;
  looks.front().look.gain_seed = 1;
  look.paint = PaintLook{dark, false};
  looks.push_back({"painted dark", look, Figure::match_rate, 1, true, plain_baseline});
  look.paint = PaintLook{dark, true};
  looks.push_back({"painted dark, lamp moved", look, Figure::match_rate, 1, true, plain_baseline});
  look.paint = PaintLook{gray, true};
  looks.push_back({"painted gray, lamp moved", look, Figure::match_rate, 1, true, plain_baseline});
  return looks;
}

/// What a folder holds.
struct Sets {
  std::vector<datasets::PairSet> pairs;
  std::vector<datasets::ViewSet> views;  // those with something to recognize
  bool has_meshes;
};

/// One or, if there is nothing to be done, none. The quick form does not look at meshes, nor at splits that take long.
std::vector<Sets> sets_in(const std::string& folder, bool quick, std::string& looked_for) {
  Sets sets{datasets::open_pair_sets(folder), {}, !quick && datasets::holds_meshes(folder)};
  for (datasets::ViewSet& set : datasets::open_view_sets(folder)) {
    const std::vector<paper::RecognitionTask> tasks = paper::tasks_of(set);
    if (!paper::can_be_tested(tasks, looked_for)) continue;
    const bool any = std::any_of(tasks.begin(), tasks.end(), [&](const paper::RecognitionTask& task) {
      return task.tests() > 0 && !(quick && task.leave_one_sequence_out);
    });
    if (any) sets.views.push_back(std::move(set));
  }
  if (sets.pairs.empty() && sets.views.empty() && !sets.has_meshes) return {};
  return {sets};
}

class Builder {
 public:
  Builder(const TradeoffOptions& options, Candidates candidates) : options_(options), all_(std::move(candidates)) {
    auto named = std::make_shared<std::vector<Candidate>>();
    std::copy_if(all_->begin(), all_->end(), std::back_inserter(*named),
                 [](const Candidate& c) { return c.kind != Kind::relative; });
    named_ = named;
    experiment_.parameters = {{"experiment", "tradeoff"}, {"quick", options.quick}, {"entries", entries()}};
  }

  void add(const std::string& folder, const std::string& name, const Sets& sets) {
    for (const datasets::PairSet& set : sets.pairs) add_pairs(name, set);
    for (const datasets::ViewSet& set : sets.views) add_views(name, set);
    if (sets.has_meshes) add_meshes(folder, name + " virtual views");
  }
  paper::Experiment finish() && {
    experiment_.parameters["measures"] = nlohmann::ordered_json(measures_);
    return std::move(experiment_);
  }

 private:
  nlohmann::ordered_json entries() const {
    auto list = nlohmann::ordered_json::array();
    for (const Candidate& c : *all_) {
      for (const Storage& s : c.storages) {
        list.push_back({{"name", entry_name(c, s)},
                        {"size_bytes", s.size_bytes},
                        {"kind", static_cast<int>(c.kind)},
                        {"board_name", c.board_name}});
      }
    }
    return list;
  }

  void add_measure(const std::string& name, Figure figure, const std::string& baseline, bool scored,
                   const std::string& at_rest) {
    measures_.push_back({name, figure, baseline, scored, at_rest});
  }

  void add_pairs(const std::string& folder, const datasets::PairSet& set) {
    for (const NamedLook& named : looks_at(set)) {
      const bool is_second_look = named.named_only || (set.name != "frames" && named.look.view.radius > 0.06f);
      if (options_.quick && is_second_look) continue;
      const std::string measure = folder + " " + set.name + ", " + named.name;
      const std::string rest = sibling_at_rest(measure);
      const char* const baseline = set.has_color ? named.baseline : shape_baseline;
      add_measure(measure, named.figure, baseline, named.figure == Figure::match_rate, rest);
      if (named.look.gain_seed != 0) add_measure(measure + gain_suffix, named.figure, baseline, false, measure);
      const std::size_t step = options_.quick ? std::max<std::size_t>(named.step, set.size() / 3) : named.step;
      const std::vector<std::size_t> chosen = datasets::every_nth_by_rotation(set, step);
      if (set.name == "frames") {
        add_frames(set, named, measure, chosen);
        continue;
      }
      for (const std::size_t i : chosen) {
        PairLook look = named.look;
        if (look.gain_seed != 0) look.gain_seed += static_cast<std::uint32_t>(i);
        if (look.paint) look.view.seed += 2 * static_cast<std::uint32_t>(i);
        add_unit(experiment_, {measure + "/" + set.pair_names[i],
                               [set, i, look, measure, candidates = named.named_only ? named_ : all_] {
                                 return to_json(match_pair(set.load(i), set.groups[i], look, measure, *candidates));
                               }});
      }
    }
  }

  /// Many pairs of few frames: each is described once.
  void add_frames(const datasets::PairSet& set, const NamedLook& named, const std::string& measure,
                  const std::vector<std::size_t>& chosen) {
    const auto views = std::make_shared<paper::Views>(set.clouds, set.load_cloud, named.look.view);
    for (const Candidate& candidate : named.look.reciprocal ? headline() : *all_) {
      add_unit(experiment_, {measure + "/" + candidate.configuration.name,
                             [set, views, look = named.look, measure, chosen, candidate] {
                               return to_json(match_pairs(set, chosen, *views, look, measure, candidate));
                             }});
    }
  }

  void add_views(const std::string& folder, const datasets::ViewSet& set) {
    paper::ViewSettings settings;
    settings.radius = 0.045f;
    settings.leaf = 0.01f;
    settings.normal_radius = 0.01f;
    settings.points_of_cloud = true;
    // About 10,000 key points in all.
    settings.most_keypoints = std::clamp<std::size_t>(10000 / std::max<std::size_t>(set.views.size(), 1), 50, 130);
    const std::vector<paper::RecognitionTask> tasks = paper::tasks_of(set);
    const auto views = std::make_shared<paper::Views>(tasks.front(), settings);
    for (const paper::RecognitionTask& task : tasks) {
      if (task.tests() == 0 || (options_.quick && task.leave_one_sequence_out)) continue;
      const std::string measure = folder + " " + task.name + ", R " + millimeters(settings.radius);
      add_measure(measure, Figure::right_instance, color_baseline, true, sibling_at_rest(measure));
      add_task(task, views, measure, *all_, count_right_instances);
    }
    add_painted_views(folder, tasks.back(), settings);
    add_hough(tasks.front(), folder + " " + tasks.front().name);
  }

  /// All objects in one dark color, every second view under a lamp that is somewhere else.
  void add_painted_views(const std::string& folder, paper::RecognitionTask task, const paper::ViewSettings& settings) {
    if (task.tests() == 0 || options_.quick) return;
    task.load = [load = task.load](std::size_t i) {
      const shortshot::Point& lamp = i % 2 == 0 ? lamp_at_right : lamp_at_left;
      return painted(load(i), {dark, lamp, static_cast<std::uint32_t>(i)});
    };
    const std::string measure = folder + " " + task.name + ", painted dark";
    add_measure(measure, Figure::right_instance, plain_baseline, false, "");
    add_task(task, std::make_shared<paper::Views>(task, settings), measure, *named_, count_right_instances);
  }

  void add_meshes(const std::string& folder, const std::string& name) {
    add_hough(paper::task_of(datasets::open_virtual_views(folder, {}), name), name);
  }

  void add_hough(const paper::RecognitionTask& task, const std::string& name) {
    if (task.tests() == 0 || options_.quick) return;
    const std::string measure = name + ", Hough";
    add_measure(measure, Figure::hough_instance, color_baseline, false, sibling_at_rest(measure));
    add_task(task, std::make_shared<paper::Views>(task, paper::ViewSettings{}), measure, headline(),
             count_hough_instances);
  }

  /// What a recognizer would be given: published ones in floats, compact ones in four bits or in bits.
  std::vector<Candidate> headline() const {
    std::vector<Candidate> chosen;
    for (Candidate c : *all_) {
      const bool is_published = c.kind == Kind::published && !c.configuration.wants_viewpoint;
      if (!is_published && c.kind != Kind::compact) continue;
      std::vector<Storage> kept;
      for (const Storage& s : c.storages) {
        if (s.name == (is_published ? "float" : "4bit") || s.name == "sums44") kept.push_back(s);
      }
      c.storages = std::move(kept);
      chosen.push_back(std::move(c));
    }
    return chosen;
  }

  template <class Count>
  void add_task(const paper::RecognitionTask& task, const std::shared_ptr<paper::Views>& views,
                const std::string& measure, const std::vector<Candidate>& candidates, Count count) {
    for (const Candidate& candidate : candidates) {
      add_unit(experiment_, {measure + "/" + candidate.configuration.name, [task, views, measure, candidate, count] {
                               return to_json(count(task, *views, measure, candidate));
                             }});
    }
  }

  TradeoffOptions options_;
  Candidates all_;
  Candidates named_;
  paper::Experiment experiment_;
  std::vector<MeasureInfo> measures_;
};

}  // namespace

paper::Experiment tradeoff_experiment(const TradeoffOptions& options) {
  Builder builder(options, std::make_shared<const std::vector<Candidate>>(candidates(options.quick)));
  std::string looked_for = std::string(datasets::looked_for_pairs) + ", " + datasets::looked_for_views + ", or " +
                           datasets::looked_for_meshes;
  const auto open = [&](const std::string& folder) { return sets_in(folder, options.quick, looked_for); };
  for (const auto& found : paper::open_folders(options.data, open, looked_for)) {
    for (const Sets& sets : found.sets) builder.add(found.folder, found.name, sets);
  }
  return std::move(builder).finish();
}

}  // namespace shortshot_bench::tradeoff
