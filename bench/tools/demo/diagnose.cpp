#include "tools/demo/diagnose.hpp"

#include <cstdio>
#include <string>
#include <vector>

#include "tools/demo/advice.hpp"
#include "tools/demo/run.hpp"
#include "tools/demo/slow_stage.hpp"
#include "tools/demo/text.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench {
namespace {

using shortshot::CloudView;
using shortshot::Diagnosis;
using shortshot::Status;

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
    const float share = shortshot::frame_agreement(cloud, radius, options.leaf, viewpoint);
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

shortshot::Support support_of(const RgbdCloud& cloud, const DemoOptions& options) {
  shortshot::Support support = options.radius;
  if (options.towards_camera) support.viewpoint = camera_of_cloud(cloud);
  return support;
}

}  // namespace

Diagnosis diagnosis_of(const RgbdCloud& cloud, const DemoOptions& options) {
  const SlowStage stage("looking at " + std::to_string(cloud.size()) + " points");
  const CloudView view = view_of_cloud(cloud);
  const shortshot::GridSearch search(view, options.radius);
  return shortshot::diagnose(view, search, support_of(cloud, options));
}

bool print_diagnosis(const RgbdCloud& cloud, const DemoOptions& options) {
  const CloudView view = view_of_cloud(cloud);
  const Diagnosis diagnosis = diagnosis_of(cloud, options);
  const std::vector<std::string> advice = advice_on(diagnosis, view, options);
  if (diagnosis.status == Status::ok) {
    print_numbers(diagnosis, view, options);
    print_frames(view, options, support_of(cloud, options).viewpoint);
    const std::string fitting = fitting_options(shortshot::suggest(view, camera_of_cloud(cloud)));
    if (!fitting.empty()) std::printf("  %-19s %s\n", "suggested", fitting.c_str());
  }
  for (const std::string& sentence : advice) std::printf("  %-19s %s\n", "WRONG", sentence.c_str());
  if (advice.empty()) std::printf("  %-19s %s\n", "nothing is wrong", "with these points and this radius");
  return advice.empty();
}

}  // namespace shortshot_bench
