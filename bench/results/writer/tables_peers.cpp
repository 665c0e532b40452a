// The comparison with other implementations, and the goals.
#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "results/writer/markdown.hpp"
#include "results/writer/tables.hpp"

namespace shortshot_bench::results {
namespace {

/// One comparison in both builds: plain -O2, and -O2 -mavx2.
struct Pair {
  const JsonRow* o2 = nullptr;
  const JsonRow* avx2 = nullptr;
};

using Key = std::array<std::string, 4>;
constexpr std::array<const char*, 4> key_names{"cloud", "descriptor", "peer", "search"};

Key key_of(const JsonRow& row) {
  Key key;
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = row.text(key_names[i]);
  return key;
}

/// The row of that build, or null.
const JsonRow* find(const std::vector<JsonRow>& rows, const Key& key, const char* build) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const JsonRow& row) { return key_of(row) == key && row.text("build") == build; });
  return found == rows.end() ? nullptr : &*found;
}

/// A value of both builds: "14.1 / 8.3".
template <class Format>
std::string both(const Pair& pair, const char* key, const Format& format) {
  return (pair.o2 ? format(pair.o2->number(key)) : "-") + " / " + (pair.avx2 ? format(pair.avx2->number(key)) : "-");
}

std::string us(double value) { return digits(value); }

/// "NAME: 170909 points, 1000 key points, R = 0.04 m, 831 neighbors per key point".
std::string cloud_line(const JsonRow& row) {
  char radius[32];
  std::snprintf(radius, sizeof radius, "%g", row.number("radius"));
  return row.text("cloud") + ": " + whole(row.number("points")) + " points, " + whole(row.number("keypoints")) +
         " key points, R = " + radius + " m, " + whole(row.number("mean_neighbors")) + " neighbors per key point";
}

std::vector<std::string> cells(const Pair& pair, std::vector<std::string> first) {
  const JsonRow& any = pair.o2 ? *pair.o2 : *pair.avx2;
  const std::string memory = megabytes(any.number("peak_bytes")) + ", " + megabytes(any.number("peer_peak_bytes"));
  const std::vector<std::string> more{both(pair, "us_per_keypoint", us), us(any.number("peer_us_per_keypoint")),
                                      both(pair, "ratio_per_keypoint", times), both(pair, "ratio_frame", times),
                                      memory};
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

std::string peers_of_cloud(const std::vector<JsonRow>& peers, const std::string& cloud) {
  Table table({"ours", "against", "our search", "us per key point", "peer's", "times faster", "whole frame",
               "extra memory, peer's"});
  std::vector<Key> seen;
  std::string text;
  for (const JsonRow& row : peers) {
    const Key key = key_of(row);
    if (key[0] != cloud || std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
    if (seen.empty()) text = cloud_line(row) + ".\n\n";
    seen.push_back(key);
    const Pair pair{find(peers, key, "O2"), find(peers, key, "avx2")};
    if (!pair.o2 && !pair.avx2) row.fail("'build' must be \"O2\" or \"avx2\", not \"" + row.text("build") + "\"");
    table.add(cells(pair, {key[1], key[2], key[3]}));
  }
  return text + table.markdown();
}

}  // namespace

std::string headline(const std::string& peers_path, const std::vector<JsonRow>& peers, const Machine& machine) {
  const JsonRow& first = peers.front();
  Table table({"one thread, -O2 / -O2 -mavx2", "us per key point", "peer's", "times faster", "whole frame",
               "extra memory, peer's"});
  const std::array<std::array<const char*, 2>, 6> comparisons{{{"SCSH-336", "PCL SHOTColor"},
                                                               {"SCSH-336", "naive double"},
                                                               {"SSH-32", "PCL SHOT"},
                                                               {"SSH-32", "naive double"},
                                                               {"SHOT-352", "PCL SHOT"},
                                                               {"CSHOT-1344", "PCL SHOTColor"}}};
  for (const auto& [descriptor, peer] : comparisons) {
    const Key key{first.text("cloud"), descriptor, peer, "grid"};
    const Pair pair{find(peers, key, "O2"), find(peers, key, "avx2")};
    if (!pair.o2 || !pair.avx2) {
      throw std::runtime_error(peers_path + ": no comparison of " + descriptor + " by grid with " + peer + " on " +
                               key[0] + (pair.o2 ? " for avx2" : " for O2"));
    }
    table.add(cells(pair, {std::string(descriptor) + " against " + peer}));
  }
  return "\n" + table.markdown() + "\n" + cloud_line(first) + "; " + machine.cpu + ", " + machine.compiler +
         ". All tables, command lines and scaling curves: [bench/RESULTS.md](bench/RESULTS.md).\n\n";
}

std::string peers_table(const std::vector<JsonRow>& peers) {
  std::vector<std::string> clouds;
  for (const JsonRow& row : peers) {
    if (std::find(clouds.begin(), clouds.end(), row.text("cloud")) == clouds.end()) clouds.push_back(row.text("cloud"));
  }
  std::string text;
  for (const std::string& cloud : clouds) text += "\n" + peers_of_cloud(peers, cloud);
  return text + "\n";
}

std::string goals_table(const std::vector<JsonRow>& goals) {
  Table table({"goal", "build", "bound", "measured, the worst cloud", "cloud", "met"});
  for (const JsonRow& row : goals) {
    const bool measured = row.has("worst");
    table.add({row.text("goal"), row.text("build"), row.text("bound"),
               measured ? digits(row.number("worst")) : "not measured", measured ? row.text("worst_cloud") : "",
               !row.has("met")   ? ""
               : row.flag("met") ? "yes"
                                 : "**no**"});
  }
  return "\n" + table.markdown() + "\n";
}

}  // namespace shortshot_bench::results
