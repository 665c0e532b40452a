// Prints the tables of tests/bench/bun0_facts.hpp, computed by PCL, and says whether they are those that stand there.
// Reads the golden folder of that name. Exit code 1 if a number differs, 2 if the folder cannot be used.
#include <pcl/features/normal_3d.h>
#include <pcl/features/shot.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iterator>
#include <vector>

#include "bench/bun0_facts.hpp"
#include "shortshot/cloud/read.hpp"
#include "tools/golden/case.hpp"

namespace {

using Points = pcl::PointCloud<pcl::PointXYZRGB>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Tree = pcl::search::KdTree<pcl::PointXYZRGB>;
using Shot = pcl::SHOTEstimation<pcl::PointXYZRGB, pcl::Normal, pcl::SHOT352>;
using ColorShot = pcl::SHOTColorEstimation<pcl::PointXYZRGB, pcl::Normal, pcl::SHOT1344>;

struct Cloud {
  Points::Ptr points{new Points};
  Normals::Ptr normals{new Normals};
};

Cloud make_cloud(const shortshot::CloudView& view, const bun0::Setting& setting) {
  Cloud cloud;
  for (std::size_t i = 0; i < setting.points; ++i) {
    const shortshot::Point p = shortshot::point(view, i);
    const shortshot::Rgb c = bun0::color_at(i);
    cloud.points->push_back(pcl::PointXYZRGB(p.x, p.y, p.z, c.r, c.g, c.b));
  }
  cloud.points->is_dense = false;
  pcl::NormalEstimation<pcl::PointXYZRGB, pcl::Normal> estimation;
  estimation.setInputCloud(cloud.points);
  estimation.setSearchMethod(Tree::Ptr(new Tree));
  estimation.setRadiusSearch(setting.normal_radius);
  estimation.compute(*cloud.normals);
  return cloud;
}

template <class Estimation, class Signature>
pcl::PointCloud<Signature> describe(const Cloud& cloud, const std::vector<std::size_t>& keypoints, double radius) {
  Estimation estimation;
  estimation.setInputCloud(cloud.points);
  estimation.setIndices(pcl::IndicesPtr(new pcl::Indices(keypoints.begin(), keypoints.end())));
  estimation.setInputNormals(cloud.normals);
  estimation.setSearchMethod(Tree::Ptr(new Tree));
  estimation.setRadiusSearch(radius);
  pcl::PointCloud<Signature> rows;
  estimation.compute(rows);
  return rows;
}

/// The entries of one row that are written down: the first one that is zero, six from the first to the last one that is
/// not, and those that PCL's tests look at.
template <std::size_t Size>
std::vector<std::size_t> entries_of(const float (&row)[Size], const std::vector<std::size_t>& more) {
  std::vector<std::size_t> zero, other;
  for (std::size_t i = 0; i < Size; ++i) (row[i] == 0.0f ? zero : other).push_back(i);
  std::vector<std::size_t> entries{zero.at(0)};
  for (std::size_t k = 0; k < 6; ++k) entries.push_back(other.at(k * (other.size() - 1) / 5));
  entries.insert(entries.end(), more.begin(), more.end());
  return entries;
}

/// Prints a table; true if it is `committed`.
template <class Estimation, class Signature>
bool record(const char* name, const Cloud& cloud, const bun0::Setting& setting,
            const std::vector<bun0::Fact>& committed) {
  const auto rows = describe<Estimation, Signature>(cloud, setting.keypoints, setting.radius);
  std::vector<bun0::Fact> facts;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::size_t keypoint = setting.keypoints[row];
    const auto& values = rows[row].descriptor;
    const bool of_pcl = keypoint == bun0::pcl_keypoint && &setting == &bun0::pcl_setting;
    for (const std::size_t entry : entries_of(values, of_pcl ? bun0::pcl_entries : std::vector<std::size_t>{})) {
      facts.push_back({keypoint, entry, values[entry]});
    }
  }
  std::printf("inline const std::vector<Fact> %s{\n", name);
  for (const bun0::Fact& f : facts) {
    std::printf("{%zu, %zu, %#.9gf}, ", f.keypoint, f.entry, static_cast<double>(f.value));
  }
  std::printf("};\n");
  for (const auto& lonely : describe<Estimation, Signature>(cloud, setting.lonely, setting.radius)) {
    if (!std::isnan(lonely.descriptor[0])) return false;
  }
  const auto same = [](const bun0::Fact& a, const bun0::Fact& b) {
    return a.keypoint == b.keypoint && a.entry == b.entry && std::abs(a.value - b.value) <= 1e-6f;
  };
  return std::equal(facts.begin(), facts.end(), committed.begin(), committed.end(), same);
}

bool record_all(const char* folder) {
  const shortshot_bench::golden::Case golden_case = shortshot_bench::golden::read_case(folder);
  const Cloud golden = make_cloud(golden_case.cloud(), bun0::golden_setting);
  const Cloud pcl = make_cloud(golden_case.cloud(), bun0::pcl_setting);
  bool same = record<Shot, pcl::SHOT352>("golden_shot352", golden, bun0::golden_setting, bun0::golden_shot352);
  same &= record<ColorShot, pcl::SHOT1344>("golden_cshot1344", golden, bun0::golden_setting, bun0::golden_cshot1344);
  same &= record<Shot, pcl::SHOT352>("pcl_shot352", pcl, bun0::pcl_setting, bun0::pcl_shot352);
  same &= record<ColorShot, pcl::SHOT1344>("pcl_cshot1344", pcl, bun0::pcl_setting, bun0::pcl_cshot1344);
  return same;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: record_bun0_facts FOLDER\n");
    return 2;
  }
  try {
    if (record_all(argv[1])) return 0;
    std::fprintf(stderr, "these are not the numbers in tests/bench/bun0_facts.hpp\n");
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
