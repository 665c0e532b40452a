#include "tools/demo/options.hpp"

#include <CLI/CLI.hpp>

#include "tools/input/options.hpp"

namespace shortshot_bench {
bool parse_options(int argc, const char* const* argv, DemoOptions& options, int& exit_code) {
  CLI::App app(
      "Describe the key points of RGB-D point clouds; without a file, of a tabletop scene made up on the spot.");
  app.name("demo");
  app.add_option("clouds", options.clouds, "PCD or PLY files, or DEPTH.png[,COLOR.png]");
  add_input_options(app, options.input);
  app.add_option(
         "--descriptor", options.descriptor,
         "shapecolor95, shapecolor32, roomcolor95, heightshape96, colorrings27 (compact); ssh32, ssh96, scsh336, "
         "scsh696, intensity336, shot352 or cshot1344")
      ->check(CLI::IsMember({"shapecolor95", "shapecolor32", "roomcolor95", "heightshape96", "colorrings27", "ssh32",
                             "ssh96", "scsh336", "scsh696", "intensity336", "shot352", "cshot1344"}))
      ->capture_default_str();
  const auto* const radius =
      app.add_option("--radius", options.radius,
                     "support radius, in the clouds' unit [of files: suggested by the spacing of their points]")
          ->check(finite_and_positive)
          ->capture_default_str();
  app.add_option(
         "--normal-radius", options.normal_radius,
         "estimate normals for shot352 and cshot1344 within this radius [the file's; else a quarter of --radius]")
      ->check(finite_and_positive);
  const auto* const leaf =
      app.add_option("--leaf", options.leaf,
                     "voxel size of the uniform key points, in the same unit [of files: radius / 2]")
          ->check(finite_and_positive)
          ->capture_default_str();
  app.add_option("--search", options.search, "grid, nanoflann, organized or brute")
      ->check(CLI::IsMember({"grid", "nanoflann", "organized", "brute"}))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "threads, 1 to 256")->check(CLI::Range(1, 256))->capture_default_str();
  app.add_option("--out", options.out, "write the descriptors to this .npy or .pcd file (one cloud only)");
  options.picture = "demo.png";
  app.add_option(
         "--picture", options.picture,
         "PNG file to draw, of one cloud with its key points, or two views of the generated scene; - draws none")
      ->capture_default_str();
  app.add_flag("--towards-camera", options.towards_camera, "turn the frames' z axes towards the camera");
  app.add_flag("--drop-zeros", options.input.drop_zeros, "leave out points of (0, 0, 0)");
  app.add_flag(
      "--check", options.check,
      "compare all searches (large clouds: a sample of brute force), and 1, 2 and 3 threads: exit 1 if a bit differs");
  app.add_flag(
      "--diagnose", options.diagnose,
      "describe nothing: say whether points, unit and radius can work, and what to do; exit 1 if something is wrong");
  exit_code = 0;
  try {
    app.parse(argc, argv);
    const auto ends_with = [&](const std::string& end) {
      return options.out.size() > end.size() && options.out.substr(options.out.size() - end.size()) == end;
    };
    if (!options.out.empty() && !ends_with(".npy") && !ends_with(".pcd")) {
      throw CLI::ValidationError("--out", "must end in .npy or .pcd, not '" + options.out + "'");
    }
    if (!options.out.empty() && options.clouds.size() > 1) {
      throw CLI::ValidationError("--out", "takes one cloud, not " + std::to_string(options.clouds.size()));
    }
    options.suggest_radius = radius->count() == 0 && !options.clouds.empty() && !options.diagnose;
    options.suggest_leaf = leaf->count() == 0 && !options.clouds.empty() && !options.diagnose;
    if (options.picture == "-" || options.clouds.size() > 1 || options.diagnose) options.picture.clear();
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return false;
  }
  return true;
}

}  // namespace shortshot_bench
