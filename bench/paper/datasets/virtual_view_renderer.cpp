// Must be built with -ffp-contract=off and without -ffast-math: a fused multiply-add rounds once, not twice.
#include "paper/datasets/virtual_view_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace shortshot_bench::datasets {
namespace {

constexpr int image_width = 640;
constexpr int image_height = 480;
constexpr double focal_px = 525.0;
constexpr double center_u = 319.5;
constexpr double center_v = 239.5;
constexpr double disparity_scale = 575.0 * 0.075;  // the Kinect's focal length in infrared times its baseline, px m
constexpr double azimuth_step_deg = 30.0;

// --- The camera ---

struct Camera {
  Eigen::Vector3d position;
  Eigen::Matrix3d axes;  // its columns: right, down and forward, in the object's frame
};

Camera place_camera(const Eigen::Vector3d& center, const VirtualView& view, const VirtualViewOptions& options,
                    Random& random) {
  constexpr double radians = 3.14159265358979323846 / 180.0;
  const double distance = random.uniform(options.nearest_m, options.farthest_m);
  const double jitter_deg = random.uniform(-options.azimuth_jitter_deg, options.azimuth_jitter_deg);
  const double azimuth = radians * (azimuth_step_deg * view.azimuth_index + jitter_deg);
  const double elevation = radians * view.elevation_deg;
  const Eigen::Vector3d outward(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
  const Eigen::Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0.0);
  Camera camera;
  camera.position = center + distance * outward;
  camera.axes << right, right.cross(outward), -outward;
  return camera;
}

// The part of the image that can show what is in the box, in whole pixels.
Eigen::AlignedBox2i region_of(const Eigen::AlignedBox3d& box, const Camera& camera) {
  Eigen::AlignedBox2i region;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    const Eigen::Vector3d seen = camera.axes.transpose() * (corner - camera.position);
    const double u = center_u + focal_px * seen.x() / seen.z();
    const double v = center_v + focal_px * seen.y() / seen.z();
    region.extend(Eigen::Vector2d(std::floor(u), std::floor(v)).cast<int>());
    region.extend(Eigen::Vector2d(std::ceil(u), std::ceil(v)).cast<int>());
  }
  const Eigen::AlignedBox2i image(Eigen::Vector2i(0, 0), Eigen::Vector2i(image_width - 1, image_height - 1));
  return region.intersection(image);
}

struct Pixel {
  double u, v;
  Eigen::Vector3d ray;  // in the camera's frame, of depth 1
  RayHit hit;           // so that its distance is the depth
  double cos_incidence;
};

std::vector<Pixel> pixels_of(const MeshRayCaster& object, const Eigen::AlignedBox3d& box, const Camera& camera) {
  const Eigen::AlignedBox2i region = region_of(box, camera);
  std::vector<Pixel> pixels;
  for (int v = region.min().y(); v <= region.max().y(); ++v) {
    for (int u = region.min().x(); u <= region.max().x(); ++u) {
      const Eigen::Vector3d ray((u - center_u) / focal_px, (v - center_v) / focal_px, 1.0);
      const Eigen::Vector3d direction = camera.axes * ray;
      const std::optional<RayHit> hit = object.nearest_hit(camera.position, direction);
      if (!hit) continue;
      const double cos_incidence = std::fabs(hit->normal.dot(direction)) / direction.norm();
      pixels.push_back({static_cast<double>(u), static_cast<double>(v), ray, *hit, cos_incidence});
    }
  }
  return pixels;
}

// --- What hides some of the object ---

// The side of a straight line in the image on which `direction` . (u, v) is below `limit`.
struct HalfPlane {
  Vec3 direction;
  double limit;

  double offset(const Pixel& pixel) const { return direction.x * pixel.u + direction.y * pixel.v; }
  bool hides(const Pixel& pixel) const { return offset(pixel) < limit; }
};

// The half plane in a given direction that hides this share of the pixels.
HalfPlane half_plane(const Vec3& direction, double share, const std::vector<Pixel>& pixels) {
  HalfPlane result{direction, 0.0};
  if (pixels.empty()) return result;
  std::vector<double> offsets;
  for (const Pixel& pixel : pixels) offsets.push_back(result.offset(pixel));
  const auto hidden = static_cast<std::ptrdiff_t>(share * static_cast<double>(pixels.size()));
  std::nth_element(offsets.begin(), offsets.begin() + hidden, offsets.end());
  result.limit = offsets[static_cast<std::size_t>(hidden)];
  return result;
}

// --- The sensor ---

// The measured depth, 0 if there is none.
double measured_depth(const Pixel& pixel, const VirtualViewOptions& options, Random& random) {
  const double deviation = options.depth_noise_scale * random.normal();
  const bool is_dropped = random.uniform() < options.dropped_share;
  if (is_dropped || pixel.cos_incidence < options.least_cos_incidence) return 0.0;
  const double z = pixel.hit.distance;
  const double noisy = z + deviation * (0.0012 + 0.0019 * (z - 0.4) * (z - 0.4));
  if (!(noisy > 0.0) || options.disparity_step_px == 0.0) return std::max(0.0, noisy);
  const double step = disparity_scale / options.disparity_step_px;  // the depth at a disparity of one step
  const double steps = std::floor(step / noisy + 0.5);
  return steps >= 1.0 ? step / steps : 0.0;
}

using Channels = std::array<double, 3>;

std::array<std::uint8_t, 3> measured_color(const Eigen::Vector3d& color, const Channels& gains, double noise,
                                           Random& random) {
  std::array<std::uint8_t, 3> measured{};
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double value = gains[i] * color[static_cast<Eigen::Index>(i)] + noise * random.normal();
    measured[i] = static_cast<std::uint8_t>(std::min(255.0, std::max(0.0, std::floor(value + 0.5))));
  }
  return measured;
}

}  // namespace

Eigen::AlignedBox3d bounding_box(const TexturedMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  return box;
}

RgbdCloud render_view(const MeshRayCaster& object, const VirtualView& view, const VirtualViewOptions& options,
                      Random random) {
  const Eigen::AlignedBox3d box = bounding_box(object.mesh());
  const Camera camera = place_camera(box.center(), view, options, random);
  Channels gains{};
  for (double& gain : gains) gain = random.uniform(1.0 - options.gain_spread, 1.0 + options.gain_spread);
  const Vec3 hidden_side = random.horizontal_direction();
  const double hidden_share = random.uniform(0.0, options.largest_hidden_share);

  const std::vector<Pixel> pixels = pixels_of(object, box, camera);
  const HalfPlane cover = half_plane(hidden_side, view.is_training ? 0.0 : hidden_share, pixels);
  RgbdCloud cloud;
  for (const Pixel& pixel : pixels) {
    const double depth = measured_depth(pixel, options, random);
    const Eigen::Vector3d color = texture_color(object.mesh().texture, pixel.hit.uv);
    const std::array<std::uint8_t, 3> rgb = measured_color(color, gains, options.color_noise, random);
    if (!(depth > 0.0) || cover.hides(pixel)) continue;
    for (const double coordinate : {pixel.ray.x(), pixel.ray.y(), pixel.ray.z()})
      cloud.xyz.push_back(static_cast<float>(depth * coordinate));
    cloud.rgb.insert(cloud.rgb.end(), rgb.begin(), rgb.end());
  }
  cloud.width = cloud.size();
  cloud.height = 1;
  return cloud;
}

}  // namespace shortshot_bench::datasets
