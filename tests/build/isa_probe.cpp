// PROBE is the function's name, which says what flags this is compiled with.
#include "isa_probe.hpp"

namespace {

constexpr std::size_t width = 40;
constexpr std::size_t count = width * width;

}  // namespace

IsaProbe PROBE() {
  static float xyz[3 * count];
  static unsigned char rgb[3 * count];
  static shortshot::Workspace<count> workspace;
  for (std::size_t i = 0; i < count; ++i) {  // a saddle with a gradient of colours
    const float x = 0.002f * (static_cast<float>(i % width) - 17.3f);
    const float y = 0.002f * (static_cast<float>(i / width) - 21.1f);
    xyz[3 * i] = x;
    xyz[3 * i + 1] = y;
    xyz[3 * i + 2] = 4.0f * x * x - 7.0f * x * y + 0.2f * y;
    rgb[3 * i] = static_cast<unsigned char>(i * 7 % 256);
    rgb[3 * i + 1] = static_cast<unsigned char>(i % 256);
    rgb[3 * i + 2] = static_cast<unsigned char>(i / 16);
  }
  const shortshot::CloudView cloud = shortshot::view_xyz_rgb(xyz, rgb, count);
  IsaProbe probe{};
  probe.status = shortshot::describe_at<shortshot::Scsh336>(cloud, shortshot::BruteSearch{cloud}, width * width / 2,
                                                            0.03f, workspace, probe.descriptor);
  probe.message = shortshot::message(probe.status);
  return probe;
}
