// The comparison with other implementations, and the goals.
#include <algorithm>
#include <array>
#include <cstdio>

#include "results/writer/markdown.hpp"
#include "results/writer/tables.hpp"

namespace shortshot_bench::results {
namespace {

/// One comparison in both builds: plain -O2, and -O2 -mavx2.
struct Pair {
  const JsonRow* o2 = nullptr;
  const JsonRow* avx2 = nullptr;
};

constexpr std::array<const char*, 4> key_names{"cloud", "descriptor", "peer", "search"};

ComparisonKey key_of(const JsonRow& row) {
  ComparisonKey key;
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = row.text(key_names[i]);
  return key;
}

/// A value of both builds: "14.1 / 8.3".
template <class Format>
std::string both(const Pair& pair, const char* key, const Format& format) {
  return (pair.o2 ? format(pair.o2->number(key)) : "-") + " / " + (pair.avx2 ? format(pair.avx2->number(key)) : "-");
}

const std::vector<std::string> columns{
    "ours",         "against",          "our search", "whole frame, ms", "peer's, ms",
    "times faster", "us per key point", "peer's, us", "times faster",    "extra memory, peer's"};

std::vector<std::string> cells(const Pair& pair, std::vector<std::string> first) {
  const JsonRow& any = pair.o2 ? *pair.o2 : *pair.avx2;
  const std::string memory = megabytes(any.number("peak_bytes")) + ", " + megabytes(any.number("peer_peak_bytes"));
  const std::vector<std::string> more{both(pair, "frame_ms", digits),
                                      digits(any.number("peer_frame_ms")),
                                      both(pair, "ratio_frame", times),
                                      both(pair, "us_per_keypoint", digits),
                                      digits(any.number("peer_us_per_keypoint")),
                                      both(pair, "ratio_per_keypoint", times),
                                      memory};
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

std::string peers_of_cloud(const std::vector<JsonRow>& peers, const std::string& cloud) {
  Table table(columns);
  std::vector<ComparisonKey> seen;
  std::string text;
  for (const JsonRow& row : peers) {
    const ComparisonKey key = key_of(row);
    if (key[0] != cloud || std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
    if (seen.empty()) text = cloud_line(row) + ".\n\n";
    seen.push_back(key);
    const Pair pair{find_comparison(peers, key, "O2"), find_comparison(peers, key, "avx2")};
    if (!pair.o2 && !pair.avx2) row.fail("'build' must be \"O2\" or \"avx2\", not \"" + row.text("build") + "\"");
    table.add(cells(pair, {key[1], key[2], key[3]}));
  }
  return text + table.markdown();
}

}  // namespace

const JsonRow* find_comparison(const std::vector<JsonRow>& peers, const ComparisonKey& key, const char* build) {
  const auto found = std::find_if(peers.begin(), peers.end(),
                                  [&](const JsonRow& row) { return key_of(row) == key && row.text("build") == build; });
  return found == peers.end() ? nullptr : &*found;
}

std::string cloud_line(const JsonRow& row) {
  char lengths[64];
  std::snprintf(lengths, sizeof lengths, "%g m, R = %g m", row.number("leaf"), row.number("radius"));
  return row.text("cloud") + ": " + whole(row.number("points")) + " points, " + whole(row.number("keypoints")) +
         " key points of voxels of " + lengths + ", " + whole(row.number("mean_neighbors")) +
         " neighbors per key point";
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
