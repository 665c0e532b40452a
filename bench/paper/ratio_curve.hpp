// Precision and recall of nearest neighbors that pass Lowe's test, swept over the ratio of the distances of the nearest
// and the second nearest.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "paper/truth.hpp"

namespace shortshot_bench::paper {

inline constexpr std::size_t ratio_steps = 50;

/// The ratio up to which matches are accepted at step 0, 1, ...: 0.02, 0.04, ... 1.
double ratio_at(std::size_t step);

/// Counts add up over pairs.
struct RatioCurve {
  std::size_t matchable = 0;                        // key points of the source that have a counterpart
  std::array<std::size_t, ratio_steps> accepted{};  // nearest neighbors up to ratio_at(step)
  std::array<std::size_t, ratio_steps> right{};     // those of them that are correct

  RatioCurve& operator+=(const RatioCurve& other);

  double recall(std::size_t step) const;     // right of all matchable; 0 if there are none
  double precision(std::size_t step) const;  // right of all accepted; NaN if there are none

  /// The area under recall over 1 - precision, as papers draw it, the curve's last recall being drawn on to where
  /// precision is 0: the integral of precision over recall, by trapezoids. 0 if nothing is accepted.
  double area() const;
};

/// Of all key points of the source. A target with fewer than two rows accepts nothing.
RatioCurve ratio_curve(const Described& source, const Described& target, const Truth& truth);

nlohmann::ordered_json to_json(const RatioCurve& curve);
RatioCurve ratio_curve_of(const nlohmann::ordered_json& json);

}  // namespace shortshot_bench::paper
