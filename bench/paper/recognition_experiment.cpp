#include "paper/recognition_experiment.hpp"

#include "paper/recognition.hpp"

namespace shortshot_bench::paper {
namespace {

constexpr std::uint32_t virtual_seeds = 2;

/// A task whose views are kept for all descriptors.
struct SharedTask {
  RecognitionTask task;
  std::shared_ptr<Views> views;
  std::uint32_t seed;
};

ViewSettings settings_of(const PaperOptions& options) { return with_options({}, options); }

/// Nothing for a folder without views or meshes; views that are of no use are added to `looked_for`.
std::vector<SharedTask> tasks_in(const std::string& folder, const PaperOptions& options, std::uint32_t seeds,
                                 std::string& looked_for) {
  std::vector<SharedTask> tasks;
  for (std::uint32_t seed = options.seed; seed < options.seed + seeds && datasets::holds_meshes(folder); ++seed) {
    datasets::VirtualViewOptions view_options;
    view_options.seed = seed;
    view_options.scale = options.scale;
    view_options.up = options.up;
    RecognitionTask task = task_of(datasets::open_virtual_views(folder, view_options), "virtual views");
    if (options.quick) task = every_nth(task, 3);  // a ninth of the work
    tasks.push_back({task, std::make_shared<Views>(task, settings_of(options)), seed});
  }
  for (const datasets::ViewSet& set : datasets::open_view_sets(folder)) {
    std::vector<RecognitionTask> all = tasks_of(set);
    for (RecognitionTask& task : all) {
      task.load = [load = task.load, meters = options.scale](std::size_t i) {
        return datasets::scaled(load(i), meters);
      };
    }
    if (!can_be_tested(all, looked_for)) continue;
    const auto views = std::make_shared<Views>(all.front(), settings_of(options));
    for (const RecognitionTask& task : all) {
      if (task.tests() > 0) tasks.push_back({task, views, options.seed});
    }
  }
  return tasks;
}

auto all_tasks(const PaperOptions& options, std::uint32_t seeds) {
  std::string looked_for = std::string(datasets::looked_for_views) + ", or " + datasets::looked_for_meshes;
  auto all = open_folders(
      options.data, [&](const std::string& folder) { return tasks_in(folder, options, seeds, looked_for); },
      looked_for);
  for (auto& found : all) {
    for (SharedTask& shared : found.sets) shared.task.name = found.name + " " + shared.task.name;
  }
  return all;
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
          {"clouds", to_json(settings_of(options))},
          {"meters_in_a_unit", options.scale},
          {"up", std::string(1, options.up)},
          {"bandwidth_m", RecognitionSettings{}.bandwidth}};
}

}  // namespace

Experiment recognition_experiment(const PaperOptions& options) {
  const std::vector<Configuration> configurations = configurations_named(options.descriptors);
  Experiment experiment{common_parameters(options, configurations), {}};
  for (const auto& found : all_tasks(options, options.quick ? 1 : virtual_seeds)) {
    for (const SharedTask& shared : found.sets) {
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
  for (const auto& found : all_tasks(options, 1)) {
    add_task(experiment, options.quick ? found.sets.back() : found.sets.front(), configurations, settings);
  }
  return experiment;
}

}  // namespace shortshot_bench::paper
