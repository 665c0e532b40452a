#include "speed/peers/naive_suite.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "speed/peers/naive.hpp"

namespace shortshot_bench::peers {
namespace {

struct State {
  explicit State(const Task& t) : task(t), naive(t) {}

  const Task& task;
  Naive naive;
  std::vector<std::uint32_t> sampled;
  std::vector<float> rows;

  void find_all() {
    Naive::Neighbors neighbors;
    for (const std::uint32_t key : task.keypoints) naive.find_neighbors(key, neighbors);
  }

  void describe_all(const std::vector<NaivePart>& parts, std::size_t size) {
    rows.assign(task.keypoints.size() * size, 0.0f);
    Naive::Neighbors neighbors;
    std::vector<double> descriptor;
    for (std::size_t row = 0; row < task.keypoints.size(); ++row) {
      const std::uint32_t key = task.keypoints[row];
      naive.find_neighbors(key, neighbors);
      shortshot::Frame frame{};
      if (!naive.estimate_frame(key, neighbors, frame)) continue;
      naive.describe(key, neighbors, frame, parts, descriptor);
      std::transform(descriptor.begin(), descriptor.end(), rows.begin() + static_cast<std::ptrdiff_t>(row * size),
                     [](double value) { return static_cast<float>(value); });
    }
  }
};

}  // namespace

Suite make_naive_suite(const Task& task) {
  const auto state = std::make_shared<State>(task);
  Suite suite{"naive"};
  const std::size_t sample = suite.add("sample", [state] { state->sampled = state->naive.sample(); });
  Contender sampling{"naive double", key_points_made, {}, "voxels"};
  sampling.against = {key_points_made};
  suite.add_maker(sampling, sample, task.sampled.size(), sizeof(std::uint32_t));
  const std::size_t tree = suite.add("tree", [state] { state->naive.build_tree(); });
  const std::size_t lab = suite.add("Lab", [state] { state->naive.convert_colors(); });
  suite.add("search", [state] { state->find_all(); });

  const auto add = [&](const char* descriptor, const std::vector<NaivePart>& parts) {
    std::size_t size = 0;
    bool colored = false;
    for (const NaivePart& part : parts) {
      size += part.size();
      colored = colored || part.bins > 0;
    }
    Contender contender{"naive double", descriptor, {}, "nanoflann"};
    contender.describe = suite.add(descriptor, [=] { state->describe_all(parts, size); });
    contender.frame = {sample, tree};
    if (colored) contender.frame.push_back(lab);
    contender.frame.push_back(contender.describe);
    contender.output_bytes = task.keypoints.size() * size * sizeof(float);
    contender.against = {descriptor};
    suite.contenders.push_back(contender);
  };
  add("SSH-32", {{2, 2, 8}});
  add("SCSH-336", {{3, 4, 8}, {2, 2, 4, 15}});
  add("SCSH-696", {{3, 4, 8}, {2, 2, 6, 25}});

  suite.release = [state] {
    state->naive.release();
    state->sampled = std::vector<std::uint32_t>();  // {} would keep its memory
    state->rows = std::vector<float>();
  };
  return suite;
}

}  // namespace shortshot_bench::peers
