// firmware_recognition: a model and views for the programs that recognize on microcontrollers, and how well hosted
// recognizers do on them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "firmware/host/host_facts.hpp"
#include "firmware/recognition/segments.hpp"
#include "firmware/recognition/task.hpp"
#include "tools/io/binary_file.hpp"
#include "tools/io/require_ok.hpp"

namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::firmware;

struct Options {
  std::string directory;
  std::string segments;
  std::vector<std::size_t> kilobytes;
  std::vector<std::size_t> thinned;
};

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

constexpr const char* program = "recognition_on_host";

/// A model of three key points of two objects, and no views: each of its bytes will be damaged.
void make_small(const std::string& directory, RecognitionTask task) {
  task.training.resize(5);
  task.training.erase(task.training.begin() + 1, task.training.begin() + 4);
  task.training_keypoints = 3;
  std::vector<std::uint8_t> bytes;
  require(shortshot::save_for_flash<recognition::Stored>(train_stored(task), bytes));
  write_file(directory + "/small/model.bin", bytes_of(bytes));
  write_file(directory + "/small/views.bin", "");
}

/// The model, the views, and what this machine says of them.
void make(const std::string& directory, const std::string& name, const RecognitionTask& task) {
  const shortshot::Recognizer recognizer = train_stored(task);
  std::vector<std::uint8_t> bytes;
  require(shortshot::save_for_flash<recognition::Stored>(recognizer, bytes));
  const std::vector<std::uint32_t> views = views_of(task, recognizer);
  write_file(directory + "/model.bin", bytes_of(bytes));
  write_file(directory + "/views.bin", bytes_of(views));

  shortshot::ModelView<recognition::Stored> model;
  require(model.open(bytes.data(), bytes.size()));
  const auto memory = std::make_unique<recognition::Memory>();
  const auto outcome =
      recognition::Task(model, *memory).name_all(views.data(), [](const char*, const auto& call) { call(); });
  HostFacts facts(program, "host", name);
  facts.add_hash(name, outcome.hypotheses.value());
  facts.add("objects", recognizer.instance_count());
  facts.add("codewords", recognizer.codeword_count());
  facts.add("model_bytes", bytes.size());
  facts.add("views", outcome.views);
  facts.add("right", outcome.right);
  facts.write_to(directory + "/host.txt");

  HostFacts floats(program, "host_cshot1344_floats", name);
  floats.add("objects", recognizer.instance_count());
  floats.add("codewords", recognizer.codeword_count());
  floats.add("views", task.test.size());
  floats.add("right", right_with_cshot(task));
  floats.write_to(directory + "/host_floats.txt");
}

void write_left_out(const std::string& path, const std::string& target, std::size_t views, const LeftOut& result,
                    std::size_t right_with_floats) {
  HostFacts facts(program, target, "SegmentsLeftOut");
  facts.add("views", views);
  facts.add("codewords", result.codewords);
  facts.add("model_bytes", result.model_bytes);
  facts.add("right", result.instances_right);
  facts.add("right_classes", result.classes_right);
  facts.add("right_kept", result.right_kept);
  facts.add("unknown_refused", result.unknown_refused);
  facts.add("views_behind_floats", right_with_floats - std::min(right_with_floats, result.instances_right));
  facts.write_to(path);
}

/// Accuracy against bytes. The recognizer of floats learns as many key points as the largest model.
void leave_out(const Options& options, const std::vector<Segment>& segments) {
  std::vector<LeftOut> results;
  std::size_t keypoints = 0;
  for (const std::size_t kilobytes : options.kilobytes) {
    results.push_back(leave_scenes_out(segments, 1024 * kilobytes, false));
    keypoints = std::max(keypoints, results.back().keypoints);
  }
  std::vector<LeftOut> thinned;
  for (const std::size_t kilobytes : options.thinned)
    thinned.push_back(leave_scenes_out(segments, 1024 * kilobytes, true));
  const LeftOut floats = leave_scenes_out_with_cshot(segments, keypoints);
  const auto write_one = [&](const std::string& name, const LeftOut& result) {
    write_left_out(options.directory + "/left_out_" + name + ".txt", "host_" + name, segments.size(), result,
                   floats.instances_right);
  };
  write_one("cshot1344_floats", floats);
  for (std::size_t i = 0; i < thinned.size(); ++i)
    write_one(std::to_string(options.thinned[i]) + "KB_thinned", thinned[i]);
  for (std::size_t i = 0; i < results.size(); ++i) write_one(std::to_string(options.kilobytes[i]) + "KB", results[i]);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A model and views for microcontrollers, of generated objects: model.bin, views.bin, and facts.");
  app.name("firmware_recognition");
  Options options;
  app.add_option("directory", options.directory, "where the files go")->required()->check(CLI::ExistingDirectory);
  auto* const segments =
      app.add_option("--segments", options.segments, "a folder of labeled segments, instead of generated objects");
  app.add_option("--kilobytes", options.kilobytes, "also how well models of these sizes do, each scene left out")
      ->needs(segments)
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--thinned", options.thinned, "the same of models that were thinned to these sizes")
      ->needs(segments)
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (options.segments.empty()) {
      const RecognitionTask task = generated_task();
      make(options.directory, "Recognition", task);
      make_small(options.directory, task);
    } else {
      const std::vector<Segment> all = read_segments(options.segments);
      make(options.directory, "Segments", segments_task(all));
      if (!options.kilobytes.empty() || !options.thinned.empty()) leave_out(options, all);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
