#include "speed/peers/comparisons.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

namespace shortshot_bench::peers {
namespace {

std::string samples_of(const MeasuredContender& m) { return std::to_string(m.kept) + "/" + std::to_string(m.taken); }

std::string implementation_of(const MeasuredContender& m) {
  return m.what.build.empty() ? m.what.implementation : m.what.implementation + " -" + m.what.build;
}

}  // namespace

std::vector<Comparison> compare(const CloudResult& result) {
  std::vector<Comparison> comparisons;
  for (const MeasuredContender& ours : result.contenders) {
    for (const MeasuredContender& peer : result.contenders) {
      const auto& against = peer.what.against;
      const bool comparable = std::find(against.begin(), against.end(), ours.what.descriptor) != against.end();
      if (!ours.what.against.empty() || !comparable) continue;
      comparisons.push_back({&ours, &peer, peer.us_per_keypoint / ours.us_per_keypoint, peer.frame_ms / ours.frame_ms});
    }
  }
  return comparisons;
}

nlohmann::ordered_json to_json(const CloudResult& result) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Comparison& c : compare(result)) {
    list.push_back({{"cloud", result.cloud},
                    {"points", result.points},
                    {"keypoints", result.keypoints},
                    {"radius", result.radius},
                    {"leaf", result.leaf},
                    {"mean_neighbors", result.mean_neighbors},
                    {"descriptor", c.ours->what.descriptor},
                    {"build", c.ours->what.build},
                    {"search", c.ours->what.search},
                    {"peer", c.peer->what.implementation},
                    {"peer_descriptor", c.peer->what.descriptor},
                    {"us_per_keypoint", c.ours->us_per_keypoint},
                    {"peer_us_per_keypoint", c.peer->us_per_keypoint},
                    {"peer_made", c.peer->what.made > 0 ? c.peer->what.made : result.keypoints},
                    {"ratio_per_keypoint", c.ratio_per_keypoint},
                    {"frame_ms", c.ours->frame_ms},
                    {"peer_frame_ms", c.peer->frame_ms},
                    {"ratio_frame", c.ratio_frame},
                    {"peak_bytes", c.ours->peak_bytes},
                    {"peer_peak_bytes", c.peer->peak_bytes},
                    {"samples", c.ours->kept},
                    {"samples_taken", c.ours->taken},
                    {"peer_samples", c.peer->kept},
                    {"peer_samples_taken", c.peer->taken}});
  }
  return list;
}

namespace {

void print_contenders(const CloudResult& result) {
  std::printf("%-32s %-25s %-10s %13s %10s %9s %8s\n", "", "descriptor", "search", "us for each", "frame ms",
              "extra MB", "samples");
  for (const MeasuredContender& m : result.contenders) {
    std::printf("%-32s %-25s %-10s %13.3f %10.1f %9.1f %8s\n", implementation_of(m).c_str(), m.what.descriptor.c_str(),
                m.what.search.c_str(), m.us_per_keypoint, m.frame_ms, 1e-6 * static_cast<double>(m.peak_bytes),
                samples_of(m).c_str());
  }
}

/// A line per descriptor and peer, a column for each of our ways to get the descriptor.
void print_ratios(const CloudResult& result) {
  std::vector<std::string> columns;
  std::map<std::pair<std::string, std::string>, std::map<std::string, const Comparison*>> lines;
  const std::vector<Comparison> comparisons = compare(result);
  for (const Comparison& c : comparisons) {
    const std::string column = "-" + c.ours->what.build + ", " + c.ours->what.search;
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
    lines[{c.ours->what.descriptor, c.peer->what.implementation}][column] = &c;
  }
  std::printf("\n%-62s", "times as fast, for each key point / whole frame");
  for (const std::string& column : columns) std::printf(" %17s", column.c_str());
  for (const auto& [line, cells] : lines) {
    std::printf("\n%-25s vs %-33s", line.first.c_str(), line.second.c_str());
    for (const std::string& column : columns) {
      const auto cell = cells.find(column);
      if (cell == cells.end()) {
        std::printf(" %17s", "-");
      } else {
        std::printf(" %8.1f /%7.1f", cell->second->ratio_per_keypoint, cell->second->ratio_frame);
      }
    }
  }
  std::printf("\n\n");
}

void print_stages(const CloudResult& result) {
  std::printf("Stages, ms for all key points or the cloud (*: no sample from an undisturbed core)\n");
  std::string last;
  for (const auto& [name, step] : result.steps) {
    const std::size_t colon = name.find(':');
    const std::string suite = name.substr(0, colon);
    if (suite != last) std::printf("%s  %s", last.empty() ? "" : "\n", suite.c_str());
    std::printf("%s %s %.2f%s", suite != last ? ":" : ";", name.substr(colon + 2).c_str(), step.ms,
                step.kept == 0 ? "*" : "");
    last = suite;
  }
  std::printf("\n\n");
}

}  // namespace

void print_result(const CloudResult& result) {
  std::printf("%s: %zu points, %zu key points of voxels of %g m, radius %g m, %.0f neighbors per key point\n",
              result.cloud.c_str(), result.points, result.keypoints, result.leaf, result.radius, result.mean_neighbors);
  std::printf(
      "%zu of %zu samples come from an undisturbed core; medians are over those, or over all where none does\n\n",
      result.kept, result.taken);
  print_contenders(result);
  print_ratios(result);
  print_stages(result);
  std::printf(
      "Difference from the oracle: over %zu of %zu key points; the others have no frame or a neighbor within "
      "1e-5 cells of a border\n\n",
      result.clear_keypoints, result.keypoints);
}

}  // namespace shortshot_bench::peers
