// firmware_small_sensor: for each small depth sensor a model and frames for the programs on microcontrollers, and how
// well a hosted recognizer does on them.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "firmware/host/host_facts.hpp"
#include "firmware/small_sensor/task.hpp"
#include "tools/io/binary_file.hpp"
#include "tools/io/require_ok.hpp"

namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::firmware;

void make(const small_sensor::Sensor& sensor, const std::string& directory) {
  const SensorTask task = sensor_task(sensor);
  std::vector<std::uint8_t> model;
  require(shortshot::save_for_flash<small_sensor::Stored>(train_stored(task), model));
  write_file(directory + "/model.bin", std::string(model.begin(), model.end()));
  write_file(directory + "/views.bin", frames_of(task));
  HostFacts floats("small_sensor_on_host", "host_shot352_floats", sensor.name);
  floats.add("views", task.test.size());
  floats.add("right", right_with_shot(task));
  floats.write_to(directory + "/host.txt");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A model and frames of a small depth sensor for microcontrollers: model.bin, views.bin, and host.txt.");
  app.name("firmware_small_sensor");
  std::string directory;
  std::size_t sensor = 0;
  app.add_option("sensor", sensor, "0: 8x8 zones, 1: 16x16, 2: 32x24, 3: 64x48")->required()->check(CLI::Range(0, 3));
  app.add_option("directory", directory, "where the files go")->required()->check(CLI::ExistingDirectory);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    make(small_sensor::sensors[sensor], directory);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
