#include <algorithm>
#include <cmath>

#include "tradeoff/map.hpp"
#include "tradeoff/map_plots.hpp"

namespace shortshot_bench::tradeoff {
namespace {

using campaign::Cell;
using campaign::Section;
using campaign::Table;

constexpr double none = campaign::automatic;  // shown as "-"

Cell shown(double value, int digits) { return {value > 0.0 ? value : none, digits}; }

/// Those of the library, and whatever is on the front: a table of all would be for nobody.
bool is_listed(const Entry& entry) { return entry.kind != Kind::relative || entry.on_front; }

Table map_table(const Map& map, const std::string& title, bool all) {
  Table table(title, {"descriptor", "bytes", "front", "score", "least", "shape", "us", "time", "instructions",
                      "M7 flash", "M7 instructions"});
  for (const Entry& e : map.entries) {
    if (!all && !is_listed(e)) continue;
    table.add({e.name, e.size_bytes, e.on_front ? "*" : "", shown(e.score, 2), shown(e.least, 2), shown(e.shape, 2),
               shown(e.cost.microseconds, 1), shown(e.cost.relative, 2), shown(e.cost.instructions, 0),
               shown(e.board.flash_bytes, 0), shown(e.board.instructions_per_neighbor, 0)});
  }
  return table;
}

/// The library's compact ones as they are meant to be stored, and what they are to be measured by.
bool is_headline(const Entry& entry) {
  const auto ends_with = [&](const std::string& end) {
    return entry.name.size() > end.size() && entry.name.compare(entry.name.size() - end.size(), end.size(), end) == 0;
  };
  if (entry.kind == Kind::compact) return ends_with("-4bit") || ends_with("-sums44");
  return entry.name == "scsh336-float" || entry.name == plain_baseline;
}

/// For a README.
Table headline_table(const Map& map) {
  Table table("The library's compact descriptors",
              {"descriptor", "bytes", "right matches, over CSHOT's", "the worst set", "us per key point"});
  for (const Entry& e : map.entries) {
    if (!is_headline(e) && e.name != color_baseline) continue;
    table.add({e.name, e.size_bytes, shown(e.score, 2), shown(e.least, 2), shown(e.cost.microseconds, 1)});
  }
  return table;
}

/// A row for each measure of these figures, a column for each headline entry: `cell(measure, entry)`.
template <class CellOf>
Table overview(const Map& map, const std::string& title, const std::vector<Figure>& figures, const CellOf& cell) {
  std::vector<std::string> columns{"data", "items", "baseline"};
  for (const Entry& e : map.entries) {
    if (is_headline(e)) columns.push_back(e.name);
  }
  Table table(title, columns);
  for (const Measure& m : map.measures) {
    if (std::find(figures.begin(), figures.end(), m.info.figure) == figures.end() || !m.has(m.info.baseline)) continue;
    std::vector<Cell> row{m.info.name, m.items.size(), paper::text_of(m.share(m.info.baseline), 3)};
    for (const Entry& e : map.entries) {
      if (is_headline(e)) row.emplace_back(m.has(e.name) ? cell(m, e) : std::string("-"));
    }
    table.add(row);
  }
  return table;
}

std::string ratio_text(const Measure& m, const Entry& e) {
  return m.pooled(m.info.baseline) > 0.0 ? paper::text_of(m.ratio(e.name, m.info.baseline), 2) : "-";
}
std::string difference_text(const Measure& m, const Entry& e) {
  return paper::text_of(m.difference(e.name, m.info.baseline), 3);
}
std::string share_text(const Measure& m, const Entry& e) { return paper::text_of(m.share(e.name), 3); }

const Measure* find(const Map& map, const std::string& name) {
  const auto place =
      std::find_if(map.measures.begin(), map.measures.end(), [&](const Measure& m) { return m.info.name == name; });
  return place == map.measures.end() ? nullptr : &*place;
}

/// What other light costs: the share at rest less the share then.
Table lost_table(const Map& map) {
  std::vector<std::string> columns{"data", "baseline"};
  for (const Entry& e : map.entries) {
    if (is_headline(e)) columns.push_back(e.name);
  }
  Table table("Share lost under other light", columns);
  for (const Measure& m : map.measures) {
    const Measure* const rest = find(map, m.info.at_rest);
    if (rest == nullptr || !m.has(m.info.baseline) || !rest->has(m.info.baseline)) continue;
    const auto lost = [&](const std::string& entry) {
      return m.has(entry) && rest->has(entry) ? Cell(rest->pooled(entry) - m.pooled(entry), 3) : Cell(none, 3);
    };
    std::vector<Cell> row{m.info.name, lost(m.info.baseline)};
    for (const Entry& e : map.entries) {
      if (is_headline(e)) row.push_back(lost(e.name));
    }
    table.add(row);
  }
  return table;
}

Section map_section(const Map& map) {
  return {
      "The map",
      "Score: the geometric mean, over the data sets with color, of the share of right matches (or of key points "
      "whose nearest neighbor is of the right instance) over that of CSHOT in 5,376 bytes; least: its worst set. "
      "Shape: the same over the sets without color, against SHOT in 1,408 bytes. Front: nothing else that is as "
      "small and as fast scores as high. Time: over that of SCSH-336 in floats. " +
          cost_workload() +
          " On a Cortex-M7 (emulated, -Os): flash with a brute-force search, and instructions a neighbor. Relatives "
          "are named after their grids: hRxExA for points, mRxA for mean colors, cRxB for rings of B bins.",
      {{"headline", headline_table(map)},
       {"map", map_table(map, "The library's own, and the front", false)},
       {"all", map_table(map, "All", true)}},
      {"score_by_bytes.svg", "score_by_time.svg"}};
}

Section overview_section(const Map& map) {
  return {"Set by set",
          "Baseline: CSHOT in its own frame; without color SHOT in its own frame; painted in one color SHOT in a frame "
          "that looks at the camera. With 95 % bootstrap intervals.",
          {{"ratios", overview(map, "Share of right matches, over the baseline's",
                               {Figure::match_rate, Figure::right_instance}, ratio_text)},
           {"inliers", overview(map, "Right ones of reciprocal matches", {Figure::inlier_ratio}, share_text)},
           {"hough", overview(map, "Right instances of the Hough vote, less the baseline's", {Figure::hough_instance},
                              difference_text)},
           {"lost", lost_table(map)}},
          {}};
}

Table best_table(const Map& map) {
  Table table("The best within so many bytes", {"bytes at most", "descriptor", "bytes", "score", "us"});
  for (const int bytes : {16, 32, 48, 64, 100, 128, 256, 512, 1024, 2048, 6000}) {
    const Entry* const best = best_within(map, bytes, 0.0);
    if (best == nullptr) continue;
    table.add({bytes, best->name, best->size_bytes, shown(best->score > 0.0 ? best->score : best->shape, 2),
               shown(best->cost.microseconds, 1)});
  }
  return table;
}

std::string figure_name(Figure figure) {
  switch (figure) {
    case Figure::match_rate: return "match rate";
    case Figure::inlier_ratio: return "inlier ratio";
    case Figure::right_instance: return "right instance";
    case Figure::hough_instance: return "instance, Hough";
  }
  return {};
}

/// One row for each entry that is listed: its share, and what it is next to the baseline's.
Table measure_table(const Map& map, const Measure& m, std::vector<paper::FigureValue>& figures) {
  const std::string figure = figure_name(m.info.figure);
  const std::string baseline = m.info.baseline;
  const bool of_the_same = m.info.figure != Figure::inlier_ratio && m.has(baseline) && m.pooled(baseline) > 0.0;
  Table table(m.info.name, {"descriptor", "bytes", figure, "over " + baseline, "difference"});
  for (const Entry& e : map.entries) {
    if (!is_listed(e) || !m.has(e.name)) continue;
    figures.push_back({m.info.name, e.name, figure, m.share(e.name)});
    std::vector<Cell> row{e.name, e.size_bytes, paper::text_of(figures.back().interval, 3)};
    if (of_the_same) {
      figures.push_back({m.info.name, e.name, figure + ", over baseline", m.ratio(e.name, baseline)});
      row.emplace_back(paper::text_of(figures.back().interval, 2));
      row.emplace_back(paper::text_of(m.difference(e.name, baseline), 3));
    } else {
      row.insert(row.end(), {Cell(""), Cell("")});
    }
    table.add(row);
  }
  return table;
}

}  // namespace

paper::Findings report_of(const Map& map, const nlohmann::ordered_json& parameters, const std::string& directory) {
  paper::Findings findings;
  findings.report.title = "Bytes, time and accuracy";
  findings.report.parameters = parameters;
  findings.report.sections.push_back(map_section(map));
  findings.report.sections.push_back({"The best within limits", "", {{"best", best_table(map)}}, {}});
  findings.report.sections.push_back(overview_section(map));
  std::size_t number = 0;
  for (const Measure& m : map.measures) {
    if (m.items.empty()) continue;
    const std::string name = "measure" + std::to_string(++number);
    const char* const items = m.info.figure < Figure::right_instance ? " pairs" : " views";
    findings.report.sections.push_back({m.info.name,
                                        std::to_string(m.items.size()) + items + ", with 95 % bootstrap intervals.",
                                        {{name, measure_table(map, m, findings.figures)}},
                                        {}});
  }
  findings.report.sections.push_back(paper::section_of(findings.figures));
  if (std::any_of(map.entries.begin(), map.entries.end(), [](const Entry& e) { return e.score > 0.0; })) {
    draw_scores(map, directory);
  } else {
    findings.report.sections.front().plots.clear();
  }
  return findings;
}

}  // namespace shortshot_bench::tradeoff
