// A user's PCL clouds in, clouds of PCL's signatures out, next to PCL's own estimation in the same program.
#include <doctest/doctest.h>
#include <pcl/features/normal_3d.h>
#include <pcl/features/shot.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "bench/real_data.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace {

namespace ss = shortshot;
using shortshot_bench::RgbdCloud;

using Points = pcl::PointCloud<pcl::PointXYZRGB>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Tree = pcl::search::KdTree<pcl::PointXYZRGB>;
using PclShot = pcl::SHOTEstimation<pcl::PointXYZRGB, pcl::Normal, pcl::SHOT352>;
using PclColorShot = pcl::SHOTColorEstimation<pcl::PointXYZRGB, pcl::Normal, pcl::SHOT1344>;

/// What a user of PCL has.
struct Scene {
  Points::Ptr points{new Points};
  Normals::Ptr normals{new Normals};
  pcl::IndicesPtr keypoints{new pcl::Indices};
  float radius = 0.0f;
};

Scene make_scene(const RgbdCloud& cloud, float radius, float leaf) {
  Scene scene;
  scene.radius = radius;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float* p = &cloud.xyz[3 * i];
    const std::uint8_t* c = &cloud.rgb[3 * i];
    scene.points->push_back(pcl::PointXYZRGB(p[0], p[1], p[2], c[0], c[1], c[2]));
  }
  scene.points->is_dense = false;
  pcl::NormalEstimation<pcl::PointXYZRGB, pcl::Normal> estimation;
  estimation.setInputCloud(scene.points);
  estimation.setSearchMethod(Tree::Ptr(new Tree));
  estimation.setKSearch(10);
  estimation.compute(*scene.normals);
  std::vector<std::uint32_t> keypoints;
  REQUIRE(ss::sample_uniform(ss::view_of(*scene.points), leaf, keypoints) == ss::Status::ok);
  scene.keypoints->assign(keypoints.begin(), keypoints.end());
  return scene;
}

template <class Estimation, class Signature>
pcl::PointCloud<Signature> by_pcl(const Scene& scene) {
  Estimation estimation;
  estimation.setInputCloud(scene.points);
  estimation.setIndices(scene.keypoints);
  estimation.setInputNormals(scene.normals);
  estimation.setSearchMethod(Tree::Ptr(new Tree));
  estimation.setRadiusSearch(static_cast<double>(scene.radius));
  pcl::PointCloud<Signature> rows;
  estimation.compute(rows);
  return rows;
}

template <class D, class Signature>
pcl::PointCloud<Signature> by_shortshot(const Scene& scene, const ss::CloudView& cloud) {
  const ss::GridSearch search(cloud, scene.radius);
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud, search, *scene.keypoints, scene.radius, features) == ss::Status::ok);
  pcl::PointCloud<Signature> rows;
  ss::to_pcl(features, rows);
  return rows;
}

double distance(const float* a, const float* b, std::size_t count) {
  double squared = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    squared += d * d;
  }
  return std::sqrt(squared);
}

struct Agreement {
  std::size_t described = 0;        // key points that both describe
  std::size_t described_by_us = 0;  // by nobody else
  std::size_t described_by_pcl = 0;
  std::size_t same_frame = 0;  // of those described: within 0.1 degrees in each axis
  std::size_t alike = 0;       // of those: within an L2 distance of 1e-4
  double median = 0.0;         // distance of those
};

template <class Signature>
Agreement compare(const pcl::PointCloud<Signature>& theirs, const pcl::PointCloud<Signature>& ours) {
  constexpr double chord = 0.0017453;  // of 0.1 degrees
  Agreement result;
  std::vector<double> distances;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool by_pcl = !std::isnan(theirs[i].descriptor[0]);
    const bool by_us = !std::isnan(ours[i].descriptor[0]);
    result.described_by_pcl += by_pcl && !by_us ? 1 : 0;
    result.described_by_us += by_us && !by_pcl ? 1 : 0;
    if (!by_pcl || !by_us) continue;
    ++result.described;
    const auto same = [&](int axis) { return distance(theirs[i].rf + axis, ours[i].rf + axis, 3) <= chord; };
    if (!same(0) || !same(3) || !same(6)) continue;
    ++result.same_frame;
    distances.push_back(distance(theirs[i].descriptor, ours[i].descriptor, std::size(ours[i].descriptor)));
    result.alike += distances.back() <= 1e-4 ? 1 : 0;
  }
  std::sort(distances.begin(), distances.end());
  if (!distances.empty()) result.median = distances[distances.size() / 2];
  return result;
}

template <class Signature>
void check_same(const std::string& name, const pcl::PointCloud<Signature>& theirs,
                const pcl::PointCloud<Signature>& ours) {
  REQUIRE(ours.size() == theirs.size());
  CHECK(ours.width == theirs.width);
  CHECK(ours.height == theirs.height);
  const Agreement a = compare(theirs, ours);
  MESSAGE(name, ", ", std::size(ours[0].descriptor), " floats: of ", ours.size(), " key points both describe ",
          a.described, ", shortshot alone ", a.described_by_us, ", PCL alone ", a.described_by_pcl, "; ", a.same_frame,
          " in the same frame, ", a.alike, " of them alike, median distance ", a.median);
  CHECK(a.described > 300);
  CHECK(100 * (a.described_by_us + a.described_by_pcl) <= a.described);
  CHECK(100 * a.same_frame >= 98 * a.described);
  CHECK(100 * a.alike >= 99 * a.same_frame);
}

void check_scene(const std::string& name, const Scene& scene) {
  const ss::CloudView cloud = ss::view_of(*scene.points, *scene.normals);
  check_same(name, by_pcl<PclShot, pcl::SHOT352>(scene), by_shortshot<ss::PclShot352, pcl::SHOT352>(scene, cloud));
  check_same(name, by_pcl<PclColorShot, pcl::SHOT1344>(scene),
             by_shortshot<ss::PclCshot1344, pcl::SHOT1344>(scene, cloud));
}

Scene generated_scene() {
  shortshot_bench::TabletopOptions options;
  options.width = 320;
  options.height = 240;
  return make_scene(make_tabletop(options), 0.04f, 0.03f);
}

}  // namespace

TEST_CASE("pcl: a generated scene is described as PCL describes it") { check_scene("tabletop", generated_scene()); }

TEST_CASE("pcl: a generated scene's normals may be members of its points") {
  const Scene scene = generated_scene();
  pcl::PointCloud<pcl::PointXYZRGBNormal> points;
  for (std::size_t i = 0; i < scene.points->size(); ++i) {
    const pcl::PointXYZRGB& p = (*scene.points)[i];
    const pcl::Normal& n = (*scene.normals)[i];
    points.push_back(pcl::PointXYZRGBNormal(p.x, p.y, p.z, p.r, p.g, p.b, n.normal_x, n.normal_y, n.normal_z));
  }
  const auto rows = by_shortshot<ss::Cshot1344, pcl::SHOT1344>(scene, ss::view_of(points));
  const auto expected = by_shortshot<ss::Cshot1344, pcl::SHOT1344>(scene, ss::view_of(*scene.points, *scene.normals));
  REQUIRE(rows.size() > 300);
  REQUIRE(rows.is_dense);
  CHECK(std::memcmp(rows.points.data(), expected.points.data(), rows.size() * sizeof(pcl::SHOT1344)) == 0);
}

TEST_CASE("pcl: real clouds are described as PCL describes them") {
  struct RealCloud {
    const char* file;
    float radius, leaf;
  };
  for (const RealCloud& real :
       {RealCloud{"mosd_scenes/learn34.pcd", 0.04f, 0.03f}, RealCloud{"mosd_scenes/test60.pcd", 0.04f, 0.03f},
        RealCloud{"kinect_tombari/models_color/Doll018_0.ply", 0.03f, 0.005f}}) {
    const std::string path = real_data(std::string("data/") + real.file);
    if (path.empty()) return;
    check_scene(real.file, make_scene(shortshot_bench::read_cloud(path), real.radius, real.leaf));
  }
}
