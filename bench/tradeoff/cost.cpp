#include "tradeoff/cost.hpp"

#include <valgrind/callgrind.h>

#include <fstream>
#include <memory>
#include <stdexcept>

#include "speed/instructions/figures.hpp"
#include "speed/timing/clock.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace shortshot_bench::tradeoff {
namespace {

constexpr int rounds = 7;
constexpr float radius = 0.04f;
constexpr float leaf = 0.02f;
constexpr std::size_t every = 4;  // a few thousand are enough
constexpr const char* const unit_of_time = "scsh336-float";

/// The tabletop, ready to be described.
class Workload {
 public:
  Workload() : cloud_(make_tabletop()) {
    const shortshot::CloudView view = view_of_cloud(cloud_);
    std::vector<std::uint32_t> points;
    require(shortshot::sample_uniform(view, leaf, points));
    for (std::size_t i = 0; i < points.size(); i += every) keypoints_.push_back(shortshot::keypoint(view, points[i]));
    const shortshot::GridSearch near(view, radius / 4.0f);
    require(shortshot::estimate_normals(view, near, radius / 4.0f, camera_of_cloud(cloud_), normals_));
    search_ = std::make_unique<shortshot::GridSearch>(view, radius);
  }
  std::size_t keypoints() const { return keypoints_.size(); }

  paper::Described describe(const Candidate& candidate) const {
    shortshot::Support support(radius);
    if (candidate.configuration.wants_viewpoint) support.viewpoint = camera_of_cloud(cloud_);
    return candidate.describe_alone(shortshot::with_normals(view_of_cloud(cloud_), normals_.data()), *search_,
                                    keypoints_, support, {});
  }

 private:
  RgbdCloud cloud_;
  std::vector<shortshot::KeyPoint> keypoints_;
  std::vector<shortshot::SurfaceNormal> normals_;
  std::unique_ptr<shortshot::GridSearch> search_;
};

void pack_all(const paper::Described& described, const Storage& storage, std::vector<unsigned char>& bytes) {
  bytes.resize(described.status.size() * storage.size_bytes);
  for (std::size_t row = 0; row < described.status.size(); ++row) {
    storage.pack(described.values.data() + row * described.size, bytes.data() + row * storage.size_bytes);
  }
}

}  // namespace

std::string cost_workload() {
  return "Time and instructions of a key point: search, frame, descriptor and packing, one core, on a generated "
         "tabletop of 640 x 480 points, R = 4 cm, key points every 2 cm, compiled with " SHORTSHOT_BUILD_FLAGS
         "; without the index, and without the normals that SHOT and CSHOT need.";
}

Costs measure_times(const std::vector<Candidate>& candidates) {
  const Workload workload;
  std::map<std::string, std::vector<double>> seconds;
  for (int round = 0; round < rounds; ++round) {
    for (const Candidate& candidate : candidates) {
      const double begin = now_seconds(Clock::thread_cpu);
      const paper::Described described = workload.describe(candidate);
      const double to_describe = now_seconds(Clock::thread_cpu) - begin;
      std::vector<unsigned char> bytes;
      for (const Storage& storage : candidate.storages) {
        const double packing = now_seconds(Clock::thread_cpu);
        pack_all(described, storage, bytes);
        const double to_pack = &storage == &candidate.storages.front() ? 0.0 : now_seconds(Clock::thread_cpu) - packing;
        seconds[entry_name(candidate, storage)].push_back(to_describe + to_pack);
      }
    }
  }
  Costs costs;
  for (const auto& [entry, of_rounds] : seconds) {
    std::vector<double> relative;
    for (std::size_t i = 0; i < of_rounds.size(); ++i) relative.push_back(of_rounds[i] / seconds.at(unit_of_time)[i]);
    costs[entry] = {1e6 * median(of_rounds) / static_cast<double>(workload.keypoints()), median(relative), 0.0};
  }
  return costs;
}

void count_instructions(const std::vector<Candidate>& candidates) {
  if (RUNNING_ON_VALGRIND == 0) throw std::runtime_error("`count` is to be run under valgrind --tool=callgrind");
  const Workload workload;
  for (const Candidate& candidate : candidates) {
    CALLGRIND_START_INSTRUMENTATION;
    const paper::Described described = workload.describe(candidate);
    CALLGRIND_STOP_INSTRUMENTATION;
    const std::string name = dump_name(candidate.configuration.name, workload.keypoints(), "key point");
    CALLGRIND_DUMP_STATS_AT(name.c_str());
    std::vector<unsigned char> bytes;
    for (const Storage& storage : candidate.storages) {
      CALLGRIND_START_INSTRUMENTATION;
      pack_all(described, storage, bytes);
      CALLGRIND_STOP_INSTRUMENTATION;
      const std::string packing = dump_name(entry_name(candidate, storage), workload.keypoints(), "key point");
      CALLGRIND_DUMP_STATS_AT(packing.c_str());
    }
  }
}

void read_instructions(const std::string& callgrind_file, const std::vector<Candidate>& candidates, Costs& costs) {
  std::ifstream in(callgrind_file);
  if (!in) throw std::runtime_error(callgrind_file + ": cannot be read");
  std::map<std::string, double> counted;
  for (const shortshot_bench::Figure& figure : read_callgrind(in)) counted[figure.name] = figure.instructions;
  for (const Candidate& candidate : candidates) {
    for (const Storage& storage : candidate.storages) {
      const std::string entry = entry_name(candidate, storage);
      if (counted.count(entry) == 0 || costs.count(entry) == 0) continue;
      const double to_pack = &storage == &candidate.storages.front() ? 0.0 : counted.at(entry);
      costs.at(entry).instructions = counted.at(candidate.configuration.name) + to_pack;
    }
  }
}

}  // namespace shortshot_bench::tradeoff
