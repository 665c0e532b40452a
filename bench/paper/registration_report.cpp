#include "paper/registration_experiment.hpp"
#include "paper/registration_plots.hpp"
#include "paper/registration_set.hpp"

namespace shortshot_bench::paper {
namespace {

constexpr PairFigure all_figures[] = {pair_figures::inlier_ratio, pair_figures::matched_5,   pair_figures::matched_20,
                                      pair_figures::within_30cm,  pair_figures::within_10cm, pair_figures::within_2cm};

double median_microseconds(const FormResults& form) {
  std::vector<double> values;
  for (const Registration& r : form.pairs) values.push_back(r.microseconds);
  return campaign::quantile(values, 0.5);
}

campaign::Table registration_table(const RegistrationSet& set, std::vector<FigureValue>& figures) {
  std::vector<std::string> columns = {"descriptor", "bytes", "microseconds"};
  for (const PairFigure& figure : all_figures) columns.emplace_back(figure.name);
  columns.emplace_back("PR AUC");
  campaign::Table table(set.name, columns);
  for (const FormResults& form : set.forms) {
    std::vector<campaign::Cell> row = {form.name, form.pairs.front().size_bytes,
                                       campaign::Cell(median_microseconds(form), 1)};
    const auto add = [&](const char* name, const campaign::Interval& interval) {
      figures.push_back({set.name, form.name, name, interval});
      row.emplace_back(text_of(interval, 3));
    };
    for (const PairFigure& figure : all_figures) add(figure.name, mean_of(set, form, figure));
    add("PR AUC", area_of(set, form));
    table.add(row);
  }
  return table;
}

/// Floats against those of the first method, other forms against their own floats, if these are there; pair by pair.
campaign::Table form_differences(const RegistrationSet& set) {
  std::vector<std::string> columns = {"descriptor", "less"};
  for (const PairFigure& figure : all_figures) columns.emplace_back(figure.name);
  campaign::Table table("Differences, pair by pair", columns);
  for (const FormResults& form : set.forms) {
    const FormResults* other = form.is_method() ? nullptr : set.floats_of(form.method);
    if (other == nullptr) other = &set.forms.front();
    if (other == &form) continue;
    std::vector<campaign::Cell> row = {form.name, other->name};
    for (const PairFigure& figure : all_figures) row.emplace_back(text_of(difference_of(set, form, *other, figure), 3));
    table.add(row);
  }
  return table;
}

/// Each pair and form on a row.
campaign::Table registered_pairs(const RegistrationSet& set) {
  campaign::Table table(
      "Pairs", {"pair", "rotation in degrees", "descriptor", "reciprocal", "correct", pair_figures::within_30cm.name,
                pair_figures::within_10cm.name, pair_figures::within_2cm.name});
  for (std::size_t i = 0; i < set.rotation_deg.size(); ++i) {
    for (const FormResults& form : set.forms) {
      const Registration& r = form.pairs[i];
      const auto cell = [&](const PairFigure& figure) { return campaign::Cell(figure.of(r), 2); };
      table.add({i + 1, campaign::Cell(set.rotation_deg[i], 1), form.name, r.reciprocal, r.correct,
                 cell(pair_figures::within_30cm), cell(pair_figures::within_10cm), cell(pair_figures::within_2cm)});
    }
  }
  return table;
}

constexpr const char* what_figures_are =
    " pairs. Means over pairs, with 95 % bootstrap intervals over sources. Microseconds: median of what describing a "
    "key point took on one core, without normals and the index. Inlier ratio: correct of all reciprocal "
    "correspondences; FMR: pairs with an inlier ratio above 5 or 20 %; RR: poses (RANSAC) that rotate within so many "
    "degrees of the true one and bring the centroid of the key points within so many cm of its place; PR AUC: area "
    "under recall over 1 - precision of nearest neighbors of all pairs, swept over the ratio of the distances of the "
    "nearest and the second nearest.";

}  // namespace

Findings registration_report(const nlohmann::ordered_json& parameters, const UnitResults& results,
                             const std::string& directory) {
  Findings findings;
  findings.report.title = "Registration";
  findings.report.parameters = parameters;
  std::size_t number = 0;
  for (const RegistrationSet& set : registration_sets(parameters, results)) {
    const std::string prefix = "set" + std::to_string(++number) + "_";
    findings.report.sections.push_back({set.name,
                                        std::to_string(set.rotation_deg.size()) + what_figures_are,
                                        {{prefix + "registration", registration_table(set, findings.figures)},
                                         {prefix + "differences", form_differences(set)},
                                         {prefix + "pairs", registered_pairs(set)}},
                                        draw_registration(set, prefix, directory)});
  }
  findings.report.sections.push_back(section_of(findings.figures));
  return findings;
}

}  // namespace shortshot_bench::paper
