// What bench/firmware has measured against what is promised: every check must be able to fail, and says what failed.

#include <doctest/doctest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/report/call_graph.hpp"
#include "firmware/report/facts.hpp"
#include "firmware/report/figures.hpp"
#include "firmware/report/promises.hpp"
#include "firmware/report/tables.hpp"

namespace test_firmware_report {
namespace {

using namespace shortshot_bench::firmware;

Facts facts(const std::string& name, const std::string& text) {
  std::istringstream in(text);
  return Facts(name, in);
}

/// Start-up alone, an image, its work and its bits on one target.
std::vector<Facts> measured_images() {
  const std::string target = "target m7\nlevel O2\n";
  return {
      facts("startup", target + "program size\nimage yes\nbytes .text 200\nbytes .bss 4\ncheck kept: all\n"),
      facts("image", target +
                         "program size\nconfiguration Ssh32\nsearch brute\nworkspace full\nimage yes\n"
                         "bytes .vectors 64\nbytes .text 3000\nbytes .rodata 36\nbytes .bss 12\nbytes .stack 4096\n"
                         "check kept: all\n"),
      facts("work", target + "program work\nconfiguration Ssh32\nworkspace full\nsection given_250\nsection given_500\n"
                             "fact chunk_bytes 1000\nfact stack_painted 1400\nexit 0\ncount 30000\ncount 55000\n"),
      facts("bits", target + "program bits\ncompiler g++ 12\nhash Ssh32 0badcafe\nexit 0\n")};
}

double figure(const std::string& name) { return measure(measured_images()).rows.at(0).figures.at(name); }

Budget budget(const std::string& figure, double at_most) {
  return {"the promise", figure, at_most, at_most, {"m7"}, {}, {}, {}};
}

bool names(const std::vector<std::string>& lines, const std::string& what) {
  return lines.size() == 1 && lines[0].find(what) != std::string::npos;
}

}  // namespace

TEST_CASE("figures are made of sections, counts and facts") {
  CHECK(figure("flash_brute") == 3100.0);
  CHECK(figure("static_bytes") == 8.0);
  CHECK(figure("work_per_neighbor") == 100.0);
  CHECK(figure("work_fixed") == 5000.0);
  CHECK(figure("stack_outside_chunk") == 400.0);
  const std::string text = tables(measure(measured_images()));
  CHECK(text.find("3100") != std::string::npos);
  CHECK(text.find("0badcafe") != std::string::npos);
}

TEST_CASE("a further configuration costs what it adds to the image of the first one") {
  auto images = measured_images();
  images.push_back(facts("two",
                         "target m7\nlevel O2\nprogram size\nconfiguration Ssh32\nsecond Ssh96\nsearch brute\n"
                         "workspace full\nimage yes\nbytes .text 4100\ncheck kept: all\n"));
  CHECK(measure(images).rows.at(1).configuration == "Ssh96");
  CHECK(measure(images).rows.at(1).figures.at("flash_further") == 1000.0);
}

TEST_CASE("recognition: a view is its index, descriptions, comparisons and places; the host has facts alone") {
  auto images = measured_images();
  images.push_back(facts(
      "recognition",
      "target m7\nlevel O2\nprogram recognition\nconfiguration Recognition\nworkspace full\n"
      "section index\nsection colors\nsection describe_and_match\nsection find\nsection match\nhash Recognition 01\n"
      "fact views 30\nfact right 28\nexit 0\ncount 10\ncount 3\ncount 500\ncount 7\ncount 200\n"));
  images.push_back(facts("host",
                         "target host\nlevel O2\nprogram recognition_on_host\nconfiguration Recognition\n"
                         "workspace full\nfact views 30\nfact right 27\nexit 0\n"));
  const Measured measured = measure(images);
  REQUIRE(measured.rows.size() == 3);
  const auto& board = measured.rows[1].figures;
  CHECK((board.at("work_describe") == 300.0 && board.at("work_view") == 520.0 && board.at("wrong_views") == 2.0));
  CHECK((measured.rows[2].figures.at("right") == 27.0 && measured.rows[2].figures.count("wrong_views") == 0));
  CHECK(measured.hashes.back().value == "01");
  CHECK(tables(measured).find("520") != std::string::npos);
  const Budget band{"named rightly", "wrong_views", 1.0, 1.0, {}, {}, {"Recognition"}, {}};
  CHECK(names(broken_budgets({band}, measured.rows), "Recognition on m7"));
  CHECK(broken_images(images, {}).empty());
}

TEST_CASE("recognition of recordings: boards agree with the host; nothing is committed; what is not there is skipped") {
  auto images = measured_images();
  const std::string host =
      "level O2\nconfiguration Segments\nworkspace full\nhash Segments 0a\nfact views 9\nfact right 8\n";
  images.push_back(facts("host", "target host\nprogram recognition_on_host\n" + host + "exit 0\n"));
  images.push_back(facts("skipped", "program skipped\nconfiguration Elsewhere\nexit 0\n"));
  const Measured measured = measure(images);
  CHECK(measured.skipped == std::vector<std::string>{"Elsewhere"});
  const Hashes committed{{"Ssh32", "0badcafe"}};
  std::vector<Hash> hashes = measured.hashes;
  CHECK(broken_hashes(committed, hashes).empty());
  hashes.push_back({"m7", "O2", "Segments", "0b"});
  CHECK(names(broken_hashes(committed, hashes), "Segments on m7 -O2 has the hash 0b, the host: 0a"));
  CHECK(broken_images(images, committed).empty());

  const auto about = [](const std::vector<std::string>& configurations) {
    return Budget{"the promise", "right", 9.0, 9.0, {}, {}, configurations, {}};
  };
  const std::vector<Budget> budgets{about({"Elsewhere"}), about({"Segments"}), about({"Elsewhere", "Ssh32"}),
                                    about({})};
  CHECK(without(budgets, measured.skipped).size() == 3);
  CHECK(without(budgets, {}).size() == 4);
}

TEST_CASE("the recognizer's code is what its program weighs more than one that describes") {
  auto images = measured_images();
  images.push_back(facts("code",
                         "target m7\nlevel Os\nprogram recognizer_code\nconfiguration Recognition\nworkspace full\n"
                         "exit 0\nbytes .text 900\nbytes .rodata 50\nalone .text 600\nalone .rodata 20\n"));
  CHECK(measure(images).rows.back().figures.at("recognizer_code") == 330.0);
}

TEST_CASE("small sensors: memory with the stack, flash without the model; a host without an image has neither") {
  const std::string program =
      "program small_sensor\nworkspace compact\nsection points\nsection describe\nsection match\nsection find\n"
      "fact stack_painted 1000\nconfiguration SmallSensor8x8\nhash SmallSensor8x8 02\nfact model_bytes 600\n"
      "fact views 160\nfact right 105\nexit 0\ncount 10\ncount 300\ncount 50\ncount 7\n";
  auto images = measured_images();
  images.push_back(facts("board", "target m7\nlevel Os\n" + program +
                                      "bytes .vectors 64\nbytes .text 900\nbytes .rodata 700\nbytes .views 5000\n"
                                      "bytes .bss 2000\nbytes .stack 4096\n"));
  images.push_back(facts("other", "target aarch64\nlevel O2\n" + program));
  images.push_back(facts("host",
                         "target host\nlevel O2\nprogram small_sensor_on_host\nconfiguration SmallSensor8x8\n"
                         "workspace full\nfact views 160\nfact right 90\nexit 0\n"));
  const Measured measured = measure(images);
  REQUIRE(measured.rows.size() == 4);
  const auto& board = measured.rows[1].figures;
  CHECK((board.at("code_bytes") == 1064.0 && board.at("ram_bytes") == 3000.0));
  CHECK((board.at("work_view") == 367.0 && board.at("wrong_views") == 55.0));
  CHECK((measured.rows[2].figures.count("ram_bytes") == 0 && measured.rows[2].figures.at("wrong_views") == 55.0));
  CHECK((measured.rows[3].figures.at("right") == 90.0 && measured.rows[3].figures.count("wrong_views") == 0));
  CHECK(measured.hashes.back().configuration == "SmallSensor8x8");
  CHECK(tables(measured).find("3000") != std::string::npos);
  const Budget memory{"memory", "ram_bytes", 2999.0, 2999.0, {}, {}, {"SmallSensor8x8"}, {}};
  CHECK(names(broken_budgets({memory}, measured.rows), "SmallSensor8x8 on m7"));
}

TEST_CASE("sections without counts are refused") {
  auto images = measured_images();
  images[2] = facts("work", "target m7\nlevel O2\nprogram work\nsection given_250\nexit 0\n");
  CHECK_THROWS_AS(measure(images), std::runtime_error);
}

TEST_CASE("a goal that is missed is named, and breaks nothing") {
  const auto rows = measure(measured_images()).rows;
  Budget ambitious = budget("flash_brute", 3100.0);
  CHECK(missed_goals({ambitious}, rows).empty());
  ambitious.goal = 3000.0;
  CHECK(names(missed_goals({ambitious}, rows), "the promise: 3100 (Ssh32 on m7 -O2, full workspace), goal 3000"));
  CHECK(broken_budgets({ambitious}, rows).empty());
}

TEST_CASE("a budget is kept, broken or not measured") {
  const auto rows = measure(measured_images()).rows;
  CHECK(broken_budgets({budget("flash_brute", 3100.0)}, rows).empty());
  CHECK(names(broken_budgets({budget("flash_brute", 3099.0)}, rows),
              "the promise: 3100 (Ssh32 on m7 -O2, full workspace), promised 3099"));
  CHECK(names(broken_budgets({budget("flash_grid", 9999.0)}, rows), "the promise: not measured"));
  Budget elsewhere = budget("flash_brute", 9999.0);
  elsewhere.targets = {"m4f"};
  CHECK(names(broken_budgets({elsewhere}, rows), "not measured"));
}

TEST_CASE("every build must have the committed hash, and every committed hash a build") {
  const auto hashes = measure(measured_images()).hashes;
  CHECK(broken_hashes({{"Ssh32", "0badcafe"}}, hashes).empty());
  CHECK(names(broken_hashes({{"Ssh32", "0badcaff"}}, hashes), "Ssh32 on m7 -O2 has the hash 0badcafe"));
  CHECK(broken_hashes({{"Ssh32", "0badcafe"}, {"Ssh96", "0"}}, hashes).size() == 1);
  CHECK(names(broken_hashes({}, hashes), "committed: none"));
  CHECK(parse_hashes(to_json(Hashes{{"Ssh32", "0badcafe"}})) == Hashes{{"Ssh32", "0badcafe"}});
}

TEST_CASE("findings in images and programs that do not end well are named") {
  const Hashes none;
  auto images = measured_images();
  CHECK(broken_images(images, none).empty());
  images[1] = facts("image", "program size\ncheck broken: no heap (malloc)\n");
  CHECK(names(broken_images(images, none), "no heap (malloc) in image"));
  images[1] = facts("image", "program size\n");
  CHECK(names(broken_images(images, none), "nothing was checked in image"));
  images[1] = facts("bits", "program bits\nexit 124\n");
  CHECK(names(broken_images(images, none), "exit code 124"));
}

TEST_CASE("a negative control that nothing notices is a broken promise") {
  const Hashes committed = {{"Ssh32", "0badcafe"}};
  const auto noticed = [&](const std::string& text) {
    return broken_images({facts("control", "program control\ncontrol 1\n" + text)}, committed).empty();
  };
  CHECK(noticed("must_report no heap\ncheck broken: no heap (malloc)\n"));
  CHECK_FALSE(noticed("must_report no heap\ncheck broken: no double (f2d)\n"));
  CHECK_FALSE(noticed("must_report no heap\nmust_not_link no heap\ncheck broken: no heap (malloc)\n"));
  CHECK(noticed("must_report no heap\nmust_not_link no heap\nlinker no heap\ncheck broken: no heap (malloc)\n"));
  CHECK(noticed("must_exit 3\nexit 3\n"));
  CHECK_FALSE(noticed("must_exit 3\nexit 0\n"));
  CHECK(noticed("must differ\nhash Ssh32 12345678\n"));
  CHECK_FALSE(noticed("must differ\nhash Ssh32 0badcafe\n"));
  CHECK_FALSE(noticed("must differ\nexit 1\n"));
  CHECK_FALSE(noticed(""));
}

TEST_CASE("the deepest stack goes along the calls; what is not known is refused") {
  const auto deepest = [](const std::string& text) {
    std::istringstream in(text);
    return CallGraph(in).deepest("main");
  };
  const auto node = [](const std::string& name, const std::string& frame) {
    return "node: { title: \"" + name + "\" label: \"" + name + "\\nfile.cpp:1:1\\n" + frame + "\" }\n";
  };
  const auto edge = [](const std::string& from, const std::string& to) {
    return "edge: { sourcename: \"" + from + "\" targetname: \"" + to + "\" }\n";
  };
  const std::string two = node("main", "100 bytes (static)") + node("f.cpp:leaf", "20 bytes (static)");
  CHECK(deepest(two) == 100.0);
  CHECK(deepest(two + edge("main", "f.cpp:leaf") + edge("main", "memset")) == 120.0);
  CHECK(deepest(two + edge("main", "__indirect_call")) == 120.0);
  CHECK_THROWS(deepest(two + edge("main", "f.cpp:leaf") + edge("f.cpp:leaf", "__indirect_call")));
  CHECK_THROWS(deepest(two + edge("main", "f.cpp:leaf") + edge("f.cpp:leaf", "main")));
  CHECK_THROWS(deepest(node("main", "100 bytes (dynamic)")));
}

TEST_CASE("broken files of promises are refused") {
  CHECK_THROWS(parse_budgets("[]"));
  CHECK_THROWS(parse_budgets("[{\"promise\": \"x\", \"figure\": \"y\"}]"));
  CHECK_THROWS(parse_budgets("{"));
  CHECK_THROWS(parse_hashes("[1]"));
  const Budget plain = parse_budgets("[{\"promise\": \"x\", \"figure\": \"y\", \"at_most\": 3}]").at(0);
  CHECK(plain.at_most == 3.0);
  CHECK(plain.goal == 3.0);
  CHECK(parse_budgets("[{\"promise\": \"x\", \"figure\": \"y\", \"at_most\": 3, \"goal\": 2}]").at(0).goal == 2.0);
}

}  // namespace test_firmware_report
