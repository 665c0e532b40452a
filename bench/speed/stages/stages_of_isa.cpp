// Compiled once for each instruction set; STAGES is the function's name. All else has internal linkage, and the library
// an inline namespace of its own, so that one program can hold several.
#include "speed/stages/stages_of_isa.hpp"

#include <cstdint>
#include <memory>
#include <nanoflann.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "shortshot/search/nanoflann.hpp"
#include "shortshot/shortshot.hpp"
#include "speed/stages/calls_of_isa.hpp"
#include "speed/stages/mean_shift_of_isa.hpp"
#include "tools/io/view_of_cloud.hpp"

#ifndef STAGES
#define STAGES stages_plain
#if defined(__SSE2__)
#define STAGES_ISA sse2
#elif defined(__aarch64__)
#define STAGES_ISA neon
#else
#define STAGES_ISA scalar
#endif
#endif
#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)

namespace shortshot_bench {
namespace {

/// nanoflann's tree, made like a grid.
struct Tree : shortshot::NanoflannSearch {
  Tree(const shortshot::CloudView& view, float) : NanoflannSearch(view) {}
};

/// Makes the list. What several stages need is shared by them.
class StageList {
 public:
  explicit StageList(const Workload& workload)
      : workload_(workload), grid_(std::make_shared<shortshot::GridSearch>(workload.view(), workload.radius)) {}

  /// The key points of the next frame, in the memory of the last one.
  void add_sample() {
    const auto sampler = std::make_shared<shortshot::KeypointSampler>();
    const auto keypoints = std::make_shared<std::vector<std::uint32_t>>();
    Stage& stage = add("sample", [&w = workload_, sampler, keypoints] {
      return sample(w.view(), w.frame_leaf, *sampler, *keypoints);
    });
    stage.points = workload_.cloud.size();
  }

  template <class Search>
  void add_index(const char* name) {
    Stage& stage = add(std::string("index ") + name, [&w = workload_] { return Search(w.view(), w.radius).status(); });
    stage.points = workload_.cloud.size();
    stage.bytes = index_bytes<Search>(workload_);
  }

  /// The grid of the next frame, in the memory of the last one.
  void add_index_again() {
    const auto search = std::make_shared<shortshot::GridSearch>();
    const Workload& w = workload_;
    Stage& stage = add("index grid again", [&w, search] { return search->build(w.view(), w.radius); });
    stage.points = w.cloud.size();
    stage.bytes = index_bytes<shortshot::GridSearch>(w);
  }

  void add_search_grid() { add_search("search grid", grid_); }
  void add_search_nanoflann() {
    add_search("search nanoflann", std::make_shared<Tree>(workload_.view(), workload_.radius));
  }

  void add_frame() {
    add_for_chosen("frame", [frame = std::make_shared<shortshot::Frame>()](const GatheredKeyPoint& k, float radius) {
      return frame_of(k.neighborhood, radius, *frame);
    });
  }

  /// Of the whole cloud on one thread, the index not included; in the memory of the last run.
  void add_normals() {
    const Workload& w = workload_;
    const auto near = std::make_shared<shortshot::GridSearch>(w.view(), w.normal_radius);
    Stage& stage = add("normals", [&w, near, normals = std::make_shared<std::vector<shortshot::SurfaceNormal>>()] {
      return normals_of_cloud(w.view(), *near, w.normal_radius, camera_of_cloud(w.cloud), *normals);
    });
    stage.points = w.cloud.size();
    stage.neighbors = w.normal_neighbors;
    stage.bytes = stage.points * sizeof(shortshot::SurfaceNormal);
  }

  /// The same of the depth image, within the same radius, in the memory of the last run.
  void add_image_normals() {
    const Workload& w = workload_;
    const auto estimator = std::make_shared<shortshot::ImageNormalEstimator>();
    const auto made = std::make_shared<std::vector<shortshot::SurfaceNormal>>();
    Stage& stage = add("image normals", [&w, estimator, made] {
      return normals_of_image(w.view(), w.normal_radius, camera_of_cloud(w.cloud), *estimator, *made);
    });
    stage.points = w.cloud.size();
    stage.bytes = stage.points * sizeof(shortshot::SurfaceNormal);
  }

  void add_lab() {
    const auto table = std::make_shared<shortshot::LabTable<shortshot::PublishedLab>>();
    table->fill();
    Stage& stage = add("lab", [&w = workload_, table, lab = lab_by<shortshot::PublishedLab>()] {
      return lab_of_cloud_by(*table, w.view(), lab->data());
    });
    stage.points = workload_.cloud.size();
    stage.bytes = stage.points * sizeof(shortshot::Lab);
  }

  template <class D>
  void add_descriptor(const char* name) {
    if (D::needs_colors && !workload_.cloud.has_colors()) return;
    if (D::needs_intensities && !workload_.cloud.has_intensities()) return;
    add_kernel<D>(name);
    add_extract<D>(name);
  }

  /// From raw points to descriptors, in the memory of the last frame.
  template <class D>
  void add_whole_frame(const char* name) {
    if (D::needs_colors && !workload_.cloud.has_colors()) return;
    const auto memory = std::make_shared<FrameMemory<D>>();
    Stage& stage = add(std::string("whole frame ") + name,
                       [&w = workload_, memory] { return whole_frame<D>(w.view(), w.frame_leaf, w.radius, *memory); });
    static_cast<void>(stage.run());  // a frame that fails says so when it is measured
    const std::vector<std::uint32_t>& neighbors = memory->features.neighbors;
    stage.keypoints = memory->features.size();
    stage.neighbors = std::accumulate(neighbors.begin(), neighbors.end(), std::size_t{0});
    stage.bytes = D::size_bytes;
    stage.per_frame = true;
  }

  /// The objects that 2000 key points have voted for.
  void add_mean_shift() {
    const auto votes = std::make_shared<std::vector<shortshot::detail::Vote>>(votes_in_cubic_meter(frame_votes));
    const auto sum = std::make_shared<float>();
    Stage& stage = add("mean shift", [votes, sum] {
      *sum = climb_from_all(*votes, shortshot::RecognizerOptions{}.bandwidth);
      return Status::ok;
    });
    stage.keypoints = votes->size();
    stage.per_frame = true;
  }

  /// B-SHOT of the chosen key points, and the distances of the first one to all.
  template <class D>
  void add_binary(const char* name) {
    using Bits = shortshot::BinaryDescriptor<D>;
    constexpr auto size = static_cast<std::size_t>(D::size);
    const auto run = kernel_of<D>();
    const auto values = std::make_shared<std::vector<float>>(workload_.chosen.size() * size);
    const auto bits = std::make_shared<std::vector<Bits>>(workload_.chosen.size());
    for (std::size_t i = 0; i < workload_.chosen.size(); ++i) {  // a kernel that fails says so in its own stage
      static_cast<void>(run(workload_.chosen[i], workload_.radius, values->data() + i * size));
      bits_of<D>(values->data() + i * size, (*bits)[i]);
    }
    Stage& binarize = add(std::string("binarize ") + name, [values, bits] {
      for (std::size_t i = 0; i < bits->size(); ++i) bits_of<D>(values->data() + i * size, (*bits)[i]);
      return Status::ok;
    });
    binarize.keypoints = bits->size();
    binarize.bytes = sizeof(Bits);
    const auto distance = std::make_shared<int>();
    Stage& hamming = add(std::string("hamming ") + name, [bits, distance] {
      *distance = distance_to_all<D>(bits->front(), *bits);
      return Status::ok;
    });
    hamming.keypoints = bits->size();
  }

  std::vector<Stage> stages;

 private:
  template <class Run>
  Stage& add(std::string name, Run run) {
    Stage stage;
    stage.name = std::move(name);
    stage.run = std::move(run);
    stages.push_back(std::move(stage));
    return stages.back();
  }

  template <class Search>
  void add_search(const char* name, const std::shared_ptr<Search>& search) {
    // Room to spare, as extract() has: a search may be slower where it has to count the last places.
    const auto memory = std::make_shared<NeighborhoodMemory>(workload_.most_neighbors + workload_.most_neighbors / 2);
    add_for_chosen(name, [search, memory](const GatheredKeyPoint& k, float radius) {
      shortshot::Neighborhood n = memory->empty();
      return search_around(*search, k.key.position, radius, n);
    });
  }

  template <class Work>
  Stage& add_for_chosen(std::string name, Work work) {
    Stage& stage = add(std::move(name), [&w = workload_, work] {
      Status first = Status::ok;
      for (const GatheredKeyPoint& k : w.chosen) {
        const Status status = work(k, w.radius);
        if (first == Status::ok) first = status;
      }
      return first;
    });
    stage.keypoints = workload_.chosen.size();
    stage.neighbors = workload_.chosen_neighbors;
    return stage;
  }

  /// The cloud's colors by a rule.
  template <class Rule>
  std::shared_ptr<std::vector<shortshot::Lab>> lab_by() const {
    const auto lab = std::make_shared<std::vector<shortshot::Lab>>(workload_.cloud.size());
    static_cast<void>(lab_of_cloud<Rule>(workload_.view(), lab->data()));  // it has colors, all that can be wrong
    return lab;
  }

  /// The kernel as a function of the key point, with the cloud's colors and normals at hand.
  template <class D>
  auto kernel_of() const {
    std::shared_ptr<std::vector<shortshot::Lab>> lab;
    if constexpr (D::needs_colors) lab = lab_by<typename D::LabRule>();
    return [lab, view = workload_.view()](const GatheredKeyPoint& k, float radius, float* out) {
      const shortshot::CloudNormals normals{view};
      if constexpr (D::needs_colors) {
        const shortshot::LabColors colors{lab->data(), shortshot::to_lab<typename D::LabRule>(k.key.color)};
        return kernel<D>(k.neighborhood, shortshot::sources(colors, normals), k.frame, radius, out);
      } else if constexpr (D::needs_intensities) {
        return kernel<D>(k.neighborhood, shortshot::CloudIntensities::at(view, k.key), k.frame, radius, out);
      } else {
        return kernel<D>(k.neighborhood, shortshot::sources(normals), k.frame, radius, out);
      }
    };
  }

  template <class D>
  void add_kernel(const char* name) {
    const auto out = std::make_shared<std::vector<float>>(static_cast<std::size_t>(D::size));
    const auto run = kernel_of<D>();
    Stage& stage = add_for_chosen(std::string("kernel ") + name, [run, out](const GatheredKeyPoint& k, float radius) {
      return run(k, radius, out->data());
    });
    stage.bytes = D::size_bytes;
  }

  /// All sampled key points on one thread, the cloud's Lab included, the index not; in the memory of the last run.
  template <class D>
  void add_extract(const char* name) {
    const auto features = std::make_shared<shortshot::Features<D>>();
    Stage& stage = add(std::string("extract ") + name, [&w = workload_, grid = grid_, features] {
      return shortshot::extract<D>(w.view(), *grid, w.sampled, w.radius, *features);
    });
    stage.keypoints = workload_.sampled.size();
    stage.neighbors = workload_.sampled_neighbors;
    stage.bytes = D::size_bytes;
  }

  const Workload& workload_;
  std::shared_ptr<shortshot::GridSearch> grid_;
};

}  // namespace

StageBuild STAGES(const Workload& workload) {
  StageList list(workload);
  list.add_sample();
#if defined(STAGES_THAT_CHOOSE)
  list.add_index_again();
#else
  list.add_index<shortshot::GridSearch>("grid");
  list.add_index_again();
  list.add_index<Tree>("nanoflann");
  list.add_search_grid();
  list.add_search_nanoflann();
  list.add_frame();
  list.add_normals();
  if (workload.cloud.is_organized()) list.add_image_normals();
  if (workload.cloud.has_colors()) list.add_lab();
  list.add_descriptor<shortshot::Ssh32>("Ssh32");
  list.add_descriptor<shortshot::Ssh96>("Ssh96");
  list.add_descriptor<shortshot::Scsh336>("Scsh336");
  list.add_descriptor<shortshot::Scsh696>("Scsh696");
  list.add_descriptor<shortshot::Shot352>("Shot352");
  list.add_descriptor<shortshot::Cshot1344>("Cshot1344");
  list.add_descriptor<shortshot::IntensityShape336>("IntensityShape336");
  list.add_descriptor<shortshot::ShapeColor95>("ShapeColor95");
  list.add_descriptor<shortshot::ShapeColor32>("ShapeColor32");
  list.add_binary<shortshot::Shot352>("Shot352");
  list.add_mean_shift();
#endif
  list.add_whole_frame<shortshot::Scsh336>("Scsh336");
  return {TEXT(STAGES_ISA), std::move(list.stages)};
}

}  // namespace shortshot_bench
