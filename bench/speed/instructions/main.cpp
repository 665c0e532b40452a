// instructions: how many instructions the stages take per neighbor, point or frame, against the figures on record.
// `count` is to be run under callgrind, `check` and `update` read what it wrote.
#include <valgrind/callgrind.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "speed/instructions/figures.hpp"
#include "speed/stages/stages.hpp"
#include "tools/scene/tabletop.hpp"

#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)

namespace {

using namespace shortshot_bench;

#if defined(__x86_64__)
#define MACHINE " for x86-64"
#else
#define MACHINE " for another machine"
#endif
#if defined(__clang__)
const std::string compiler = "clang " TEXT(__clang_major__) MACHINE;
#else
const std::string compiler = "GCC " TEXT(__GNUC__) MACHINE;
#endif
const std::string workload =
    "generated tabletop, 640 x 480, seed 1, R = 0.04 m, 100 key points; normals: all points, R = 0.01 m; sample: "
    "voxels of 0.01 m; whole frame: from raw points, 1000 of the key points so sampled; mean shift: 2000 votes in a "
    "cubic meter";

bool is_gated(const std::string& stage) {
  for (const char* name :
       {"sample", "index grid again", "lab", "search grid", "frame", "normals", "image normals", "kernel Ssh32",
        "kernel Scsh336", "kernel Scsh696", "kernel Shot352", "kernel Cshot1344", "kernel IntensityShape336",
        "kernel ShapeColor95", "kernel ShapeColor32", "mean shift", "whole frame Scsh336"}) {
    if (stage == name) return true;
  }
  return false;
}

std::string dump_of(const Stage& stage, const std::string& figure) {
  if (stage.per_frame) return dump_name(figure, 1, "frame");
  return stage.neighbors > 0 ? dump_name(figure, stage.neighbors, "neighbor")
                             : dump_name(figure, stage.points, "point");
}

/// One dump for each stage, and nothing else counted.
int count() {
  if (RUNNING_ON_VALGRIND == 0) throw std::runtime_error("`count` is to be run under valgrind --tool=callgrind");
  const Workload work = make_workload(make_tabletop(), {});
  for (const StageBuild& build : build_stages(work)) {
    for (const Stage& stage : build.stages) {
      if (!is_gated(stage.name)) continue;
      const std::string name = dump_of(stage, stage.name + " " + build.isa);
      shortshot::Status status = stage.run();  // memory that grows does so before the count
      CALLGRIND_START_INSTRUMENTATION;
      if (status == shortshot::Status::ok) status = stage.run();
      CALLGRIND_STOP_INSTRUMENTATION;
      if (status != shortshot::Status::ok) throw std::runtime_error(stage.name + ": " + shortshot::message(status));
      CALLGRIND_DUMP_STATS_AT(name.c_str());
    }
  }
  return 0;
}

/// What read(stream) makes of a file; what is wrong with it is said with its name.
template <class Read>
auto read_file(const std::string& file, const Read& read) {
  std::ifstream in(file);
  try {
    if (!in) throw std::runtime_error("cannot be read");
    return read(in);
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

/// Is it one that only a CPU with AVX2 can make?
bool needs_avx2(const Figure& figure) {
  const std::string isa = figure.name.substr(figure.name.rfind(' ') + 1);
  return isa == "avx2" || isa == "baseline";
}

/// 0: as recorded, or recorded with another compiler; 1: a figure differs.
int check(const std::vector<Figure>& measured, const std::string& record_file) {
  Record record = read_file(record_file, [](std::istream& in) {
    return parse_record({std::istreambuf_iterator<char>(in), {}});
  });
  for (const Figure& figure : measured)
    std::printf("%-30s %12.2f a %s\n", figure.name.c_str(), figure.instructions, figure.per.c_str());
  if (record.compiler != compiler) {
    std::printf("not checked: recorded with %s, and this is %s\n", record.compiler.c_str(), compiler.c_str());
    return 0;
  }
  if (!cpu_has_avx2()) {
    std::printf("figures of AVX2 are not checked: this CPU has none\n");
    record.figures.erase(std::remove_if(record.figures.begin(), record.figures.end(), needs_avx2),
                         record.figures.end());
  }
  const std::vector<std::string> lines = differences(measured, record.figures);
  for (const std::string& line : lines) std::fprintf(stderr, "%s\n", line.c_str());
  if (lines.empty()) {
    std::printf("instructions per neighbor, point or frame: %zu figures as recorded\n", measured.size());
    return 0;
  }
  std::fprintf(stderr, "if that is meant: ./run instructions --update, and commit %s\n", record_file.c_str());
  return 1;
}

int update(const std::vector<Figure>& measured, const std::string& record_file) {
  if (!cpu_has_avx2()) throw std::runtime_error("this CPU has no AVX2, its figures would be lost");
  std::ofstream out(record_file);
  out << to_json(
      {compiler, SHORTSHOT_BUILD_FLAGS "; avx2: -mavx2 too; sse2: -DSHORTSHOT_NO_DISPATCH too", workload, measured});
  if (!out.flush()) throw std::runtime_error(record_file + ": cannot be written");
  std::printf("recorded in %s\n", record_file.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Instructions of key points, index, colors, search, frame, normals and kernel, per point or neighbor, and of a "
      "whole camera frame, by callgrind, against the figures on record.");
  app.name("instructions");
  app.require_subcommand(1);
  std::string counts;
  std::string record;
  const CLI::App* const counting = app.add_subcommand("count", "run the stages; under valgrind --tool=callgrind");
  CLI::App* const checking = app.add_subcommand("check", "exit 1 if a figure differs from the record");
  CLI::App* const updating = app.add_subcommand("update", "write the record");
  for (CLI::App* const command : {checking, updating}) {
    command->add_option("counts", counts, "callgrind's output")->required();
    command->add_option("record", record, "the record, a JSON file")->required();
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (counting->parsed()) return count();
    const std::vector<Figure> measured = read_file(counts, read_callgrind);
    return checking->parsed() ? check(measured, record) : update(measured, record);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
