#include "pcl_peer.hpp"

#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/features/shot.h>
#include <pcl/features/shot_lrf.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace shortshot_bench::peers {
namespace {

using Point = pcl::PointXYZRGBA;
using Points = pcl::PointCloud<Point>;
using Tree = pcl::search::KdTree<Point>;

Point point_of(const RgbdCloud& cloud, std::size_t i) {
  Point p;
  p.x = cloud.xyz[3 * i];
  p.y = cloud.xyz[3 * i + 1];
  p.z = cloud.xyz[3 * i + 2];
  p.r = cloud.rgb[3 * i];
  p.g = cloud.rgb[3 * i + 1];
  p.b = cloud.rgb[3 * i + 2];
  p.a = 255;
  return p;
}

struct State {
  explicit State(const Task& task) : radius(static_cast<double>(task.radius)) {
    for (std::size_t i = 0; i < task.points.size(); ++i) surface->push_back(point_of(task.points, i));
    for (const std::uint32_t i : task.keypoints) keypoints->push_back((*surface)[i]);
    for (std::size_t i = 0; i < task.image.size(); ++i) image->push_back(point_of(task.image, i));
    image->is_dense = false;
  }

  double radius;
  Points::Ptr surface{new Points};
  Points::Ptr keypoints{new Points};
  Points::Ptr image{new Points};
  Tree::Ptr sorted_tree, unsorted_tree;
  pcl::PointCloud<pcl::Normal>::Ptr normals;
  pcl::PointCloud<pcl::ReferenceFrame>::Ptr frames;

  void build(Tree::Ptr& tree, bool sorted) const {
    tree.reset();
    tree.reset(new Tree(sorted));
    tree->setInputCloud(surface);
  }

  void estimate_normals() {
    normals.reset(new pcl::PointCloud<pcl::Normal>);
    pcl::NormalEstimation<Point, pcl::Normal> estimation;
    estimation.setInputCloud(surface);
    estimation.setSearchMethod(sorted_tree ? sorted_tree : unsorted_tree);  // the k nearest come sorted from either
    estimation.setKSearch(10);
    estimation.compute(*normals);
  }

  /// By the radius that ours are estimated with, and with a tree of their own, as ours.
  void estimate_normals_of_image() const {
    pcl::NormalEstimation<Point, pcl::Normal> estimation;
    estimation.setInputCloud(image);
    estimation.setSearchMethod(Tree::Ptr(new Tree(false)));
    estimation.setRadiusSearch(static_cast<double>(normal_radius));
    pcl::PointCloud<pcl::Normal> estimated;
    estimation.compute(estimated);
  }

  void estimate_frames() {
    frames.reset(new pcl::PointCloud<pcl::ReferenceFrame>);
    pcl::SHOTLocalReferenceFrameEstimation<Point> estimation;
    estimation.setInputCloud(keypoints);
    estimation.setSearchSurface(surface);
    estimation.setSearchMethod(unsorted_tree);
    estimation.setRadiusSearch(radius);
    estimation.compute(*frames);
  }

  template <class Estimation>
  void prepare(Estimation& estimation, const Tree::Ptr& tree) const {
    estimation.setInputCloud(keypoints);
    estimation.setSearchSurface(surface);
    estimation.setInputNormals(normals);
    estimation.setSearchMethod(tree);
    estimation.setRadiusSearch(radius);
  }
};

/// Descriptors that stay until the next ones, so that the memory is not handed back while it is counted.
template <class Estimation, class Signature>
struct Output {
  pcl::PointCloud<Signature> rows;

  void compute_as_called(const State& state) {
    Estimation estimation;
    state.prepare(estimation, state.sorted_tree);
    estimation.compute(rows);
  }
  void compute_kindly(const State& state) {
    Estimation estimation;
    state.prepare(estimation, state.unsorted_tree);
    if constexpr (!std::is_same<Signature, pcl::FPFHSignature33>::value)
      estimation.setInputReferenceFrames(state.frames);
    estimation.compute(rows);
  }
};

struct Steps {
  std::size_t sorted_tree, unsorted_tree, normals, frames;
};

/// Adds a contender whose frame is `before` and then the descriptor.
template <class Signature>
void add_contender(Suite& suite, const State& state, const std::string& name, const std::string& descriptor,
                   const std::vector<std::string>& against, std::vector<std::size_t> before,
                   std::function<void()> run) {
  Contender contender{name, descriptor, {}, "FLANN"};
  contender.describe = suite.add(name, std::move(run));
  contender.frame = std::move(before);
  contender.frame.push_back(contender.describe);
  contender.output_bytes = state.keypoints->size() * sizeof(Signature);
  contender.against = against;
  suite.contenders.push_back(contender);
}

template <class Estimation, class Signature>
void add_shot(Suite& suite, const std::shared_ptr<State>& state, const Steps& steps, const std::string& name,
              const std::string& descriptor, const std::vector<std::string>& against) {
  const auto output = std::make_shared<Output<Estimation, Signature>>();
  add_contender<Signature>(suite, *state, name, descriptor, against, {steps.sorted_tree, steps.normals},
                           [=] { output->compute_as_called(*state); });
  add_contender<Signature>(suite, *state, name + ", frames given", descriptor, against,
                           {steps.unsorted_tree, steps.normals, steps.frames}, [=] { output->compute_kindly(*state); });
  suite.release = [release_others = suite.release, output] {
    release_others();
    output->rows = {};
  };
}

}  // namespace

Suite make_pcl_suite(const Task& task, bool with_fpfh) {
  const auto state = std::make_shared<State>(task);
  Suite suite{"PCL"};
  suite.release = [=] {
    state->sorted_tree.reset();
    state->unsorted_tree.reset();
    state->normals.reset();
    state->frames.reset();
  };
  Steps steps{};
  steps.sorted_tree = suite.add("tree", [=] { state->build(state->sorted_tree, true); });
  steps.unsorted_tree = suite.add("unsorted tree", [=] { state->build(state->unsorted_tree, false); });
  steps.normals = suite.add("normals", [=] { state->estimate_normals(); });
  steps.frames = suite.add("frames", [=] { state->estimate_frames(); });
  suite.add("normals of the image", [=] { state->estimate_normals_of_image(); });

  using Color = pcl::SHOTColorEstimation<Point, pcl::Normal, pcl::SHOT1344>;
  using Shape = pcl::SHOTEstimation<Point, pcl::Normal, pcl::SHOT352>;
  using Fpfh = pcl::FPFHEstimation<Point, pcl::Normal, pcl::FPFHSignature33>;
  add_shot<Color, pcl::SHOT1344>(suite, state, steps, "PCL SHOTColor", "CSHOT-1344",
                                 {"SCSH-336", "SCSH-696", "CSHOT-1344"});
  add_shot<Shape, pcl::SHOT352>(suite, state, steps, "PCL SHOT", "SHOT-352", {"SSH-32", "SHOT-352"});
  if (!with_fpfh) return suite;
  const auto output = std::make_shared<Output<Fpfh, pcl::FPFHSignature33>>();
  add_contender<pcl::FPFHSignature33>(suite, *state, "PCL FPFH", "FPFH-33", {"SSH-32"},
                                      {steps.unsorted_tree, steps.normals}, [=] { output->compute_kindly(*state); });
  return suite;
}

}  // namespace shortshot_bench::peers
