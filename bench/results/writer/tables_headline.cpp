// The README's table: how good, how small and how fast, ours beside what others use.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "results/writer/markdown.hpp"
#include "results/writer/tables.hpp"

namespace shortshot_bench::results {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* baseline = "cshot1344";

/// A line of the table. Its quality is that of `form` in the registration experiment; its cost that of `descriptor` in
/// the comparison with `peer`, on the peer's side if it is the peer's line.
struct Shown {
  const char* label;
  const char* form;
  const char* descriptor;
  const char* peer;
  bool is_peers = false;
  bool everywhere = true;  // else it is left out where it was not measured
};

constexpr Shown shown[] = {
    {"**ShapeColor95**, 4 bits a value", "shapecolor95-4bit", "ShapeColor95", "PCL SHOTColor"},
    {"**ShapeColor32**, 4 bits", "shapecolor32-4bit", "ShapeColor32", "PCL SHOTColor"},
    {"**HeightShape96**, 4 bits, no color", "heightshape96-4bit", "HeightShape96", "PCL SHOT"},
    {"SSH-32, the paper's", "ssh32", "SSH-32", "PCL SHOT"},
    {"SCSH-336, the paper's", "scsh336", "SCSH-336", "PCL SHOTColor"},
    {"SHOT-352", "shot352", "SHOT-352", "PCL SHOT"},
    {"CSHOT-1344", baseline, "CSHOT-1344", "PCL SHOTColor"},
    {"*PCL:* SHOT", "shot352", "SHOT-352", "PCL SHOT", true},
    {"*PCL:* SHOTColor", baseline, "CSHOT-1344", "PCL SHOTColor", true},
    {"*Open3D:* FPFH, square roots", "fpfh-open3d-root", "ShapeColor95", "Open3D FPFH", true, false}};

/// The mean of "0.482 [0.407, 0.547]".
double mean_of(const JsonRow& set, const Json& row, const char* figure) {
  const auto found = row.find(figure);
  if (found == row.end() || !found->is_string()) set.fail(std::string("no '") + figure + "' in a row");
  return std::strtod(found->get<std::string>().c_str(), nullptr);
}

const Json* row_of(const JsonRow& set, const std::string& form) {
  for (const Json& row : set.value("rows")) {
    if (row.at("descriptor") == form) return &row;
  }
  return nullptr;
}

struct Quality {
  double bytes = 0.0;
  double right = 0.0;  // right matches, over the baseline's: the geometric mean over sets
  double worst = std::numeric_limits<double>::infinity();
  double poses = 0.0;  // share of poses found: the mean over sets
  std::size_t sets = 0;
};

/// Over the sets that have the baseline, hence colors. Poses of frames of rooms are found within 10 cm, others 2.
Quality quality_of(const std::vector<JsonRow>& registration, const std::string& form) {
  Quality quality;
  double logarithms = 0.0;
  for (const JsonRow& set : registration) {
    const Json* const base = row_of(set, baseline);
    if (base == nullptr) continue;
    const Json* const row = row_of(set, form);
    if (row == nullptr) set.fail("no row of " + form);
    const double ratio = mean_of(set, *row, "inlier ratio") / mean_of(set, *base, "inlier ratio");
    const bool is_room = set.text("set").find("frames") != std::string::npos;
    logarithms += std::log(ratio);
    quality.worst = std::min(quality.worst, ratio);
    quality.poses += mean_of(set, *row, is_room ? "RR 5 deg 10 cm" : "RR 5 deg 2 cm");
    quality.bytes = row->at("bytes").get<double>();
    ++quality.sets;
  }
  if (quality.sets == 0) registration.front().fail(std::string("no set has a row of ") + baseline);
  quality.right = std::exp(logarithms / static_cast<double>(quality.sets));
  quality.poses /= static_cast<double>(quality.sets);
  return quality;
}

std::string hundredths(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

}  // namespace

std::string headline(const std::string& peers_path, const std::vector<JsonRow>& peers,
                     const std::vector<JsonRow>& registration, const Machine& machine) {
  Table table({"", "bytes", "right matches, CSHOT's = 1", "worst set", "poses found", "us a key point",
               "whole frame, ms", "extra memory"});
  std::size_t sets = 0;
  for (const Shown& line : shown) {
    const JsonRow* const cost =
        find_comparison(peers, {peers.front().text("cloud"), line.descriptor, line.peer, "grid"}, "O2");
    if (cost == nullptr && !line.everywhere) continue;
    if (cost == nullptr) {
      throw std::runtime_error(peers_path + ": no comparison of " + line.descriptor + " with " + line.peer + " for O2");
    }
    const Quality quality = quality_of(registration, line.form);
    const std::string of = line.is_peers ? "peer_" : "";
    sets = quality.sets;
    table.add({line.label, whole(quality.bytes), hundredths(quality.right), hundredths(quality.worst),
               whole(100.0 * quality.poses) + " %", digits(cost->number((of + "us_per_keypoint").c_str())),
               digits(cost->number((of + "frame_ms").c_str())), megabytes(cost->number((of + "peak_bytes").c_str()))});
  }
  return "\n" + table.markdown() + "\nQuality: " + whole(static_cast<double>(sets)) +
         " sets of real views with color. Cost: " + cloud_line(peers.front()) + ", from raw points; " + machine.cpu +
         ", " + machine.compiler + ", one thread.\n";
}

}  // namespace shortshot_bench::results
