// Key points with the surest frames, and as many at random, as configurations of the experiments.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "paper/kept_frames.hpp"
#include "paper/matching.hpp"
#include "paper/matching_experiment.hpp"
#include "paper/view.hpp"
#include "relief.hpp"

namespace test_paper_kept_frames {
namespace {

using namespace shortshot_bench::paper;

std::vector<bool> kept_by(const View& view, const std::string& name) {
  const Described described = view.describe(configurations_named({name}).front());
  std::vector<bool> kept;
  for (const shortshot::Status status : described.status) kept.push_back(status == shortshot::Status::ok);
  return kept;
}

std::size_t count_of(const std::vector<bool>& kept) {
  return static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
}

}  // namespace

TEST_CASE("kept frames: names say which, how many, and of what") {
  const auto check = [](const std::string& name, const std::string& descriptor, unsigned percent, bool at_random) {
    CAPTURE(name);
    const KeptName parts = kept_name_of(name);
    CHECK(parts.descriptor == descriptor);
    CHECK(parts.kept.percent == percent);
    CHECK(parts.kept.at_random == at_random);
    if (percent < 100) CHECK(name_of(parts) == name);
  };
  check("scsh336", "scsh336", 100, false);
  check("scsh336-best50", "scsh336", 50, false);
  check("scsh336-random5", "scsh336", 5, true);
  for (const char* other : {"a-best", "a-best0", "a-best05", "a-best100", "a-best5x", "a-worst50"}) {
    check(other, other, 100, false);
  }
  CHECK(keeps_frames({"a", "a-best50"}));
  CHECK_FALSE(keeps_frames({"a", "b"}));
}

TEST_CASE("kept frames: the control keeps as many, but others; less of it is part of more") {
  const View view(paper_test::view_of({}, paper_test::turned(0.0), 1), ViewSettings{});
  const std::size_t all = count_of(kept_by(view, "ssh32"));
  const std::vector<bool> best = kept_by(view, "ssh32-best50");
  const std::vector<bool> random = kept_by(view, "ssh32-random50");
  const std::vector<bool> fewer = kept_by(view, "ssh32-random25");
  REQUIRE(all > 20);
  CHECK(count_of(best) == (all + 1) / 2);
  CHECK(count_of(random) == count_of(best));
  CHECK(best != random);
  for (std::size_t i = 0; i < fewer.size(); ++i) CHECK((!fewer[i] || random[i]));
}

TEST_CASE("kept frames: a table of the report compares both") {
  const std::vector<std::string> names = with_kept_frames({"ssh32"}, {50});
  std::vector<Matching> matchings;
  for (std::size_t i = 0; i < names.size(); ++i) {
    matchings.push_back({names[i], 100, 80, 10, 50, 20 - 5 * i, {Trial{}}});  // precision .4, .3, .2
  }
  const nlohmann::ordered_json parameters = {
      {"experiment", "matching"},
      {"quick", true},
      {"descriptors", to_json(configurations_named(names))},
      {"sets",
       {{{"name", "reliefs"}, {"kind", "views"}, {"pairs", {{{"key", "a"}, {"group", "a"}, {"rotation_deg", 20.0}}}}}}},
      {"units", {"a"}}};
  const Findings findings =
      matching_report(parameters, {{"a", to_json(matchings)}}, std::string(SHORTSHOT_TEST_OUTPUT));
  const auto& table = findings.report.sections.front().tables.back();
  CHECK(table.name == "set1_kept_frames");
  const nlohmann::ordered_json rows = table.table.json();
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].at("kept, %") == 50);
  CHECK(rows[1].at("precision") == "0.300 [0.300, 0.300]");
  CHECK(rows[1].at("precision at random") == "0.200 [0.200, 0.200]");
  CHECK(rows[1].at("precision, difference") == "0.100 [0.100, 0.100]");
  CHECK(rows[1].at("right matches, difference") == "5.0 [5.0, 5.0]");
}

}  // namespace test_paper_kept_frames
