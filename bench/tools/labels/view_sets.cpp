#include "tools/labels/view_sets.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <system_error>
#include <tuple>
#include <utility>

#include "tools/io/text_rows.hpp"
#include "tools/labels/csv_table.hpp"
#include "tools/labels/dataset_files.hpp"

namespace shortshot_bench::datasets {
namespace {

namespace fs = std::filesystem;

// Paths, relative to the folder, of the files in it and in two levels of folders below.
std::vector<std::string> files_below(const std::string& directory) {
  constexpr int deepest = 2;
  constexpr auto follow_links = fs::directory_options::follow_directory_symlink;
  std::vector<std::string> files;
  try {
    for (fs::recursive_directory_iterator entry(directory, follow_links), end; entry != end; ++entry) {
      if (entry.depth() == deepest) entry.disable_recursion_pending();
      if (entry->is_regular_file()) files.push_back(entry->path().lexically_relative(directory).generic_string());
    }
  } catch (const fs::filesystem_error& error) {
    throw InputError::about(directory, std::string("cannot list the folder's files: ") + error.what());
  }
  return files;
}

// A view with what it is ordered by.
struct OrderedView {
  std::tuple<std::string, int, int, int> order;
  LabeledView view;
};

std::vector<LabeledView> in_order(std::vector<OrderedView> ordered) {
  std::sort(ordered.begin(), ordered.end(), [](const OrderedView& a, const OrderedView& b) {
    return std::tie(a.order, a.view.file) < std::tie(b.order, b.view.file);
  });
  std::vector<LabeledView> views;
  for (OrderedView& view : ordered) views.push_back(std::move(view.view));
  return views;
}

std::vector<LabeledView> segments(const std::string& table) {
  std::vector<LabeledView> views;
  for (const auto& row : read_csv<5>(table, {"file", "object_class", "instance", "scene", "scene_set"})) {
    const auto& [file, object_class, instance, scene, scene_set] = row.cells;
    const bool is_training = scene_set == "learn";
    if (!is_training && scene_set != "test") {
      throw InputError::at_line(table, row.line,
                                "expected learn or test as scene_set, found " + shortshot_bench::quoted(scene_set));
    }
    views.push_back({file, object_class, instance, scene, is_training, !is_training});
  }
  return views;
}

// The number after the text's last '_', and both cut off; -1, and the text as it was, without such a number.
int cut_number(std::string& text) {
  const std::size_t underscore = text.rfind('_');
  if (underscore == std::string::npos) return -1;
  const char* const end = text.data() + text.size();
  int number = -1;
  const std::from_chars_result result = std::from_chars(text.data() + underscore + 1, end, number);
  if (result.ec != std::errc() || result.ptr != end || number < 0) return -1;
  text.resize(underscore);
  return number;
}

std::vector<LabeledView> wrgbd_views(const std::vector<std::string>& files) {
  std::vector<OrderedView> views;
  for (const std::string& file : files) {
    const fs::path path(file);
    std::string name = path.stem().string();
    const int frame = cut_number(name);
    const int video = cut_number(name);
    const std::string instance = name;
    const int number = cut_number(name);
    if (path.extension() != ".pcd" || frame < 0 || video < 0 || number < 0 || name.empty()) continue;
    views.push_back({{name, number, video, frame},
                     {file, name, instance, std::to_string(video), video == 1 || video == 4, video == 2}});
  }
  return in_order(std::move(views));
}

// From the table where there is one.
void assign_classes(std::vector<OrderedView>& views, const std::string& table) {
  if (views.empty() || !is_file(table)) return;
  std::map<std::string, std::string> classes;
  for (const auto& row : read_csv<2>(table, {"object", "object_class"})) {
    if (!classes.emplace(row.cells[0], row.cells[1]).second) {
      throw InputError::at_line(
          table, row.line,
          "expected one class for each object, found a second one for " + shortshot_bench::quoted(row.cells[0]));
    }
  }
  for (OrderedView& ordered : views) {
    const auto found = classes.find(ordered.view.instance);
    if (found == classes.end()) {
      throw InputError::about(
          table, "expected a class for " + shortshot_bench::quoted(ordered.view.instance) + ", found none");
    }
    ordered.view.object_class = found->second;
  }
}

std::vector<LabeledView> bigbird_views(const std::string& directory, const std::vector<std::string>& files) {
  std::vector<OrderedView> views;
  for (const std::string& file : files) {
    const fs::path path(file);
    std::string camera = path.stem().string();
    const int angle = cut_number(camera);
    const bool is_camera =
        camera.size() == 3 && camera.compare(0, 2, "NP") == 0 && camera[2] >= '1' && camera[2] <= '5';
    const fs::path folder = path.parent_path();
    if (path.extension() != ".pcd" || angle < 0 || !is_camera || folder.filename() != "clouds") continue;
    const std::string object = folder.parent_path().string();
    views.push_back({{object, camera[2], angle, 0},
                     {file, object, object, camera, camera == "NP1" || camera == "NP3", camera == "NP2"}});
  }
  assign_classes(views, directory + "/classes.csv");
  return in_order(std::move(views));
}

ViewSet make_view_set(const std::string& name, Split split, const std::string& directory,
                      std::vector<LabeledView> views) {
  std::vector<std::string> paths;
  for (const LabeledView& view : views) paths.push_back(directory + "/" + view.file);
  require_files(paths, "a cloud");
  return {name, split, std::move(views),
          [paths = std::move(paths)](std::size_t i) { return read_colored_cloud(paths.at(i)); }};
}

}  // namespace

std::vector<ViewSet> open_view_sets(const std::string& directory) {
  std::vector<ViewSet> sets;
  const auto add = [&](const char* name, Split split, std::vector<LabeledView> views) {
    if (!views.empty()) sets.push_back(make_view_set(name, split, directory, std::move(views)));
  };
  const std::string labels = directory + "/labels.csv";
  if (is_file(labels)) add("segments", Split::leave_one_sequence_out, segments(labels));
  const std::vector<std::string> files = is_folder(directory) ? files_below(directory) : std::vector<std::string>();
  add("w-rgbd", Split::fixed, wrgbd_views(files));
  add("bigbird", Split::fixed, bigbird_views(directory, files));
  return sets;
}

}  // namespace shortshot_bench::datasets
