// What is marked on clouds: key points, those that count, and where they point to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "tools/io/rgbd_cloud.hpp"
#include "tools/picture/canvas.hpp"
#include "tools/picture/panel.hpp"

namespace shortshot_bench::picture {

/// A cloud, and what a picture calls it.
struct NamedCloud {
  std::string name;
  const RgbdCloud& cloud;
};

/// So many of them, evenly chosen.
template <class Element>
std::vector<Element> thinned(const std::vector<Element>& all, std::size_t most) {
  std::vector<Element> chosen;
  const std::size_t count = std::min(most, all.size());
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(all[k * all.size() / count]);
  return chosen;
}

/// All strokes are multiples of `unit`, a 1600th of a picture's width.
float unit_of(std::size_t width);

/// Key points: small dots, of very many so many as do not hide the cloud.
void draw_dots(Canvas& canvas, const Panel& panel, const std::vector<shortshot::Point>& points, float unit);

/// Light green with a dark rim, to be told from what is below in grays, too.
void draw_mark(Canvas& canvas, const Place& at, float unit);
/// A white disc with a cross.
void draw_target(Canvas& canvas, const Place& at, float unit);
void draw_strong_line(Canvas& canvas, const Place& from, const Place& to, float unit);

struct MarkedCloud {
  std::string title;
  std::string legend;
  std::vector<shortshot::Point> dots;
  std::vector<shortshot::Point> marks;
  std::vector<shortshot::Point> targets;  // none, or one for each mark, joined to it by a line; the first one is marked
};

/// One cloud as its camera saw it.
Canvas draw_marked(const NamedCloud& cloud, const MarkedCloud& marked, std::size_t width);

}  // namespace shortshot_bench::picture
