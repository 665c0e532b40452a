// Labeled views, on folders that are made here.
#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "dataset_samples.hpp"
#include "tools/labels/view_sets.hpp"

namespace test_datasets_views {
namespace {

using namespace dataset_test;
using shortshot_bench::datasets::LabeledView;
using shortshot_bench::datasets::open_view_sets;
using shortshot_bench::datasets::Split;
using shortshot_bench::datasets::ViewSet;

constexpr auto labels =
    "file,object_class,instance,scene,scene_set\na.pcd,cup,white,learn3,learn\nb.pcd,can,tin,test4,test\n";

std::string error_of_opening(const Folder& folder) {
  return error_in(folder, [&] { open_view_sets(folder.path()); });
}

std::vector<std::string> files_of(const ViewSet& set) {
  std::vector<std::string> files;
  for (const LabeledView& view : set.views) files.push_back(view.file);
  return files;
}

// The part of the split: "train", "test" or nothing.
std::string part_of(const LabeledView& view) {
  return std::string(view.is_training ? "train" : "") + (view.is_test ? "test" : "");
}

void add_bigbird(const Folder& folder) {
  for (const char* name : {"NP1_0", "NP1_30", "NP1_6", "NP2_3", "NP3_0", "NP5_0", "merged", "NP1_0_mask", "NP1_x",
                           "NP_0", "NP6_0", "NP10_0"}) {
    folder.add("tea/clouds/" + std::string(name) + ".pcd", pcd_at(1.0F));
  }
  folder.add("coffee/clouds/NP2_3.pcd", pcd_at(2.0F));
  folder.add("coffee/other/NP2_3.pcd", pcd_at(2.0F));
}

}  // namespace

TEST_CASE("segments: scenes are left out in turn, learn and test are a second split") {
  const Folder folder;
  folder.add("labels.csv", labels);
  folder.add("a.pcd", pcd_at(1.0F));
  folder.add("b.pcd", pcd_at(2.0F));
  const auto sets = open_view_sets(folder.path());
  REQUIRE(sets.size() == 1);
  CHECK(sets[0].name == "segments");
  CHECK(sets[0].split == Split::leave_one_sequence_out);
  REQUIRE(sets[0].views.size() == 2);
  const LabeledView& view = sets[0].views[1];
  CHECK(view.file == "b.pcd");
  CHECK(view.object_class == "can");
  CHECK(view.instance == "tin");
  CHECK(view.sequence == "test4");
  CHECK(part_of(view) == "test");
  CHECK(part_of(sets[0].views[0]) == "train");
  CHECK(sets[0].load(1).xyz[0] == 2.0F);
  CHECK_THROWS_AS(sets[0].load(2), std::out_of_range);
}

TEST_CASE("labels that are broken are refused by file and line, clouds by their names") {
  const Folder folder;
  folder.add("labels.csv", labels + std::string("c.pcd,can,tin,test5,tset\n"));
  CHECK(error_of_opening(folder) == "SET/labels.csv:4: expected learn or test as scene_set, found 'tset'");
  folder.add("labels.csv", "file,object_class,scene,scene_set\na.pcd,cup,learn3,learn\n");
  CHECK(error_of_opening(folder) == "SET/labels.csv:1: Missing column \"instance\" in header of file \"labels.csv\".");
  folder.add("labels.csv", labels);
  folder.add("b.pcd", pcd_at(1.0F, false));
  const auto load = [&](std::size_t i) { return error_in(folder, [&] { open_view_sets(folder.path())[0].load(i); }); };
  CHECK(load(0) == "SET/a.pcd: expected a cloud, found no file of this name; 1 of 2 are missing");
  CHECK(load(1) == load(0));  // before any work is done
  folder.add("a.pcd", "no cloud");
  CHECK(load(0).rfind("SET/a.pcd:1: ", 0) == 0);
  CHECK(load(1) == "SET/b.pcd: expected a cloud with colors, found none");
}

TEST_CASE("W-RGB-D: labels from the files' names, ordered by their numbers, in folders or without") {
  const Folder folder;
  for (const char* file :
       {"apple/apple_2/apple_2_1_1.pcd", "apple/apple_1/apple_1_4_10.pcd", "apple/apple_1/apple_1_4_9.pcd",
        "apple/apple_1/apple_1_3_1.pcd", "cell_phone/cell_phone_10/cell_phone_10_2_101.pcd", "cell_phone_9_1_7.pcd"}) {
    folder.add(file, pcd_at(1.0F));
  }
  for (const char* other : {"apple/apple_1/apple_1_4_9.txt", "apple_1_x_9.pcd", "apple_1_2.pcd", "_1_2_3.pcd",
                            "apple_1_2_12345678901.pcd", "apple_1_-2_3.pcd", "too/deep/for/apple_1_1_1.pcd"}) {
    folder.add(other, pcd_at(1.0F));
  }
  for (const char* end : {"", "/"}) {  // the folder with and without a slash
    const auto sets = open_view_sets(folder.path() + end);
    REQUIRE(sets.size() == 1);
    CHECK(sets[0].name == "w-rgbd");
    CHECK(sets[0].split == Split::fixed);
    REQUIRE(files_of(sets[0]) ==
            std::vector<std::string>{"apple/apple_1/apple_1_3_1.pcd", "apple/apple_1/apple_1_4_9.pcd",
                                     "apple/apple_1/apple_1_4_10.pcd", "apple/apple_2/apple_2_1_1.pcd",
                                     "cell_phone_9_1_7.pcd", "cell_phone/cell_phone_10/cell_phone_10_2_101.pcd"});
    const LabeledView& phone = sets[0].views[5];
    CHECK(phone.object_class == "cell_phone");
    CHECK(phone.instance == "cell_phone_10");
    CHECK(phone.sequence == "2");
    std::string parts;
    for (const LabeledView& view : sets[0].views) parts += part_of(view) + " ";
    CHECK(parts == " train train train train test ");
    CHECK(sets[0].load(5).size() == 1);
  }
}

TEST_CASE("BigBIRD: cameras are the sequences, every object its own class without a table") {
  const Folder folder;
  add_bigbird(folder);
  const auto sets = open_view_sets(folder.path());
  REQUIRE(sets.size() == 1);
  CHECK(sets[0].name == "bigbird");
  CHECK(sets[0].split == Split::fixed);
  REQUIRE(files_of(sets[0]) == std::vector<std::string>{"coffee/clouds/NP2_3.pcd", "tea/clouds/NP1_0.pcd",
                                                        "tea/clouds/NP1_6.pcd", "tea/clouds/NP1_30.pcd",
                                                        "tea/clouds/NP2_3.pcd", "tea/clouds/NP3_0.pcd",
                                                        "tea/clouds/NP5_0.pcd"});
  CHECK(sets[0].views[1].object_class == "tea");
  CHECK(sets[0].views[1].instance == "tea");
  CHECK(sets[0].views[1].sequence == "NP1");
  std::string parts;
  for (const LabeledView& view : sets[0].views) parts += part_of(view) + " ";
  CHECK(parts == "test train train train test train  ");
  CHECK(sets[0].load(0).xyz[0] == 2.0F);
}

TEST_CASE("BigBIRD: classes from a table, which has to have each object once") {
  const Folder folder;
  add_bigbird(folder);
  folder.add("classes.csv", "object,object_class\ntea,can\nwater,bottle\ncoffee,jar\n");
  const auto sets = open_view_sets(folder.path());
  CHECK(sets[0].views[0].object_class == "jar");
  CHECK(sets[0].views[0].instance == "coffee");
  CHECK(sets[0].views[1].object_class == "can");
  folder.add("classes.csv", "object,object_class\ncoffee,jar\n");
  CHECK(error_of_opening(folder) == "SET/classes.csv: expected a class for 'tea', found none");
  folder.add("classes.csv", "object,object_class\ncoffee,jar\ntea,can\ncoffee,can\n");
  CHECK(error_of_opening(folder) ==
        "SET/classes.csv:4: expected one class for each object, found a second one for 'coffee'");
}

TEST_CASE("a folder without labeled views has no set") {
  const Folder folder;
  CHECK(open_view_sets(folder.path()).empty());
  folder.add("classes.csv", "broken");  // of the scanned meshes, say: none of this reader's business
  CHECK(open_view_sets(folder.path()).empty());
}

}  // namespace test_datasets_views
