// A part of a picture with a cloud in it.
#pragma once

#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "tools/io/rgbd_cloud.hpp"
#include "tools/picture/canvas.hpp"
#include "tools/picture/viewing.hpp"

namespace shortshot_bench::picture {

/// How the points of a cloud are painted.
enum class Paint : unsigned char {
  own,     // their colors; without colors gray, the nearer the lighter
  orange,  // light, by their brightness or nearness: tells one cloud from another, without colors, too
  blue     // dark, likewise
};

class Panel {
 public:
  /// The view is scaled so that all but one point in a hundred on each side fit into the box.
  Panel(Canvas& canvas, const Box& box, const Viewing& viewing, const RgbdCloud& fits);

  /// The nearest points hide the others, also those of clouds that were drawn before. A point is as large as the
  /// spacing of the cloud's points.
  void draw(const RgbdCloud& cloud, Paint paint);

  /// On the canvas.
  Place place_of(const shortshot::Point& p) const;
  bool is_inside(const Place& place) const;

  /// A bar with its length, of one, two or five tens of the cloud's unit; with perspective that at the median depth.
  void draw_scale(float text_height) const;

 private:
  void splat(const Projected& at, int radius, const Color& color);

  Canvas& canvas_;
  Box box_;
  Viewing viewing_;
  float scale_ = 1.0f;  // pixels to a length of the picture plane
  float middle_u_ = 0.0f;
  float middle_v_ = 0.0f;
  float median_depth_ = 1.0f;
  int columns_;
  int rows_;
  std::vector<float> depths_;  // of the nearest point at each sample of the box
};

}  // namespace shortshot_bench::picture
