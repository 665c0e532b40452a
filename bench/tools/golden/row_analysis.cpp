#include "row_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "unit/oracle.hpp"
#include "unit/oracle_shot.hpp"

namespace shortshot_bench::golden {
namespace {

// What rounding may do to a position, in cells: angles and distances are good to 1e-6, distances of colors times tens
// of bins to less.
constexpr double rounding_in_cells[border_kinds] = {2e-6, 2e-6, 2e-6, 1e-5};
constexpr double beyond_border = 1e-7;

// What rounding may make of one neighbor in one part: its votes on each side of the borders next to it, values of the
// descriptor before it is normalized.
struct Choices {
  std::vector<std::vector<double>> votes;  // none if the neighbor has none
  BorderCounts at_border;                  // this neighbor: 0 or 1 of each
};

// One part of a row as the oracle sees it.
class ExactPart {
 public:
  ExactPart(const Case& c, std::size_t row, Sharing sharing, const Histogram& part)
      : case_(c), radius_(static_cast<float>(*c.radius)), sharing_(sharing), part_(part) {
    const std::size_t key = c.keypoints[row];
    if (!c.rgb.empty()) color_ = {c.rgb[3 * key], c.rgb[3 * key + 1], c.rgb[3 * key + 2]};
    const float* axes = c.frames.data() + 9 * row;
    frame_ = oracle::given_frame(axes, axes + 3, axes + 6);
  }

  std::size_t size() const {
    return votes({}, [](int, double raw) { return raw; }).size();
  }

  Choices choices_of(const oracle::Neighbor& neighbor) const {
    std::vector<double> exact;
    votes({neighbor}, [&](int, double raw) { return exact.emplace_back(raw); });
    Choices choices;
    if (!exact.empty()) add_choices(neighbor, exact, 0, choices);
    return choices;
  }

 private:
  template <class Adjust>
  std::vector<double> votes(const std::vector<oracle::Neighbor>& neighbors, Adjust adjust) const {
    if (sharing_ == Sharing::published) {
      oracle::Config config;
      config.parts = {{part_.radial, part_.elevation, part_.azimuth, part_.bins}};
      return oracle::votes(neighbors, case_.rgb, color_, frame_, radius_, config, adjust).values;
    }
    oracle::ShotConfig config;
    config.wrap = true;
    config.parts = {{part_.radial, part_.elevation, part_.azimuth, part_.bins, part_.of_colors}};
    return oracle::shot_votes(neighbors, case_.normals, case_.rgb, color_, frame_, static_cast<double>(radius_), config,
                              adjust)
        .values;
  }

  // Where a position may as well be: on both sides of a place where votes jump, and at both ends of a turn.
  std::vector<double> sides_of(int axis, double raw) const {
    const bool is_shot_bin = sharing_ == Sharing::shot && axis == 3;  // centered at whole numbers
    const double border = sharing_ == Sharing::published ? std::round(2.0 * raw) / 2.0
                          : is_shot_bin                  ? std::floor(raw) + 0.5
                                                         : std::round(raw);
    std::vector<double> sides{raw};
    if (std::fabs(raw - border) >= rounding_in_cells[axis]) return sides;
    sides.insert(sides.end(), {border - beyond_border, border + beyond_border});
    const double turn = part_.azimuth;
    if (axis == 2 && border <= 0.0) sides.insert(sides.end(), {turn - beyond_border, turn});
    if (axis == 2 && border >= turn) sides.insert(sides.end(), {0.0, beyond_border});
    return sides;
  }

  // All sides from axis k on.
  void add_choices(const oracle::Neighbor& neighbor, std::vector<double> positions, std::size_t k,
                   Choices& choices) const {
    if (k == positions.size()) {
      choices.votes.push_back(
          votes({neighbor}, [&](int axis, double) { return positions[static_cast<std::size_t>(axis)]; }));
      return;
    }
    const std::vector<double> sides = sides_of(static_cast<int>(k), positions[k]);
    choices.at_border.of[k] = sides.size() > 1 ? 1 : 0;
    for (const double side : sides) {
      positions[k] = side;
      add_choices(neighbor, positions, k + 1, choices);
    }
  }

  const Case& case_;
  float radius_;
  Sharing sharing_;
  Histogram part_;
  oracle::Bytes3 color_{};
  oracle::ShotFrame frame_;
};

// All that rounding may make of a row before it is normalized.
class Range {
 public:
  void add_values(std::size_t count) {
    least_.resize(least_.size() + count, 0.0);
    most_.resize(least_.size(), 0.0);
  }

  // To the last `count` values that were added.
  void add(const Choices& choices) {
    const std::size_t count = choices.votes.front().size();
    const std::size_t first = least_.size() - count;
    for (std::size_t i = 0; i < count; ++i) {
      double least = HUGE_VAL, most = 0.0;
      for (const std::vector<double>& votes : choices.votes) {
        least = std::min(least, votes[i]);
        most = std::max(most, votes[i]);
      }
      least_[first + i] += least;
      most_[first + i] += most;
    }
  }

  // Is there a length by which all values of a normalized row, each off by `tolerance` at most, are in range?
  bool holds(const float* row, double tolerance) const {
    double shortest = 0.0, longest = HUGE_VAL;
    for (std::size_t i = 0; i < least_.size(); ++i) {
      const double value = static_cast<double>(row[i]);
      if (!(value + tolerance >= 0.0)) return false;
      shortest = std::max(shortest, least_[i] / (value + tolerance));
      if (value > tolerance) longest = std::min(longest, most_[i] / (value - tolerance));
    }
    return shortest <= longest;
  }

 private:
  std::vector<double> least_, most_;
};

}  // namespace

void BorderCounts::add(const BorderCounts& other) {
  for (std::size_t k = 0; k < border_kinds; ++k) of[k] += other.of[k];
}

std::string BorderCounts::text() const {
  constexpr const char* names[border_kinds] = {"shell", "elevation", "azimuth", "bin"};
  std::string list;
  for (std::size_t k = 0; k < border_kinds; ++k) {
    if (of[k] == 0) continue;
    list += (list.empty() ? "at a border: " : ", ") + std::to_string(of[k]) + " " + names[k];
  }
  return list;
}

RowAnalysis analyze_row(const Case& c, std::size_t row, const DescriptorOutput& descriptor, const float* ours,
                        const float* reference) {
  const std::size_t key = c.keypoints[row];
  const auto radius = static_cast<float>(*c.radius);
  const std::vector<oracle::Neighbor> neighbors =
      oracle::neighbors(c.points, {c.points[3 * key], c.points[3 * key + 1], c.points[3 * key + 2]}, radius * radius);
  Range range;
  RowAnalysis analysis;
  for (const Histogram& histogram : descriptor.histograms()) {
    const ExactPart part(c, row, descriptor.sharing, histogram);
    range.add_values(part.size());
    for (const oracle::Neighbor& neighbor : neighbors) {
      const Choices choices = part.choices_of(neighbor);
      if (choices.votes.empty()) continue;
      range.add(choices);
      analysis.at_border.add(choices.at_border);
    }
  }
  analysis.explains = range.holds(ours, descriptor.row_l2) && range.holds(reference, descriptor.row_l2);
  return analysis;
}

}  // namespace shortshot_bench::golden
