// What the documents show of the measurements. Each function takes what the measuring programs wrote and gives
// Markdown; all throw std::runtime_error, which names the file, for what is missing or malformed.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "results/writer/machine.hpp"
#include "speed/scaling/curve_point.hpp"
#include "speed/scaling/json_rows.hpp"

namespace shortshot_bench::results {

using scaling::CurvePoint;
using scaling::JsonRow;

/// The README's table: quality by the registration experiment (`registration` is what registration.jq made), cost by
/// ./run peers on its first cloud, plain -O2; ours, PCL's and, where it was measured, Open3D's.
std::string headline(const std::string& peers_path, const std::vector<JsonRow>& peers,
                     const std::vector<JsonRow>& registration, const Machine& machine);

/// What tells comparisons apart, but for the build: cloud, descriptor, peer, search.
using ComparisonKey = std::array<std::string, 4>;

/// The comparison of that build, or null.
const JsonRow* find_comparison(const std::vector<JsonRow>& peers, const ComparisonKey& key, const char* build);

/// "NAME: 170909 points, 1000 key points of voxels of 0.01 m, R = 0.04 m, 831 neighbors per key point".
std::string cloud_line(const JsonRow& row);

std::string machine_lines(const Machine& machine);
std::string goals_table(const std::vector<JsonRow>& goals);
std::string peers_table(const std::vector<JsonRow>& peers);

/// `json` is Google Benchmark's: medians where there are any, else every run; user counters become columns.
std::string micro_table(const std::string& path, const nlohmann::ordered_json& json);

/// `json` is the instruction gate's record: compiler, flags, workload, instructions_per_point,
/// instructions_per_neighbor, instructions_per_frame.
std::string instructions_table(const std::string& path, const nlohmann::ordered_json& json);

/// `json` is what ./run firmware --record wrote: the README's rows, and the firmware page's tables.
std::string firmware_headline(const std::string& path, const nlohmann::ordered_json& json);
std::string firmware_tables(const nlohmann::ordered_json& json);

/// `json` is what ./run tradeoff --record wrote: the page's plots, which lie in the folder `plots`, and its tables.
std::string tradeoff_tables(const nlohmann::ordered_json& json, const std::string& plots);

/// For each curve a table and its plot, which lies in the folder `plots`.
std::string scaling_tables(const std::vector<CurvePoint>& points, const std::string& plots);

}  // namespace shortshot_bench::results
