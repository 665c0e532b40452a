#include "paper/accuracy.hpp"
#include "paper/claims.hpp"
#include "paper/kept_frames.hpp"
#include "paper/recognition_experiment.hpp"

namespace shortshot_bench::paper {
namespace {

using campaign::Table;

constexpr NamedFigure named_figures[] = {{"class, Hough", hough_class},
                                         {"instance, Hough", hough_instance},
                                         {"class, nearest", nearest_class},
                                         {"instance, nearest", nearest_instance}};

Table accuracy_table(const nlohmann::ordered_json& descriptors, const TaskResults& task,
                     std::vector<FigureValue>& figures) {
  Table table(task.name,
              {"descriptor", "bytes", "class, Hough", "instance, Hough", "class, nearest", "instance, nearest"});
  for (const auto& d : descriptors) {
    std::vector<campaign::Cell> row{d.at("name").get<std::string>(), d.at("size_bytes").get<std::size_t>()};
    for (const NamedFigure& figure : named_figures) {
      const ByObject values = correct(task.of.at(d.at("name")), figure.correct);
      figures.push_back({task.name, d.at("name"), figure.name, over_objects(values)});
      row.emplace_back(percent_of(figures.back().interval));
    }
    table.add(row);
  }
  return table;
}

/// View by view against the first descriptor.
Table difference_table(const nlohmann::ordered_json& descriptors, const TaskResults& task) {
  const std::string baseline = descriptors.front().at("name");
  Table table("Differences to " + baseline + ", view by view",
              {"descriptor", "class, Hough", "instance, Hough", "class, nearest", "instance, nearest"});
  for (const auto& d : descriptors) {
    const std::string name = d.at("name");
    if (name == baseline) continue;
    std::vector<campaign::Cell> row{name};
    for (const NamedFigure& figure : named_figures) {
      row.emplace_back(percent_of(over_objects(
          difference(correct(task.of.at(name), figure.correct), correct(task.of.at(baseline), figure.correct)))));
    }
    table.add(row);
  }
  return table;
}

/// The best frames against as many at random, view by view.
Table kept_table(const nlohmann::ordered_json& descriptors, const TaskResults& task) {
  Table table("Key points with the surest frames, and as many at random",
              {"descriptor", "kept, %", "class, Hough", "class at random", "class, difference", "instance, Hough",
               "instance at random", "instance, difference"});
  for (const auto& d : descriptors) {
    const KeptName name = kept_name_of(d.at("name"));
    const bool all = name.kept.percent == 100;
    if (name.kept.at_random) continue;
    const std::string control = name_of({name.descriptor, {name.kept.percent, true}});
    if (!all && task.of.count(control) == 0) continue;
    std::vector<campaign::Cell> row{name.descriptor, std::size_t{name.kept.percent}};
    for (const Correct figure : {hough_class, hough_instance}) {
      const ByObject best = correct(task.of.at(d.at("name")), figure);
      const ByObject random = all ? best : correct(task.of.at(control), figure);
      row.emplace_back(percent_of(over_objects(best)));
      row.emplace_back(all ? "" : percent_of(over_objects(random)));
      row.emplace_back(all ? "" : percent_of(over_objects(difference(best, random))));
    }
    table.add(row);
  }
  return table;
}

void add_claims(const TaskResults& task, std::vector<Claim>& claims) {
  for (const char* d : {"scsh336", "scsh696"}) {
    if (task.of.count(d) == 0 || task.of.count("cshot1344") == 0) continue;
    for (const auto& [what, figure] : {NamedFigure{"class", hough_class}, NamedFigure{"instance", hough_instance}}) {
      claims.push_back(
          {task.name + ": " + d + " recognizes the " + what + " within a point of cshot1344, or better",
           "accuracy (Hough), difference to cshot1344",
           over_objects(difference(correct(task.of.at(d), figure), correct(task.of.at("cshot1344"), figure))), -0.01,
           "Its shape part counts points and has no normals; where shape tells the objects apart, or the "
           "colors change with the light, CSHOT's normals make up for that."});
    }
  }
}

}  // namespace

Findings recognition_report(const nlohmann::ordered_json& parameters, const UnitResults& results) {
  Findings findings;
  campaign::Report& report = findings.report;
  report.title = "Object recognition";
  report.parameters = parameters;
  const nlohmann::ordered_json& descriptors = parameters.at("descriptors");
  std::vector<std::string> names;
  for (const auto& d : descriptors) names.push_back(d.at("name"));
  const bool any_kept = keeps_frames(names);
  std::vector<Claim> claims;
  std::size_t number = 0;
  for (const TaskResults& task : tasks_of(parameters, results)) {
    const std::string prefix = "task" + std::to_string(++number) + "_";
    const std::vector<Judgement>& judgements = task.of.begin()->second;
    report.sections.push_back({task.name,
                               std::to_string(judgements.size()) + " test views of " +
                                   std::to_string(correct(judgements, hough_class).size()) +
                                   " objects. Accuracies in percent with 95 % bootstrap intervals over objects, of the "
                                   "Hough vote and of the plain vote of nearest descriptors.",
                               {{prefix + "accuracy", accuracy_table(descriptors, task, findings.figures)},
                                {prefix + "differences", difference_table(descriptors, task)}},
                               {}});
    if (any_kept) report.sections.back().tables.push_back({prefix + "kept_frames", kept_table(descriptors, task)});
    add_claims(task, claims);
  }
  report.sections.push_back(section_of(claims));
  report.sections.push_back(section_of(findings.figures));
  return findings;
}

}  // namespace shortshot_bench::paper
