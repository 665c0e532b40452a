#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "paper/campaign/plot.hpp"
#include "paper/claims.hpp"
#include "paper/kept_frames.hpp"
#include "paper/matching.hpp"
#include "paper/matching_experiment.hpp"

namespace shortshot_bench::paper {
namespace {

using campaign::Cell;
using campaign::Interval;
using campaign::Statistic;
using campaign::Table;

/// What counts where RANSAC finds no motion: far more than any it could find.
constexpr double t_diff_if_lost = 10.0;

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
}

double mean_over_trials(const Matching& m, const std::function<double(const Trial&)>& value) {
  std::vector<double> values;
  for (const Trial& trial : m.trials) values.push_back(value(trial));
  return campaign::mean(values);
}

double precision(const Matching& m) { return share(m.correct, m.reciprocal); }
double right_matches(const Matching& m) { return static_cast<double>(m.correct); }
double match_rate(const Matching& m) { return share(m.correct_nearest, m.matchable); }
double c_rk(const Matching& m) {
  return mean_over_trials(m, [&](const Trial& t) { return share(t.inliers, m.keypoints); });
}
double success(const Matching& m) {
  return mean_over_trials(
      m, [](const Trial& t) { return t.found && t.rotation_deg < 5.0 && t.translation_m < 0.02 ? 1.0 : 0.0; });
}
double is_found(const Matching& m) {
  return mean_over_trials(m, [](const Trial& t) { return t.found && t.t_diff < 0.3 ? 1.0 : 0.0; });
}
double median_t_diff(const Matching& m) {
  std::vector<double> values;
  for (const Trial& t : m.trials) values.push_back(t.found ? t.t_diff : t_diff_if_lost);
  return campaign::quantile(values, 0.5);
}

using Figure = double (*)(const Matching&);

/// One data set's results.
struct SetResults {
  std::string name;
  std::string kind;
  std::vector<std::string> descriptors;  // those that could be computed, in the order of the parameters
  std::map<std::string, std::size_t> size_bytes;
  std::vector<double> rotation_deg;                        // of each pair
  std::map<std::string, std::vector<Matching>> matchings;  // of each descriptor, one for each pair

  std::vector<double> figures(const std::string& descriptor, Figure figure) const {
    std::vector<double> values;
    for (const Matching& m : matchings.at(descriptor)) values.push_back(figure(m));
    return values;
  }
};

std::vector<SetResults> sets_of(const nlohmann::ordered_json& parameters, const UnitResults& results) {
  std::map<std::string, std::vector<Matching>> of_unit;
  for (const campaign::UnitResult& r : results) of_unit[r.key] = matchings_of(r.result);
  std::vector<SetResults> sets;
  for (const auto& json : parameters.at("sets")) {
    SetResults set;
    set.name = json.at("name");
    set.kind = json.at("kind");
    for (const auto& pair : json.at("pairs")) {
      set.rotation_deg.push_back(pair.at("rotation_deg"));
      for (const Matching& m : of_unit.at(pair.at("key"))) set.matchings[m.descriptor].push_back(m);
    }
    for (const auto& descriptor : parameters.at("descriptors")) {
      const std::string name = descriptor.at("name");
      if (set.matchings.count(name) == 0) continue;
      set.descriptors.push_back(name);
      set.size_bytes[name] = descriptor.at("size_bytes");
    }
    sets.push_back(set);
  }
  return sets;
}

Interval over_pairs(const std::vector<double>& values, Statistic statistic = Statistic::mean) {
  return campaign::bootstrap(campaign::each_its_own_group(values), statistic, bootstrap_seed);
}

Table main_table(const SetResults& set, std::vector<FigureValue>& figures) {
  Table table(set.name,
              {"descriptor", "bytes", "precision", "match rate", "C_rk", "median T_diff", "T_diff < 0.3", "success"});
  for (const std::string& d : set.descriptors) {
    const auto add = [&](const char* name, Figure figure, Statistic statistic = Statistic::mean) {
      figures.push_back({set.name, d, name, over_pairs(set.figures(d, figure), statistic)});
      return text_of(figures.back().interval, 3);
    };
    const std::string of_precision = add("precision", precision);
    const std::string of_match_rate = add("match rate", match_rate);
    const std::string of_c_rk = add("C_rk", c_rk);
    const std::string of_t_diff = add("median T_diff", median_t_diff, Statistic::median);
    const std::string of_found = add("T_diff < 0.3", is_found);
    table.add(
        {d, set.size_bytes.at(d), of_precision, of_match_rate, of_c_rk, of_t_diff, of_found, add("success", success)});
  }
  return table;
}

std::vector<double> minus(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

/// Pair by pair against the first descriptor.
Table difference_table(const SetResults& set) {
  const std::string& baseline = set.descriptors.front();
  Table table("Differences to " + baseline + ", pair by pair",
              {"descriptor", "precision", "match rate", "C_rk", "T_diff < 0.3", "success"});
  for (const std::string& d : set.descriptors) {
    if (d == baseline) continue;
    const auto difference = [&](Figure figure) {
      return text_of(over_pairs(minus(set.figures(d, figure), set.figures(baseline, figure))), 3);
    };
    table.add({d, difference(precision), difference(match_rate), difference(c_rk), difference(is_found),
               difference(success)});
  }
  return table;
}

/// The best frames against as many at random, pair by pair.
Table kept_table(const SetResults& set) {
  Table table(
      "Key points with the surest frames, and as many at random",
      {"descriptor", "kept, %", "precision", "precision at random", "precision, difference", "right matches",
       "right matches at random", "right matches, difference", "success", "success at random", "success, difference"});
  for (const std::string& d : set.descriptors) {
    const KeptName name = kept_name_of(d);
    const bool all = name.kept.percent == 100;
    if (name.kept.at_random) continue;
    const std::string control = name_of({name.descriptor, {name.kept.percent, true}});
    if (!all && set.matchings.count(control) == 0) continue;
    std::vector<Cell> row{name.descriptor, std::size_t{name.kept.percent}};
    using Column = std::pair<double (*)(const Matching&), int>;  // a figure and its digits
    for (const auto& [figure, digits] : {Column{precision, 3}, Column{right_matches, 1}, Column{success, 3}}) {
      row.emplace_back(text_of(over_pairs(set.figures(d, figure)), digits));
      row.emplace_back(all ? "" : text_of(over_pairs(set.figures(control, figure)), digits));
      row.emplace_back(all ? ""
                           : text_of(over_pairs(minus(set.figures(d, figure), set.figures(control, figure))), digits));
    }
    table.add(row);
  }
  return table;
}

struct RotationBin {
  std::string name;
  double above_deg;
  double to_deg;
};

/// Thirds that are easy, hard and nearly hopeless; a room is seen from much closer places.
std::vector<RotationBin> bins_of(const SetResults& set) {
  const double first = set.kind == "frames" ? 7.0 : 25.0;
  const double second = set.kind == "frames" ? 15.0 : 45.0;
  const auto text = [](double degrees) { return std::to_string(static_cast<int>(degrees)); };
  return {{"to " + text(first), -1.0, first},
          {text(first) + " to " + text(second), first, second},
          {"above " + text(second), second, 180.0}};
}

Table bin_table(const SetResults& set) {
  Table table("By the rotation between the views",
              {"degrees", "pairs", "descriptor", "precision", "match rate", "success"});
  for (const RotationBin& bin : bins_of(set)) {
    const auto in_bin = [&](std::vector<double> values) {
      std::vector<double> kept;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (set.rotation_deg[i] > bin.above_deg && set.rotation_deg[i] <= bin.to_deg) kept.push_back(values[i]);
      }
      return kept;
    };
    const std::size_t pairs = in_bin(set.rotation_deg).size();
    if (pairs == 0) continue;
    for (const std::string& d : set.descriptors) {
      const auto mean = [&](Figure figure) { return Cell(campaign::mean(in_bin(set.figures(d, figure))), 3); };
      table.add({bin.name, pairs, d, mean(precision), mean(match_rate), mean(success)});
    }
  }
  return table;
}

/// A figure of each pair: the paper's figures 3 and 4, of which each descriptor has its panel.
campaign::Plot plot_of_pairs(const SetResults& set, const std::string& label, const std::string& meaning,
                             Figure figure) {
  campaign::Plot plot;
  plot.title = set.name + ": " + label + ", " + meaning;
  plot.x = campaign::axis_of_numbers("number of the pair, in the order of the rotation between its views",
                                     set.rotation_deg.size());
  plot.y.label = label;
  plot.in_panels = true;
  for (const std::string& d : set.descriptors) {
    campaign::Series& series = plot.series.emplace_back();
    series.name = d;
    series.marks = campaign::Marks::points;
    series.ys = set.figures(d, figure);
    for (std::size_t i = 0; i < series.ys.size(); ++i) series.xs.push_back(static_cast<double>(i + 1));
  }
  return plot;
}

std::vector<std::string> draw(const SetResults& set, const std::string& prefix, const std::string& directory) {
  campaign::Plot errors = plot_of_pairs(
      set, "T_diff",
      "the error of a pose (equation 9); " + std::to_string(static_cast<int>(t_diff_if_lost)) + " where none was found",
      median_t_diff);
  errors.y.logarithmic = true;
  campaign::Plot inliers = plot_of_pairs(set, "C_rk", "the share of inliers of all key points", c_rk);
  inliers.y.min = 0.0;
  campaign::write_svg(errors, directory + "/" + prefix + "t_diff.svg");
  campaign::write_svg(inliers, directory + "/" + prefix + "c_rk.svg");
  return {prefix + "t_diff.svg", prefix + "c_rk.svg"};
}

/// Each pair and descriptor on a row: what the plots show, and more.
Table pair_table(const SetResults& set) {
  Table table("Pairs", {"pair", "rotation in degrees", "descriptor", "key points", "reciprocal", "correct", "C_rk",
                        "T_diff", "success"});
  for (std::size_t i = 0; i < set.rotation_deg.size(); ++i) {
    for (const std::string& d : set.descriptors) {
      const Matching& m = set.matchings.at(d)[i];
      table.add({i + 1, Cell(set.rotation_deg[i], 1), d, m.keypoints, m.reciprocal, m.correct, Cell(c_rk(m), 4),
                 Cell(median_t_diff(m), 3), Cell(success(m), 2)});
    }
  }
  return table;
}

void add_claims(const SetResults& set, std::vector<Claim>& claims) {
  for (const char* d : {"scsh336", "scsh696"}) {
    if (set.matchings.count(d) == 0 || set.matchings.count("cshot1344") == 0) continue;
    const auto baseline = set.figures("cshot1344", precision);
    claims.push_back({set.name + ": " + d + " matches key points as well as cshot1344",
                      "precision, difference to cshot1344", over_pairs(minus(set.figures(d, precision), baseline)),
                      -0.1 * campaign::mean(baseline),
                      "The color of one key point is the reference of all its color distances, and SCSH spends more "
                      "of its few dimensions on color than on the normals, which tell CSHOT about shape."});
  }
}

}  // namespace

Findings matching_report(const nlohmann::ordered_json& parameters, const UnitResults& results,
                         const std::string& directory) {
  Findings findings;
  campaign::Report& report = findings.report;
  report.title = "Key-point matching";
  report.parameters = parameters;
  std::vector<Claim> claims;
  std::size_t number = 0;
  for (const SetResults& set : sets_of(parameters, results)) {
    const std::string prefix = "set" + std::to_string(++number) + "_";
    report.sections.push_back(
        {set.name,
         std::to_string(set.rotation_deg.size()) +
             " pairs. Means over pairs with 95 % bootstrap intervals; precision: correct of all reciprocal "
             "correspondences; match rate: correct nearest neighbors of all key points that have a counterpart; "
             "success: rotation within 5 degrees and translation within 2 cm. A pair without a pose counts as T_diff " +
             std::to_string(static_cast<int>(t_diff_if_lost)) + ".",
         {{prefix + "matching", main_table(set, findings.figures)},
          {prefix + "differences", difference_table(set)},
          {prefix + "rotation", bin_table(set)},
          {prefix + "pairs", pair_table(set)}},
         draw(set, prefix, directory)});
    if (keeps_frames(set.descriptors)) {
      report.sections.back().tables.push_back({prefix + "kept_frames", kept_table(set)});
    }
    add_claims(set, claims);
  }
  report.sections.push_back(section_of(claims));
  report.sections.push_back(section_of(findings.figures));
  return findings;
}

}  // namespace shortshot_bench::paper
