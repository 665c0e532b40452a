// peers: shortshot next to PCL, Open3D and a naive transcription, in one run on one thread.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "heap_count.hpp"
#ifdef SHORTSHOT_PEERS_OPEN3D
#include "open3d_peer.hpp"
#endif
#include "pcl_peer.hpp"
#include "speed/peers/comparisons.hpp"
#include "speed/peers/goals.hpp"
#include "speed/peers/measure.hpp"
#include "speed/peers/naive_suite.hpp"
#include "speed/peers/options.hpp"
#include "speed/peers/oracle_difference.hpp"
#include "tools/io/input_error.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace shortshot_bench::peers {

Suite make_our_suite_O2(const Task& task);
Suite make_our_suite_avx2(const Task& task);

namespace {

/// Ours in every build that this CPU can run, and the peers.
std::vector<Suite> make_suites(const Task& task, const Options& options) {
  std::vector<Suite> suites;
  suites.push_back(make_our_suite_O2(task));
#ifdef SHORTSHOT_PEERS_AVX2
  if (__builtin_cpu_supports("avx2")) suites.push_back(make_our_suite_avx2(task));
#endif
  suites.push_back(make_naive_suite(task));
  suites.push_back(make_pcl_suite(task, options.fpfh));
#ifdef SHORTSHOT_PEERS_OPEN3D
  suites.push_back(make_open3d_suite(task));
#endif
  return suites;
}

std::size_t peak_of(const std::function<void()>& work) {
  start_counting_heap();
  work();
  return peak_heap_bytes();
}

/// Largest difference over the described kinds, for every build.
void add_oracle_difference(const Task& task, const std::vector<Suite>& suites, CloudResult& result) {
  const OracleDescriptors ssh32(task, OracleDescriptors::Kind::ssh32);
  const OracleDescriptors scsh336(task, OracleDescriptors::Kind::scsh336);
  result.clear_keypoints = scsh336.clear_keypoints();
  for (const Suite& suite : suites) {
    for (const Contender& contender : suite.contenders) {
      if (!contender.rows || (contender.descriptor != "SSH-32" && contender.descriptor != "SCSH-336")) continue;
      const OracleDescriptors& oracle = contender.descriptor == "SSH-32" ? ssh32 : scsh336;
      double& largest = result.oracle_difference[contender.build];
      largest = std::max(largest, oracle.largest_difference(contender.rows()));
    }
  }
}

CloudResult run(const std::string& file, const Options& options) {
  const bool generated = file.empty();
  const std::string name = generated ? "tabletop" : std::filesystem::path(file).filename().string();
  const Task task = make_task(name, generated ? make_tabletop() : read_cloud(file), options.radius, options.leaf);
  const std::vector<Suite> suites = make_suites(task, options);
  CloudResult result = measure(task, suites, options.rounds, peak_of);
  add_oracle_difference(task, suites, result);
  return result;
}

/// Opened before anything is measured, so that a mistyped path costs no time.
std::ofstream open_output(const std::string& path) {
  std::ofstream file;
  if (path.empty()) return file;
  file.open(path);
  if (!file) throw std::runtime_error(path + ": cannot be written");
  return file;
}

void write(std::ofstream& file, const std::string& path, const nlohmann::ordered_json& json) {
  if (path.empty()) return;
  file << json.dump(2) << '\n';
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

int compare_all(const Options& options) {
  std::vector<std::string> files = options.clouds;
  if (files.empty()) files.push_back({});
  std::ofstream json_file = open_output(options.json);
  std::ofstream goals_file = open_output(options.goals);
  nlohmann::ordered_json comparisons = nlohmann::ordered_json::array();
  std::vector<CloudResult> results;
  for (const std::string& file : files) {
    try {
      results.push_back(run(file, options));
    } catch (const InputError&) {
      throw;
    } catch (const std::exception& error) {
      throw std::runtime_error((file.empty() ? "generated tabletop scene" : file) + ": " + error.what());
    }
    print_result(results.back());
    std::fflush(stdout);
    for (const auto& comparison : to_json(results.back())) comparisons.push_back(comparison);
  }
  print_goals(results);
  write(json_file, options.json, comparisons);
  write(goals_file, options.goals, goals_to_json(results));
  return 0;
}

}  // namespace
}  // namespace shortshot_bench::peers

int main(int argc, char** argv) {
  using namespace shortshot_bench::peers;
  Options options;
  int exit_code = 0;
  if (!parse_options(argc, argv, options, exit_code)) return exit_code;
#ifdef SHORTSHOT_PEERS_AVX2
  if (!__builtin_cpu_supports("avx2")) std::printf("build avx2 is left out: this CPU has no AVX2\n");
#else
  std::printf("build avx2 is left out: this is no x86-64\n");
#endif
#ifndef SHORTSHOT_PEERS_OPEN3D
  std::printf("Open3D is left out: it was not found when this was built\n");
#endif
  try {
    return compare_all(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 2;
}
