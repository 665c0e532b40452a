#include "tools/match/options.hpp"

#include <CLI/CLI.hpp>

#include "tools/input/options.hpp"
#include "tools/io/threads_option.hpp"

namespace shortshot_bench {

bool parse_match_options(int argc, const char* const* argv, MatchCommand& command, int& exit_code) {
  CLI::App app(
      "Where is cloud B in cloud A? Prints the pose that moves B onto A and how sure it is, and draws both. Without "
      "files: two views of a tabletop made up on the spot. The exit code is 0 if B is found, 1 if not, 2 for bad "
      "input.");
  app.name("match");
  app.add_option("clouds", command.clouds, "A and B: PCD or PLY files, or DEPTH.png[,COLOR.png]");
  add_input_options(app, command.input);
  command.input.drop_zeros = true;  // a heap of points in one place would be a surface to the refinement
  app.add_option("--whole", command.whole,
                 "a, b or both: shows an object from all sides; its frames look outwards, in place of at a camera")
      ->check(CLI::IsMember({"a", "b", "both"}));
  app.add_option("--radius", command.match.radius, "support radius, in the clouds' unit [suggested by their spacing]")
      ->check(finite_and_positive);
  app.add_option("--leaf", command.match.leaf, "voxel size of the key points; pairs agree within it [radius / 4]")
      ->check(finite_and_positive);
  app.add_option("--expected", command.match.expected,
                 "found is what chance would find less often than that in a pair of clouds that have nothing in common")
      ->check(finite_and_positive)
      ->capture_default_str();
  add_threads_option(app, command.match.threads);
  app.add_option("--out", command.out, "writes OUT.png, OUT-moved.png and OUT-pose.txt")->capture_default_str();
  app.add_option("--width", command.width, "of the pictures, in pixels")
      ->check(CLI::Range(400, 8000))
      ->capture_default_str();
  app.add_flag("--quiet", command.quiet, "one line for programs to read, and no files");
  exit_code = 0;
  try {
    app.parse(argc, argv);
    if (command.clouds.size() != 0 && command.clouds.size() != 2) {
      throw CLI::ValidationError("clouds", "A and B are two, not " + std::to_string(command.clouds.size()));
    }
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return false;
  }
  return true;
}

}  // namespace shortshot_bench
