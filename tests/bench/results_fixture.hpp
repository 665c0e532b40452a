// A project's measurements and documents in miniature; all figures are made up.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>

#include "cloud_file_samples.hpp"

namespace results_fixture {

/// One comparison, as ./run peers writes them.
inline std::string comparison(const std::string& descriptor, const std::string& peer, const std::string& build,
                              double ratio, const std::string& search = "grid") {
  const double us = 360.0 / ratio;
  std::ostringstream row;
  row << R"({"cloud": "desk.pcd", "points": 170000, "keypoints": 1000, "radius": 0.04, "leaf": 0.01, "mean_neighbors": 831.2,)"
      << R"( "descriptor": ")" << descriptor << R"(", "build": ")" << build << R"(", "search": ")" << search
      << R"(", "peer": ")" << peer << R"(", "us_per_keypoint": )" << us
      << R"(, "peer_us_per_keypoint": 360, "ratio_per_keypoint": )" << ratio << R"(, "frame_ms": )" << 600.0 / ratio
      << R"(, "peer_frame_ms": 900, "ratio_frame": )" << 1.5 * ratio
      << R"(, "peak_bytes": 5200000, "peer_peak_bytes": 31400})";
  return row.str();
}

inline std::string peers() {
  std::string list;
  double ratio = 5.0;
  for (const auto& [descriptor, peer] :
       {std::pair{"SCSH-336", "PCL SHOTColor"}, std::pair{"SCSH-336", "naive double"}, std::pair{"SSH-32", "PCL SHOT"},
        std::pair{"SSH-32", "naive double"}, std::pair{"SHOT-352", "PCL SHOT"},
        std::pair{"CSHOT-1344", "PCL SHOTColor"}, std::pair{"ShapeColor95", "PCL SHOTColor"},
        std::pair{"ShapeColor32", "PCL SHOTColor"}, std::pair{"HeightShape96", "PCL SHOT"}}) {
    for (const char* build : {"O2", "avx2"})
      list += (list.empty() ? "[" : ", ") + comparison(descriptor, peer, build, ratio *= 2.0);
  }
  for (const char* build : {"O2", "avx2"})
    list += ", " + comparison("key points", "PCL VoxelGrid", build, 2.0, "voxels");
  return list + "]";
}

/// A set of the registration experiment, whose descriptors all have these figures, CSHOT but for the inlier ratio.
inline std::string registration_set(const std::string& name, double right, double poses) {
  std::ostringstream set;
  set << R"({"set": ")" << name << R"(", "pairs": 9, "rows": [)";
  bool is_first = true;
  for (const char* form : {"cshot1344", "shot352", "scsh336", "ssh32", "shapecolor95-4bit", "shapecolor32-4bit",
                           "heightshape96-4bit", "fpfh-open3d-root"}) {
    set << (is_first ? "" : ", ") << R"({"descriptor": ")" << form << R"(", "bytes": 95, "inlier ratio": ")"
        << (is_first ? 0.5 : right) << R"( [0.1, 0.9]", "RR 5 deg 10 cm": ")" << poses
        << R"( [0.1, 0.9]", "RR 5 deg 2 cm": "0.25 [0.1, 0.9]"})";
    is_first = false;
  }
  return set.str() + "]}";
}

/// A room, objects, and a set without colors.
inline std::string registration() {
  return "[" + registration_set("kitchen frames", 1.0, 0.75) + ", " + registration_set("mug views", 0.25, 0.5) +
         R"(, {"set": "gray object-scene", "pairs": 9, "rows": [{"descriptor": "shot352", "bytes": 1408}]}])";
}

/// What ./run firmware --record writes, of the configurations that the README shows, on one core.
inline std::string firmware() {
  std::string figures;
  for (const char* configuration : {"Ssh96", "Scsh336", "ShapeColor95", "ShapeColor32"}) {
    for (const char* workspace : {"full", "compact"}) {
      for (const char* level : {"Os", "O2"}) {
        figures += (figures.empty() ? "" : ", ") + std::string(R"({"target": "m7", "level": ")") + level +
                   R"(", "configuration": ")" + configuration + R"(", "workspace": ")" + workspace +
                   R"(", "flash_brute": 5100.0, "flash_grid": 6200.0, "static_bytes": 0.0, "stack_outside_chunk": 444.0,
                   "chunk_bytes": 324.0, "workspace_bytes_per_neighbor": 20.0, "work_per_neighbor": 555.4,
                   "work_fixed": 3210.0})";
      }
    }
  }
  figures +=
      R"(, {"target": "host_shot352_floats", "level": "O2", "configuration": "SmallSensor8x8", "workspace": "full",
                   "views": 160.0, "right": 83.0},
                  {"target": "m7", "level": "Os", "configuration": "SmallSensor8x8", "workspace": "compact",
                   "points": 51.0, "keypoints": 1.0, "names": 8.0, "ram_bytes": 2764.0, "code_bytes": 8708.0, "work_view": 200776.0, "views": 160.0,
                   "right": 105.0, "sure": 81.0, "right_sure": 74.0})";
  return R"({"figures": [)" + figures +
         R"(], "hashes": [{"target": "m7", "level": "O2", "configuration": "Ssh96", "hash": "0badcafe"}],
         "budgets": [{"promise": "less", "goal": 475, "at_most": 560, "measured": 555.4, "where": "Scsh336 on m7"}]})";
}

/// A folder of its own with all files that the results are made of; it goes with the object.
class Project {
 public:
  Project() {
    write(
        "README.md",
        "before\n<!-- generated: headline -->\nold\n<!-- end -->\nafter\n<!-- generated: firmware -->\n<!-- end -->\n");
    write("bench/TRADEOFF.md", "# Page\n<!-- generated: tradeoff -->\n<!-- end -->\n");
    write(
        "bench/results/tradeoff.json",
        R"({"headline": {"title": "H", "markdown": "| small | 32 |\n"}, "map": {"title": "M", "markdown": "| all |\n"}})");
    write("bench/firmware/README.md", "# Page\n<!-- generated: firmware -->\n<!-- end -->\n");
    write("bench/results/firmware.json", firmware());
    std::string report = "# Report\n";
    for (const char* name : {"machine", "peers", "micro", "instructions", "scaling"}) {
      report += std::string("<!-- generated: ") + name + " -->\n<!-- end -->\n";
    }
    write("bench/RESULTS.md", report);
    write("bench/GOALS.md", "# Goals\n<!-- generated: goals -->\n<!-- end -->\n");
    write("bench/results/machine.json",
          R"({"cpu": "Imaginary 1", "cores": 2, "system": "Debian", "compiler": "GCC 12", "flags": "-O2"})");
    write("bench/results/peers.json", peers());
    write("bench/results/registration.json", registration());
    write("bench/results/goals.json", R"([
      {"goal": "faster", "build": "O2", "bound": ">= 25", "measured": {"desk.pcd": 26.04}, "worst": 26.04,
       "worst_cloud": "desk.pcd", "met": true},
      {"goal": "exact", "build": "avx2", "bound": "<= 1e-06", "worst": 3.2e-6, "worst_cloud": "desk.pcd", "met": false},
      {"goal": "instructions", "build": "avx2", "bound": "report"}])");
    write("bench/results/micro.json", R"({"benchmarks": [
      {"name": "kernel_mean", "run_name": "kernel", "aggregate_name": "mean", "cpu_time": 99, "time_unit": "us"},
      {"name": "kernel_median", "run_name": "kernel", "aggregate_name": "median", "cpu_time": 8.25, "time_unit": "us",
       "family_index": 4, "ns/neighbor": 6.5},
      {"name": "index_median", "run_name": "index", "aggregate_name": "median", "cpu_time": 1234, "time_unit": "us",
       "bytes": 4096}]})");
    write("bench/speed/instructions/expected.json", R"({"compiler": "GCC 12", "flags": "-O2", "workload": "tabletop",
      "instructions_per_neighbor": {"kernel Ssh32 sse2": 60.25, "frame sse2": 40},
      "instructions_per_point": {"sample sse2": 130},
      "instructions_per_frame": {"whole frame Scsh336 sse2": 204123456}})");
    write("bench/results/scaling.json", R"([
      {"curve": "threads", "x": 1, "x_name": "threads", "series": "extract", "value": 80.5, "unit": "ms",
       "extra_bytes": 2000000, "repetitions": 3},
      {"curve": "threads", "x": 2, "x_name": "threads", "series": "extract", "value": 41.25, "unit": "ms",
       "extra_bytes": 2500000, "repetitions": 3},
      {"curve": "threads", "x": 2, "x_name": "threads", "series": "index", "value": 1.5, "unit": "ms",
       "extra_bytes": 3500000, "repetitions": 3}])");
  }

  std::string root() const { return directory_.file("project"); }
  std::string path(const std::string& name) const { return root() + "/" + name; }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    cloud_file_test::write_bytes(path(name), text);
  }

 private:
  cloud_file_test::TemporaryDirectory directory_;
};

}  // namespace results_fixture
