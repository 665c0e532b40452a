#include "tools/picture/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION  // here and nowhere else
#include <stb/stb_easy_font.h>
#include <stb/stb_image_write.h>

#include "tools/io/binary_file.hpp"

namespace shortshot_bench::picture {
namespace {

constexpr float line_units = 12.0f;  // of the font, from line to line

std::string printable(const std::string& line) {
  std::string ascii;
  for (const char c : line) {
    if (c >= ' ' && c <= '~') ascii += c;
  }
  return ascii;
}

std::uint8_t mixed(std::uint8_t below, std::uint8_t above, float opacity) {
  const auto from = static_cast<float>(below);
  return static_cast<std::uint8_t>(std::lround(from + opacity * (static_cast<float>(above) - from)));
}

}  // namespace

float luminance(const Color& color) {
  return 0.299f * static_cast<float>(color.r) + 0.587f * static_cast<float>(color.g) +
         0.114f * static_cast<float>(color.b);
}

Canvas::Canvas(std::size_t width, std::size_t height, Color background)
    : width_(width), height_(height), samples_(width * height * samples * samples, background) {}

void Canvas::set_sample(int x, int y, const Color& color) {
  const auto columns = static_cast<int>(samples * width_);
  if (x < 0 || y < 0 || x >= columns || y >= static_cast<int>(samples * height_)) return;
  samples_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)] = color;
}

/// Every sample that is covered, of those within the bounds and, in the row at y, from span_at(y).x to .y.
template <class SpanAt, class Covers>
void Canvas::paint(const Box& bounds, const Color& color, float opacity, const SpanAt& span_at, const Covers& covers) {
  constexpr auto fine = static_cast<float>(samples);
  const auto clamped = [&](float v, std::size_t most) -> std::size_t {
    if (!(v > 0.0f)) return 0;  // nor NaN
    return static_cast<std::size_t>(std::min(std::floor(fine * v), fine * static_cast<float>(most)));
  };
  const std::size_t bottom = clamped(bounds.top + bounds.height + 1.0f, height_);
  for (std::size_t y = clamped(bounds.top, height_); y < bottom; ++y) {
    const float row = (static_cast<float>(y) + 0.5f) / fine;
    const Place span = span_at(row);
    const std::size_t right = clamped(std::min(bounds.left + bounds.width, span.y) + 1.0f, width_);
    for (std::size_t x = clamped(std::max(bounds.left, span.x), width_); x < right; ++x) {
      if (!covers(Place{(static_cast<float>(x) + 0.5f) / fine, row})) continue;
      Color& sample = samples_[y * samples * width_ + x];
      sample = {mixed(sample.r, color.r, opacity), mixed(sample.g, color.g, opacity),
                mixed(sample.b, color.b, opacity)};
    }
  }
}

void Canvas::fill(const Box& box, const Color& color) {
  const auto all = [&](float) { return Place{box.left, box.left + box.width}; };
  paint(box, color, 1.0f, all, [&](const Place& p) {
    return p.x >= box.left && p.x < box.left + box.width && p.y >= box.top && p.y < box.top + box.height;
  });
}

void Canvas::outline(const Box& box, float line_width, const Color& color) {
  const float right = box.left + box.width;
  const float bottom = box.top + box.height;
  line({box.left, box.top}, {right, box.top}, line_width, color);
  line({right, box.top}, {right, bottom}, line_width, color);
  line({right, bottom}, {box.left, bottom}, line_width, color);
  line({box.left, bottom}, {box.left, box.top}, line_width, color);
}

void Canvas::disc(const Place& center, float radius, const Color& color) {
  const Box bounds{center.x - radius, center.y - radius, 2.0f * radius, 2.0f * radius};
  const auto all = [&](float) { return Place{center.x - radius, center.x + radius}; };
  paint(bounds, color, 1.0f, all, [&](const Place& p) { return std::hypot(p.x - center.x, p.y - center.y) < radius; });
}

void Canvas::line(const Place& from, const Place& to, float width, const Color& color, float opacity) {
  const float reach = 0.5f * width;
  const float dx = to.x - from.x;
  const float dy = to.y - from.y;
  const float length2 = std::max(dx * dx + dy * dy, 1e-12f);
  const Box bounds{std::min(from.x, to.x) - reach, std::min(from.y, to.y) - reach, std::fabs(dx) + width,
                   std::fabs(dy) + width};
  const auto span_at = [&](float y) {
    if (std::fabs(dy) < 1e-3f) return Place{bounds.left, bounds.left + bounds.width};
    const float x = from.x + (y - from.y) * dx / dy;
    const float half = reach * std::sqrt(length2) / std::fabs(dy);
    return Place{x - half, x + half};
  };
  paint(bounds, color, opacity, span_at, [&](const Place& p) {
    const float along = ((p.x - from.x) * dx + (p.y - from.y) * dy) / length2;
    const float t = std::min(std::max(along, 0.0f), 1.0f);
    return std::hypot(p.x - from.x - t * dx, p.y - from.y - t * dy) < reach;
  });
}

void Canvas::text(const Place& upper_left, float height, const std::string& line, const Color& color) {
  struct Corner {
    float x, y, z;
    std::uint8_t color[4];
  };
  std::string ascii = printable(line);
  std::vector<Corner> corners(64 * (ascii.size() + 1));
  const int quads = stb_easy_font_print(0.0f, 0.0f, ascii.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  const float scale = height / line_units;
  for (int q = 0; q < quads; ++q) {
    const Corner& first = corners[4 * static_cast<std::size_t>(q)];
    const Corner& last = corners[4 * static_cast<std::size_t>(q) + 2];
    fill({upper_left.x + scale * first.x, upper_left.y + scale * first.y, scale * (last.x - first.x),
          scale * (last.y - first.y)},
         color);
  }
}

void Canvas::text_that_fits(const Place& upper_left, float height, const std::string& line, const Color& color) {
  const float room = static_cast<float>(width_) - upper_left.x - 4.0f;
  const float needed = text_width(height, line);
  text(upper_left, needed > room ? height * room / needed : height, line, color);
}

float Canvas::text_width(float height, const std::string& line) {
  std::string ascii = printable(line);
  return height / line_units * static_cast<float>(stb_easy_font_width(ascii.data()));
}

Color Canvas::pixel(std::size_t x, std::size_t y) const {
  std::array<unsigned, 3> sums{};
  for (std::size_t k = 0; k < samples * samples; ++k) {
    const Color& c = samples_[(samples * y + k / samples) * samples * width_ + samples * x + k % samples];
    sums = {sums[0] + c.r, sums[1] + c.g, sums[2] + c.b};
  }
  constexpr unsigned count = samples * samples;
  const auto mean = [](unsigned sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  return {mean(sums[0]), mean(sums[1]), mean(sums[2])};
}

void Canvas::write_png(const std::string& path) const {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * width_ * height_);
  for (std::size_t i = 0; i < width_ * height_; ++i) {
    const Color c = pixel(i % width_, i / width_);
    pixels.insert(pixels.end(), {c.r, c.g, c.b});
  }
  BinaryFile file(path);
  const auto write = [](void* to, void* bytes, int size) {
    static_cast<BinaryFile*>(to)->write({static_cast<const char*>(bytes), static_cast<std::size_t>(size)});
  };
  stbi_write_png_to_func(write, &file, static_cast<int>(width_), static_cast<int>(height_), 3, pixels.data(),
                         static_cast<int>(3 * width_));
  file.close();
}

}  // namespace shortshot_bench::picture
