#include "tools/match/run.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tools/input/read_input.hpp"
#include "tools/io/binary_file.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/match/match.hpp"
#include "tools/match/pictures.hpp"
#include "tools/match/report.hpp"
#include "tools/scene/tabletop.hpp"

namespace shortshot_bench {
namespace {

struct OutputFiles {
  std::string picture, moved_picture, pose;
};

OutputFiles outputs_of(const MatchCommand& command) {
  return {command.out + ".png", command.out + "-moved.png", command.out + "-pose.txt"};
}

void keep_inputs(const MatchCommand& command) {
  const auto [picture, moved_picture, pose] = outputs_of(command);
  for (const std::string& input : command.clouds) {
    for (const std::string& output : {picture, moved_picture, pose}) keep_input(input, output);
  }
}

/// What was not found leaves no pose, also none of an earlier run.
void write_files(const MatchCommand& command, const NamedCloud& a, const NamedCloud& b, const MatchResult& result) {
  const auto [picture, moved_picture, pose] = outputs_of(command);
  draw_matches(a, b, result, command.width).write_png(picture);
  std::printf("written: %s\n", picture.c_str());
  if (!result.is_found) {
    std::filesystem::remove(moved_picture);
    std::filesystem::remove(pose);
    return;
  }
  draw_moved(a, b, result, command.width).write_png(moved_picture);
  write_file(pose, pose_text(result.pose));
  std::printf("written: %s, %s\n", moved_picture.c_str(), pose.c_str());
}

RgbdCloud read_side(const MatchCommand& command, std::size_t side) {
  RgbdCloud cloud = read_input(command.clouds[side], command.input);
  cloud.is_whole = command.whole == "both" || command.whole == (side == 0 ? "a" : "b");
  return cloud;
}

void print_cloud(char letter, const NamedCloud& named) {
  const RgbdCloud& cloud = named.cloud;
  std::printf("%c: %s, %zu points\n", letter, named.name.c_str(), cloud.size());
  print_notes(cloud);
  if (cloud.is_whole || !surrounds_its_viewpoint(cloud)) return;
  std::printf("note: %c lies around its viewpoint: if it shows an object from all sides, say so with --whole\n",
              letter);
}

}  // namespace

bool run_match(const MatchCommand& command) {
  if (!command.quiet) keep_inputs(command);
  const bool is_generated = command.clouds.empty();
  TabletopOptions other_view;
  other_view.turn = 0.25;
  const RgbdCloud a = is_generated ? make_tabletop() : read_side(command, 0);
  const RgbdCloud b = is_generated ? make_tabletop(other_view) : read_side(command, 1);
  const auto start = std::chrono::steady_clock::now();
  const MatchResult result = match_clouds(a, b, command.match);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  if (command.quiet) {
    std::printf("%s\n", quiet_line(result).c_str());
    return result.is_found;
  }
  const NamedCloud named_a{is_generated ? "generated tabletop" : name_of_input(command.clouds[0]), a};
  const NamedCloud named_b{is_generated ? "the same, turned" : name_of_input(command.clouds[1]), b};
  print_cloud('A', named_a);
  print_cloud('B', named_b);
  print_report(result, elapsed.count());
  write_files(command, named_a, named_b, result);
  return result.is_found;
}

}  // namespace shortshot_bench
