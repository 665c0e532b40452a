#include "speed/peers/goals.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "speed/peers/instruction_goals.hpp"

namespace shortshot_bench::peers {
namespace {

using Value = std::optional<double>;

/// The value of each build by a function of its name.
template <class Work>
PerBuild per_build(const Work& work) {
  return {work(std::string(builds[0])), work(std::string(builds[1]))};
}

const MeasuredContender* find(const CloudResult& result, const std::string& implementation,
                              const std::string& descriptor, const std::string& build = {},
                              const std::string& search = {}) {
  for (const MeasuredContender& m : result.contenders) {
    if (m.what.implementation == implementation && m.what.descriptor == descriptor && m.what.build == build &&
        (search.empty() || m.what.search == search)) {
      return &m;
    }
  }
  return nullptr;
}

/// How many times as long a peer takes as ours with the grid, by a member of what was measured.
PerBuild ratio(const CloudResult& result, const char* peer_name, const char* peer_descriptor, const char* descriptor,
               double MeasuredContender::*time) {
  return per_build([&](const std::string& build) -> Value {
    const MeasuredContender* peer = find(result, peer_name, peer_descriptor);
    const MeasuredContender* ours = find(result, "shortshot", descriptor, build, "grid");
    if (peer == nullptr || ours == nullptr) return {};
    return peer->*time / ours->*time;
  });
}

PerBuild shot_color(const CloudResult& r) {
  return ratio(r, "PCL SHOTColor", "CSHOT-1344", "SCSH-336", &MeasuredContender::us_per_keypoint);
}
PerBuild shot_color_frame(const CloudResult& r) {
  return ratio(r, "PCL SHOTColor", "CSHOT-1344", "SCSH-336", &MeasuredContender::frame_ms);
}
PerBuild naive(const CloudResult& r) {
  return ratio(r, "naive double", "SCSH-336", "SCSH-336", &MeasuredContender::us_per_keypoint);
}
PerBuild shot(const CloudResult& r) {
  return ratio(r, "PCL SHOT", "SHOT-352", "SSH-32", &MeasuredContender::us_per_keypoint);
}

PerBuild same_shot(const CloudResult& r) {
  return ratio(r, "PCL SHOT", "SHOT-352", "SHOT-352", &MeasuredContender::us_per_keypoint);
}
PerBuild same_shot_color(const CloudResult& r) {
  return ratio(r, "PCL SHOTColor", "CSHOT-1344", "CSHOT-1344", &MeasuredContender::us_per_keypoint);
}

/// Time of one step over that of another.
Value step_ratio(const CloudResult& result, const std::string& slower, const std::string& faster) {
  const auto a = result.steps.find(slower);
  const auto b = result.steps.find(faster);
  if (a == result.steps.end() || b == result.steps.end()) return {};
  return a->second.ms / b->second.ms;
}

PerBuild search(const CloudResult& r) {
  return per_build([&](const std::string& b) { return step_ratio(r, "naive: search", b + ": search, grid"); });
}
PerBuild index_build(const CloudResult& r) {
  return per_build([&](const std::string& b) { return step_ratio(r, "naive: tree", b + ": grid"); });
}
PerBuild normals(const CloudResult& r) {
  return per_build(
      [&](const std::string& b) { return step_ratio(r, "PCL: normals of the image", b + ": normals of the image"); });
}
PerBuild nearest_normals(const CloudResult& r) {
  return per_build([&](const std::string& b) -> Value {
    const Value tree = step_ratio(r, "PCL: unsorted tree", b + ": normals of the image");
    const Value normals = step_ratio(r, "PCL: normals", b + ": normals of the image");
    if (!tree || !normals) return {};
    return *tree + *normals;
  });
}
PerBuild two_threads(const CloudResult& r) {
  return per_build([&](const std::string& b) { return step_ratio(r, b + ": 1 thread", b + ": 2 threads"); });
}

PerBuild memory(const CloudResult& r) {
  return per_build([&](const std::string& build) -> Value {
    const MeasuredContender* ours = find(r, "shortshot", "SCSH-336", build, "grid");
    if (ours == nullptr) return {};
    return 1e-6 * static_cast<double>(ours->peak_bytes) * 170'000.0 / static_cast<double>(r.points);
  });
}

PerBuild difference(const CloudResult& r) {
  return per_build([&](const std::string& build) -> Value {
    const auto found = r.oracle_difference.find(build);
    if (found == r.oracle_difference.end()) return {};
    return found->second;
  });
}

PerBuild kernel(const CloudResult&) {
  return per_build([](const std::string& build) { return committed_instructions(Stage::kernel, build); });
}
PerBuild search_and_frame(const CloudResult&) {
  return per_build([](const std::string& build) { return committed_instructions(Stage::search_and_frame, build); });
}

std::string bound_of(const Goal& goal, std::size_t build) {
  if (goal.limit == Limit::none) return "report";
  char text[32];
  std::snprintf(text, sizeof text, "%s %.3g", goal.limit == Limit::at_least ? ">=" : "<=", *goal.bound[build]);
  return text;
}

void print_goals_of(std::size_t build, const std::vector<CloudResult>& results) {
  std::printf("Goals, build %s\n%-70s %9s", builds[build], "", "goal");
  for (const CloudResult& result : results) std::printf(" %12.12s", result.cloud.c_str());
  std::printf("   worst\n");
  for (const Goal& goal : goals()) {
    std::printf("%-70s %9s", goal.name.c_str(), bound_of(goal, build).c_str());
    const std::optional<Worst> worst = worst_of(goal, build, results);
    for (const CloudResult& result : results) {
      const Value value = goal.measured(result)[build];
      value ? std::printf(" %12.4g", *value) : std::printf(" %12s", "-");
    }
    if (worst) {
      const char* verdict = goal.limit == Limit::none ? "" : worst->met ? ", met" : ", MISSED";
      std::printf("   %.4g (%s)%s\n", worst->value, worst->cloud.c_str(), verdict);
    } else {
      std::printf("   not measured: %s\n", goal.if_missing.c_str());
    }
  }
  std::printf("\n");
}

}  // namespace

const std::vector<Goal>& goals() {
  static const char* const no_avx2 = "no AVX2 here";
  static const char* const instructions = "run ./run instructions";
  static const std::vector<Goal> all{
      {"SCSH-336 per key point, PCL SHOTColor (no normals) / ours", Limit::at_least, {25.0, 43.0}, shot_color, no_avx2},
      {"the same for the whole frame", Limit::at_least, {37.0, 55.0}, shot_color_frame, no_avx2},
      {"SCSH-336 per key point, naive double / ours", Limit::at_least, {13.0, 22.0}, naive, no_avx2},
      {"SSH-32 per key point, PCL SHOT-352 / ours", Limit::at_least, {32.0, 55.0}, shot, no_avx2},
      {"SHOT-352 per key point, PCL / ours, normals given", Limit::at_least, {20.0, 32.0}, same_shot, no_avx2},
      {"CSHOT-1344 per key point, PCL / ours, normals given", Limit::at_least, {18.0, 30.0}, same_shot_color, no_avx2},
      {"normals of an image, index included, r = 0.01 m, PCL / ours", Limit::at_least, {8.0, 12.0}, normals, no_avx2},
      {"the same, k = 10 with PCL", Limit::none, {}, nearest_normals, no_avx2},
      {"kernel SCSH-336, instructions per neighbor", Limit::at_most, {112.0, 68.0}, kernel, instructions},
      {"search + frame, instructions per neighbor", Limit::none, {}, search_and_frame, instructions},
      {"search per neighbor, nanoflann (leaf 10, unsorted) / grid", Limit::at_least, {4.0, 7.0}, search, no_avx2},
      {"index build, nanoflann / grid", Limit::at_least, {15.0, 15.0}, index_build, no_avx2},
      {"2 threads on 2 free cores, times as fast as 1", Limit::at_least, {1.85, 1.85}, two_threads, no_avx2},
      {"extra memory, MB per 170,000 points", Limit::at_most, {5.5, 5.5}, memory, no_avx2},
      {"largest difference from the double oracle away from cell borders",
       Limit::at_most,
       {1e-6, 1e-6},
       difference,
       no_avx2},
  };
  return all;
}

std::optional<Worst> worst_of(const Goal& goal, std::size_t build, const std::vector<CloudResult>& results) {
  std::optional<Worst> worst;
  for (const CloudResult& result : results) {
    const Value value = goal.measured(result)[build];
    if (!value) continue;
    const bool higher_is_worse = goal.limit != Limit::at_least;
    if (worst && (higher_is_worse ? *value <= worst->value : *value >= worst->value)) continue;
    const bool met =
        goal.limit == Limit::none || (higher_is_worse ? *value <= *goal.bound[build] : *value >= *goal.bound[build]);
    worst = Worst{result.cloud, *value, met};
  }
  return worst;
}

nlohmann::ordered_json goals_to_json(const std::vector<CloudResult>& results) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Goal& goal : goals()) {
    for (std::size_t build = 0; build < builds.size(); ++build) {
      nlohmann::ordered_json entry{{"goal", goal.name}, {"build", builds[build]}, {"bound", bound_of(goal, build)}};
      for (const CloudResult& result : results) {
        if (const Value value = goal.measured(result)[build]) entry["measured"][result.cloud] = *value;
      }
      if (const auto worst = worst_of(goal, build, results)) {
        entry["worst"] = worst->value;
        entry["worst_cloud"] = worst->cloud;
        if (goal.limit != Limit::none) entry["met"] = worst->met;
      }
      list.push_back(entry);
    }
  }
  return list;
}

void print_goals(const std::vector<CloudResult>& results) {
  for (std::size_t build = 0; build < builds.size(); ++build) print_goals_of(build, results);
}

}  // namespace shortshot_bench::peers
