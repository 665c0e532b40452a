// The generator of the documents' tables: what it makes of measurements, and what it refuses.

#include <doctest/doctest.h>

#include <exception>
#include <filesystem>
#include <string>

#include "results/writer/machine.hpp"
#include "results/writer/markdown.hpp"
#include "results/writer/project.hpp"
#include "results_fixture.hpp"

namespace test_results_writer {
namespace {

using namespace shortshot_bench::results;
using results_fixture::Project;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What is said about a project in which one file holds something else.
std::string refusal_of(const std::string& file, const std::string& text) {
  const Project project;
  project.write(file, text);
  try {
    generate(project.root());
  } catch (const std::exception& error) {
    const std::string what = error.what();
    const std::string start = project.path(file) + ": ";
    return what.compare(0, start.size(), start) == 0 ? what.substr(start.size()) : "without the name: " + what;
  }
  return "accepted";
}

}  // namespace

TEST_CASE("numbers keep their significant digits") {
  CHECK(digits(0.0) == "0");
  CHECK(digits(0.30189) == "0.302");
  CHECK(digits(8.0) == "8.00");
  CHECK(digits(14.149) == "14.1");
  CHECK(digits(170909.0) == "170909");
  CHECK(digits(3.2e-7) == "3.20e-07");
  CHECK(whole(831.6) == "832");
  CHECK(times(4.96) == "5.0x");
  CHECK(times(24.6) == "25x");
  CHECK(megabytes(0.0) == "0");
  CHECK(megabytes(31400.0) == "31.4 KB");
  CHECK(megabytes(5.25e6) == "5.2 MB");
}

TEST_CASE("a table has as many cells in each row as in its header") {
  Table table({"a", "b", "c"});
  table.add({"1", "2"});
  CHECK(table.markdown() == "| a | b | c |\n|---|---:|---:|\n| 1 | 2 | |\n");
}

TEST_CASE("only the block is replaced, and there must be exactly one") {
  const std::string text = "x\n<!-- generated: a -->\nold\n<!-- end -->\ny\n<!-- generated: b -->\n<!-- end -->\n";
  CHECK(with_block(text, "a", "new\n", "F") ==
        "x\n<!-- generated: a -->\nnew\n<!-- end -->\ny\n<!-- generated: b -->\n<!-- end -->\n");
  CHECK(with_block(with_block(text, "a", "new\n", "F"), "a", "new\n", "F") == with_block(text, "a", "new\n", "F"));
  CHECK_THROWS_WITH(with_block(text, "c", "", "F"), "F: there is no line '<!-- generated: c -->'");
  CHECK_THROWS_WITH(with_block(text + text, "a", "", "F"), "F: the block 'a' is there twice");
  CHECK_THROWS_WITH(with_block("<!-- generated: a -->\n", "a", "", "F"), "F: the block 'a' has no line '<!-- end -->'");
  CHECK_THROWS_WITH(with_block("<!-- generated: a -->\n<!-- generated: b -->\n<!-- end -->", "a", "", "F"),
                    "F: the block 'a' has no line '<!-- end -->'");
}

TEST_CASE("the README's headline: quality of sets with color, cost beside the peer's, and where they are from") {
  const Project project;
  const Document readme = generate(project.root()).at(0);
  CHECK(readme.path == project.path("README.md"));
  CHECK(has(readme.committed, "old"));
  CHECK_FALSE(has(readme.generated, "old"));
  CHECK(readme.generated.compare(0, 7, "before\n") == 0);
  CHECK(has(readme.generated, "<!-- end -->\nafter\n"));
  CHECK(has(readme.generated, "| SCSH-336, the paper's | 95 | 1.00 | 0.50 | 50 % | 36.0 | 60.0 | 5.2 MB |\n"));
  CHECK(has(readme.generated, "| *PCL:* SHOTColor | 95 | 1.00 | 1.00 | 50 % | 360 | 900 | 31.4 KB |\n"));
  CHECK(has(readme.generated, "Quality: 2 sets"));
  CHECK(
      has(readme.generated, "desk.pcd: 170000 points, 1000 key points of voxels of 0.01 m, R = 0.04 m, 831 neighbors"));
  CHECK(has(readme.generated, "Imaginary 1, GCC 12"));
}

TEST_CASE("the report and the goals show every file") {
  const Project project;
  const std::vector<Document> documents = generate(project.root());
  const std::string& report = documents.at(1).generated;
  const std::string& goals = documents.at(3).generated;
  CHECK(has(report, "Imaginary 1, 2 cores; Debian; GCC 12, `-O2`."));
  CHECK(has(goals, "| faster | O2 | >= 25 | 26.0 | desk.pcd | yes |\n"));
  CHECK(has(goals, "| exact | avx2 | <= 1e-06 | 3.20e-06 | desk.pcd | **no** |\n"));
  CHECK(has(goals, "| instructions | avx2 | report | not measured | | |\n"));
  CHECK(has(report,
            "| SSH-32 | PCL SHOT | grid | 3.75 / 1.88 | 900 | 240x / 480x | 2.25 / 1.12 | 360 | 160x / 320x | 5.2 MB, "
            "31.4 KB |\n"));
  CHECK(has(report, "| stage | CPU time | | ns/neighbor | bytes |\n"));
  CHECK(has(report, "| kernel | 8.25 | us | 6.50 | |\n| index | 1234 | us | | 4096 |\n"));
  CHECK_FALSE(has(report, "mean"));
  CHECK(has(report,
            "| sample sse2 | 130 | point |\n| kernel Ssh32 sse2 | 60.2 | neighbor |\n| frame sse2 | 40.0 | neighbor |\n"
            "| whole frame Scsh336 sse2 | 204 million | frame |\n"));
  CHECK(has(report, "![cost and extra memory against threads](results/scaling_threads.svg)"));
  CHECK(has(report, "| threads | extract, ms | index, ms | extra memory |\n|---|---:|---:|---:|\n"));
  CHECK(has(report, "| 1 | 80.5 | | 2.0 MB |\n| 2 | 41.2 | 1.50 | 3.5 MB |\n"));
}

TEST_CASE("the headline leaves out Open3D where it was not measured") {
  const Project project;
  CHECK_FALSE(has(generate(project.root()).at(0).generated, "Open3D"));
  std::string more = results_fixture::peers();
  more.pop_back();
  more += ", " + results_fixture::comparison("ShapeColor95", "Open3D FPFH", "O2", 2.0) + "]";
  project.write("bench/results/peers.json", more);
  CHECK(has(generate(project.root()).at(0).generated,
            "| *Open3D:* FPFH, square roots | 95 | 1.00 | 0.50 | 50 % | 360 | 900 | 31.4 KB |\n"));
}

TEST_CASE("a descriptor without quality in a set with color is named, and a set that is malformed") {
  const std::string file = "bench/results/registration.json";
  CHECK(refusal_of(file, R"([{"set": "a", "rows": [{"descriptor": "cshot1344", "inlier ratio": "0.5"}]}])") ==
        "entry 1: no row of shapecolor95-4bit");
  CHECK(refusal_of(file, R"([{"set": "a", "rows": []}])") == "entry 1: no set has a row of cshot1344");
  CHECK(refusal_of(file,
                   R"([{"set": "a", "rows": [{"descriptor": "cshot1344"}, {"descriptor": "shapecolor95-4bit"}]}])") ==
        "entry 1: no 'inlier ratio' in a row");
}

TEST_CASE("what was generated is what is generated again") {
  const Project project;
  for (const Document& document : generate(project.root())) {
    CHECK(document.committed != document.generated);
    project.write(document.path.substr(project.root().size() + 1), document.generated);
  }
  for (const Document& document : generate(project.root())) CHECK(document.committed == document.generated);
  project.write("bench/results/machine.json",
                R"({"cpu": "Other", "cores": 2, "system": "Debian", "compiler": "GCC 12", "flags": "-O2"})");
  const std::vector<Document> documents = generate(project.root());
  CHECK(documents.at(0).committed != documents.at(0).generated);
  CHECK(documents.at(1).committed != documents.at(1).generated);
  CHECK(documents.at(2).committed == documents.at(2).generated);  // knows nothing of the machine
}

TEST_CASE("firmware: the README's rows, and the page's tables") {
  const Project project;
  const std::vector<Document> documents = generate(project.root());
  CHECK(has(documents.at(0).generated,
            "| Scsh336 | 5100 B | 768 B | 20 B a neighbor, compact 20 | 555 a neighbor + 3210 |\n"));
  const std::string& page = documents.at(2).generated;
  CHECK(has(page, "| less (goal missed) | 475 | 560 | 555 | Scsh336 on m7 |\n"));
  CHECK(has(page, "| m7 -O2, compact | 5100 | 1100 | | | 444 | 324 | 555 | | 3210 | | |\n"));
  CHECK(has(page, "Hash of the bits: 0badcafe"));
  CHECK(has(page, "| 8x8 host_shot352_floats -O2 | | | | | | | | | | | 83 of 160 | | | | | |\n"));
  CHECK(has(page, "| 8x8 m7 -Os | 51 | 1 | 2764 | | 8708 | | | | | 200776 | 105 of 160 | 20 | | | 74 of 81 | |\n"));
  const std::string file = "bench/results/firmware.json";
  CHECK(has(refusal_of(file, "{}"), "'figures' not found"));
  CHECK(has(refusal_of(file, R"({"figures": [], "hashes": [], "budgets": []})"), "no figures of Ssh96 on m7 -Os"));
}

TEST_CASE("trade-offs: the page's tables and plots") {
  const Project project;
  const std::string page = generate(project.root()).at(4).generated;
  CHECK(has(page, "![score_by_bytes](results/tradeoff_score_by_bytes.svg)\n"));
  CHECK(has(page, "**M**\n\n| all |\n"));
  CHECK(has(page, "**H**\n\n| small | 32 |\n"));
  CHECK(has(refusal_of("bench/results/tradeoff.json", "{}"), "'headline' not found"));
}

TEST_CASE("a missing or malformed file is named, and what is wrong with it") {
  for (const char* file :
       {"README.md", "bench/RESULTS.md", "bench/GOALS.md", "bench/results/machine.json", "bench/results/peers.json",
        "bench/results/registration.json", "bench/results/goals.json", "bench/results/micro.json",
        "bench/speed/instructions/expected.json", "bench/results/scaling.json", "bench/results/firmware.json",
        "bench/firmware/README.md", "bench/results/tradeoff.json", "bench/TRADEOFF.md"}) {
    CAPTURE(file);
    const Project project;
    std::filesystem::remove(project.path(file));
    try {
      generate(project.root());
      FAIL("accepted");
    } catch (const std::exception& error) {
      CHECK(has(error.what(), project.path(file) + ": cannot "));
    }
    CHECK(
        has(refusal_of(file, "[{"), std::string(file).find(".json") == std::string::npos ? "no line" : "parse error"));
  }
  const std::string peers = "bench/results/peers.json";
  CHECK(refusal_of(peers, "[]") == "expected a list of one or more objects");
  CHECK(refusal_of(peers, "[" + results_fixture::comparison("SSH-32", "PCL SHOT", "O2", 2.0) + "]") ==
        "no comparison of ShapeColor95 with PCL SHOTColor for O2");
  std::string other_build = results_fixture::peers();
  other_build.insert(1, results_fixture::comparison("SSH-32", "PCL FPFH", "O9", 2.0) + ", ");
  CHECK(refusal_of(peers, other_build) == "entry 1: 'build' must be \"O2\" or \"avx2\", not \"O9\"");
  std::string no_number = results_fixture::peers();
  no_number.replace(no_number.find("5200000"), 7, "\"5 MB\"");
  CHECK(refusal_of(peers, no_number) == "entry 1: 'peak_bytes' must be a number, not \"5 MB\"");
  CHECK(refusal_of("bench/results/goals.json", R"([{"goal": "a", "build": "O2"}])") == "entry 1: 'bound' is missing");
  CHECK(has(refusal_of("bench/results/micro.json", "{}"), "'benchmarks' is missing"));
  CHECK(refusal_of("bench/results/micro.json",
                   R"({"benchmarks": [{"name": "a", "error_occurred": true, "error_message": "bad"}]})") ==
        "entry 1: a: bad");
  CHECK(has(refusal_of("bench/speed/instructions/expected.json", "{}"), "'instructions_per_point' is missing"));
}

TEST_CASE("this machine is written down and read back") {
  const Project project;
  const Machine here = this_machine();
  CHECK_FALSE(here.cpu.empty());
  CHECK_FALSE(here.flags.empty());
  write_machine(machine_path(project.root()), here);
  const Machine read = read_machine(machine_path(project.root()));
  CHECK(read.cpu == here.cpu);
  CHECK(read.cores == here.cores);
  CHECK(read.system == here.system);
  CHECK(read.compiler == here.compiler);
  CHECK(read.flags == here.flags);
}

}  // namespace test_results_writer
