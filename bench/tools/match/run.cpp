#include "tools/match/run.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "tools/io/binary_file.hpp"
#include "tools/io/folder_name.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/match/match.hpp"
#include "tools/match/pictures.hpp"
#include "tools/match/report.hpp"
#include "tools/scene/tabletop.hpp"

namespace shortshot_bench {
namespace {

/// What was not found leaves no pose, also none of an earlier run.
void write_files(const MatchCommand& command, const NamedCloud& a, const NamedCloud& b, const MatchResult& result) {
  const std::string picture = command.out + ".png";
  const std::string moved_picture = command.out + "-moved.png";
  const std::string pose = command.out + "-pose.txt";
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

}  // namespace

bool run_match(const MatchCommand& command) {
  const bool is_generated = command.clouds.empty();
  TabletopOptions other_view;
  other_view.turn = 0.25;
  const RgbdCloud a = is_generated ? make_tabletop() : read_cloud(command.clouds[0]);
  const RgbdCloud b = is_generated ? make_tabletop(other_view) : read_cloud(command.clouds[1]);
  const auto start = std::chrono::steady_clock::now();
  const MatchResult result = match_clouds(a, b, command.match);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  if (command.quiet) {
    std::printf("%s\n", quiet_line(result).c_str());
    return result.is_found;
  }
  const NamedCloud named_a{is_generated ? "generated tabletop" : folder_name(command.clouds[0]), a};
  const NamedCloud named_b{is_generated ? "the same, turned" : folder_name(command.clouds[1]), b};
  std::printf("A: %s, %zu points\nB: %s, %zu points\n", named_a.name.c_str(), a.size(), named_b.name.c_str(), b.size());
  print_report(result, elapsed.count());
  write_files(command, named_a, named_b, result);
  return result.is_found;
}

}  // namespace shortshot_bench
