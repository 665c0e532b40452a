#include "tools/picture/marks.hpp"

#include <cmath>

#include "tools/picture/viewing.hpp"

namespace shortshot_bench::picture {
namespace {

constexpr std::size_t most_dots = 800;
constexpr Color rim{0, 50, 15};
constexpr Color light_green{90, 240, 120};

}  // namespace

float unit_of(std::size_t width) { return std::max(0.5f, static_cast<float>(width) / 1600.0f); }

void draw_dots(Canvas& canvas, const Panel& panel, const std::vector<shortshot::Point>& points, float unit) {
  for (const shortshot::Point& p : thinned(points, most_dots)) {
    const Place at = panel.place_of(p);
    if (!panel.is_inside(at)) continue;
    canvas.disc(at, 1.7f * unit, white);
    canvas.disc(at, 1.1f * unit, black);
  }
}

void draw_mark(Canvas& canvas, const Place& at, float unit) {
  canvas.disc(at, 6.0f * unit, rim);
  canvas.disc(at, 4.4f * unit, light_green);
}

void draw_target(Canvas& canvas, const Place& at, float unit) {
  const float arm = 12.0f * unit;
  canvas.disc(at, 16.0f * unit, rim);
  canvas.disc(at, 13.0f * unit, white);
  canvas.line({at.x - arm, at.y}, {at.x + arm, at.y}, 4.0f * unit, rim);
  canvas.line({at.x, at.y - arm}, {at.x, at.y + arm}, 4.0f * unit, rim);
}

void draw_strong_line(Canvas& canvas, const Place& from, const Place& to, float unit) {
  canvas.line(from, to, 4.6f * unit, rim);
  canvas.line(from, to, 2.6f * unit, light_green);
}

Canvas draw_marked(const NamedCloud& cloud, const MarkedCloud& marked, std::size_t width) {
  const float unit = unit_of(width);
  const float text = std::max(10.0f, 22.0f * unit);
  const Box box{std::floor(text), std::floor(4.2f * text), static_cast<float>(width) - 2.0f * std::floor(text),
                std::floor(0.56f * static_cast<float>(width))};
  const float bottom = box.top + box.height;
  Canvas canvas(width, static_cast<std::size_t>(bottom + 2.0f * text));
  Panel panel(canvas, box, best_viewing(cloud.cloud), cloud.cloud);
  panel.draw(cloud.cloud, Paint::own);
  draw_dots(canvas, panel, marked.dots, unit);
  for (std::size_t i = 0; i < marked.marks.size(); ++i) {
    const Place at = panel.place_of(marked.marks[i]);
    if (!panel.is_inside(at)) continue;
    if (i < marked.targets.size()) draw_strong_line(canvas, at, panel.place_of(marked.targets[i]), 0.6f * unit);
    draw_mark(canvas, at, unit);
  }
  if (!marked.targets.empty()) draw_target(canvas, panel.place_of(marked.targets.front()), unit);
  panel.draw_scale(text);
  canvas.outline(box, unit, dark_gray);
  canvas.text_that_fits({box.left, 0.6f * text}, 1.25f * text, marked.title, black);
  canvas.text_that_fits({box.left, 2.7f * text}, text, cloud.name, black);
  canvas.text_that_fits({box.left, bottom + 0.6f * text}, text, marked.legend, black);
  return canvas;
}

}  // namespace shortshot_bench::picture
