#include "paper/ratio_curve.hpp"

#include <limits>

namespace shortshot_bench::paper {

double ratio_at(std::size_t step) { return static_cast<double>(step + 1) / static_cast<double>(ratio_steps); }

RatioCurve& RatioCurve::operator+=(const RatioCurve& other) {
  matchable += other.matchable;
  for (std::size_t step = 0; step < ratio_steps; ++step) {
    accepted[step] += other.accepted[step];
    right[step] += other.right[step];
  }
  return *this;
}

double RatioCurve::recall(std::size_t step) const {
  return matchable == 0 ? 0.0 : static_cast<double>(right[step]) / static_cast<double>(matchable);
}

double RatioCurve::precision(std::size_t step) const {
  if (accepted[step] == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(right[step]) / static_cast<double>(accepted[step]);
}

double RatioCurve::area() const {
  double area = 0.0, recall_before = 0.0, precision_before = -1.0;
  for (std::size_t step = 0; step < ratio_steps; ++step) {
    if (accepted[step] == 0) continue;
    if (precision_before < 0.0) precision_before = precision(step);
    area += 0.5 * (precision(step) + precision_before) * (recall(step) - recall_before);
    recall_before = recall(step);
    precision_before = precision(step);
  }
  return area;
}

RatioCurve ratio_curve(const Described& source, const Described& target, const Truth& truth) {
  std::vector<shortshot::Match> nearest;
  require(shortshot::nearest(source.rows().descriptors, target.rows().descriptors, 2, nearest));
  RatioCurve curve;
  for (std::size_t i = 0; i < source.status.size(); ++i) {
    if (truth.is_matchable(i)) ++curve.matchable;
    const shortshot::Match& first = nearest[2 * i];
    const shortshot::Match& second = nearest[2 * i + 1];
    if (second.row == shortshot::no_row) continue;
    const bool right = truth.is_right(i, first.row);
    for (std::size_t step = 0; step < ratio_steps; ++step) {  // of two as near as each other the ratio is 1
      const bool is_last = step + 1 == ratio_steps;
      const double most = ratio_at(step) * static_cast<double>(second.distance);
      if (!is_last && !(static_cast<double>(first.distance) < most)) continue;
      ++curve.accepted[step];
      if (right) ++curve.right[step];
    }
  }
  return curve;
}

nlohmann::ordered_json to_json(const RatioCurve& curve) {
  return {{"matchable", curve.matchable}, {"accepted", curve.accepted}, {"right", curve.right}};
}

RatioCurve ratio_curve_of(const nlohmann::ordered_json& json) {
  RatioCurve curve;
  json.at("matchable").get_to(curve.matchable);
  json.at("accepted").get_to(curve.accepted);
  json.at("right").get_to(curve.right);
  return curve;
}

}  // namespace shortshot_bench::paper
