// The results of a data set's pairs, and what they come to: means over pairs, with intervals. Pairs of one source are
// drawn together.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/campaign/statistics.hpp"
#include "paper/experiment.hpp"
#include "paper/registration.hpp"

namespace shortshot_bench::paper {

/// Of a pair: what counts is the mean over pairs.
struct PairFigure {
  const char* name;
  double (*of)(const Registration&);
};

/// Feature-matching recall: the share of pairs of which more than 5 or 20 % of the correspondences are correct.
/// Registration recall: the share of poses within bounds that are in use for rooms, strict ones, and those for objects.
namespace pair_figures {
inline constexpr PairFigure inlier_ratio{"inlier ratio", [](const Registration& r) { return r.inlier_ratio(); }};
inline constexpr PairFigure matched_5{"FMR 5 %",
                                      [](const Registration& r) { return r.inlier_ratio() > 0.05 ? 1.0 : 0.0; }};
inline constexpr PairFigure matched_20{"FMR 20 %",
                                       [](const Registration& r) { return r.inlier_ratio() > 0.2 ? 1.0 : 0.0; }};
inline constexpr PairFigure within_30cm{"RR 15 deg 30 cm", [](const Registration& r) { return r.within(15.0, 0.3); }};
inline constexpr PairFigure within_10cm{"RR 5 deg 10 cm", [](const Registration& r) { return r.within(5.0, 0.1); }};
inline constexpr PairFigure within_2cm{"RR 5 deg 2 cm", [](const Registration& r) { return r.within(5.0, 0.02); }};
}  // namespace pair_figures

/// A form of a method's rows.
struct FormResults {
  std::string name;
  std::string method;
  std::vector<Registration> pairs;  // one for each pair of the set

  bool is_method() const { return name == method; }  // its floats as they are
};

/// One data set's results.
struct RegistrationSet {
  std::string name;
  std::vector<double> rotation_deg;              // of each pair
  std::vector<std::vector<std::size_t>> groups;  // of pairs, by their places
  std::vector<FormResults> forms;                // those that could be computed, in the order of the parameters

  /// Nothing if the method's floats were not compared.
  const FormResults* floats_of(const std::string& method) const;
};

std::vector<RegistrationSet> registration_sets(const nlohmann::ordered_json& parameters, const UnitResults& results);

campaign::Interval mean_of(const RegistrationSet& set, const FormResults& form, const PairFigure& figure);

/// Of the first less the second, pair by pair.
campaign::Interval difference_of(const RegistrationSet& set, const FormResults& a, const FormResults& b,
                                 const PairFigure& figure);

/// Of the matches of all pairs together.
RatioCurve curve_of(const FormResults& form);
campaign::Interval area_of(const RegistrationSet& set, const FormResults& form);

}  // namespace shortshot_bench::paper
