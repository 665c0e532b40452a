#include "tools/demo/advice.hpp"

#include <algorithm>
#include <cmath>

#include "tools/demo/run.hpp"
#include "tools/demo/text.hpp"

namespace shortshot_bench {
namespace {

using shortshot::CloudView;
using shortshot::Diagnosis;
using shortshot::Status;

using shortshot::detail::in_two_digits;
using shortshot::detail::largest_extent;

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
  if (d.sampled > 0 && largest_extent(d) <= options.radius) {
    advice.push_back(text(
        "all of the cloud, %.2g large, is within the radius, %g: take a smaller one, or is the cloud's unit another?",
        static_cast<double>(largest_extent(d)), radius));
  } else if (d.few_neighbors > 0.5f && looks_like_millimeters(d, options.radius)) {
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
                          static_cast<double>(in_two_digits(5.0f * d.spacing))));
  }
  if (options.leaf < 0.5f * d.spacing) {
    advice.push_back(text("voxels of %g are smaller than what lies between points, %.2g: every point is a key point",
                          static_cast<double>(options.leaf), static_cast<double>(d.spacing)));
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

std::string fitting_options(const shortshot::Suggestion& suggested) {
  if (suggested.status != Status::ok) return {};
  return text("--radius %g --leaf %g --normal-radius %g", static_cast<double>(suggested.radius),
              static_cast<double>(suggested.leaf), static_cast<double>(suggested.normal_radius));
}

}  // namespace shortshot_bench
