// The map of trade-offs: what is counted, scores, the front, and the best within limits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "paper/campaign/atomic_file.hpp"
#include "tradeoff/map.hpp"
#include "tradeoff/map_plots.hpp"
#include "tradeoff/options.hpp"

namespace test_tradeoff_map {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::tradeoff;

const std::string color_set = "generated views";

Item item(const std::string& measure, const std::string& name,
          const std::map<std::string, campaign::Fraction>& counts) {
  return {measure, name, "group of " + name, counts};
}

/// Two pairs with color: "small" finds twice as much as CSHOT, "large" as much as "small"; "half" half as much.
struct Fixture {
  nlohmann::ordered_json parameters;
  paper::UnitResults results;
  Costs costs;

  Fixture() {
    parameters["measures"] = nlohmann::ordered_json::array();
    parameters["measures"].push_back(MeasureInfo{color_set, Figure::match_rate, color_baseline, true, ""});
    parameters["entries"] = nlohmann::ordered_json::array();
    for (const auto& [name, bytes] : std::vector<std::pair<std::string, int>>{
             {color_baseline, 5376}, {"large", 200}, {"small", 32}, {"half", 16}, {"slow", 16}}) {
      parameters["entries"].push_back({{"name", name}, {"size_bytes", bytes}, {"kind", 1}, {"board_name", ""}});
      costs[name] = {name == "slow" ? 20.0 : 10.0, name == "slow" ? 2.0 : 1.0, 0.0};
    }
    const std::map<std::string, campaign::Fraction> first{{color_baseline, {10, 100}},
                                                          {"large", {20, 100}},
                                                          {"small", {20, 100}},
                                                          {"half", {5, 100}},
                                                          {"slow", {5, 100}}};
    const std::map<std::string, campaign::Fraction> second{{color_baseline, {30, 100}},
                                                           {"large", {60, 100}},
                                                           {"small", {60, 100}},
                                                           {"half", {15, 100}},
                                                           {"slow", {15, 100}}};
    results.push_back({"one", to_json(std::vector<Item>{item(color_set, "one", first)})});
    results.push_back({"two", to_json(std::vector<Item>{item(color_set, "two", second)})});
  }
  Map map() const { return make_map(parameters, results, costs, SHORTSHOT_FIRMWARE_RESULTS); }
};

const Entry& entry(const Map& map, const std::string& name) {
  return *std::find_if(map.entries.begin(), map.entries.end(), [&](const Entry& e) { return e.name == name; });
}

TEST_CASE("an entry's score is its share over the baseline's") {
  const Map map = Fixture().map();
  CHECK(entry(map, color_baseline).score == doctest::Approx(1.0));
  CHECK(entry(map, "small").score == doctest::Approx(2.0));
  CHECK(entry(map, "half").score == doctest::Approx(0.5));
  CHECK(entry(map, "half").least == doctest::Approx(0.5));
  CHECK(map.measures.front().pooled("small") == doctest::Approx(0.4));
  CHECK(map.measures.front().ratio("small", color_baseline).value == doctest::Approx(2.0));
  CHECK(map.measures.front().difference("small", color_baseline).value == doctest::Approx(0.2));
}

TEST_CASE("the front holds whatever nothing beats in bytes, time and score") {
  const Map map = Fixture().map();
  CHECK(entry(map, "small").on_front);
  CHECK(entry(map, "half").on_front);         // fewer bytes
  CHECK_FALSE(entry(map, "large").on_front);  // as good in more bytes
  CHECK_FALSE(entry(map, "slow").on_front);   // as good and as small, but slower
  CHECK_FALSE(entry(map, color_baseline).on_front);
}

TEST_CASE("the best within limits") {
  const Map map = Fixture().map();
  CHECK(best_within(map, 0.0, 0.0)->name == "small");
  CHECK(best_within(map, 31.0, 0.0)->name == "half");
  CHECK(best_within(map, 100.0, 15.0)->name == "small");
  CHECK(best_within(map, 15.0, 0.0) == nullptr);
  CHECK(best_within(map, 0.0, 9.0) == nullptr);
}

TEST_CASE("counts of one item from several units come together, and an entry that lacks some has no score") {
  Fixture fixture;
  fixture.parameters["entries"].push_back({{"name", "late"}, {"size_bytes", 8}, {"kind", 1}, {"board_name", ""}});
  fixture.results.push_back({"late", to_json(std::vector<Item>{item(color_set, "one", {{"late", {40, 100}}})})});
  const Map map = fixture.map();
  CHECK(map.measures.front().items.size() == 2);
  CHECK_FALSE(map.measures.front().has("late"));
  CHECK(entry(map, "late").score == 0.0);
  CHECK_FALSE(entry(map, "late").on_front);
}

TEST_CASE("shares of different wholes have no ratio") {
  Fixture fixture;
  fixture.results.front().result =
      to_json(std::vector<Item>{item(color_set, "one", {{color_baseline, {10, 100}}, {"small", {20, 90}}})});
  CHECK_THROWS_AS(fixture.map().measures.front().ratio("small", color_baseline), std::logic_error);
}

TEST_CASE("figures of microcontrollers are found by the configuration's name") {
  Fixture fixture;
  fixture.parameters["entries"][1]["board_name"] = "Scsh336";
  const Map map = fixture.map();
  CHECK(entry(map, "large").board.flash_bytes > 1000.0);
  CHECK(entry(map, "large").board.instructions_per_neighbor > 100.0);
  CHECK(entry(map, "small").board.flash_bytes == 0.0);
}

TEST_CASE("entries are points; only what is best so far is joined, and never falls") {
  Map map;
  for (const auto& [bytes, score] : {std::pair(8u, 0.7), {16u, 0.5}, {32u, 1.5}, {64u, 0.0}, {96u, 1.2}}) {
    Entry& entry = map.entries.emplace_back();
    entry.size_bytes = bytes;
    entry.cost.microseconds = 104.0 - bytes;
    entry.score = score;
  }
  const campaign::Plot by_bytes = score_by_bytes(map);
  REQUIRE(by_bytes.series.size() == 4);
  for (std::size_t kind = 0; kind < 3; ++kind) CHECK(by_bytes.series[kind].marks == campaign::Marks::points);
  CHECK(by_bytes.series[0].xs == std::vector<double>{8.0, 16.0, 32.0, 96.0});  // without the one that has no score
  CHECK(by_bytes.series[3].marks == campaign::Marks::steps);
  CHECK(by_bytes.series[3].xs == std::vector<double>{8.0, 32.0, 96.0});
  CHECK(by_bytes.series[3].ys == std::vector<double>{0.7, 1.5, 1.5});
  CHECK(score_by_time(map).series[3].xs == std::vector<double>{8.0, 72.0, 96.0});
  CHECK(score_by_time(map).series[3].ys == std::vector<double>{1.2, 1.5, 1.5});
}

TEST_CASE("the report has the map and every measure, and draws the plots") {
  const Fixture fixture;
  const std::string folder = std::string(SHORTSHOT_TEST_OUTPUT) + "/tradeoff_report";
  campaign::make_directory(folder);
  const paper::Findings findings = report_of(fixture.map(), fixture.parameters, folder);
  const std::string text = campaign::markdown_of(findings.report);
  CHECK(text.find("| small | 32 | * | 2.00 |") != std::string::npos);
  CHECK(text.find(color_set) != std::string::npos);
  CHECK(std::ifstream(folder + "/score_by_bytes.svg").good());
  CHECK(std::ifstream(folder + "/score_by_time.svg").good());
  CHECK(std::any_of(findings.figures.begin(), findings.figures.end(), [](const paper::FigureValue& f) {
    return f.descriptor == "small" && f.figure == "match rate, over baseline" &&
           std::fabs(f.interval.value - 2.0) < 1e-9;
  }));
}

bool parse(std::vector<const char*> arguments, TradeoffOptions& options, int& exit_code) {
  arguments.insert(arguments.begin(), "tradeoff");
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), options, exit_code);
}

TEST_CASE("options") {
  TradeoffOptions options;
  int exit_code = 0;
  REQUIRE(parse({"draw", "data", "--shard", "2/3", "--bytes", "64", "--quick"}, options, exit_code));
  CHECK(options.command == "draw");
  CHECK(options.shard.k == 2);
  CHECK(options.most_bytes == 64.0);
  CHECK(options.quick);
  for (const std::vector<const char*>& wrong : std::vector<std::vector<const char*>>{
           {}, {"draw"}, {"draw", "data", "--bytes", "-1"}, {"draw", "data", "--shard", "4/3"}, {"paint", "data"}}) {
    CHECK_FALSE(parse(wrong, options, exit_code));
    CHECK(exit_code == 2);
  }
}

}  // namespace

}  // namespace test_tradeoff_map
