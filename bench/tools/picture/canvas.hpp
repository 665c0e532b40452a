// An image that is drawn on: boxes, discs, lines, text. It is sampled three times as finely as it is written, which
// makes all edges smooth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"

namespace shortshot_bench::picture {

using Color = shortshot::Rgb;

inline constexpr Color white{255, 255, 255};
inline constexpr Color black{0, 0, 0};
inline constexpr Color green{0, 170, 60};
inline constexpr Color dark_gray{70, 70, 70};

/// The luminance, 0 to 255, as a picture without colors shows it.
float luminance(const Color& color);

/// In pixels, from the upper left corner of the image; a pixel's center is at half numbers.
struct Place {
  float x, y;
};

struct Box {
  float left, top, width, height;
};

class Canvas {
 public:
  static constexpr int samples = 3;  // along each axis of a pixel

  Canvas(std::size_t width, std::size_t height, Color background = white);

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }

  void fill(const Box& box, const Color& color);
  void outline(const Box& box, float line_width, const Color& color);
  void disc(const Place& center, float radius, const Color& color);
  /// `opacity` from 0 to 1.
  void line(const Place& from, const Place& to, float width, const Color& color, float opacity = 1.0f);
  /// ASCII, a line; other bytes are left out. `height` is that of a line, of which capitals are seven twelfths.
  void text(const Place& upper_left, float height, const std::string& line, const Color& color);
  /// The same, smaller where it would reach beyond the image.
  void text_that_fits(const Place& upper_left, float height, const std::string& line, const Color& color);
  static float text_width(float height, const std::string& line);

  /// One sample; those outside are left out.
  void set_sample(int x, int y, const Color& color);

  /// The mean of a pixel's samples.
  Color pixel(std::size_t x, std::size_t y) const;
  /// Throws InputError if the file cannot be written.
  void write_png(const std::string& path) const;

 private:
  template <class SpanAt, class Covers>
  void paint(const Box& bounds, const Color& color, float opacity, const SpanAt& span_at, const Covers& covers);

  std::size_t width_;
  std::size_t height_;
  std::vector<Color> samples_;
};

}  // namespace shortshot_bench::picture
