// shortshot as contenders. Compiled once per instruction set: PEERS_SUITE is the function's name and PEERS_BUILD the
// build's, which say with what flags. No type of an instruction set's own crosses the function's border.

#include <cstdint>
#include <memory>
#include <nanoflann.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "shortshot/search/nanoflann.hpp"
#include "shortshot/shortshot.hpp"
#include "speed/peers/suite.hpp"
#include "speed/peers/task.hpp"
#include "speed/spread_keypoints.hpp"
#include "tools/golden/neighbors.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench::peers {

Suite PEERS_SUITE(const Task& task);

namespace {

namespace ss = shortshot;

/// One search; built anew for every frame, as one does.
struct Grid {
  static constexpr const char* name = "grid";
  ss::GridSearch search;
  void build(const ss::CloudView& view, float radius) { require(search.build(view, radius)); }
  void release() { search = {}; }
  const ss::GridSearch& operator*() const { return search; }
};

struct Tree {
  static constexpr const char* name = "nanoflann";
  std::unique_ptr<ss::NanoflannSearch> search;
  void build(const ss::CloudView& view, float) {
    search.reset();
    search = std::make_unique<ss::NanoflannSearch>(view);
  }
  void release() { search.reset(); }
  const ss::NanoflannSearch& operator*() const { return *search; }
};

struct State {
  explicit State(const Task& t) : task(t), view(view_of_cloud(t.points)) {}

  const Task& task;
  ss::CloudView view;  // with normals once they are there
  Grid grid, normal_grid;
  Tree tree;
  std::vector<std::uint32_t> keypoints;
  std::vector<ss::SurfaceNormal> normals;
  std::vector<ss::Lab> lab;
  golden::Neighbors neighbors;
};

/// As in the first frame: nothing is kept of a frame before.
void sample_keypoints(State& state) {
  require(ss::sample_uniform(state.view, state.task.leaf, state.keypoints));
  keep_spread(state.keypoints, max_keypoints);
}

/// By the grid that serves their radius best.
void estimate_normals(State& state, const ss::CloudView& view) {
  state.normal_grid.build(view, normal_radius);
  require(ss::estimate_normals(view, *state.normal_grid, normal_radius, ss::Viewpoint::towards({}), state.normals));
}

/// Of the image, and then those of its points if they are a list.
void estimate_fast_normals(State& state, const ss::CloudView& view) {
  const ss::CloudView image = view_of_cloud(state.task.image);
  require(ss::estimate_image_normals(image, normal_radius, ss::Viewpoint::towards({}), state.normals));
  if (view.size == image.size) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < image.size; ++i) {
    if (ss::is_finite(ss::point(image, i))) state.normals[kept++] = state.normals[i];
  }
  state.normals.resize(kept);
}

template <class LabRule>
void convert_colors(State& state) {
  state.lab.resize(state.view.size);
  require(ss::convert_colors<LabRule>(state.view, state.lab.data()));
}

template <class Search>
void find_all(State& state, const Search& search) {
  for (const std::uint32_t key : state.task.keypoints) {
    state.neighbors.gather(search, ss::point(state.view, key), state.task.radius);
  }
}

template <class D>
auto sources_for(const State& state, std::uint32_t key) {
  const ss::CloudNormals normals{state.view};  // looked at only if D needs them
  if constexpr (D::needs_colors) {
    return ss::sources(ss::LabColors{state.lab.data(), state.lab[key]}, normals);
  } else {
    return ss::sources(normals);
  }
}

/// Rows as published: floats, and frames that know no viewpoint.
template <class D>
struct Floats {
  using Descriptor = D;
  static constexpr std::size_t row_bytes = D::size_bytes;
  static ss::Support support(ss::Radius radius) { return radius; }
  void resize(std::size_t) {}
  void keep(const float*, std::size_t) {}
};

/// Rows as compact descriptors are used: four bits a value, and frames that look at the camera.
template <class D>
struct Nibbles {
  using Descriptor = D;
  static constexpr std::size_t row_bytes = sizeof(ss::NibbleDescriptor<D>);
  static ss::Support support(ss::Radius radius) {
    ss::Support support(radius);
    support.viewpoint = ss::Viewpoint::towards({});
    return support;
  }
  void resize(std::size_t count) { rows.resize(count); }
  void keep(const float* row, std::size_t i) { ss::quantize(row, rows[i]); }

  std::vector<ss::NibbleDescriptor<D>> rows;
};

/// Search, frame and kernel of each key point; normals and the cloud's colors, by D's rule, are there already.
template <class Form, class D, class Search>
void describe_all(State& state, const Search& search, ss::Features<D>& features, Form& form) {
  const ss::Support support = Form::support(state.task.radius);
  float* row = features.values.data();
  for (std::size_t i = 0; i < state.task.keypoints.size(); ++i, row += D::size) {
    const std::uint32_t key = state.task.keypoints[i];
    const ss::Point center = ss::point(state.view, key);
    const ss::Neighborhood& n = state.neighbors.gather(search, center, state.task.radius);
    ss::Frame frame;
    if (ss::estimate_frame(n, support.frame_radius, frame, support.viewpoint) != ss::Status::ok) continue;
    static_cast<void>(ss::describe<D>(n, sources_for<D>(state, key), frame, support.radius, row));
    form.keep(row, i);
  }
}

/// Adds a descriptor in a form with one search, given by the state's member and the steps before it, which build it.
template <class Form, class Index>
void add_contender(Suite& suite, const std::shared_ptr<State>& state, Index State::*index,
                   const std::vector<std::size_t>& before, const std::string& descriptor) {
  using D = typename Form::Descriptor;
  const auto extractor = std::make_shared<ss::Extractor<D>>();
  const auto features = std::make_shared<ss::Features<D>>();
  const auto form = std::make_shared<Form>();
  const auto extract = [=](unsigned threads) {
    const State& s = *state;
    require(
        extractor->extract(s.view, *((*state).*index), s.keypoints, Form::support(s.task.radius), *features, threads));
    form->resize(features->size());
    for (std::size_t i = 0; i < features->size(); ++i) form->keep((*features)[i], i);
  };
  const std::string name = descriptor + ", " + Index::name;
  Contender contender{"shortshot", descriptor, suite.name, Index::name};
  contender.frame = before;
  contender.frame.push_back(suite.add(name + ": extract", [=] { extract(1); }));
  contender.describe =
      suite.add(name + ": describe", [=] { describe_all(*state, *((*state).*index), *features, *form); });
  contender.output_bytes = state->task.keypoints.size() * (Form::row_bytes + sizeof features->status[0] +
                                                           sizeof features->frames[0] + sizeof features->neighbors[0]);
  contender.rows = [=] { return static_cast<const float*>(features->values.data()); };
  suite.contenders.push_back(contender);
  if constexpr (std::is_same<Index, Grid>::value && std::is_same<D, ss::Scsh336>::value) {
    suite.add(
        "1 thread", [=] { extract(1); }, Clock::wall);
    suite.add(
        "2 threads", [=] { extract(2); }, Clock::wall);
  }
  suite.release = [release_others = suite.release, extractor, features, form] {
    release_others();
    *extractor = {};
    *features = {};
    *form = {};
  };
}

/// Steps of a frame before its descriptors.
struct Steps {
  std::size_t sample, grid, tree;
};

template <class D>
void add_descriptor(Suite& suite, const std::shared_ptr<State>& state, const Steps& steps, const char* descriptor) {
  add_contender<Floats<D>>(suite, state, &State::grid, {steps.sample, steps.grid}, descriptor);
  add_contender<Floats<D>>(suite, state, &State::tree, {steps.sample, steps.tree}, descriptor);
}

template <class D>
void add_compact(Suite& suite, const std::shared_ptr<State>& state, const Steps& steps, const char* descriptor) {
  add_contender<Nibbles<D>>(suite, state, &State::grid, {steps.sample, steps.grid}, descriptor);
}

/// A way to estimate normals, of the image and of the points, and the descriptors that need them, PCL's own, defects
/// included, so that both sides compute the same. `suffix` tells them from those with normals of another way.
template <class Estimate>
void add_with_normals(Suite& suite, const std::shared_ptr<State>& state, const Steps& steps, const char* makes,
                      const std::string& suffix, Estimate estimate) {
  const std::size_t of_image = suite.add(makes, [=] { estimate(*state, view_of_cloud(state->task.image)); });
  suite.add_maker({"shortshot", makes, suite.name, Grid::name}, of_image, state->task.image.size(),
                  sizeof(ss::SurfaceNormal));
  const std::size_t normals = suite.add("normals" + suffix, [=] {
    estimate(*state, state->view);
    state->view = ss::with_normals(state->view, state->normals.data());
  });
  const std::vector<std::size_t> before{steps.sample, steps.grid, normals};
  add_contender<Floats<ss::PclShot352>>(suite, state, &State::grid, before, "SHOT-352" + suffix);
  add_contender<Floats<ss::PclCshot1344>>(suite, state, &State::grid, before, "CSHOT-1344" + suffix);
}

}  // namespace

Suite PEERS_SUITE(const Task& task) {
  const auto state = std::make_shared<State>(task);
  Suite suite{PEERS_BUILD};
  suite.release = [state] {
    state->grid.release();
    state->normal_grid.release();
    state->tree.release();
    state->keypoints = std::vector<std::uint32_t>();  // {} would keep its memory
    state->view.normals = {};
    state->normals = std::vector<ss::SurfaceNormal>();
    state->lab = std::vector<ss::Lab>();
    state->neighbors = {};
  };
  Steps steps{};
  steps.sample = suite.add("sample", [=] { sample_keypoints(*state); });
  suite.add_maker({"shortshot", key_points_made, suite.name, "voxels"}, steps.sample, task.sampled.size(),
                  sizeof(std::uint32_t));
  steps.grid = suite.add("grid", [=] { state->grid.build(state->view, state->task.radius); });
  steps.tree = suite.add("tree", [=] { state->tree.build(state->view, state->task.radius); });
  suite.add("search, grid", [=] { find_all(*state, *state->grid); });
  suite.add("search, nanoflann", [=] { find_all(*state, *state->tree); });
  suite.add("Lab", [=] { convert_colors<ss::PublishedLab>(*state); });
  add_descriptor<ss::Ssh32>(suite, state, steps, "SSH-32");
  add_descriptor<ss::Scsh336>(suite, state, steps, "SCSH-336");
  add_descriptor<ss::Scsh696>(suite, state, steps, "SCSH-696");
  add_compact<ss::ShapeColor95>(suite, state, steps, "ShapeColor95");
  add_compact<ss::ShapeColor32>(suite, state, steps, "ShapeColor32");
  add_compact<ss::HeightShape96>(suite, state, steps, "HeightShape96");
  suite.add("Lab, PCL's rule", [=] { convert_colors<ss::PclCshot1344::LabRule>(*state); });
  add_with_normals(suite, state, steps, normals_made, "", estimate_normals);
  if (task.image.is_organized()) {
    add_with_normals(suite, state, steps, fast_normals_made, with_fast_normals, estimate_fast_normals);
  }
  return suite;
}

}  // namespace shortshot_bench::peers
