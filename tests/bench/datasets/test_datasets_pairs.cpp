// Pairs of clouds with their true motion, on folders that are made here.
#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "dataset_samples.hpp"
#include "paper/datasets/pair_sets.hpp"
#include "tools/labels/dataset_files.hpp"

namespace test_datasets_pairs {
namespace {

using namespace dataset_test;
using shortshot_bench::datasets::looked_for_pairs;
using shortshot_bench::datasets::not_recognized;
using shortshot_bench::datasets::open_pair_sets;
using shortshot_bench::datasets::PairSet;
using shortshot_bench::datasets::ViewPair;

constexpr auto scene_table =
    "gt,scene,object,other,model\nb.xf,scene2,Mug,7,mug.pcd\na.xf, scene1 ,\"Big, mug\",7,mug.pcd\n";
constexpr auto view_table = "object,source,target,gt\nMug,a.pcd,b.pcd,ab.xf\n";

void add_scenes(const Folder& folder) {
  folder.add("object_scene_pairs.csv", scene_table);
  folder.add("models_color/mug.pcd", pcd_at(1.0F));
  folder.add("scenes_xyz/scene1.pcd", pcd_at(2.0F, false));
  folder.add("scenes_xyz/scene2.pcd", pcd_at(3.0F, false));
  folder.add("groundtruth/a.xf", no_motion());
  folder.add("groundtruth/b.xf", quarter_turn());
}

void add_views(const Folder& folder) {
  folder.add("view_pairs.csv", view_table);
  folder.add("views_color/a.pcd", pcd_at(4.0F));
  folder.add("views_color/b.pcd", pcd_at(5.0F));
  folder.add("view_pairs_gt/ab.xf", quarter_turn());
}

std::string error_of_opening(const Folder& folder) {
  return error_in(folder, [&] { open_pair_sets(folder.path()); });
}

// What is said about another motion.
std::string error_of_motion(const std::string& motion) {
  const Folder folder;
  add_views(folder);
  folder.add("view_pairs_gt/ab.xf", motion);
  const std::string error = error_of_opening(folder);
  const std::string file = "SET/view_pairs_gt/ab.xf:";
  return error.rfind(file, 0) == 0 ? error.substr(file.size()) : "no name: " + error;
}

}  // namespace

TEST_CASE("object-scene pairs: the columns by name, scenes without colors, the model as the source") {
  const Folder folder;
  add_scenes(folder);
  const auto sets = open_pair_sets(folder.path());
  REQUIRE(sets.size() == 1);
  const PairSet& set = sets[0];
  CHECK(set.name == "object-scene");
  CHECK_FALSE(set.has_color);
  REQUIRE(set.size() == 2);
  CHECK(set.pair_names == std::vector<std::string>{"scene2 Mug", "scene1 Big, mug"});
  CHECK(set.groups == std::vector<std::string>{"scene2", "scene1"});
  CHECK(set.rotation_deg[0] == doctest::Approx(90.0));
  CHECK(set.rotation_deg[1] == 0.0);
  const ViewPair pair = set.load(0);
  CHECK(pair.name == "scene2 Mug");
  CHECK(pair.source.xyz[0] == 1.0F);
  CHECK(pair.target.xyz[0] == 3.0F);
  CHECK_FALSE(pair.target.has_colors());
  CHECK(pair.rotation_deg == set.rotation_deg[0]);
  CHECK(pair.truth == shortshot_bench::datasets::RigidMotion{0, -1, 0, 0.5, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
}

TEST_CASE("view pairs have colors and are grouped by their source; a folder may hold several sets") {
  const Folder folder;
  add_scenes(folder);
  add_views(folder);
  const auto sets = open_pair_sets(folder.path());
  REQUIRE(sets.size() == 2);
  CHECK(sets[1].name == "views");
  CHECK(sets[1].has_color);
  CHECK(sets[1].pair_names == std::vector<std::string>{"a b"});
  CHECK(sets[1].groups == std::vector<std::string>{"a"});
  const ViewPair pair = sets[1].load(0);
  CHECK(pair.source.xyz[0] == 4.0F);
  CHECK(pair.target.xyz[0] == 5.0F);
  CHECK(pair.target.rgb == std::vector<std::uint8_t>{1, 2, 3});
  REQUIRE(sets[1].clouds == 2);
  CHECK(sets[1].load_cloud(sets[1].sources[0]).xyz[0] == 4.0F);
  CHECK(sets[1].load_cloud(sets[1].targets[0]).xyz[0] == 5.0F);
  CHECK(sets[1].truths[0] == pair.truth);
}

TEST_CASE("a copy of the set outlives it; there is no pair past the last") {
  PairSet set;
  const Folder folder;
  add_views(folder);
  set = open_pair_sets(folder.path()).front();
  CHECK(set.load(0).source.size() == 1);
  CHECK_THROWS_AS(set.load(1), std::out_of_range);
}

TEST_CASE("a folder without pairs has no set, and what to say about it is at hand") {
  const Folder folder;
  const auto said = [&] { return error_in(folder, [&] { throw not_recognized(folder.path(), looked_for_pairs); }); };
  const std::string looked_for =
      "SET: expected a folder with object_scene_pairs.csv, view_pairs.csv or frame_pairs.csv, found ";
  CHECK(open_pair_sets(folder.path()).empty());
  CHECK(said() == looked_for + "no folder of this name");
  folder.add("labels.csv", "file\na\n");
  CHECK(open_pair_sets(folder.path()).empty());
  CHECK(said() == looked_for + "none of them");
}

TEST_CASE("broken tables are refused by file and line") {
  const auto error_of_table = [](const std::string& table) {
    const Folder folder;
    add_views(folder);
    folder.add("view_pairs.csv", table);
    return error_of_opening(folder);
  };
  const std::string file = "SET/view_pairs.csv:";
  const std::string header = "object,source,target,gt\n";
  CHECK(error_of_table(view_table) == "no error");
  CHECK(error_of_table(header + "\nMug,a.pcd,b.pcd,ab.xf") == "no error");  // no line end, but a blank line
  CHECK(error_of_table("") == file + "1: Header missing in file \"view_pairs.csv\".");
  CHECK(error_of_table("source,target\na,b\n") ==
        file + "1: Missing column \"gt\" in header of file \"view_pairs.csv\".");
  CHECK(error_of_table("source,gt,target,gt\na,b,c,d\n") ==
        file + "1: Duplicated column \"gt\" in header of file \"view_pairs.csv\".");
  CHECK(error_of_table(header) == file + "1: expected one or more rows below the header, found none");
  CHECK(error_of_table(view_table + std::string("Mug,a.pcd\n")) ==
        file + "3: Too few columns in line 3 in file \"view_pairs.csv\".");
  CHECK(error_of_table(view_table + std::string("Mug,a.pcd,b.pcd,ab.xf,1\n")) ==
        file + "3: Too many columns in line 3 in file \"view_pairs.csv\".");
  CHECK(error_of_table(header + "Mug,a.pcd, ,ab.xf\n") == file + "2: expected text in column target, found none");
  CHECK(error_of_table(header + "Mug,\"a.pcd,b.pcd,ab.xf\n").rfind(file + "2: ", 0) == 0);
}

TEST_CASE("what is no rigid motion is refused") {
  CHECK(error_of_motion("1 0 0 0\n0 1 0 0\n0 0 1 0\n") == "3: expected 4 rows for a rigid motion, found only 3");
  CHECK(error_of_motion(no_motion() + "0 0 0 1\n") ==
        "5: expected 4 rows of 4 numbers for a rigid motion, found another one of 4");
  CHECK(error_of_motion("1 0 0 0\n0 1 0\n") ==
        "2: expected 4 rows of 4 numbers for a rigid motion, found another one of 3");
  CHECK(error_of_motion("1 0 0 0\n0 1 O 0\n") == "2: expected a number for a rigid motion, found 'O'");
  CHECK(error_of_motion("1 0 0 nan\n") == "1: expected finite numbers for a rigid motion, found 'nan'");
  CHECK(error_of_motion("") == "1: expected 4 rows for a rigid motion, found only 0");
  CHECK(error_of_motion("1.01 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n") ==
        " expected a rotation R, found R^T R off 1 by 0.020100");
  CHECK(error_of_motion("1.004 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n") == "no name: no error");
  CHECK(error_of_motion("1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n") == " expected a rotation, found a mirror image");
  CHECK(error_of_motion("1 0 0 0\n0 1 0 0\n0 0 1 0\n0.5 0 0 1\n") ==
        " expected 0 0 0 1 as the last row, found another");
}

TEST_CASE("missing files are named when the set is opened, before any work is done; broken ones when they are loaded") {
  const Folder folder;
  add_views(folder);
  folder.remove("views_color/b.pcd");
  CHECK(error_of_opening(folder) ==
        "SET/views_color/b.pcd: expected a cloud's file, found no file of this name; 1 of 2 are missing");
  const auto load = [&] { open_pair_sets(folder.path()).front().load(0); };
  folder.add("views_color/b.pcd", pcd_at(5.0F, false));
  CHECK(error_in(folder, load) == "SET/views_color/b.pcd: expected a cloud with colors, found none");
  folder.add("views_color/b.pcd", "no cloud");
  CHECK(error_in(folder, load).rfind("SET/views_color/b.pcd:1: ", 0) == 0);
  folder.remove("view_pairs_gt/ab.xf");
  CHECK(error_of_opening(folder) == "SET/view_pairs_gt/ab.xf: expected a rigid motion, found no file of this name");
}

TEST_CASE("other units are made meters: of clouds and of motions") {
  const Folder folder;
  add_scenes(folder);
  const PairSet set = shortshot_bench::datasets::scaled(open_pair_sets(folder.path()).front(), 0.001);
  const ViewPair pair = set.load(0);
  CHECK(pair.source.xyz[0] == 0.001F);
  CHECK(pair.target.xyz[0] == 0.003F);
  CHECK(pair.truth[3] == 0.0005);
  CHECK(pair.truth == set.truths[0]);
  CHECK(set.load_cloud(set.targets[0]).xyz[0] == 0.003F);
}

}  // namespace test_datasets_pairs
