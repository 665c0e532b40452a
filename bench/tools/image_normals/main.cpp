// image_normals [CLOUD...]: a table of how far the normals of depth images are from the exact ones, in degrees.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tools/image_normals/normal_errors.hpp"
#include "tools/io/finite_and_positive.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/scene/tabletop.hpp"

int main(int argc, char** argv) {
  using namespace shortshot_bench;
  CLI::App app(
      "The angle between normals by estimate_image_normals() and by estimate_normals(), median / 90 %, by the distance "
      "from an edge and by depth; of depth images, or of three generated tabletops.");
  app.name("image_normals");
  std::string name = "generated tabletop";
  std::vector<std::string> clouds;
  std::vector<float> radii{0.01f, 0.015f, 0.02f, 0.03f};
  app.add_option("clouds", clouds, "organized PCD or PLY files, one row of the table for all of them");
  app.add_option("--name", name, "of that row")->capture_default_str();
  app.add_option("--radius", radii, "meters; a row for each")->check(finite_and_positive)->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    std::vector<RgbdCloud> images;
    for (const std::string& file : clouds) images.push_back(read_cloud(file));
    for (std::uint32_t seed = 1; clouds.empty() && seed <= 3; ++seed) images.push_back(make_tabletop({seed}));
    std::fputs(heading_of_errors().c_str(), stdout);
    for (const float radius : radii) {
      NormalErrors errors;
      for (const RgbdCloud& image : images) add_errors(image, radius, errors);
      std::fputs(row_of_errors(name, radius, errors).c_str(), stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
