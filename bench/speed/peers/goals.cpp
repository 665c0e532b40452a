#include "speed/peers/goals.hpp"

#include <utility>

#include "speed/peers/instruction_goals.hpp"

namespace shortshot_bench::peers {
namespace {

using Value = std::optional<double>;
using Measure = std::function<PerBuild(const CloudResult&)>;

/// The value of each build by a function of the result and the build's name.
template <class Work>
Measure per_build(const Work& work) {
  return [work](const CloudResult& result) -> PerBuild {
    return {work(result, std::string(builds[0])), work(result, std::string(builds[1]))};
  };
}

/// Of ours that with the grid, where searches differ.
const MeasuredContender* find_ours(const CloudResult& result, const std::string& descriptor, const std::string& build) {
  for (const MeasuredContender& m : result.contenders) {
    if (m.what.descriptor == descriptor && m.what.build == build && m.what.search != "nanoflann") return &m;
  }
  return nullptr;
}

/// By its name and, where it has several descriptors, by one of these.
const MeasuredContender* find_peer(const CloudResult& result, const std::string& name, const std::string& descriptor) {
  for (const MeasuredContender& m : result.contenders) {
    if (m.what.implementation == name && (descriptor.empty() || m.what.descriptor == descriptor)) return &m;
  }
  return nullptr;
}

/// How many times as long a peer takes as ours, by a member of what was measured.
Measure ratio(const std::string& descriptor, double MeasuredContender::*time, const std::string& peer_name,
              const std::string& peer_descriptor = {}) {
  return per_build([=](const CloudResult& result, const std::string& build) -> Value {
    const MeasuredContender* const peer = find_peer(result, peer_name, peer_descriptor);
    const MeasuredContender* const ours = find_ours(result, descriptor, build);
    if (peer == nullptr || ours == nullptr) return {};
    return peer->*time / ours->*time;
  });
}

constexpr auto per_keypoint = &MeasuredContender::us_per_keypoint;
constexpr auto whole_frame = &MeasuredContender::frame_ms;

/// Time of one step over that of another; "BUILD" in their names stands for the build.
Measure step_ratio(const std::string& slower, const std::string& faster) {
  return per_build([=](const CloudResult& result, const std::string& build) -> Value {
    const auto step = [&](std::string name) {
      const std::size_t at = name.find("BUILD");
      if (at != std::string::npos) name.replace(at, 5, build);
      return result.steps.find(name);
    };
    const auto a = step(slower);
    const auto b = step(faster);
    if (a == result.steps.end() || b == result.steps.end()) return {};
    return a->second.ms / b->second.ms;
  });
}

/// As they are committed; of several stages the sum. Build O2 without AVX2, unless it shall choose (`plain` is
/// "baseline").
Measure instructions(const std::string& per, const std::vector<std::string>& stages, const std::string& plain = "O2") {
  return per_build([=](const CloudResult&, const std::string& build) -> Value {
    double sum = 0.0;
    for (const std::string& stage : stages) {
      const Value one = committed_instructions(stage, per, build == "O2" ? plain : build);
      if (!one) return {};
      sum += *one;
    }
    return per == "frame" ? 1e-6 * sum : sum;
  });
}

Value memory(const CloudResult& r, const std::string& build) {
  const MeasuredContender* const ours = find_ours(r, "SCSH-336", build);
  if (ours == nullptr) return {};
  return 1e-6 * static_cast<double>(ours->peak_bytes) * 170'000.0 / static_cast<double>(r.points);
}

Value difference(const CloudResult& r, const std::string& build) {
  const auto found = r.oracle_difference.find(build);
  if (found == r.oracle_difference.end()) return {};
  return found->second;
}

Value nothing(const CloudResult&, const std::string&) { return {}; }

constexpr const char* no_avx2 = "no AVX2 here";
constexpr const char* no_open3d = "no Open3D here";
constexpr const char* not_counted = "run ./run instructions";

std::vector<Goal> bounded_goals() {
  const Measure exact = ratio("SHOT-352", whole_frame, "PCL SHOT");
  const Measure fast = ratio("SHOT-352, fast normals", whole_frame, "PCL SHOT, fast normals");
  return {
      {"sample_uniform, 1 cm, instructions a point",
       Limit::at_most,
       {200.0, 180.0},
       instructions("point", {"sample"}),
       not_counted,
       "tabletop"},
      {"whole frame, SCSH-336, million instructions, CPU with AVX2",
       Limit::at_most,
       {120.0, 120.0},
       instructions("frame", {"whole frame Scsh336"}, "baseline"),
       not_counted,
       "tabletop"},
      {"whole frame, SCSH-336, million instructions, CPU without AVX2",
       Limit::at_most,
       {190.0, {}},
       instructions("frame", {"whole frame Scsh336"}),
       not_counted,
       "tabletop"},
      {"kernel SCSH-336, instructions per neighbor",
       Limit::at_most,
       {125.0, 80.0},
       instructions("neighbor", {"kernel Scsh336"}),
       not_counted,
       "tabletop"},
      {"kernel SSH-32, instructions per neighbor",
       Limit::at_most,
       {70.0, 40.0},
       instructions("neighbor", {"kernel Ssh32"}),
       not_counted,
       "tabletop"},
      {"kernel CSHOT-1344, instructions per neighbor",
       Limit::at_most,
       {142.0, 92.0},
       instructions("neighbor", {"kernel Cshot1344"}),
       not_counted,
       "tabletop"},
      {"extract SCSH-336, time with -mavx2 / of the baseline binary",
       Limit::at_least,
       {0.97, {}},
       step_ratio("avx2: SCSH-336, grid: extract", "BUILD: SCSH-336, grid: extract"),
       no_avx2},
      {"SHOT-352, whole frame, PCL / ours, fast normals on both sides",
       Limit::at_least,
       {12.0, 12.0},
       fast,
       "the cloud is no image, or no AVX2 here"},
      {"SHOT-352, whole frame, PCL / ours, exact normals", Limit::at_least, {8.0, 8.0}, exact, no_avx2},
      {"fast normals of an image, instructions a point",
       Limit::at_most,
       {400.0, 400.0},
       instructions("point", {"image normals"}),
       not_counted,
       "tabletop"},
      {"fast normals of an image, median error, degrees",
       Limit::at_most,
       {1.0, {}},
       per_build(nothing),
       "run ./run image_normals"},
      {"mean shift, 2000 votes, million instructions",
       Limit::at_most,
       {30.0, 30.0},
       instructions("frame", {"mean shift"}),
       not_counted,
       "votes"},
      {"extra memory, MB per 170,000 points", Limit::at_most, {5.5, 5.5}, per_build(memory), no_avx2},
      {"2 threads on 2 free cores, times as fast as 1",
       Limit::at_least,
       {1.85, 1.85},
       step_ratio("BUILD: 1 thread", "BUILD: 2 threads"),
       no_avx2},
      {"largest difference from the double oracle away from cell borders",
       Limit::at_most,
       {1e-6, 1e-6},
       per_build(difference),
       no_avx2},
  };
}

std::vector<Goal> reports() {
  const auto report = [](std::string name, Measure measure, const char* if_missing = no_avx2, const char* cloud = "") {
    return Goal{std::move(name), Limit::none, {}, std::move(measure), if_missing, cloud};
  };
  return {
      report("SCSH-336, whole frame, PCL SHOTColor / ours", ratio("SCSH-336", whole_frame, "PCL SHOTColor")),
      report("SCSH-336, whole frame, PCL SHOTColor with fast normals / ours",
             ratio("SCSH-336", whole_frame, "PCL SHOTColor, fast normals"), "the cloud is no image"),
      report("SCSH-336, whole frame, Open3D FPFH of as many points / ours",
             ratio("SCSH-336", whole_frame, "Open3D FPFH, as many points"), no_open3d),
      report("SCSH-336, whole frame, naive double / ours", ratio("SCSH-336", whole_frame, "naive double", "SCSH-336")),
      report("SSH-32, whole frame, PCL SHOT / ours", ratio("SSH-32", whole_frame, "PCL SHOT")),
      report("SHOT-352 per key point, PCL / ours, normals given", ratio("SHOT-352", per_keypoint, "PCL SHOT")),
      report("CSHOT-1344 per key point, PCL / ours, normals given", ratio("CSHOT-1344", per_keypoint, "PCL SHOTColor")),
      report("key points, PCL VoxelGrid / ours", ratio(key_points_made, whole_frame, "PCL VoxelGrid")),
      report("key points, Open3D voxel_down_sample / ours",
             ratio(key_points_made, whole_frame, "Open3D voxel_down_sample"), no_open3d),
      report("exact normals of an image, index included, r = 0.01 m, PCL / ours",
             ratio(normals_made, whole_frame, "PCL NormalEstimation")),
      report("fast normals of PCL / exact ones of ours",
             ratio(normals_made, whole_frame, "PCL IntegralImageNormalEstimation"), "the cloud is no image"),
      report("search per neighbor, nanoflann (leaf 10, unsorted) / grid",
             step_ratio("naive: search", "BUILD: search, grid")),
      report("index build, nanoflann / grid", step_ratio("naive: tree", "BUILD: grid")),
      report("search + frame, instructions per neighbor", instructions("neighbor", {"search grid", "frame"}),
             not_counted, "tabletop"),
  };
}

}  // namespace

const std::vector<Goal>& goals() {
  static const std::vector<Goal> all = [] {
    std::vector<Goal> list = bounded_goals();
    for (Goal& report : reports()) list.push_back(std::move(report));
    return list;
  }();
  return all;
}

}  // namespace shortshot_bench::peers
