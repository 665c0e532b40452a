// The README's lines for users of PCL, before and after, in one program: both describe the key points of a bent sheet.
#include <pcl/features/normal_3d.h>
#include <pcl/features/shot.h>
#include <pcl/filters/uniform_sampling.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "shortshot/shortshot.hpp"

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZRGB>;

Cloud::Ptr sheet() {
  const Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 100 * 100; ++i) {
    const float x = 0.004f * static_cast<float>(i % 100), y = 0.004f * static_cast<float>(i / 100);
    pcl::PointXYZRGB p;
    p.x = x, p.y = y, p.z = 1 + 3 * x * y * (0.3f - x);
    p.r = static_cast<std::uint8_t>(500 * x), p.g = static_cast<std::uint8_t>(600 * y), p.b = 90;
    cloud->push_back(p);
  }
  return cloud;
}

std::size_t described_before(const Cloud::Ptr& cloud) {
  const Cloud::Ptr keypoints(new Cloud);
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  const pcl::PointCloud<pcl::SHOT1344>::Ptr rows(new pcl::PointCloud<pcl::SHOT1344>);
#include "from_pcl.before"
  return static_cast<std::size_t>(std::count_if(
      rows->begin(), rows->end(), [](const pcl::SHOT1344& row) { return std::isfinite(row.descriptor[0]); }));
}

std::size_t described_after(const Cloud::Ptr& cloud) {
#include "from_pcl.after"
  if (status != shortshot::Status::ok) return 0;
  return static_cast<std::size_t>(std::count(rows.status.begin(), rows.status.end(), shortshot::Status::ok));
}

}  // namespace

int main() {
  const std::size_t before = described_before(sheet()), after = described_after(sheet());
  std::printf("described before: %zu, after: %zu\n", before, after);
  return before > 300 && after > 300 && after * 10 > before * 9 && before * 10 > after * 9 ? 0 : 1;
}
