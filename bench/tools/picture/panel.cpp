#include "tools/picture/panel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "shortshot/cloud/read.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench::picture {
namespace {

using shortshot::Point;

std::vector<Projected> projections(const RgbdCloud& cloud, const Viewing& viewing) {
  std::vector<Projected> all;  // one for each point; a depth of NaN where there is none
  const shortshot::CloudView view = view_of_cloud(cloud);
  all.reserve(view.size);
  for (std::size_t i = 0; i < view.size; ++i) {
    Projected p = viewing.project(shortshot::point(view, i));
    const bool is_seen = std::isfinite(p.u) && std::isfinite(p.v) && (!viewing.is_perspective || p.depth > 0.0f);
    if (!is_seen) p.depth = std::numeric_limits<float>::quiet_NaN();
    all.push_back(p);
  }
  return all;
}

/// Of the points that are seen, at a share of their order.
float quantile(const std::vector<Projected>& points, float Projected::*coordinate, float share) {
  std::vector<float> values;
  for (const Projected& p : points) {
    if (!std::isnan(p.depth)) values.push_back(p.*coordinate);
  }
  if (values.empty()) return 0.0f;
  const auto at = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<float>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

Color scaled(const Color& tint, float brightness) {
  const auto channel = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::min(255.0f, static_cast<float>(c) * brightness));
  };
  return {channel(tint.r), channel(tint.g), channel(tint.b)};
}

/// `lightness` is 0 to 1.
Color painted(Paint paint, float lightness) {
  if (paint == Paint::orange) return scaled({255, 176, 70}, 0.65f + 0.35f * lightness);
  if (paint == Paint::blue) return scaled({40, 90, 190}, 0.35f + 0.65f * lightness);
  return scaled({215, 215, 215}, 0.25f + 0.75f * lightness);
}

std::string length_text(float length) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", static_cast<double>(length));
  return text;
}

}  // namespace

Panel::Panel(Canvas& canvas, const Box& box, const Viewing& viewing, const RgbdCloud& fits)
    : canvas_(canvas),
      box_(box),
      viewing_(viewing),
      columns_(static_cast<int>(Canvas::samples * box.width)),
      rows_(static_cast<int>(Canvas::samples * box.height)),
      depths_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
              std::numeric_limits<float>::infinity()) {
  const std::vector<Projected> points = projections(fits, viewing);
  const float left = quantile(points, &Projected::u, 0.01f);
  const float right = quantile(points, &Projected::u, 0.99f);
  const float top = quantile(points, &Projected::v, 0.01f);
  const float bottom = quantile(points, &Projected::v, 0.99f);
  middle_u_ = 0.5f * (left + right);
  middle_v_ = 0.5f * (top + bottom);
  median_depth_ = quantile(points, &Projected::depth, 0.5f);
  constexpr float margin = 0.94f;
  const float least = std::numeric_limits<float>::min();
  scale_ = margin * std::min(box.width / std::max(right - left, least), box.height / std::max(bottom - top, least));
}

Place Panel::place_of(const Point& p) const {
  const Projected at = viewing_.project(p);
  if (viewing_.is_perspective && !(at.depth > 0.0f)) return {-1.0f, -1.0f};  // outside of every box
  return {box_.left + 0.5f * box_.width + scale_ * (at.u - middle_u_),
          box_.top + 0.5f * box_.height + scale_ * (at.v - middle_v_)};
}

bool Panel::is_inside(const Place& place) const {
  return place.x >= box_.left && place.x < box_.left + box_.width && place.y >= box_.top &&
         place.y < box_.top + box_.height;
}

void Panel::splat(const Projected& at, int radius, const Color& color) {
  constexpr auto fine = static_cast<float>(Canvas::samples);
  const float x = fine * (0.5f * box_.width + scale_ * (at.u - middle_u_));
  const float y = fine * (0.5f * box_.height + scale_ * (at.v - middle_v_));
  if (!(x > -100.0f && y > -100.0f && x < static_cast<float>(columns_ + 100) && y < static_cast<float>(rows_ + 100))) {
    return;
  }
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  for (int j = std::max(0, row - radius); j <= std::min(rows_ - 1, row + radius); ++j) {
    for (int i = std::max(0, column - radius); i <= std::min(columns_ - 1, column + radius); ++i) {
      float& depth =
          depths_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i)];
      const int dx = i - column;
      const int dy = j - row;
      if (at.depth >= depth || dx * dx + dy * dy > radius * (radius + 1)) continue;
      depth = at.depth;
      canvas_.set_sample(static_cast<int>(fine * box_.left) + i, static_cast<int>(fine * box_.top) + j, color);
    }
  }
}

void Panel::draw(const RgbdCloud& cloud, Paint paint) {
  const std::vector<Projected> points = projections(cloud, viewing_);
  const auto seen = std::count_if(points.begin(), points.end(), [](const auto& p) { return !std::isnan(p.depth); });
  if (seen == 0) return;
  const float near = quantile(points, &Projected::depth, 0.02f);
  const float far = quantile(points, &Projected::depth, 0.98f);
  // What each of the points would have of the part of the box that they fill, were they spread evenly.
  const float width = quantile(points, &Projected::u, 0.98f) - quantile(points, &Projected::u, 0.02f);
  const float height = quantile(points, &Projected::v, 0.98f) - quantile(points, &Projected::v, 0.02f);
  const float spacing = scale_ * std::sqrt(width * height / static_cast<float>(seen));
  const int radius = static_cast<int>(std::lround(std::min(30.0f, 0.65f * spacing * Canvas::samples)));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(points[i].depth)) continue;
    const Color own = cloud.has_colors() ? Color{cloud.rgb[3 * i], cloud.rgb[3 * i + 1], cloud.rgb[3 * i + 2]} : black;
    const float nearness = std::clamp((far - points[i].depth) / std::max(far - near, 1e-30f), 0.0f, 1.0f);
    const float lightness = cloud.has_colors() ? luminance(own) / 255.0f : nearness;
    splat(points[i], radius, paint == Paint::own && cloud.has_colors() ? own : painted(paint, lightness));
  }
}

void Panel::draw_scale(float text_height) const {
  const float pixels = scale_ / (viewing_.is_perspective ? median_depth_ : 1.0f);  // to a unit of length
  if (!(pixels > 0.0f) || !std::isfinite(pixels)) return;
  const float longest = 0.3f * box_.width / pixels;
  float length = std::pow(10.0f, std::floor(std::log10(longest)));
  length *= longest >= 5.0f * length ? 5.0f : longest >= 2.0f * length ? 2.0f : 1.0f;
  const Place left{box_.left + 8.0f, box_.top + box_.height - 8.0f};
  const Place right{left.x + pixels * length, left.y};
  canvas_.line(left, right, 5.0f, white);
  canvas_.line(left, right, 3.0f, black);
  const std::string label = length_text(length);
  const Place corner{left.x, left.y - 1.3f * text_height};
  canvas_.fill({corner.x - 3.0f, corner.y - 3.0f, Canvas::text_width(text_height, label) + 6.0f, text_height + 3.0f},
               white);
  canvas_.text(corner, text_height, label, black);
}

}  // namespace shortshot_bench::picture
