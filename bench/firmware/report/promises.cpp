#include "firmware/report/promises.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace shortshot_bench::firmware {
namespace {

bool is_among(const std::string& word, const std::vector<std::string>& list) {
  return list.empty() || std::find(list.begin(), list.end(), word) != list.end();
}

std::string number(double value) {
  std::ostringstream out;
  out.precision(7);
  out << value;
  return out.str();
}

/// Is one of the lines `text`, or does it start with it and a space?
bool has_line(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line == text || line.compare(0, text.size() + 1, text + " ") == 0;
  });
}

/// What is wrong with an image that breaks a promise on purpose; empty if it was noticed.
std::string unnoticed(const Facts& image, const Hashes& committed) {
  const std::string reported = image.text("must_report");
  if (!reported.empty() && !has_line(image.all("check"), "broken: " + reported)) {
    return "'" + reported + "' is broken on purpose, and the check does not say so";
  }
  const std::string refused = image.text("must_not_link");
  if (!refused.empty() && !has_line(image.all("linker"), refused)) {
    return "'" + refused + "' is broken on purpose, and the linker script does not say so";
  }
  const std::string code = image.text("must_exit");
  if (!code.empty() && image.text("exit") != code) return "exit code " + image.text("exit") + " instead of " + code;
  const std::vector<Hash> hashes = hashes_of(image);
  const bool differs = std::any_of(hashes.begin(), hashes.end(), [&](const Hash& hash) {
    return committed.count(hash.configuration) != 0 && committed.at(hash.configuration) != hash.value;
  });
  if (image.text("must") == "differ" && !differs) return "has the same bits, or none";
  return reported.empty() && code.empty() && image.text("must").empty() ? "controls nothing" : "";
}

/// What a budget is about.
std::vector<const Row*> rows_of(const Budget& budget, const std::vector<Row>& rows) {
  std::vector<const Row*> found;
  for (const Row& row : rows) {
    if (row.figures.count(budget.figure) != 0 && is_among(row.target, budget.targets) &&
        is_among(row.level, budget.levels) && is_among(row.configuration, budget.configurations) &&
        is_among(row.workspace, budget.workspaces)) {
      found.push_back(&row);
    }
  }
  return found;
}

std::string described(const Budget& budget, const Row& row) {
  return budget.promise + ": " + number(row.figures.at(budget.figure)) + " (" + row.configuration + " on " +
         row.target + " -" + row.level + ", " + row.workspace + " workspace)";
}

}  // namespace

std::vector<Budget> parse_budgets(const std::string& json) {
  std::vector<Budget> budgets;
  for (const auto& entry : nlohmann::ordered_json::parse(json)) {
    const auto list = [&](const char* name) { return entry.value(name, std::vector<std::string>{}); };
    budgets.push_back({entry.at("promise"), entry.at("figure"), entry.at("at_most"),
                       entry.value("goal", entry.at("at_most").get<double>()), list("targets"), list("levels"),
                       list("configurations"), list("workspaces")});
  }
  if (budgets.empty()) throw std::runtime_error("there is no budget");
  return budgets;
}

std::vector<Budget> without(const std::vector<Budget>& budgets, const std::vector<std::string>& skipped) {
  std::vector<Budget> kept;
  std::copy_if(budgets.begin(), budgets.end(), std::back_inserter(kept), [&](const Budget& budget) {
    const std::vector<std::string>& all = budget.configurations;
    const bool is_measured = std::any_of(all.begin(), all.end(), [&](const std::string& configuration) {
      return std::find(skipped.begin(), skipped.end(), configuration) == skipped.end();
    });
    return all.empty() || is_measured;
  });
  return kept;
}

Hashes parse_hashes(const std::string& json) { return nlohmann::json::parse(json).get<Hashes>(); }

std::string to_json(const Hashes& hashes) { return nlohmann::json(hashes).dump(2) + "\n"; }

std::vector<std::string> broken_budgets(const std::vector<Budget>& budgets, const std::vector<Row>& rows) {
  std::vector<std::string> lines;
  for (const Budget& budget : budgets) {
    const std::vector<const Row*> measured = rows_of(budget, rows);
    for (const Row* row : measured) {
      const double figure = row->figures.at(budget.figure);
      if (figure > budget.at_most) lines.push_back(described(budget, *row) + ", promised " + number(budget.at_most));
    }
    if (measured.empty()) lines.push_back(budget.promise + ": not measured (" + budget.figure + ")");
  }
  return lines;
}

const Row* worst_row(const Budget& budget, const std::vector<Row>& rows) {
  const std::vector<const Row*> measured = rows_of(budget, rows);
  const auto worst = std::max_element(measured.begin(), measured.end(), [&](const Row* a, const Row* b) {
    return a->figures.at(budget.figure) < b->figures.at(budget.figure);
  });
  return worst == measured.end() ? nullptr : *worst;
}

std::vector<std::string> missed_goals(const std::vector<Budget>& budgets, const std::vector<Row>& rows) {
  std::vector<std::string> lines;
  for (const Budget& budget : budgets) {
    const Row* const worst = worst_row(budget, rows);
    if (worst == nullptr || worst->figures.at(budget.figure) <= budget.goal) continue;
    lines.push_back(described(budget, *worst) + ", goal " + number(budget.goal));
  }
  return lines;
}

std::vector<std::string> broken_hashes(const Hashes& committed, const std::vector<Hash>& hashes) {
  std::vector<std::string> lines;
  Hashes known = committed;
  for (const Hash& hash : hashes) {
    if (hash.target == "host" && is_of_recordings(hash.configuration)) known[hash.configuration] = hash.value;
  }
  for (const Hash& hash : hashes) {
    const auto expected = known.find(hash.configuration);
    const std::string wanted = expected == known.end() ? "none" : expected->second;
    if (hash.value == wanted) continue;
    lines.push_back("same bits: " + hash.configuration + " on " + hash.target + " -" + hash.level + " has the hash " +
                    hash.value + ", " + (is_of_recordings(hash.configuration) ? "the host: " : "committed: ") + wanted);
  }
  for (const auto& [configuration, value] : committed) {
    const bool computed = std::any_of(hashes.begin(), hashes.end(),
                                      [&, &name = configuration](const Hash& h) { return h.configuration == name; });
    if (!computed) lines.push_back("same bits: " + configuration + " was not computed");
  }
  return lines;
}

bool is_of_recordings(const std::string& configuration) { return configuration == "Segments"; }

std::vector<std::string> broken_images(const std::vector<Facts>& images, const Hashes& committed) {
  std::vector<std::string> lines;
  for (const Facts& image : images) {
    const std::string program = image.text("program");
    if (program == "control") {
      const std::string what = unnoticed(image, committed);
      if (!what.empty()) lines.push_back("negative control " + image.text("control") + ": " + what);
      continue;
    }
    const std::vector<std::string> checks = image.all("check");
    for (const std::string& finding : checks) {
      const std::string broken = "broken: ";
      if (finding.compare(0, broken.size(), broken) == 0)
        lines.push_back(finding.substr(broken.size()) + " in " + image.name());
    }
    if (program == "size" && checks.empty()) lines.push_back("image checks: nothing was checked in " + image.name());
    if (program != "size" && image.text("exit") != "0") {
      lines.push_back(image.name() + ": exit code " + image.text("exit") + "; see its file of facts");
    }
  }
  return lines;
}

}  // namespace shortshot_bench::firmware
