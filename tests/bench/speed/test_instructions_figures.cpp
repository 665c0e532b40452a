// Counts of instructions: reading callgrind's output and the record, and the comparison, which must be able to fail.

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "speed/instructions/figures.hpp"

namespace test_instructions_figures {
namespace {

using namespace shortshot_bench;

std::vector<Figure> read(const std::string& text) {
  std::istringstream in(text);
  return read_callgrind(in);
}

/// As callgrind 3.19 writes a dump, cut down to what is around the lines that count.
std::string dump(const std::string& name, const std::string& total) {
  return "part: 1\n\ndesc: Trigger: Client Request: " + name +
         "\n\npositions: line\nevents: Ir\nsummary: 0\n\n\nfn=(22) frame_of\n0 1\n0 9999\n\ntotals: " + total + "\n";
}

}  // namespace

TEST_CASE("callgrind's dumps become instructions per neighbor or point, and what it writes at the end is left out") {
  const std::string head = "# callgrind format\nversion: 1\ncmd: ./instructions count\n";
  const std::string end = "\ndesc: Trigger: Program termination\n\nevents: Ir\nsummary: 0\n\ntotals: 77\n";
  const auto figures = read(head + dump(dump_name("frame sse2", 1000, "neighbor"), "21360") +
                            dump(dump_name("sample avx2", 3, "point"), "12") +
                            dump(dump_name("whole frame D sse2", 1, "frame"), "204123456") + end);
  REQUIRE(figures.size() == 3);
  CHECK(figures[0].name == "frame sse2");
  CHECK(figures[0].instructions == doctest::Approx(21.36));
  CHECK(figures[0].per == "neighbor");
  CHECK(figures[1].name == "sample avx2");
  CHECK(figures[1].instructions == doctest::Approx(4.0));
  CHECK(figures[1].per == "point");
  CHECK(figures[2].name == "whole frame D sse2");
  CHECK(figures[2].instructions == 204123456.0);
  CHECK(figures[2].per == "frame");
}

TEST_CASE("no or broken counts are refused") {
  CHECK_THROWS_WITH(read(""), "callgrind counted no stage");
  CHECK_THROWS_WITH(read("desc: Trigger: Program termination\ntotals: 5\n"), "callgrind counted no stage");
  CHECK_THROWS_WITH(read(dump("frame sse2", "5")), "a dump of another program: 'frame sse2'");
  CHECK_THROWS_WITH(read(dump("frame sse2, neighbors ", "5")), "no number above zero: ''");
  CHECK_THROWS_WITH(read(dump("frame sse2, neighbors 0", "5")), "no number above zero: '0'");
  CHECK_THROWS_WITH(read(dump(dump_name("frame sse2", 7, "neighbor"), "0")), "no number above zero: '0'");
  CHECK_THROWS_WITH(read(dump(dump_name("frame sse2", 7, "neighbor"), "5 6")), "no number above zero: '5 6'");
}

TEST_CASE("3 % more or less than recorded pass, 4 % fail with both numbers in the message") {
  const std::vector<Figure> recorded = {{"frame sse2", 47.9}, {"kernel Scsh336 sse2", 112.0}};
  const auto compare = [&](double kernel) {
    return differences({{"frame sse2", 47.9}, {"kernel Scsh336 sse2", kernel}}, recorded);
  };
  CHECK(compare(112.0).empty());
  CHECK(compare(112.0 * 1.029).empty());
  CHECK(compare(112.0 * 0.971).empty());
  const auto slower = compare(112.0 * 1.04);
  REQUIRE(slower.size() == 1);
  CHECK(slower[0] == "kernel Scsh336 sse2: 116.48 instructions per neighbor, expected 112.00 (+4.0 %, allowed 3 %)");
  const auto faster = compare(112.0 * 0.96);
  REQUIRE(faster.size() == 1);
  CHECK(faster[0] ==
        "kernel Scsh336 sse2: 107.52 instructions per neighbor, expected 112.00 (-4.0 %, allowed 3 %); better: record "
        "it");
}

TEST_CASE("figures on one side only fail, each with its name") {
  const Figure frame = {"frame sse2", 47.9};
  const Figure search = {"search grid sse2", 61.3};
  CHECK(differences({frame, search}, {frame}) == std::vector<std::string>{"search grid sse2: not recorded"});
  CHECK(differences({search}, {frame, search}) == std::vector<std::string>{"frame sse2: recorded, but not measured"});
  CHECK(differences({}, {frame, search}).size() == 2);
}

TEST_CASE("a record survives being written and read, to the second decimal") {
  const Record record = {
      "GCC 12 for x86-64", "-O2", "a scene", {{"search grid sse2", 61.344}, {"sample sse2", 47.916, "point"}}};
  const Record back = parse_record(to_json(record));
  CHECK(back.compiler == record.compiler);
  CHECK(back.flags == record.flags);
  CHECK(back.workload == record.workload);
  REQUIRE(back.figures.size() == 2);
  CHECK(back.figures[0].name == "search grid sse2");
  CHECK(back.figures[0].instructions == doctest::Approx(61.34).epsilon(1e-9));
  CHECK(back.figures[1].name == "sample sse2");
  CHECK(back.figures[1].per == "point");
  CHECK(back.figures[1].instructions == doctest::Approx(47.92).epsilon(1e-9));
}

TEST_CASE("a record that says nothing is refused") {
  const std::string head = R"({"compiler": "GCC 12", "flags": "-O2", "workload": "w")";
  CHECK_THROWS(parse_record(""));
  CHECK_THROWS(parse_record("[]"));
  CHECK_THROWS(parse_record(head + "}"));
  CHECK_THROWS(parse_record(head + R"(, "instructions_per_neighbor": {"frame": "fast"}})"));
  CHECK_THROWS_WITH(parse_record(head + R"(, "instructions_per_neighbor": {}})"), "there is no figure");
  CHECK_THROWS_WITH(parse_record(head + R"(, "instructions_per_neighbor": {"frame": 0}})"), "frame is not above zero");
}

TEST_CASE("the record of the project has all stages of a frame for two instruction sets and a baseline binary") {
  std::ifstream in(SHORTSHOT_TEST_DATA "/../../bench/speed/instructions/expected.json");
  REQUIRE(in);
  const Record record = parse_record({std::istreambuf_iterator<char>(in), {}});
  std::vector<Figure> expected;
  for (const std::string isa : {"sse2", "avx2"}) {
    for (const std::string stage : {"search grid ", "frame ", "normals ", "kernel Ssh32 ", "kernel Scsh336 ",
                                    "kernel Scsh696 ", "kernel Shot352 ", "kernel Cshot1344 ",
                                    "kernel IntensityShape336 ", "kernel ShapeColor95 ", "kernel ShapeColor32 "}) {
      expected.push_back({stage + isa, 1.0});
    }
  }
  for (const std::string isa : {"sse2", "avx2"}) {
    for (const std::string stage : {"sample ", "index grid again ", "image normals ", "lab "})
      expected.push_back({stage + isa, 1.0, "point"});
  }
  for (const std::string stage : {"sample ", "index grid again "})
    expected.push_back({stage + "baseline", 1.0, "point"});
  for (const std::string isa : {"sse2", "avx2"}) {
    for (const std::string stage : {"mean shift ", "whole frame Scsh336 "})
      expected.push_back({stage + isa, 1.0, "frame"});
  }
  expected.push_back({"whole frame Scsh336 baseline", 1.0, "frame"});
  REQUIRE(record.figures.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(record.figures[i].name == expected[i].name);
}

}  // namespace test_instructions_figures
