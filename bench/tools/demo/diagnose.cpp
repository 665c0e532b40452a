#include "tools/demo/diagnose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>

#include "tools/demo/run.hpp"
#include "tools/demo/slow_stage.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench {
namespace {

using shortshot::CloudView;
using shortshot::Diagnosis;
using shortshot::Status;

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  std::array<char, 400> line{};
  va_list values;
  va_start(values, format);
  std::vsnprintf(line.data(), line.size(), format, values);
  va_end(values);
  return line.data();
}

double percent(float share) { return 100.0 * static_cast<double>(share); }

/// Two digits: nobody wants to type more.
double rounded(double length) {
  if (!(length > 0.0)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  return std::round(length / unit) * unit;
}

/// A radius of 20 spacings holds a thousand points of a surface, as one of 4 cm does of what a depth camera sees a
/// meter away.
double fitting_radius(const Diagnosis& d) { return rounded(20.0 * static_cast<double>(d.spacing)); }

float largest_extent(const Diagnosis& d) {
  return std::max({d.high.x - d.low.x, d.high.y - d.low.y, d.high.z - d.low.z});
}

float largest_coordinate(const Diagnosis& d) {
  float largest = 0.0f;
  for (const shortshot::Point& p : {d.low, d.high}) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  return largest;
}

/// Depth cameras and scanners of rooms: a tenth of a millimeter to centimeters between points, 5 cm to 50 m in all.
bool looks_like_millimeters(const Diagnosis& d, float radius) {
  const float extent = largest_extent(d);
  return d.spacing >= 0.1f && d.spacing <= 50.0f && extent >= 50.0f && extent <= 50000.0f && radius < d.spacing;
}

void say_of_radius(const Diagnosis& d, const DemoOptions& options, std::vector<std::string>& advice) {
  const auto radius = static_cast<double>(options.radius);
  if (d.few_neighbors > 0.5f && looks_like_millimeters(d, options.radius)) {
    advice.push_back(
        text("%.0f %% of the points have fewer than five neighbors within %g: the coordinates are most likely "
             "millimeters and the radius meters (--radius %g --leaf %g, or divide the coordinates by 1000)",
             percent(d.few_neighbors), radius, 1000.0 * radius, 1000.0 * static_cast<double>(options.leaf)));
  } else if (d.few_neighbors > 0.5f) {
    advice.push_back(
        text("%.0f %% of the points have fewer than five neighbors within %g: the radius is too small for "
             "points that lie %.2g apart",
             percent(d.few_neighbors), radius, static_cast<double>(d.spacing)));
  } else if (d.few_neighbors > 0.1f) {
    advice.push_back(
        text("%.0f %% of the points have fewer than five neighbors within %g: stray points, or parts of the "
             "cloud that are too sparse for the radius",
             percent(d.few_neighbors), radius));
  } else if (d.spacing > 0.0f && options.radius < 5.0f * d.spacing) {
    advice.push_back(
        text("points lie %.2g apart, and %.0f of them within %g say little of a shape: take a larger radius",
             static_cast<double>(d.spacing), static_cast<double>(d.neighbors), radius));
  }
  if (d.neighbors > 20000.0f) {
    advice.push_back(
        text("%.0f neighbors within %g are more than a descriptor needs: it takes long and tells little of "
             "a place; take a smaller radius or fewer points",
             static_cast<double>(d.neighbors), radius));
  }
  if (d.sampled > 0 && d.few_neighbors <= 0.5f && d.no_frame > 0.5f) {
    advice.push_back(
        text("%.0f %% of the points have no local frame: what surrounds them is a line, a sphere or a "
             "plane without texture of shape",
             percent(d.no_frame)));
  }
}

/// Are the coordinates so large that extract() refuses them? Nothing else can be said then.
bool is_refused(const Diagnosis& d, const DemoOptions& options) { return d.float_step > options.radius / 64.0f; }

void say_of_coordinates(const Diagnosis& d, const DemoOptions& options, std::vector<std::string>& advice) {
  const auto extent = static_cast<double>(largest_extent(d));
  const bool absurd = extent > 1e6 * static_cast<double>(options.radius);
  if (absurd) {
    advice.push_back(text("the extent is %.2g, %.2g times the radius: stray points, or numbers that are no coordinates",
                          extent, extent / static_cast<double>(options.radius)));
  } else if (is_refused(d, options) || (d.float_step > options.radius * 0.001f && d.few_neighbors <= 0.5f)) {
    advice.push_back(
        text("coordinates reach %.3g, where floats lie %.2g apart: %s. Subtract an origin near the cloud "
             "before they become floats",
             static_cast<double>(largest_coordinate(d)), static_cast<double>(d.float_step),
             is_refused(d, options) ? "the shape within the radius is lost, and refused"
                                    : "this blurs the shape within the radius"));
  }
  if (d.at_origin > 0.001f) {
    advice.push_back(
        text("%.3g %% of the points are (0, 0, 0): most likely no measurements. Leave them out, or make them "
             "NaN",
             percent(d.at_origin)));
  }
  if (d.not_finite > 0.99f) advice.push_back(text("%.1f %% of the points are NaN or infinite", percent(d.not_finite)));
  if (d.doubles > 0.01f && !is_refused(d, options)) {
    advice.push_back(
        text("%.0f %% of the points lie exactly on another one, and count twice: were two copies of a cloud "
             "put together?",
             percent(d.doubles)));
  }
}

void say_of_lengths(const Diagnosis& d, const DemoOptions& options, std::vector<std::string>& advice) {
  const bool needs_normals = options.descriptor.find("shot") != std::string::npos;
  if (needs_normals && normal_radius(options) < 2.0f * d.spacing) {
    advice.push_back(text("normals within %g are those of a few points, which lie %.2g apart: --normal-radius %g",
                          static_cast<double>(normal_radius(options)), static_cast<double>(d.spacing),
                          rounded(5.0 * static_cast<double>(d.spacing))));
  }
  if (options.leaf < 0.5f * d.spacing) {
    advice.push_back(text("voxels of %g are smaller than what lies between points, %.2g: every point is a key point",
                          static_cast<double>(options.leaf), static_cast<double>(d.spacing)));
  }
}

/// The even or the odd points of a cloud.
std::vector<float> half_of(const CloudView& cloud, std::size_t first) {
  std::vector<float> xyz;
  for (std::size_t i = first; i < cloud.size; i += 2) {
    const shortshot::Point p = shortshot::point(cloud, i);
    xyz.insert(xyz.end(), {p.x, p.y, p.z});
  }
  return xyz;
}

/// Axes less than 20 degrees apart.
bool agree(const shortshot::Frame& a, const shortshot::Frame& b) {
  const auto cosine = [](const float(&u)[3], const float(&v)[3]) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  return cosine(a.x, b.x) > 0.94f && cosine(a.y, b.y) > 0.94f && cosine(a.z, b.z) > 0.94f;
}

void print_numbers(const Diagnosis& d, const CloudView& cloud, const DemoOptions& options) {
  const auto line = [](const char* name, const std::string& value) {
    std::printf("  %-19s %s\n", name, value.c_str());
  };
  const auto from_to = [](float low, float high) {
    return text("%.4g to %.4g", static_cast<double>(low), static_cast<double>(high));
  };
  line("points",
       text("%zu: %.3g %% not finite, %.3g %% at (0, 0, 0)", cloud.size, percent(d.not_finite), percent(d.at_origin)));
  line("extent",
       "x " + from_to(d.low.x, d.high.x) + ", y " + from_to(d.low.y, d.high.y) + ", z " + from_to(d.low.z, d.high.z));
  line("float step", text("%.2g: what the coordinates cannot tell apart", static_cast<double>(d.float_step)));
  line("spacing",
       text("%.3g from a point to the nearest one (median of %zu points)", static_cast<double>(d.spacing), d.sampled));
  line("neighbors",
       text("%.0f within %g (median); fewer than five at %.3g %% of the points", static_cast<double>(d.neighbors),
            static_cast<double>(options.radius), percent(d.few_neighbors)));
  line("frames", text("none at %.3g %% of the points, confidence of the others %.2f (median, 0 to 1)",
                      percent(d.no_frame), static_cast<double>(d.frame_confidence)));
  if (shortshot::has_normals(cloud)) {
    line("normals", text("none at %.3g %% of the points, length not 1 at %.3g %% of the others", percent(d.no_normal),
                         percent(d.other_length)));
  }
  line("colors", !shortshot::has_colors(cloud) ? "none" : d.one_color ? "one color at all points" : "several");
}

/// How far frames can be repeated, and where they can better.
void print_frames(const CloudView& cloud, const DemoOptions& options, const shortshot::Viewpoint& viewpoint) {
  std::string agreements;
  float at_radius = -1.0f;
  for (const float factor : {0.5f, 1.0f, 2.0f, 4.0f}) {
    const float radius = factor * options.radius;
    const float share = frame_agreement(cloud, radius, options.leaf, viewpoint);
    if (share < 0.0f) continue;
    if (factor == 1.0f) at_radius = share;
    agreements +=
        text("%s%.0f %% within %g", agreements.empty() ? "" : ", ", percent(share), static_cast<double>(radius));
  }
  if (agreements.empty()) agreements = "there are none to compare";
  std::printf("  %-19s %s\n", "frames repeat", agreements.c_str());
  std::printf("  %-19s %s\n", "", "(from the even and the odd points alone: axes less than 20 degrees apart)");
  if (at_radius >= 0.0f && at_radius < 0.5f) {
    std::printf("  %-19s %s\n", "hint",
                "most frames would turn from view to view: a larger Support::frame_radius, or a viewpoint "
                "(--towards-camera), makes them surer");
  }
}

}  // namespace

std::vector<std::string> advice_on(const Diagnosis& d, const CloudView& cloud, const DemoOptions& options) {
  std::vector<std::string> advice;
  if (d.status != Status::ok) {
    advice.emplace_back(shortshot::message(d.status));
    return advice;
  }
  say_of_coordinates(d, options, advice);
  if (!is_refused(d, options)) {
    say_of_radius(d, options, advice);
    if (d.few_neighbors <= 0.5f) say_of_lengths(d, options, advice);
  }
  if (d.one_color) {
    advice.emplace_back("all points have the same color: descriptors of colors see nothing (--descriptor ssh96)");
  }
  if (shortshot::has_normals(cloud) && d.other_length > 0.01f) {
    advice.push_back(
        text("%.0f %% of the normals are not of length 1: divide them by their length", percent(d.other_length)));
  }
  if (d.off_surface > 0) {
    advice.push_back(
        text("%zu key points are not on the surface: are they in the cloud's unit and coordinates?", d.off_surface));
  }
  return advice;
}

std::string fitting_options(const Diagnosis& d) {
  const double radius = fitting_radius(d);
  if (!(radius > 0.0) || d.spacing < 8.0f * d.float_step) return {};
  return text("--radius %g --leaf %g --normal-radius %g", radius, rounded(0.5 * radius), rounded(0.25 * radius));
}

float frame_agreement(const CloudView& cloud, float radius, float leaf, const shortshot::Viewpoint& viewpoint) {
  std::vector<shortshot::KeyPoint> centroids;
  if (shortshot::sample_centroids(cloud, leaf, centroids) != Status::ok) return -1.0f;
  constexpr std::size_t most = 200;
  std::vector<shortshot::KeyPoint> keypoints;
  for (std::size_t k = 0; k < std::min(most, centroids.size()); ++k) {
    keypoints.push_back(centroids[k * centroids.size() / std::min(most, centroids.size())]);
  }
  shortshot::Support support = radius;
  support.viewpoint = viewpoint;
  shortshot::Features<shortshot::Ssh32> halves[2];
  for (std::size_t first = 0; first < 2; ++first) {
    const std::vector<float> xyz = half_of(cloud, first);
    const CloudView half = shortshot::view_xyz(xyz.data(), xyz.size() / 3);
    const shortshot::GridSearch search(half, radius);
    if (shortshot::extract(half, search, keypoints, support, halves[first]) != Status::ok) return -1.0f;
  }
  std::size_t both = 0;
  std::size_t alike = 0;
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    if (halves[0].status[k] != Status::ok || halves[1].status[k] != Status::ok) continue;
    ++both;
    alike += agree(halves[0].frames[k], halves[1].frames[k]) ? 1 : 0;
  }
  return both == 0 ? -1.0f : static_cast<float>(alike) / static_cast<float>(both);
}

bool print_diagnosis(const RgbdCloud& cloud, const DemoOptions& options) {
  const SlowStage stage("looking at " + std::to_string(cloud.size()) + " points");
  const CloudView view = view_of_cloud(cloud);
  shortshot::Support support = options.radius;
  if (options.towards_camera) support.viewpoint = camera_of_cloud(cloud);
  const shortshot::GridSearch search(view, options.radius);
  const Diagnosis diagnosis = shortshot::diagnose(view, search, support);
  const std::vector<std::string> advice = advice_on(diagnosis, view, options);
  if (diagnosis.status == Status::ok) {
    print_numbers(diagnosis, view, options);
    print_frames(view, options, support.viewpoint);
    const std::string fitting = fitting_options(diagnosis);
    if (!fitting.empty()) std::printf("  %-19s %s\n", "fits the spacing", fitting.c_str());
  }
  for (const std::string& sentence : advice) std::printf("  %-19s %s\n", "WRONG", sentence.c_str());
  if (advice.empty()) std::printf("  %-19s %s\n", "nothing is wrong", "with these points and this radius");
  return advice.empty();
}

}  // namespace shortshot_bench
