// Tables and reports: the exact text of each format.

#include <doctest/doctest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "cloud_file_samples.hpp"
#include "paper/campaign/report.hpp"
#include "paper/campaign/table.hpp"

namespace test_campaign_report {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::campaign;
using cloud_file_test::read_bytes;
using cloud_file_test::TemporaryDirectory;

Table matches() {
  Table table("Matches of made-up pairs", {"descriptor", "bytes", "precision", "note"});
  table.add({"SSH-32", 128, {0.8766, 3}, ""});
  table.add({"with, \"all\"", 1344u, {12.5, 3}, "a|b"});
  table.add({"\u00b1", 0, {std::numeric_limits<double>::quiet_NaN(), 3}, "two\nlines"});
  return table;
}

Report report() {
  return {"Matching",
          {{"Precision", "Higher is better.", {{"precision", matches()}}, {"precision.svg"}}, {"Nothing", {}, {}, {}}},
          {{"radius", 0.02}, {"set", "desk"}, {"seeds", {1, 2}}}};
}

}  // namespace

TEST_CASE("a table for the terminal is aligned: numbers to the right, text to the left") {
  Table table("Title", {"descriptor", "bytes", "precision"});
  table.add({"SSH-32", 128, {0.8766, 3}});
  table.add({"\u00b1", 13440, {-12.5, 1}});
  CHECK(table.text() ==
        "Title\n"
        "descriptor  bytes  precision\n"
        "----------  -----  ---------\n"
        "SSH-32        128      0.877\n"
        "\u00b1           13440      -12.5\n");
  CHECK(Table("Empty", {"a", "b"}).text() == "Empty\na  b\n-  -\n");
}

TEST_CASE("a table as CSV quotes what needs it") {
  CHECK(matches().csv() ==
        "descriptor,bytes,precision,note\n"
        "SSH-32,128,0.877,\n"
        "\"with, \"\"all\"\"\",1344,12.500,a|b\n"
        "\u00b1,0,,\"two\nlines\"\n");
}

TEST_CASE("a table as Markdown") {
  CHECK(matches().markdown() ==
        "| descriptor | bytes | precision | note |\n"
        "|---|---:|---:|---|\n"
        "| SSH-32 | 128 | 0.877 | |\n"
        "| with, \"all\" | 1344 | 12.500 | a\\|b |\n"
        "| \u00b1 | 0 | - | two lines |\n");
}

TEST_CASE("a table as JSON has all digits") {
  CHECK(matches().json().dump() ==
        R"([{"descriptor":"SSH-32","bytes":128,"precision":0.8766,"note":""},)"
        R"({"descriptor":"with, \"all\"","bytes":1344,"precision":12.5,"note":"a|b"},)"
        "{\"descriptor\":\"\u00b1\",\"bytes\":0,\"precision\":null,\"note\":\"two\\nlines\"}]");
  CHECK(Table("Empty", {"a"}).json().dump() == "[]");
}

TEST_CASE("tables that cannot be are refused") {
  CHECK_THROWS_AS(Table("t", {}), std::invalid_argument);
  CHECK_THROWS_AS(Table("t", {"a", "b", "a"}), std::invalid_argument);
  Table table("t", {"a", "b"});
  CHECK_THROWS_WITH_AS(table.add({"x"}), "table 't' has 2 columns, not 1", std::invalid_argument);
}

TEST_CASE("a report: Markdown, JSON, and a CSV file for each table") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("new/folder");
  write_report(report(), out);
  const std::string markdown =
      "# Matching\n\n## Precision\n\nHigher is better.\n\n"
      "**Matches of made-up pairs** ([CSV](precision.csv))\n\n" +
      matches().markdown() +
      "\n![precision.svg](precision.svg)\n\n## Nothing\n\n## Parameters\n\n"
      "| parameter | value |\n|---|---|\n| radius | 0.02 |\n| set | desk |\n| seeds | [1,2] |\n";
  CHECK(read_bytes(out + "/report.md") == markdown);
  CHECK(read_bytes(out + "/precision.csv") == matches().csv());
  const auto json = nlohmann::ordered_json::parse(read_bytes(out + "/report.json"));
  CHECK(json["title"] == "Matching");
  CHECK(json["parameters"]["seeds"][1] == 2);
  CHECK(json["sections"][0]["plots"][0] == "precision.svg");
  CHECK(json["sections"][0]["tables"][0]["name"] == "precision");
  CHECK(json["sections"][0]["tables"][0]["rows"] == matches().json());
  CHECK(json["sections"][1]["tables"].empty());
  for (const auto& entry : std::filesystem::directory_iterator(out)) CHECK(entry.path().extension() != ".tmp");
  write_report(report(), out);  // again
  CHECK(read_bytes(out + "/report.md") == markdown);
}

TEST_CASE("a report that cannot be written is refused") {
  const TemporaryDirectory directory;
  cloud_file_test::write_bytes(directory.file("file"), "");
  CHECK_THROWS_AS(write_report(report(), directory.file("file")), InputError);
  CHECK_THROWS_AS(write_report(report(), directory.file("file") + "/below"), InputError);
  const std::string out = directory.file("out");
  std::filesystem::create_directories(out + "/report.md/in the way");
  CHECK_THROWS_AS(write_report(report(), out), InputError);
  for (const char* name : {"", "a/b", "..", "with space"}) {
    Report named = report();
    named.sections[0].tables[0].name = name;
    CHECK_THROWS_AS(write_report(named, directory.file("other")), std::invalid_argument);
  }
  Report twice = report();
  twice.sections[1].tables = twice.sections[0].tables;
  CHECK_THROWS_WITH_AS(write_report(twice, directory.file("other")), "two tables are named 'precision'",
                       std::invalid_argument);
}

}  // namespace test_campaign_report
