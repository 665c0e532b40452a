#include "pcl_peer.hpp"

#include <pcl/console/print.h>
#include <pcl/features/fpfh.h>
#include <pcl/features/integral_image_normal.h>
#include <pcl/features/normal_3d.h>
#include <pcl/features/shot.h>
#include <pcl/features/shot_lrf.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace shortshot_bench::peers {
namespace {

using Point = pcl::PointXYZRGBA;
using Points = pcl::PointCloud<Point>;
using Normals = pcl::PointCloud<pcl::Normal>;
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
  explicit State(const Task& task)
      : radius(static_cast<double>(task.radius)), leaf(task.leaf), width(task.image.width), height(task.image.height) {
    for (std::size_t i = 0; i < task.points.size(); ++i) surface->push_back(point_of(task.points, i));
    for (const std::uint32_t i : task.keypoints) keypoints->push_back((*surface)[i]);
    for (std::size_t i = 0; i < task.image.size(); ++i) {
      image->push_back(point_of(task.image, i));
      const Point& p = image->back();
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) valid.push_back(i);
    }
    image->width = static_cast<std::uint32_t>(width);
    image->height = static_cast<std::uint32_t>(height);
    image->is_dense = false;
  }

  double radius;
  float leaf;
  std::size_t width, height;
  Points::Ptr surface{new Points};
  Points::Ptr keypoints{new Points};
  Points::Ptr image{new Points};
  std::vector<std::size_t> valid;  // of the image: those of the surface, in its order
  Tree::Ptr sorted_tree, unsorted_tree;
  Normals::Ptr normals, fast_normals;
  pcl::PointCloud<pcl::ReferenceFrame>::Ptr frames;

  /// Centroids, colors too. What is described are nevertheless the key points of all, that ratios are of equal work.
  void sample() const {
    pcl::VoxelGrid<Point> grid;
    grid.setInputCloud(surface);
    grid.setLeafSize(leaf, leaf, leaf);
    Points sampled;
    grid.filter(sampled);
  }

  void build(Tree::Ptr& tree, bool sorted) const {
    tree.reset();
    tree.reset(new Tree(sorted));
    tree->setInputCloud(surface);
  }

  void estimate_normals() {
    normals.reset(new Normals);
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
    Normals estimated;
    estimation.compute(estimated);
  }

  /// With the method and the parameters of PCL's tutorial.
  void estimate_fast_normals_of_image(Normals& estimated) const {
    pcl::IntegralImageNormalEstimation<Point, pcl::Normal> estimation;
    estimation.setNormalEstimationMethod(estimation.AVERAGE_3D_GRADIENT);
    estimation.setMaxDepthChangeFactor(0.02f);
    estimation.setNormalSmoothingSize(10.0f);
    estimation.setInputCloud(image);
    estimation.compute(estimated);
  }

  void estimate_fast_normals() {
    Normals estimated;
    estimate_fast_normals_of_image(estimated);
    fast_normals.reset(new Normals);
    fast_normals->reserve(valid.size());
    for (const std::size_t i : valid) fast_normals->push_back(estimated[i]);
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
  void prepare(Estimation& estimation, const Tree::Ptr& tree, const Normals::Ptr& its_normals) const {
    estimation.setInputCloud(keypoints);
    estimation.setSearchSurface(surface);
    estimation.setInputNormals(its_normals);
    estimation.setSearchMethod(tree);
    estimation.setRadiusSearch(radius);
  }
};

/// Descriptors that stay until the next ones, so that the memory is not handed back while it is counted.
template <class Estimation, class Signature>
struct Output {
  pcl::PointCloud<Signature> rows;

  void compute_as_called(const State& state, const Normals::Ptr& normals) {
    Estimation estimation;
    state.prepare(estimation, state.sorted_tree, normals);
    estimation.compute(rows);
  }
  void compute_kindly(const State& state) {
    Estimation estimation;
    state.prepare(estimation, state.unsorted_tree, state.normals);
    if constexpr (!std::is_same<Signature, pcl::FPFHSignature33>::value)
      estimation.setInputReferenceFrames(state.frames);
    estimation.compute(rows);
  }
};

struct Steps {
  std::size_t sample, sorted_tree, unsorted_tree, normals, frames;
  std::optional<std::size_t> fast_normals;  // of an image
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
              const std::string& descriptor, std::vector<std::string> against) {
  const auto output = std::make_shared<Output<Estimation, Signature>>();
  add_contender<Signature>(suite, *state, name, descriptor, against, {steps.sample, steps.sorted_tree, steps.normals},
                           [=] { output->compute_as_called(*state, state->normals); });
  add_contender<Signature>(suite, *state, name + ", frames given", descriptor, against,
                           {steps.sample, steps.unsorted_tree, steps.normals, steps.frames},
                           [=] { output->compute_kindly(*state); });
  if (steps.fast_normals) {
    against.push_back(descriptor + with_fast_normals);
    add_contender<Signature>(suite, *state, name + with_fast_normals, descriptor, against,
                             {steps.sample, steps.sorted_tree, *steps.fast_normals},
                             [=] { output->compute_as_called(*state, state->fast_normals); });
  }
  suite.release = [release_others = suite.release, output] {
    release_others();
    output->rows = {};
  };
}

/// Those that more than one contender needs.
Steps add_steps(Suite& suite, const std::shared_ptr<State>& state) {
  Steps steps{};
  steps.sample = suite.add("VoxelGrid", [=] { state->sample(); });
  steps.sorted_tree = suite.add("tree", [=] { state->build(state->sorted_tree, true); });
  steps.unsorted_tree = suite.add("unsorted tree", [=] { state->build(state->unsorted_tree, false); });
  steps.normals = suite.add("normals", [=] { state->estimate_normals(); });
  steps.frames = suite.add("frames", [=] { state->estimate_frames(); });
  return steps;
}

/// Key points and normals by themselves. Integral images need an image.
void add_makers(Suite& suite, const std::shared_ptr<State>& state, Steps& steps, std::size_t sampled) {
  const std::size_t pixels = state->image->size();
  Contender voxels{"PCL VoxelGrid", key_points_made, {}, "voxels"};
  voxels.against = {key_points_made};
  suite.add_maker(voxels, steps.sample, sampled, sizeof(Point));
  Contender exact{"PCL NormalEstimation", normals_made, {}, "FLANN"};
  exact.against = {normals_made};
  suite.add_maker(exact, suite.add(normals_made, [=] { state->estimate_normals_of_image(); }), pixels,
                  sizeof(pcl::Normal));
  if (state->height < 2) {
    std::printf("PCL's IntegralImageNormalEstimation is left out: the cloud is no image\n");
    return;
  }
  const std::size_t of_image = suite.add(fast_normals_made, [=] {
    Normals estimated;
    state->estimate_fast_normals_of_image(estimated);
  });
  Contender fast{"PCL IntegralImageNormalEstimation", normals_made, {}, "image"};
  fast.against = {normals_made, fast_normals_made};
  suite.add_maker(fast, of_image, pixels, sizeof(pcl::Normal));
  steps.fast_normals = suite.add(std::string("normals") + with_fast_normals, [=] { state->estimate_fast_normals(); });
}

}  // namespace

Suite make_pcl_suite(const Task& task, bool with_fpfh) {
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);  // fast normals have gaps, and SHOT warns of each
  const auto state = std::make_shared<State>(task);
  Suite suite{"PCL"};
  suite.release = [=] {
    state->sorted_tree.reset();
    state->unsorted_tree.reset();
    state->normals.reset();
    state->fast_normals.reset();
    state->frames.reset();
  };
  Steps steps = add_steps(suite, state);
  add_makers(suite, state, steps, task.sampled.size());

  using Color = pcl::SHOTColorEstimation<Point, pcl::Normal, pcl::SHOT1344>;
  using Shape = pcl::SHOTEstimation<Point, pcl::Normal, pcl::SHOT352>;
  using Fpfh = pcl::FPFHEstimation<Point, pcl::Normal, pcl::FPFHSignature33>;
  add_shot<Color, pcl::SHOT1344>(suite, state, steps, "PCL SHOTColor", "CSHOT-1344",
                                 {"ShapeColor95", "ShapeColor32", "SCSH-336", "SCSH-696", "CSHOT-1344"});
  add_shot<Shape, pcl::SHOT352>(suite, state, steps, "PCL SHOT", "SHOT-352", {"HeightShape96", "SSH-32", "SHOT-352"});
  if (!with_fpfh) return suite;
  const auto output = std::make_shared<Output<Fpfh, pcl::FPFHSignature33>>();
  add_contender<pcl::FPFHSignature33>(suite, *state, "PCL FPFH", "FPFH-33", {"SSH-32"},
                                      {steps.sample, steps.unsorted_tree, steps.normals},
                                      [=] { output->compute_kindly(*state); });
  return suite;
}

}  // namespace shortshot_bench::peers
