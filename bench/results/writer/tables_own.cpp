// Our own figures: machine, stages, instructions, scaling.
#include <algorithm>
#include <set>
#include <stdexcept>

#include "results/writer/markdown.hpp"
#include "results/writer/tables.hpp"
#include "speed/scaling/plots.hpp"

namespace shortshot_bench::results {
namespace {

/// What Google Benchmark itself writes about a run; all other numbers are user counters.
const std::set<std::string> benchmark_keys{"name",
                                           "run_name",
                                           "run_type",
                                           "repetitions",
                                           "threads",
                                           "iterations",
                                           "real_time",
                                           "cpu_time",
                                           "time_unit",
                                           "aggregate_name",
                                           "aggregate_unit",
                                           "family_index",
                                           "repetition_index",
                                           "per_family_instance_index"};

bool is_median(const JsonRow& row) { return row.has("aggregate_name") && row.text("aggregate_name") == "median"; }

std::vector<std::string> counters_of(const std::vector<JsonRow>& runs) {
  std::vector<std::string> names;
  for (const JsonRow& run : runs) {
    for (const auto& [key, value] : run.object().items()) {
      const bool counter = value.is_number() && benchmark_keys.count(key) == 0;
      if (counter && std::find(names.begin(), names.end(), key) == names.end()) names.push_back(key);
    }
  }
  return names;
}

std::string without_suffix(const std::string& text, const std::string& suffix) {
  const bool ends =
      text.size() > suffix.size() && text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
  return ends ? text.substr(0, text.size() - suffix.size()) : text;
}

/// Of instructions: 93.3, or 212 million.
std::string count_of(double count) { return count < 1e6 ? digits(count) : digits(1e-6 * count) + " million"; }

/// Rows are the curve's x, columns its series and the largest extra memory of any of them.
std::string scaling_table(const std::vector<CurvePoint>& points) {
  const std::vector<std::string> series = scaling::distinct(points, &CurvePoint::series);
  std::vector<std::string> header{points.front().x_name};
  for (const std::string& name : series) header.push_back(name + ", " + points.front().unit);
  header.push_back("extra memory");
  Table table(header);
  std::vector<double> xs;
  for (const CurvePoint& p : points) {
    if (std::find(xs.begin(), xs.end(), p.x) == xs.end()) xs.push_back(p.x);
  }
  for (const double x : xs) {
    std::vector<std::string> row{whole(x)};
    double extra_bytes = 0.0;
    for (const std::string& name : series) {
      const auto p = std::find_if(points.begin(), points.end(),
                                  [&](const CurvePoint& other) { return other.x == x && other.series == name; });
      row.push_back(p == points.end() ? "" : digits(p->value));
      if (p != points.end()) extra_bytes = std::max(extra_bytes, p->extra_bytes);
    }
    row.push_back(megabytes(extra_bytes));
    table.add(row);
  }
  return table.markdown();
}

}  // namespace

std::string machine_lines(const Machine& machine) {
  return "\n" + machine.cpu + ", " + std::to_string(machine.cores) + " cores; " + machine.system + "; " +
         machine.compiler + ", `" + machine.flags + "`.\n\n";
}

std::string micro_table(const std::string& path, const nlohmann::ordered_json& json) {
  if (!json.is_object() || !json.contains("benchmarks")) {
    throw std::runtime_error(path + ": 'benchmarks' is missing: this is not what Google Benchmark writes");
  }
  const std::vector<JsonRow> all = scaling::rows_of(path, json["benchmarks"]);
  for (const JsonRow& run : all) {
    if (run.has("error_occurred")) run.fail(run.text("name") + ": " + run.text("error_message"));
  }
  std::vector<JsonRow> runs;
  std::copy_if(all.begin(), all.end(), std::back_inserter(runs), is_median);
  if (runs.empty()) runs = all;
  const std::vector<std::string> counters = counters_of(runs);
  std::vector<std::string> header{"stage", "CPU time", ""};
  for (const std::string& counter : counters) header.push_back(counter);
  Table table(header);
  for (const JsonRow& run : runs) {
    std::vector<std::string> row{without_suffix(run.text("name"), "_median"), digits(run.number("cpu_time")),
                                 run.text("time_unit")};
    for (const std::string& counter : counters) {
      row.push_back(run.has(counter.c_str()) ? digits(run.number(counter.c_str())) : "");
    }
    table.add(row);
  }
  return "\n" + table.markdown() + "\n";
}

std::string instructions_table(const std::string& path, const nlohmann::ordered_json& json) {
  const JsonRow record(path, 1, json);
  Table table({"stage", "instructions", "for each"});
  for (const char* key : {"instructions_per_point", "instructions_per_neighbor", "instructions_per_frame"}) {
    const JsonRow figures(path, 1, record.value(key));
    const std::string unit = std::string(key).substr(std::string(key).rfind('_') + 1);
    for (const auto& [name, value] : figures.object().items())
      table.add({name, count_of(figures.number(name.c_str())), unit});
  }
  return "\n" + record.text("workload") + "; " + record.text("compiler") + ", `" + record.text("flags") + "`.\n\n" +
         table.markdown() + "\n";
}

std::string scaling_tables(const std::vector<CurvePoint>& points, const std::string& plots) {
  std::string text;
  for (const std::string& name : scaling::distinct(points, &CurvePoint::curve)) {
    const std::vector<CurvePoint> curve = scaling::with(points, &CurvePoint::curve, name);
    text += "\n### Against " + curve.front().x_name + "\n\n![cost and extra memory against " + curve.front().x_name +
            "](" + plots + "/" + scaling::plot_name(name) + ")\n\n" + scaling_table(curve);
  }
  return text + "\n";
}

}  // namespace shortshot_bench::results
