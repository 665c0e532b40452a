#include "tradeoff/experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>

#include "paper/datasets/virtual_views.hpp"
#include "tradeoff/paint.hpp"
#include "tradeoff/pairs.hpp"
#include "tradeoff/views.hpp"

namespace shortshot_bench::tradeoff {
namespace {

using Candidates = std::shared_ptr<const std::vector<Candidate>>;

std::string name_of(const std::string& folder) {
  return std::filesystem::path(folder).lexically_normal().filename().string();
}

std::string millimeters(float meters) { return std::to_string(std::lround(1000.0f * meters)) + " mm"; }

/// "apc_lamp_moved" has a sibling under the lamp at rest, "apc_lamp_same".
std::string sibling_at_rest(const std::string& name) {
  const std::string end = "_moved";
  const std::size_t place = name.find(end);
  return place == std::string::npos ? "" : std::string(name).replace(place, end.size(), "_same");
}

/// Every `step`-th pair in the order of rotation.
std::vector<std::size_t> every_nth_by_rotation(const datasets::PairSet& set, std::size_t step) {
  std::vector<std::size_t> order(set.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return set.rotation_deg[a] < set.rotation_deg[b]; });
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < order.size(); i += step) chosen.push_back(order[i]);
  return chosen;
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
    looks.push_back({"inliers", look, Figure::inlier_ratio, 1, true});
    return looks;
  }
  look.view.leaf = 0.01f;
  look.view.normal_radius = 0.01f;
  look.view.most_keypoints = 600;
  for (const float radius : {0.045f, 0.07f}) {
    look.view.radius = radius;
    looks.push_back({"R " + millimeters(radius), look, Figure::match_rate, 1, false});
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

class Builder {
 public:
  Builder(const TradeoffOptions& options, Candidates candidates) : options_(options), all_(std::move(candidates)) {
    auto named = std::make_shared<std::vector<Candidate>>();
    std::copy_if(all_->begin(), all_->end(), std::back_inserter(*named),
                 [](const Candidate& c) { return c.kind != Kind::relative; });
    named_ = named;
    experiment_.parameters = {{"experiment", "tradeoff"}, {"quick", options.quick}, {"entries", entries()}};
  }

  /// False if the folder holds nothing.
  bool add_folder(const std::string& folder) {
    const std::size_t before = experiment_.units.size();
    for (const datasets::PairSet& set : datasets::open_pair_sets(folder)) add_pairs(folder, set);
    for (const datasets::ViewSet& set : datasets::open_view_sets(folder)) add_views(folder, set);
    if (datasets::holds_meshes(folder)) add_meshes(folder);
    return experiment_.units.size() > before;
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
      const std::string measure = name_of(folder) + " " + set.name + ", " + named.name;
      const std::string rest = sibling_at_rest(measure);
      const char* const baseline = set.has_color ? named.baseline : shape_baseline;
      add_measure(measure, named.figure, baseline, named.figure == Figure::match_rate, rest);
      if (named.look.gain_seed != 0) add_measure(measure + gain_suffix, named.figure, baseline, false, measure);
      const std::size_t step = options_.quick ? std::max<std::size_t>(named.step, set.size() / 3) : named.step;
      for (const std::size_t i : every_nth_by_rotation(set, step)) {
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
      const std::string measure = name_of(folder) + " " + task.name + ", R " + millimeters(settings.radius);
      add_measure(measure, Figure::right_instance, color_baseline, true, sibling_at_rest(measure));
      add_task(task, views, measure, *all_, count_right_instances);
    }
    add_painted_views(folder, tasks.back(), settings);
    add_hough(tasks.front(), name_of(folder) + " " + tasks.front().name);
  }

  /// All objects in one dark color, every second view under a lamp that is somewhere else.
  void add_painted_views(const std::string& folder, paper::RecognitionTask task, const paper::ViewSettings& settings) {
    if (task.tests() == 0 || options_.quick) return;
    task.load = [load = task.load](std::size_t i) {
      const shortshot::Point lamp =
          i % 2 == 0 ? shortshot::Point{0.4f, -0.5f, 0.1f} : shortshot::Point{-0.6f, -0.2f, 0.3f};
      return painted(load(i), {dark, lamp, static_cast<std::uint32_t>(i)});
    };
    const std::string measure = name_of(folder) + " " + task.name + ", painted dark";
    add_measure(measure, Figure::right_instance, plain_baseline, false, "");
    add_task(task, std::make_shared<paper::Views>(task, settings), measure, *named_, count_right_instances);
  }

  void add_meshes(const std::string& folder) {
    const std::string name = name_of(folder) + " virtual views";
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
  for (const std::string& directory : options.data) {
    bool any = builder.add_folder(directory);
    if (!any) {
      for (const std::string& folder : datasets::folders_in(directory)) any = builder.add_folder(folder) || any;
    }
    if (!any) {
      throw datasets::not_recognized(directory, std::string(datasets::looked_for_pairs) + ", " +
                                                    datasets::looked_for_views + ", or " + datasets::looked_for_meshes);
    }
  }
  return std::move(builder).finish();
}

}  // namespace shortshot_bench::tradeoff
