#include "paper/datasets/pair_sets.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>

#include "paper/datasets/rgbd_frame.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/labels/csv_table.hpp"
#include "tools/labels/dataset_files.hpp"

namespace shortshot_bench::datasets {
namespace {

using ReadView = std::function<RgbdCloud(const std::string&)>;

// A pair before it is loaded; source and target are what ReadView wants.
struct PairEntry {
  std::string name;
  std::string group;
  std::string source;
  std::string target;
  RigidMotion truth;
};

using Files = std::vector<std::string>;

Files itself(const std::string& cloud) { return {cloud}; }

std::string stem(const std::string& file) { return std::filesystem::path(file).stem().string(); }

RigidMotion scaled(RigidMotion motion, double meters) {
  for (const std::size_t i : {3u, 7u, 11u}) motion[i] *= meters;
  return motion;
}

/// `files_of(cloud)`: what must be there.
template <class FilesOf>
PairSet make_pair_set(const std::string& name, bool has_color, const std::vector<PairEntry>& pairs, ReadView read,
                      const FilesOf& files_of) {
  PairSet set;
  set.name = name;
  set.has_color = has_color;
  std::map<std::string, std::size_t> numbers;
  std::vector<std::string> clouds;
  const auto number_of = [&](const std::string& cloud) {
    const auto [place, is_new] = numbers.try_emplace(cloud, clouds.size());
    if (is_new) clouds.push_back(cloud);
    return place->second;
  };
  for (const PairEntry& pair : pairs) {
    set.sources.push_back(number_of(pair.source));
    set.targets.push_back(number_of(pair.target));
    set.truths.push_back(pair.truth);
    set.pair_names.push_back(pair.name);
    set.groups.push_back(pair.group);
    set.rotation_deg.push_back(rotation_degrees(pair.truth));
  }
  std::vector<std::string> files;
  for (const std::string& cloud : clouds) {
    for (const std::string& file : files_of(cloud)) files.push_back(file);
  }
  require_files(files, "a cloud's file");
  set.clouds = clouds.size();
  set.load_cloud = [clouds = std::move(clouds), read = std::move(read)](std::size_t i) { return read(clouds.at(i)); };
  return set;
}

PairSet object_scene_pairs(const std::string& directory, const std::string& table) {
  std::vector<PairEntry> pairs;
  for (const auto& row : read_csv<4>(table, {"scene", "object", "model", "gt"})) {
    const auto& [scene, object, model, truth] = row.cells;
    pairs.push_back({scene + " " + object, scene, directory + "/models_color/" + model,
                     directory + "/scenes_xyz/" + scene + ".pcd",
                     read_rigid_motion(directory + "/groundtruth/" + truth)});
  }
  return make_pair_set(
      "object-scene", false, pairs, [](const std::string& file) { return read_cloud(file); }, itself);
}

PairSet view_pairs(const std::string& directory, const std::string& table) {
  std::vector<PairEntry> pairs;
  for (const auto& row : read_csv<3>(table, {"source", "target", "gt"})) {
    const auto& [source, target, truth] = row.cells;
    const std::string views = directory + "/views_color/";
    pairs.push_back({stem(source) + " " + stem(target), stem(source), views + source, views + target,
                     read_rigid_motion(directory + "/view_pairs_gt/" + truth)});
  }
  return make_pair_set("views", true, pairs, read_colored_cloud, itself);
}

PairSet frame_pairs(const std::string& directory, const std::string& table, double max_depth) {
  const PinholeCamera camera = read_pinhole_camera(directory + "/camera-intrinsics.txt");
  const auto pose = [&](const std::string& frame) { return read_rigid_motion(directory + "/" + frame + ".pose.txt"); };
  std::vector<PairEntry> pairs;
  for (const auto& row : read_csv<2>(table, {"frame_a", "frame_b"})) {
    const auto& [a, b] = row.cells;
    pairs.push_back({a + " " + b, a, directory + "/" + a, directory + "/" + b, motion_between(pose(a), pose(b))});
  }
  return make_pair_set(
      "frames", true, pairs, [=](const std::string& frame) { return read_frame(frame, camera, max_depth); },
      files_of_frame);
}

}  // namespace

std::vector<PairSet> open_pair_sets(const std::string& directory, double max_depth) {
  std::vector<PairSet> sets;
  const auto open_if_there = [&](const char* file, const auto& open) {
    const std::string table = directory + "/" + file;
    if (is_file(table)) sets.push_back(open(table));
  };
  open_if_there("object_scene_pairs.csv",
                [&](const std::string& table) { return object_scene_pairs(directory, table); });
  open_if_there("view_pairs.csv", [&](const std::string& table) { return view_pairs(directory, table); });
  open_if_there("frame_pairs.csv", [&](const std::string& table) { return frame_pairs(directory, table, max_depth); });
  return sets;
}

PairSet scaled(PairSet set, double meters) {
  if (meters == 1.0 || set.name == "frames") return set;
  for (RigidMotion& truth : set.truths) truth = scaled(truth, meters);
  set.load_cloud = [load = set.load_cloud, meters](std::size_t i) { return scaled(load(i), meters); };
  return set;
}

std::vector<std::size_t> every_nth_by_rotation(const PairSet& set, std::size_t step) {
  std::vector<std::size_t> order(set.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return set.rotation_deg[a] < set.rotation_deg[b]; });
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < order.size(); i += step) chosen.push_back(order[i]);
  return chosen;
}

}  // namespace shortshot_bench::datasets
