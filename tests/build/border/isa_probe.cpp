// PROBE is the function's name, which says what flags this is compiled with.
#include "isa_probe.hpp"

#include <cstring>

namespace {

constexpr std::size_t width = 40;
constexpr std::size_t count = width * width;
constexpr std::size_t keypoint = count / 2;
constexpr float radius = 0.03f;

using shortshot::Status;
shortshot::Workspace<count> workspace;
shortshot::SurfaceNormal normals[count];

}  // namespace

IsaProbe PROBE() {
  static float xyz[3 * count];
  static unsigned char rgb[3 * count];
  for (std::size_t i = 0; i < count; ++i) {  // a saddle with a gradient of colors
    const float x = 0.002f * (static_cast<float>(i % width) - 17.3f);
    const float y = 0.002f * (static_cast<float>(i / width) - 21.1f);
    xyz[3 * i] = x;
    xyz[3 * i + 1] = y;
    xyz[3 * i + 2] = 4.0f * x * x - 7.0f * x * y + 0.2f * y;
    rgb[3 * i] = static_cast<unsigned char>(i * 7 % 256);
    rgb[3 * i + 1] = static_cast<unsigned char>(i % 256);
    rgb[3 * i + 2] = static_cast<unsigned char>(i / 16);
  }
  shortshot::CloudView cloud = shortshot::view_xyz_rgb(xyz, rgb, count);
  const shortshot::BruteSearch search{cloud};
  IsaProbe probe{};
  Status& status = probe.status;
  status = shortshot::describe_at<shortshot::Scsh336>(cloud, search, keypoint, radius, workspace, probe.scsh);
  for (std::size_t i = 0; i < count && status == Status::ok; ++i) {
    shortshot::Neighborhood n = shortshot::neighborhood_in(workspace);
    status = search.gather(shortshot::point(cloud, i), 0.2f * radius, n);
    if (status == Status::ok) status = shortshot::estimate_normal(n, 0.2f * radius, normals[i]);
  }
  cloud = shortshot::with_normals(cloud, normals);
  using Cshot = shortshot::Cshot1344;
  if (status == Status::ok) {
    status = shortshot::describe_at<Cshot>(cloud, search, keypoint, radius, workspace, probe.cshot);
  }
  shortshot::BinaryDescriptor<Cshot> bits;
  shortshot::binarize(probe.cshot, bits);
  std::memcpy(probe.bits, bits.bytes, sizeof bits.bytes);
  probe.message = shortshot::message(status);
  return probe;
}
