#include "tools/match/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "tools/io/view_of_cloud.hpp"
#include "tools/picture/marks.hpp"
#include "tools/picture/panel.hpp"
#include "tools/picture/viewing.hpp"

namespace shortshot_bench {
namespace {

using namespace picture;

constexpr std::size_t pixels_a_line = 40;  // of the width, for each line of either kind
constexpr float side_degrees = 60.0f;

/// The parts of a picture: a title, two boxes with a line of text above each, and a line below.
struct Layout {
  float unit;  // of all strokes: a 1600th of the width
  float text;  // height of a line
  Box left, right;
  Place title, left_name, right_name, legend;
  std::size_t height;

  Layout(std::size_t width, float aspect) {
    unit = unit_of(width);
    text = std::max(10.0f, 22.0f * unit);
    const float gap = 1.0f * text;
    const float box_width = std::floor((static_cast<float>(width) - 3.0f * gap) / 2.0f);
    const float box_height = std::floor(box_width * aspect);
    const float top = std::floor(4.2f * text);
    left = {std::floor(gap), top, box_width, box_height};
    right = {std::floor(2.0f * gap + box_width), top, box_width, box_height};
    title = {gap, 0.6f * text};
    left_name = {left.left, 2.7f * text};
    right_name = {right.left, 2.7f * text};
    legend = {gap, top + box_height + 0.6f * text};
    height = static_cast<std::size_t>(top + box_height + 2.0f * text);
  }
};

std::vector<std::uint32_t> others_of(const MatchResult& result) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < result.rows.size(); ++i) {
    if (!result.is_found || !std::binary_search(result.inliers.begin(), result.inliers.end(), i)) others.push_back(i);
  }
  return others;
}

std::string name_of(const char* letter, const NamedCloud& cloud, std::size_t keypoints) {
  return std::string(letter) + ": " + cloud.name + ", " + std::to_string(keypoints) + " key points";
}

/// Both ends must be seen.
void draw_pair(Canvas& canvas, const Panel& of_a, const Panel& of_b, const MatchResult& result, std::uint32_t pair,
               bool is_inlier, float unit) {
  const Place from = of_a.place_of(result.in_a(pair));
  const Place to = of_b.place_of(result.in_b(pair));
  if (!of_a.is_inside(from) || !of_b.is_inside(to)) return;
  if (!is_inlier) return canvas.line(from, to, 1.0f * unit, dark_gray, 0.45f);
  draw_strong_line(canvas, from, to, unit);
  for (const Place& end : {from, to}) draw_mark(canvas, end, unit);
}

/// The points of a cloud in the box around another, which is a little larger than that.
RgbdCloud part_around(const RgbdCloud& cloud, const RgbdCloud& other) {
  const Extent extent = extent_of(other);
  RgbdCloud part;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float* const p = cloud.xyz.data() + 3 * i;
    const auto is_near = [&](std::size_t axis) {
      const float margin = 0.05f * (extent.high[axis] - extent.low[axis]);
      return p[axis] > extent.low[axis] - margin && p[axis] < extent.high[axis] + margin;
    };
    if (!is_near(0) || !is_near(1) || !is_near(2)) continue;
    part.xyz.insert(part.xyz.end(), p, p + 3);
    if (cloud.has_colors()) part.rgb.insert(part.rgb.end(), cloud.rgb.data() + 3 * i, cloud.rgb.data() + 3 * i + 3);
  }
  part.width = part.size();
  part.height = 1;
  return part;
}

}  // namespace

std::string verdict_of(const MatchResult& result) {
  char text[200];
  std::snprintf(text, sizeof text, "%s: %zu of %zu pairs agree, at %zu of %zu places (by chance: 10^%.0f such poses)",
                result.is_found ? "found" : "NOT FOUND", result.inliers.size(), result.rows.size(),
                result.chance.at.any, result.chance.at.places, result.chance.log10_expected);
  return text;
}

Canvas draw_matches(const NamedCloud& a, const NamedCloud& b, const MatchResult& result, std::size_t width) {
  const Layout layout(width, 0.78f);
  Canvas canvas(width, layout.height);
  Panel of_a(canvas, layout.left, best_viewing(a.cloud), a.cloud);
  Panel of_b(canvas, layout.right, best_viewing(b.cloud), b.cloud);
  of_a.draw(a.cloud, Paint::own);
  of_b.draw(b.cloud, Paint::own);
  draw_dots(canvas, of_a, result.a, layout.unit);
  draw_dots(canvas, of_b, result.b, layout.unit);
  const std::size_t most = width / pixels_a_line;
  const std::vector<std::uint32_t> others = others_of(result);
  for (const std::uint32_t i : thinned(others, most)) draw_pair(canvas, of_a, of_b, result, i, false, layout.unit);
  const std::vector<std::uint32_t> inliers = result.is_found ? result.inliers : std::vector<std::uint32_t>{};
  for (const std::uint32_t i : thinned(inliers, most)) draw_pair(canvas, of_a, of_b, result, i, true, layout.unit);
  of_a.draw_scale(layout.text);
  of_b.draw_scale(layout.text);
  canvas.outline(layout.left, layout.unit, dark_gray);
  canvas.outline(layout.right, layout.unit, dark_gray);
  canvas.text_that_fits(layout.title, 1.25f * layout.text, verdict_of(result), black);
  canvas.text_that_fits(layout.left_name, layout.text, name_of("A", a, result.a.size()), black);
  canvas.text_that_fits(layout.right_name, layout.text, name_of("B", b, result.b.size()), black);
  const auto some = [&](std::size_t all) {
    return (all > most ? std::to_string(most) + " of " : "") + std::to_string(all);
  };
  const std::string lines = result.is_found
                                ? "strong green lines: " + some(inliers.size()) +
                                      " pairs that agree; thin gray lines: " + some(others.size()) + " that do not"
                                : "thin gray lines: " + some(others.size()) + " pairs";
  canvas.text_that_fits(layout.legend, layout.text, lines + "; dots: some of the key points", black);
  return canvas;
}

Canvas draw_moved(const NamedCloud& a, const NamedCloud& b, const MatchResult& result, std::size_t width) {
  const Layout layout(width, 0.78f);
  Canvas canvas(width, layout.height);
  const RgbdCloud onto = moved(b.cloud, result.pose);
  const Viewing front = best_viewing(a.cloud);
  const Viewing side = from_the_side(front, middle_of(onto), side_degrees);
  const auto draw = [&](const Box& box, const Viewing& viewing, const RgbdCloud& of_a, const RgbdCloud& of_b,
                        const RgbdCloud& fits) {
    Panel panel(canvas, box, viewing, fits);
    panel.draw(of_a, Paint::orange);
    panel.draw(of_b, Paint::blue);
    panel.draw_scale(layout.text);
    canvas.outline(box, layout.unit, dark_gray);
  };
  draw(layout.left, front, a.cloud, onto, a.cloud);
  const RgbdCloud part_of_a = part_around(a.cloud, onto);  // what lies between it and the eye is left out
  const RgbdCloud part_of_b = part_around(onto, a.cloud);
  draw(layout.right, side, part_of_a, part_of_b, part_of_a.size() < part_of_b.size() ? part_of_a : part_of_b);
  char text[200];
  std::snprintf(text, sizeof text, "B moved onto A: turned by %.1f degrees; %.0f %% of B lies on A, %.2g off (RMS)",
                degrees_of(result.pose), 100.0 * static_cast<double>(result.fit.share),
                static_cast<double>(result.fit.deviation));
  canvas.text_that_fits(layout.title, 1.25f * layout.text, text, black);
  canvas.text_that_fits(layout.left_name, layout.text, "as A is seen", black);
  canvas.text_that_fits(layout.right_name, layout.text, "turned by 60 degrees: what both show", black);
  canvas.text_that_fits(layout.legend, layout.text, "light orange: A, " + a.name + "; dark blue: B, " + b.name, black);
  return canvas;
}

}  // namespace shortshot_bench
