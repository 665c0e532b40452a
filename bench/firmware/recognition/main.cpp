// firmware_recognition: a model and views for the programs that recognize on microcontrollers, and how well the hosted
// recognizers do on them.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/programs/recognition.hpp"
#include "firmware/recognition/task.hpp"
#include "tools/io/binary_file.hpp"

namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::firmware;

void write(const std::string& path, const std::string& bytes) {
  BinaryFile file(path);
  file.write(bytes);
  file.close();
}

void make(const std::string& directory) {
  const RecognitionTask task = generated_task();
  const shortshot::Recognizer recognizer = train_stored(task);
  std::vector<std::uint8_t> model;
  if (shortshot::save_for_flash<recognition::Stored>(recognizer, model) != shortshot::Status::ok)
    throw std::runtime_error("the model cannot be saved");
  write(directory + "/model.bin", std::string(model.begin(), model.end()));
  write(directory + "/views.bin", views_of(task));
  std::string facts =
      "program recognition_on_host\ntarget host_cshot1344_floats\nlevel O2\nconfiguration Recognition\nworkspace "
      "full\n";
  const auto fact = [&](const char* name, std::size_t value) {
    facts += std::string("fact ") + name + " " + std::to_string(value) + "\n";
  };
  fact("objects", task.instances.size());
  fact("codewords", recognizer.codeword_count());
  fact("views", task.test.size());
  fact("right", right_with_cshot(task));
  write(directory + "/host.txt", facts);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A model and views for microcontrollers, of generated objects: model.bin, views.bin, and host.txt.");
  app.name("firmware_recognition");
  std::string directory;
  app.add_option("directory", directory, "where the files go")->required()->check(CLI::ExistingDirectory);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    make(directory);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
