// Campaigns: what is done once is never lost nor done again, whatever happens in between.

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloud_file_samples.hpp"
#include "paper/campaign/campaign.hpp"
#include "paper/campaign/progress.hpp"

namespace test_campaign_journal {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::campaign;
using cloud_file_test::read_bytes;
using cloud_file_test::TemporaryDirectory;
using cloud_file_test::write_bytes;
using json = nlohmann::ordered_json;

const json radius_two = {{"radius", 0.02}, {"scenes", {"desk", "shelf"}}};
constexpr Shard whole;

/// Squares of numbers, which count how often they are computed.
struct Squares {
  explicit Squares(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      units.push_back({"square " + std::to_string(i), [this, i]() -> json {
                         ++computed;
                         return {{"value", i * i}};
                       }});
    }
  }
  void run(const std::string& directory, Shard shard = whole, unsigned threads = 2) {
    run_campaign(units, radius_two, directory, shard, threads, nullptr);
  }

  std::vector<Unit> units;
  std::atomic<int> computed{0};
};

template <class Work>
std::string refusal_of(const Work& work, const std::string& directory) {
  try {
    work();
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.rfind(directory, 0) == 0 ? what.substr(directory.size()) : what;
  }
  return "accepted";
}

const std::string header = R"({"parameters":{"radius":0.02,"scenes":["desk","shelf"]}})"
                           "\n";

}  // namespace

TEST_CASE("a shard is k/n; anything else is refused with what was expected") {
  CHECK(parse_shard("1/1").n == 1);
  CHECK(parse_shard("12/40").k == 12);
  CHECK(parse_shard("12/40").n == 40);
  for (const char* bad : {"", "1", "1/", "/1", "0/3", "4/3", "-1/3", "1/3x", " 1/3", "1.5/3", "1/0", "a/b",
                          "99999999999999999999999/3"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH_AS(parse_shard(bad),
                         ("'" + std::string(bad) + "' is no shard: expected K/N with 1 <= K <= N, such as 2/5").c_str(),
                         std::runtime_error);
  }
}

TEST_CASE("the journal: parameters first, then a line for each unit; what is in it is not done again") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("deep/er");
  Squares squares(3);
  squares.run(out, whole, 1);
  CHECK(read_bytes(journal_path(out)) == header + R"({"key":"square 0","result":{"value":0}})"
                                                  "\n"
                                                  R"({"key":"square 1","result":{"value":1}})"
                                                  "\n"
                                                  R"({"key":"square 2","result":{"value":4}})"
                                                  "\n");
  CHECK(squares.computed == 3);
  squares.run(out);
  CHECK(squares.computed == 3);
  Squares more(5);
  more.run(out, whole, 0);
  CHECK(more.computed == 2);
}

TEST_CASE("results come in the order of the units, with those that are missing") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("out");
  Squares squares(4);
  CHECK(read_results(out, squares.units, radius_two).missing.size() == 4);
  std::filesystem::create_directory(out);
  write_bytes(journal_path(out), header + R"({"key":"square 3","result":9})"
                                          "\n"
                                          R"({"key":"of another day","result":7})"
                                          "\n"
                                          R"({"key":"square 1","result":1})"
                                          "\n");
  const Results results = read_results(out, squares.units, radius_two);
  REQUIRE(results.finished.size() == 2);
  CHECK(results.finished[0].key == "square 1");
  CHECK(results.finished[0].result == 1);
  CHECK(results.finished[1].key == "square 3");
  CHECK(results.missing == std::vector<std::string>{"square 0", "square 2"});
  CHECK_THROWS_AS(read_results(out, squares.units, {{"radius", 0.03}}), InputError);
}

TEST_CASE("a journal cut off anywhere is gone on with; the incomplete line's unit alone is done again") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("out");
  Squares squares(4);
  squares.run(out, whole, 1);
  const std::string complete = read_bytes(journal_path(out));
  for (std::size_t length = 0; length <= complete.size(); ++length) {
    CAPTURE(length);
    const std::string left = complete.substr(0, length);
    write_bytes(journal_path(out), left);
    const auto lines = static_cast<int>(std::count(left.begin(), left.end(), '\n'));
    const std::size_t done = lines > 0 ? static_cast<std::size_t>(lines - 1) : 0;
    CHECK(read_results(out, squares.units, radius_two).finished.size() == done);
    squares.computed = 0;
    squares.run(out, whole, 1);
    CHECK(static_cast<std::size_t>(squares.computed) == 4 - done);
    CHECK(read_bytes(journal_path(out)) == complete);
  }
}

TEST_CASE("other parameters than the journal's are refused, and which one differs is said") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("out");
  Squares squares(2);
  squares.run(out);
  const std::string before = read_bytes(journal_path(out));
  const auto refusal = [&](const json& parameters) {
    return refusal_of([&] { run_campaign(squares.units, parameters, out, whole, 1, nullptr); }, out);
  };
  const std::string begin = "/journal.jsonl:1: the folder holds results for other parameters: ";
  const std::string end = " now; use another folder (--out) or delete this one";
  CHECK(refusal({{"radius", 0.03}, {"scenes", {"desk", "shelf"}}}) == begin + "'/radius' is 0.02 there and 0.03" + end);
  CHECK(refusal({{"radius", 0.02}, {"scenes", {"desk", "sink"}}}) ==
        begin + R"('/scenes/1' is "shelf" there and "sink")" + end);
  CHECK(refusal({{"radius", 0.02}}) == begin + R"('/scenes' is ["desk","shelf"] there and not there)" + end);
  CHECK(refusal({{"radius", 0.02}, {"scenes", {"desk", "shelf"}}, {"seed", 1}}) ==
        begin + "'/seed' is not there there and 1" + end);
  CHECK(refusal({{"scenes", {"desk", "shelf"}}, {"radius", 0.02}}) == "accepted");
  CHECK(read_bytes(journal_path(out)) == before);
}

TEST_CASE("a damaged line is refused with file and line, and nothing is changed") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("out");
  Squares squares(2);
  const auto refusal = [&](const std::string& text) {
    std::filesystem::create_directories(out);
    write_bytes(journal_path(out), text);
    const std::string what = refusal_of([&] { squares.run(out); }, out);
    CHECK(read_bytes(journal_path(out)) == text);
    return what;
  };
  const std::string fine = R"({"key":"square 1","result":1})"
                           "\n";
  CHECK(refusal(header + "{\"key\":\"squ\n" + fine).find("/journal.jsonl:2: damaged journal: ") == 0);
  CHECK(refusal(header + fine + "\n").find("/journal.jsonl:3: damaged journal: ") == 0);
  CHECK(refusal(fine) == "/journal.jsonl:1: expected {\"parameters\": ...}");
  CHECK(refusal("[]\n") == "/journal.jsonl:1: expected {\"parameters\": ...}");
  const std::string expected = "expected {\"key\": TEXT, \"result\": ...}";
  CHECK(refusal(header + fine + header) == "/journal.jsonl:3: " + expected);
  CHECK(refusal(header + "{\"key\":3,\"result\":1}\n") == "/journal.jsonl:2: " + expected);
  CHECK(refusal(header + fine + fine +
                R"({"key":"square 1","result":2})"
                "\n") == "/journal.jsonl:4: another result for 'square 1' than on a line before");
}

TEST_CASE("two cannot write into one folder; a folder that cannot be written is refused") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("out");
  Squares squares(2);
  {
    const Journal first(out, radius_two);
    const std::string what = refusal_of([&] { squares.run(out); }, out);
    CHECK(what.find("/journal.lock: another process is writing results into this folder") == 0);
    CHECK_THROWS_AS(merge_journals({out}, out), InputError);
  }
  CHECK(squares.computed == 0);
  squares.run(out);
  CHECK(squares.computed == 2);
  write_bytes(directory.file("file"), "");
  CHECK_THROWS_AS(squares.run(directory.file("file")), InputError);
  CHECK_THROWS_AS(squares.run("/dev/null/out"), InputError);
}

TEST_CASE("shards do every unit once; merged they are what one run would have written") {
  const TemporaryDirectory directory;
  Squares squares(11);
  squares.run(directory.file("whole"));
  squares.computed = 0;
  std::vector<std::string> parts;
  for (std::size_t k = 1; k <= 3; ++k) {
    parts.push_back(directory.file("part" + std::to_string(k)));
    squares.run(parts.back(), {k, 3});
    CHECK(read_journal(parts.back())->results.size() == (k == 3 ? 3 : 4));
  }
  CHECK(squares.computed == 11);
  merge_journals(parts, directory.file("merged"));
  merge_journals({directory.file("whole")}, directory.file("copy"));
  CHECK(read_bytes(journal_path(directory.file("merged"))) == read_bytes(journal_path(directory.file("copy"))));
  CHECK(read_results(directory.file("merged"), squares.units, radius_two).missing.empty());
  // What is there stays, what is there twice with one result is there once, and the campaign goes on in the folder.
  merge_journals({parts[2], parts[0]}, parts[0]);
  CHECK(read_journal(parts[0])->results.size() == 7);
  squares.computed = 0;
  squares.run(parts[0]);
  CHECK(squares.computed == 4);
}

TEST_CASE("what does not belong together is not merged") {
  const TemporaryDirectory directory;
  const std::string into = directory.file("into");
  Squares squares(2);
  squares.run(directory.file("one"));
  run_campaign(squares.units, {{"radius", 0.03}}, directory.file("other"), whole, 1, nullptr);
  const std::string other = directory.file("other");
  CHECK(refusal_of(
            [&] {
              merge_journals({directory.file("one"), other}, into);
            },
            other)
            .find("'/radius'") != std::string::npos);
  const std::string two = directory.file("two");
  std::filesystem::create_directory(two);
  write_bytes(journal_path(two), header + R"({"key":"square 1","result":5})"
                                          "\n");
  CHECK(refusal_of(
            [&] {
              merge_journals({directory.file("one"), two}, into);
            },
            two) == "/journal.jsonl: another result for 'square 1' than in a folder before: 5");
  const std::string none = directory.file("none");
  CHECK(refusal_of([&] { merge_journals({none}, into); }, none) ==
        "/journal.jsonl: there are no results in this folder");
  CHECK(!read_journal(into));
}

TEST_CASE("a unit that throws: its key is said, what is finished is kept, what is not begun is left") {
  const TemporaryDirectory directory;
  const std::string out = directory.file("out");
  Squares squares(40);
  bool broken = true;
  squares.units[7].run = [&]() -> json {
    if (broken) throw std::runtime_error("no such cloud");
    return 49;
  };
  CHECK_THROWS_WITH_AS(squares.run(out, whole, 1), "square 7: no such cloud", std::runtime_error);
  CHECK(squares.computed == 7);
  CHECK(read_journal(out)->results.size() == 7);
  CHECK_THROWS_WITH_AS(squares.run(out, whole, 2), "square 7: no such cloud", std::runtime_error);
  CHECK(read_journal(out)->results.size() == static_cast<std::size_t>(squares.computed));
  broken = false;
  squares.run(out);
  CHECK(squares.computed == 39);
  CHECK(read_results(out, squares.units, radius_two).missing.empty());
}

TEST_CASE("two units of one key are refused before anything is done") {
  const TemporaryDirectory directory;
  Squares squares(2);
  squares.units.push_back(squares.units[0]);
  CHECK_THROWS_WITH_AS(squares.run(directory.file("out")), "two units have the key 'square 0'", std::invalid_argument);
  CHECK(squares.computed == 0);
}

TEST_CASE("progress says what is done, how long it took and how long the rest will take") {
  CHECK(progress_text(153, 3, 9, 65.0) == "12/153 done, 0:01:05 elapsed, about 0:16:01 left");
  CHECK(progress_text(10, 0, 5, 10.0, 1) == "5/10 done, 0:00:10 elapsed, about 0:00:08 left");
  CHECK(progress_text(153, 3, 2, 65.0) == "5/153 done, 0:01:05 elapsed");  // the first ones tell little
  CHECK(progress_text(153, 3, 11, 65.0, 4) == "14/153 done, 0:01:05 elapsed");
  CHECK(progress_text(2, 0, 2, 7322.4) == "2/2 done, 2:02:02 elapsed, about 0:00:00 left");
  const TemporaryDirectory directory;
  Squares squares(2);
  std::FILE* const file = std::fopen(directory.file("progress").c_str(), "w");
  REQUIRE(file != nullptr);
  run_campaign(squares.units, radius_two, directory.file("out"), {2, 2}, 1, file);
  std::fclose(file);
  CHECK(read_bytes(directory.file("progress")) == "1/1 done, 0:00:00 elapsed, about 0:00:00 left: square 1\n");
}

}  // namespace test_campaign_journal
