// Recognition and ablation as the paper measures them, on objects made for the purpose; and that wrong labels do not
// pass.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "paper/accuracy.hpp"
#include "paper/recognition.hpp"
#include "paper/recognition_experiment.hpp"
#include "relief.hpp"

namespace test_paper_recognition {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::paper;

const paper_test::Relief reliefs[] = {
    {60.0, 0.015, 150.0, 80.0}, {60.0, 0.015, 150.0, 15.0}, {110.0, 0.008, 150.0, 80.0}, {110.0, 0.008, 150.0, 15.0}};

/// Two classes by shape, in each two instances by color; four views of each.
RecognitionTask reliefs_task() {
  RecognitionTask task{"reliefs", {}, false, nullptr};
  for (std::size_t i = 0; i < 16; ++i) {
    const std::size_t object = i / 4;
    const std::string name = std::to_string(object);
    task.views.push_back({"view " + std::to_string(i),
                          {object < 2 ? "wide" : "narrow", name},
                          std::to_string(i % 4),
                          i % 2 == 0,
                          i % 2 == 1});
  }
  task.load = [](std::size_t i) {
    return paper_test::view_of(reliefs[i / 4], paper_test::turned(0.25 * static_cast<double>(i % 4)),
                               static_cast<std::uint32_t>(i + 1));
  };
  return task;
}

std::vector<Judgement> judged(const RecognitionTask& task, const Views& views, const std::string& descriptor) {
  const Configuration configuration = configurations_named({descriptor}).front();
  return judgements_of(to_json(task, recognize_views(task, views, configuration, {})));
}

double accuracy(const std::vector<Judgement>& judgements, Correct figure) {
  return over_objects(correct(judgements, figure)).value;
}

}  // namespace

TEST_CASE("recognition: class and instance of reliefs, by both recognizers") {
  const RecognitionTask task = reliefs_task();
  const Views views(task, ViewSettings{});
  CHECK(task.tests() == 8);
  const std::vector<Judgement> judgements = judged(task, views, "scsh336");
  REQUIRE(judgements.size() == 8);
  for (const Correct figure : {hough_class, hough_instance, nearest_class, nearest_instance}) {
    CHECK(accuracy(judgements, figure) >= 0.87);
  }
}

TEST_CASE("recognition: wrong labels of the training views do not pass") {
  const RecognitionTask right = reliefs_task();
  RecognitionTask wrong = right;
  for (RecognitionView& v : wrong.views) {
    if (!v.is_training) continue;
    const int object = (std::stoi(v.label.instance) + 2) % 4;
    v.label = {object < 2 ? "wide" : "narrow", std::to_string(object)};
  }
  const std::vector<Judgement> judgements = judged(wrong, Views(wrong, ViewSettings{}), "scsh336");
  CHECK(accuracy(judgements, hough_class) <= 0.25);
  CHECK(accuracy(judgements, nearest_instance) <= 0.25);
}

TEST_CASE("recognition: one sequence is left out at a time") {
  RecognitionTask task = reliefs_task();
  task.leave_one_sequence_out = true;
  CHECK(task.tests() == 16);
  const std::vector<Judgement> judgements = judged(task, Views(task, ViewSettings{}), "ssh32");
  CHECK(judgements.size() == 16);
  CHECK(accuracy(judgements, nearest_class) > 0.8);
}

TEST_CASE("recognition: every third view is the same view as before") {
  const RecognitionTask task = reliefs_task();
  const RecognitionTask thinned = every_nth(task, 3);
  REQUIRE(thinned.views.size() == 6);
  CHECK(thinned.views[2].name == "view 6");
  CHECK(thinned.load(2).xyz == task.load(6).xyz);
}

TEST_CASE("recognition: the second split tests only what was learnt") {
  datasets::ViewSet set;
  set.name = "segments";
  set.split = datasets::Split::leave_one_sequence_out;
  set.views = {{"a", "cup", "red", "1", true, false},
               {"b", "cup", "red", "2", false, true},
               {"c", "cup", "blue", "2", false, true},
               {"d", "can", "red", "2", false, true}};
  const std::vector<RecognitionTask> tasks = tasks_of(set);
  REQUIRE(tasks.size() == 2);
  CHECK(tasks[0].tests() == 4);
  CHECK(tasks[1].tests() == 1);
  CHECK(tasks[1].views[1].is_test);
}

TEST_CASE("recognition: accuracies and differences by object") {
  const ObjectLabel red{"cup", "red"}, blue{"cup", "blue"}, can{"can", "red"};
  const std::vector<Judgement> a{{red, red, red}, {red, blue, red}, {can, red, red}};
  const std::vector<Judgement> b{{red, red, red}, {red, red, red}, {can, can, can}};
  CHECK(accuracy(a, hough_class) == doctest::Approx(2.0 / 3.0));
  CHECK(accuracy(a, hough_instance) == doctest::Approx(1.0 / 3.0));
  CHECK(accuracy(b, hough_instance) == 1.0);
  CHECK(correct(a, hough_class).size() == 2);  // objects: the can and the red cup
  CHECK(over_objects(difference(correct(a, hough_class), correct(b, hough_class))).value ==
        doctest::Approx(-1.0 / 3.0));
}

TEST_CASE("ablation: a report with sizes, a figure 5 and claims") {
  const auto judgements = [](int right) {
    auto list = nlohmann::ordered_json::array();
    for (int i = 0; i < 10; ++i) {
      const nlohmann::ordered_json truth{"cup", std::to_string(i % 5)};
      const nlohmann::ordered_json wrong{"can", "7"};
      list.push_back({{"view", "v"}, {"truth", truth}, {"hough", i < right ? truth : wrong}, {"nearest", truth}});
    }
    return list;
  };
  nlohmann::ordered_json parameters = {
      {"experiment", "ablation"},
      {"quick", true},
      {"sizes",
       {{"96-16-15", {{"n_g", 96}, {"n_c", 16}, {"h", 15}}}, {"96-24-15", {{"n_g", 96}, {"n_c", 24}, {"h", 15}}}}},
      {"tasks", {{"cups", {{"cshot1344", {"c"}}, {"96-16-15", {"a"}}, {"96-24-15", {"b"}}}}}}};
  const UnitResults results{{"c", judgements(8)}, {"a", judgements(5)}, {"b", judgements(10)}};
  const std::string directory = SHORTSHOT_TEST_OUTPUT;
  const Findings findings = ablation_report(parameters, results, directory);
  const std::string report = campaign::markdown_of(findings.report);
  CHECK(report.find("| 96-16-15 | 336 | 1344 |") != std::string::npos);
  CHECK(report.find("| cups: n_c = 24 is better than 16 | instance accuracy, gain | 0.500") != std::string::npos);
  for (const char* what : {"class", "instance"}) {
    std::ifstream plot(directory + "/task1_" + what + ".svg");
    const std::string svg((std::istreambuf_iterator<char>(plot)), std::istreambuf_iterator<char>());
    CHECK(svg.find(std::string("cups: ") + what + " recognized by the Hough vote") != std::string::npos);
    CHECK(svg.find("n_c = 24") != std::string::npos);
  }
}

}  // namespace test_paper_recognition
