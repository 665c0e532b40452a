#include "paper/recognition_experiment.hpp"

#include "paper/recognition.hpp"
#include "tools/io/folder_name.hpp"

namespace shortshot_bench::paper {
namespace {

constexpr std::uint32_t virtual_seeds = 2;

/// A task whose views are kept for all descriptors.
struct SharedTask {
  RecognitionTask task;
  std::shared_ptr<Views> views;
  std::uint32_t seed;
};

/// Nothing for a folder without views or meshes.
std::vector<SharedTask> tasks_in(const std::string& folder, const PaperOptions& options, std::uint32_t seeds) {
  std::vector<SharedTask> tasks;
  for (std::uint32_t seed = options.seed; seed < options.seed + seeds && datasets::holds_meshes(folder); ++seed) {
    datasets::VirtualViewOptions view_options;
    view_options.seed = seed;
    RecognitionTask task =
        task_of(datasets::open_virtual_views(folder, view_options), folder_name(folder) + " virtual views");
    if (options.quick) task = every_nth(task, 3);  // a ninth of the work
    tasks.push_back({task, std::make_shared<Views>(task, ViewSettings{}), seed});
  }
  for (const datasets::ViewSet& set : datasets::open_view_sets(folder)) {
    const std::vector<RecognitionTask> all = tasks_of(set);
    const auto views = std::make_shared<Views>(all.front(), ViewSettings{});
    for (RecognitionTask task : all) {
      task.name = folder_name(folder) + " " + task.name;
      if (task.tests() > 0) tasks.push_back({task, views, options.seed});
    }
  }
  return tasks;
}

auto all_tasks(const PaperOptions& options, std::uint32_t seeds) {
  return open_folders(
      options.data, [&](const std::string& folder) { return tasks_in(folder, options, seeds); },
      std::string(datasets::looked_for_views) + ", or " + datasets::looked_for_meshes);
}

void add_task(Experiment& experiment, const SharedTask& shared, const std::vector<Configuration>& configurations,
              const RecognitionSettings& settings) {
  for (const Configuration& configuration : configurations) {
    const std::string& name = shared.task.name;
    const std::string key = name + "/seed " + std::to_string(shared.seed) + "/" + configuration.name;
    add_unit(experiment, {key, [shared, configuration, settings] {
                            return to_json(shared.task,
                                           recognize_views(shared.task, *shared.views, configuration, settings));
                          }});
    experiment.parameters["tasks"][name][configuration.name].push_back(key);
  }
}

/// A corner of figure 5.
bool is_quick(const FamilyMember& m) {
  return m.shape_cells == 96 && (m.color_cells == 16 || m.color_cells == 24) && (m.bins == 10 || m.bins == 30);
}

nlohmann::ordered_json common_parameters(const PaperOptions& options,
                                         const std::vector<Configuration>& configurations) {
  return {{"experiment", options.command},
          {"seed", options.seed},
          {"quick", options.quick},
          {"descriptors", to_json(configurations)},
          {"clouds", to_json(ViewSettings{})},
          {"bandwidth_m", RecognitionSettings{}.bandwidth}};
}

}  // namespace

Experiment recognition_experiment(const PaperOptions& options) {
  const std::vector<Configuration> configurations = configurations_named(options.descriptors);
  Experiment experiment{common_parameters(options, configurations), {}};
  for (const auto& [folder, tasks] : all_tasks(options, options.quick ? 1 : virtual_seeds)) {
    for (const SharedTask& shared : tasks) {
      if (options.quick && shared.task.leave_one_sequence_out) continue;  // takes longest
      add_task(experiment, shared, configurations, {});
    }
  }
  return experiment;
}

Experiment ablation_experiment(const PaperOptions& options, const std::vector<FamilyMember>& members) {
  std::vector<Configuration> configurations = configurations_named({"cshot1344"});
  auto sizes = nlohmann::ordered_json::object();
  for (const FamilyMember& m : members) {
    if (options.quick && !is_quick(m)) continue;
    configurations.push_back(m.configuration);
    sizes[m.configuration.name] = {{"n_g", m.shape_cells}, {"n_c", m.color_cells}, {"h", m.bins}};
  }
  Experiment experiment{common_parameters(options, configurations), {}};
  experiment.parameters["sizes"] = sizes;
  RecognitionSettings settings;
  settings.nearest_votes = false;
  for (const auto& [folder, tasks] : all_tasks(options, 1)) {
    add_task(experiment, options.quick ? tasks.back() : tasks.front(), configurations, settings);
  }
  return experiment;
}

}  // namespace shortshot_bench::paper
