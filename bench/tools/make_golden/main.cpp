// make_golden DIRECTORY: the golden vectors of the compact descriptors.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "clouds.hpp"
#include "rows.hpp"
#include "write_case.hpp"

int main(int argc, char** argv) {
  using namespace shortshot_bench::make_golden;
  CLI::App app{
      "Writes the golden vectors of the compact descriptors, one folder for each of some generated clouds. They are "
      "what "
      "an oracle in double precision makes, which shares no code with the library."};
  std::string directory;
  app.add_option("directory", directory, "where the folders go, such as tests/golden")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    for (const Cloud& cloud : make_clouds()) {
      const Frames frames = make_frames(cloud);
      write_case(directory + "/" + cloud.name, cloud, frames, make_rows(cloud, frames.axes));
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
