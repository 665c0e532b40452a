#include <algorithm>
#include <cmath>
#include <set>

#include "paper/accuracy.hpp"
#include "paper/campaign/plot.hpp"
#include "paper/claims.hpp"
#include "paper/recognition_experiment.hpp"

namespace shortshot_bench::paper {
namespace {

using campaign::Cell;
using campaign::Interval;

/// A member of the family with its results in one task.
struct MemberResult {
  std::string name;
  int n_g = 0;
  int n_c = 0;
  int h = 0;
  std::size_t size_bytes = 0;
  ByObject classes;
  ByObject instances;
};

std::vector<MemberResult> members_of(const nlohmann::ordered_json& parameters, const TaskResults& task) {
  std::vector<MemberResult> members;
  for (const auto& [name, sizes] : parameters.at("sizes").items()) {
    const std::vector<Judgement>& judgements = task.of.at(name);
    const int n_g = sizes.at("n_g");
    const int n_c = sizes.at("n_c");
    const int h = sizes.at("h");
    members.push_back({name, n_g, n_c, h, sizeof(float) * static_cast<std::size_t>(n_g + n_c * h),
                       correct(judgements, hough_class), correct(judgements, hough_instance)});
  }
  return members;
}

const MemberResult* find(const std::vector<MemberResult>& members, int n_g, int n_c, int h) {
  const auto is_it = [=](const MemberResult& m) { return m.n_g == n_g && m.n_c == n_c && m.h == h; };
  const auto found = std::find_if(members.begin(), members.end(), is_it);
  return found == members.end() ? nullptr : &*found;
}

campaign::Table accuracy_table(const std::vector<MemberResult>& members, const TaskResults& task,
                               std::vector<FigureValue>& figures) {
  campaign::Table table(task.name, {"n_g-n_c-h", "dimensions", "bytes", "class", "instance"});
  const auto add = [&](const std::string& name, std::size_t bytes, const ByObject& classes, const ByObject& instances) {
    figures.push_back({task.name, name, "class, Hough", over_objects(classes)});
    const std::string of_class = percent_of(figures.back().interval);
    figures.push_back({task.name, name, "instance, Hough", over_objects(instances)});
    table.add({name, bytes / sizeof(float), bytes, of_class, percent_of(figures.back().interval)});
  };
  for (const MemberResult& m : members) add(m.name, m.size_bytes, m.classes, m.instances);
  const std::vector<Judgement>& baseline = task.of.at("cshot1344");
  add("cshot1344", 1344 * sizeof(float), correct(baseline, hough_class), correct(baseline, hough_instance));
  return table;
}

std::set<int> values_of(const std::vector<MemberResult>& members, int MemberResult::*member) {
  std::set<int> values;
  for (const MemberResult& m : members) {
    if (m.n_g == 96) values.insert(m.*member);
  }
  return values;
}

double accuracy(const ByObject& values) { return 100.0 * over_objects(values).value; }

/// Round, at least a tenth of the way below 100 %, where all are.
double least_percent(const std::vector<campaign::Series>& series) {
  double least = 90.0;
  for (const campaign::Series& s : series) {
    for (const double y : s.ys) least = std::min(least, 5.0 * std::floor(y / 5.0));
  }
  return least;
}

/// Accuracy against bins, a line for each color grid, CSHOT as a level; above, the bytes of n_c = 24.
campaign::Plot figure_5(const std::vector<MemberResult>& members, const TaskResults& task, const char* what,
                        ByObject MemberResult::*values, const ByObject& of_cshot) {
  campaign::Plot plot;
  plot.title = task.name + ": " + what + " recognized by the Hough vote";
  plot.x.label = "bins h of each color cell, n_g = 96 (above: bytes with n_c = 24)";
  plot.y.label = std::string("accuracy, % (") + what + ")";
  const std::set<int> bins = values_of(members, &MemberResult::h);
  plot.x.min = *bins.begin() - 1;
  plot.x.max = *bins.rbegin() + 1;
  for (const int n_c : values_of(members, &MemberResult::n_c)) {
    campaign::Series& series = plot.series.emplace_back();
    series.name = "n_c = " + std::to_string(n_c);
    for (const int h : bins) {
      const MemberResult* const m = find(members, 96, n_c, h);
      if (m == nullptr) continue;
      series.xs.push_back(h);
      series.ys.push_back(accuracy(m->*values));
    }
  }
  const double level = accuracy(of_cshot);
  plot.series.push_back({"CSHOT", {plot.x.min, plot.x.max}, {level, level}, campaign::Marks::line});
  plot.y.min = least_percent(plot.series);
  plot.y.max = 100.0 + 0.03 * (100.0 - plot.y.min);  // what is at 100 % is not on the frame
  for (const int h : bins) {
    plot.x.ticks.push_back({static_cast<double>(h), std::to_string(h)});
    plot.second_x.ticks.push_back({static_cast<double>(h), std::to_string(4 * (96 + 24 * h))});
  }
  return plot;
}

std::vector<std::string> draw(const std::vector<MemberResult>& members, const TaskResults& task,
                              const std::string& prefix, const std::string& directory) {
  const std::vector<Judgement>& cshot = task.of.at("cshot1344");
  const std::vector<std::string> files{prefix + "class.svg", prefix + "instance.svg"};
  campaign::write_svg(figure_5(members, task, "class", &MemberResult::classes, correct(cshot, hough_class)),
                      directory + "/" + files[0]);
  campaign::write_svg(figure_5(members, task, "instance", &MemberResult::instances, correct(cshot, hough_instance)),
                      directory + "/" + files[1]);
  return files;
}

/// The mean gain of instance accuracy from one size to another wherever both are there with all else equal.
void add_claim(const std::vector<MemberResult>& members, const std::string& text, int MemberResult::*size, int from,
               int to, double at_least, bool is_loss, const std::string& reason, std::vector<Claim>& claims) {
  std::vector<ByObject> differences;
  for (const MemberResult& a : members) {
    if (a.*size != from) continue;
    MemberResult other{"", a.n_g, a.n_c, a.h, 0, {}, {}};
    other.*size = to;
    const MemberResult* const b = find(members, other.n_g, other.n_c, other.h);
    if (b == nullptr) continue;
    differences.push_back(is_loss ? difference(a.instances, b->instances) : difference(b->instances, a.instances));
  }
  if (differences.empty()) return;
  claims.push_back({text, is_loss ? "instance accuracy, loss" : "instance accuracy, gain",
                    over_objects(mean(differences)), at_least, reason, !is_loss});
}

void add_claims(const std::vector<MemberResult>& members, const std::string& data, std::vector<Claim>& claims) {
  const std::string more =
      "These objects have few colors, each spread over large areas, which a coarser grid tells "
      "apart as well.";
  const std::string few =
      "Nearly all that a histogram of distances to one reference color tells is told by fewer bins.";
  add_claim(members, data + ": n_c = 24 is better than 16", &MemberResult::n_c, 16, 24, 0.0, false, more, claims);
  add_claim(members, data + ": n_c = 32 gains less than a point over 24", &MemberResult::n_c, 24, 32, -0.01, true,
            "More color cells still pay here.", claims);
  add_claim(members, data + ": h = 15 is better than 10", &MemberResult::h, 10, 15, 0.0, false, few, claims);
  add_claim(members, data + ": h = 30 is better than 15", &MemberResult::h, 15, 30, 0.0, false, few, claims);
  add_claim(members, data + ": h = 35 gains less than a point over 30", &MemberResult::h, 30, 35, -0.01, true,
            "Finer bins still pay here.", claims);
  add_claim(members, data + ": n_g = 128 gains less than a point over 96", &MemberResult::n_g, 96, 128, -0.01, true,
            "Finer shape cells still pay here.", claims);
}

}  // namespace

Findings ablation_report(const nlohmann::ordered_json& parameters, const UnitResults& results,
                         const std::string& directory) {
  Findings findings;
  campaign::Report& report = findings.report;
  report.title = "Sizes of SCSH";
  report.parameters = parameters;
  std::vector<Claim> claims;
  std::size_t number = 0;
  for (const TaskResults& task : tasks_of(parameters, results)) {
    const std::string prefix = "task" + std::to_string(++number) + "_";
    const std::vector<MemberResult> members = members_of(parameters, task);
    report.sections.push_back({task.name,
                               "Accuracies of the Hough vote in percent with 95 % bootstrap intervals over objects.",
                               {{prefix + "sizes", accuracy_table(members, task, findings.figures)}},
                               draw(members, task, prefix, directory)});
    add_claims(members, task.name, claims);
  }
  report.sections.push_back(section_of(claims));
  report.sections.push_back(section_of(findings.figures));
  return findings;
}

}  // namespace shortshot_bench::paper
