// The command line of the paper's experiments, what they say of folders, and the claims' verdicts.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "dataset_samples.hpp"
#include "paper/claims.hpp"
#include "paper/figures.hpp"
#include "paper/matching_experiment.hpp"
#include "paper/options.hpp"
#include "paper/recognition_experiment.hpp"

namespace test_paper_options {
namespace {

using namespace shortshot_bench::paper;

bool parse(std::vector<const char*> arguments, PaperOptions& options, int& exit_code) {
  arguments.insert(arguments.begin(), "paper");
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), options, exit_code);
}

}  // namespace

TEST_CASE("paper: options") {
  PaperOptions options;
  int exit_code = -1;
  REQUIRE(
      parse({"matching", "a", "b", "--shard", "2/3", "--descriptor", "ssh32,scsh336", "--quick"}, options, exit_code));
  CHECK(options.command == "matching");
  CHECK(options.data == std::vector<std::string>{"a", "b"});
  CHECK(options.out == "paper-matching");
  CHECK((options.shard.k == 2 && options.shard.n == 3));
  CHECK(options.descriptors == std::vector<std::string>{"ssh32", "scsh336"});
  CHECK((options.quick && !options.check));
  options = {};
  REQUIRE(parse({"matching", "a", "--descriptor", "ssh32", "--keep-frames", "50,5"}, options, exit_code));
  CHECK(options.descriptors ==
        std::vector<std::string>{"ssh32", "ssh32-best50", "ssh32-random50", "ssh32-best5", "ssh32-random5"});
  REQUIRE(parse({"matching", "a", "--radius", "0.1", "--leaf", "0.03", "--normal-radius", "0.02"}, options, exit_code));
  const ViewSettings settings = with_options({}, options);
  CHECK((settings.radius == 0.1f && settings.leaf == 0.03f && settings.normal_radius == 0.02f));
  options = {};
  CHECK(with_options({}, options).radius == ViewSettings{}.radius);
  REQUIRE(parse({"recognition", "a", "--up", "y", "--scale", "0.001"}, options, exit_code));
  CHECK((options.up == 'y' && options.scale == 0.001));
  options = {};
  REQUIRE(parse({"recognition", "a"}, options, exit_code));
  CHECK(options.descriptors.size() == 6);
  options = {};
  REQUIRE(parse({"registration", "a", "--peer", "x=y", "--peer", "z=w", "--tolerance", "0.02"}, options, exit_code));
  CHECK(options.peers == std::vector<std::string>{"x=y", "z=w"});
  CHECK(options.tolerance_m == 0.02f);
  CHECK(options.descriptors.front() == "cshot1344");
  CHECK(options.descriptors.size() > 20);
}

TEST_CASE("paper: wrong options end with exit code 2") {
  for (const std::vector<const char*>& arguments : {std::vector<const char*>{},
                                                    {"matching"},
                                                    {"matching", "a", "--shard", "4/3"},
                                                    {"matching", "a", "--tolerance", "nan"},
                                                    {"matching", "a", "--tolerance", "0"},
                                                    {"matching", "a", "--radius", "-1"},
                                                    {"matching", "a", "--scale", "inf"},
                                                    {"recognition", "a", "--up", "down"},
                                                    {"matching", "a", "--keep-frames", "100"},
                                                    {"matching", "a", "--keep-frames", "0"},
                                                    {"cooking", "a"},
                                                    {"merge", "a"}}) {
    PaperOptions options;
    int exit_code = -1;
    CHECK_FALSE(parse(arguments, options, exit_code));
    CHECK(exit_code == 2);
  }
}

TEST_CASE("paper: data sets are found in a folder, or in the folders in it") {
  const dataset_test::Folder folder;
  folder.add("kinect/view_pairs.csv", "source,target,gt\na.pcd,b.pcd,m.xf\n");
  folder.add("kinect/view_pairs_gt/m.xf", dataset_test::no_motion());
  folder.add("kinect/views_color/a.pcd", dataset_test::pcd_at(1.0f));
  folder.add("kinect/views_color/b.pcd", dataset_test::pcd_at(2.0f));
  folder.add("other/notes.txt", "nothing");
  PaperOptions options;
  options.command = "matching";
  options.descriptors = {"ssh32"};
  for (const std::string& directory : {folder.path(), folder.path("kinect")}) {
    options.data = {directory};
    const Experiment experiment = matching_experiment(options);
    REQUIRE(experiment.units.size() == 1);
    CHECK(experiment.parameters.at("sets").at(0).at("name") == "kinect views");
    CHECK(experiment.parameters.at("units").at(0) == experiment.units[0].key);
  }
  options.data = {folder.path("other")};
  CHECK(dataset_test::error_in(folder, [&] {
          static_cast<void>(matching_experiment(options));
        }).find("SET/other: expected a folder with object_scene_pairs.csv") == 0);
  CHECK(dataset_test::error_in(folder, [&] {
          static_cast<void>(recognition_experiment(options));
        }).find("SET/other: expected a folder with labels.csv") == 0);
}

TEST_CASE("paper: folders of one name are told apart, with or without a slash behind; one given twice is refused") {
  const dataset_test::Folder folder;
  for (const std::string place : {"one/views/", "two/views/"}) {
    folder.add(place + "view_pairs.csv", "source,target,gt\na.pcd,b.pcd,m.xf\n");
    folder.add(place + "view_pairs_gt/m.xf", dataset_test::no_motion());
    folder.add(place + "views_color/a.pcd", dataset_test::pcd_at(1.0f));
    folder.add(place + "views_color/b.pcd", dataset_test::pcd_at(2.0f));
  }
  PaperOptions options;
  options.command = "matching";
  options.descriptors = {"ssh32"};
  options.data = {folder.path("one/views/"), folder.path("two/views")};
  const Experiment experiment = matching_experiment(options);
  REQUIRE(experiment.units.size() == 2);
  CHECK(experiment.units[0].key == "one/views views/a b");
  CHECK(experiment.units[1].key == "two/views views/a b");
  options.data = {folder.path("one/views/"), folder.path("one/views")};
  CHECK(dataset_test::error_in(folder, [&] { static_cast<void>(matching_experiment(options)); }) ==
        "SET/one/views: this folder is given twice");
}

TEST_CASE("paper: views of which none is to be tested are refused, and that is said") {
  const dataset_test::Folder folder;
  folder.add("mug_1_1_1.pcd", dataset_test::pcd_at(1.0f));  // videos 1 and 4 train, 2 tests
  folder.add("mug_1_4_1.pcd", dataset_test::pcd_at(1.0f));
  PaperOptions options;
  options.command = "recognition";
  options.descriptors = {"ssh32"};
  options.data = {folder.path()};
  CHECK(dataset_test::error_in(folder, [&] { static_cast<void>(recognition_experiment(options)); }) ==
        "SET: expected a folder with labels.csv, CLASS_INSTANCE_VIDEO_FRAME.pcd (three numbers) or "
        "OBJECT/clouds/NP1_0.pcd, or classes.csv with OBJECT/textured.obj (there are 2 views of the set 'w-rgbd', but "
        "not both: some to train and some to test), found none of them");
}

TEST_CASE("paper: a figure that is not there, and data without a band, are no success") {
  const std::vector<FigureValue> figures{{"set", "scsh336", "precision", {0.5, 0.4, 0.6}}};
  const nlohmann::ordered_json band = {
      {"data", "set"}, {"descriptor", "scsh336"}, {"figure", "success"}, {"at_least", 0.0}, {"at_most", 1.0}};
  CHECK(broken_bands(figures, nlohmann::ordered_json::array({band})) ==
        std::vector<std::string>{"set, scsh336, success: not measured"});
  CHECK(broken_bands({}, nlohmann::ordered_json::array({band})) ==
        std::vector<std::string>{"no band is known for these data"});
  nlohmann::ordered_json other = band;
  other["figure"] = "precision";
  other["at_most"] = 0.45;
  CHECK(broken_bands(figures, nlohmann::ordered_json::array({other})) ==
        std::vector<std::string>{"set, scsh336, precision: 0.5 is not from 0 to 0.45"});
}

TEST_CASE("paper: claims hold, do not hold, or are undecided") {
  const auto verdict_of = [](double low, double high) { return verdict({"", "", {0.0, low, high}, 0.1, ""}); };
  CHECK(verdict_of(0.1, 0.3) == "holds");
  CHECK(verdict_of(0.0, 0.3) == "undecided");
  CHECK(verdict_of(0.0, 0.09) == "does not hold");
  const auto gain = [](double low, double high) { return verdict({"", "", {0.0, low, high}, 0.0, "", true}); };
  CHECK(gain(0.0, 0.0) == "does not hold");
  CHECK(gain(0.0, 0.1) == "undecided");
  CHECK(gain(0.01, 0.1) == "holds");
  const shortshot_bench::campaign::Section section =
      section_of({Claim{"The claim", "figure", {0.0, -1.0, 0.0}, 0.1, "The reason."}});
  CHECK(section.text.find("The claim: does not hold. Likely reason: The reason.") != std::string::npos);
}

}  // namespace test_paper_options
