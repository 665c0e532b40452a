#include "firmware/report/call_graph.hpp"

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace shortshot_bench::firmware {
namespace {

/// What stands in quotes after `key`; empty if there is nothing.
std::string quoted(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(key + ": \"");
  if (at == std::string::npos) return "";
  const std::size_t first = at + key.size() + 3;
  return line.substr(first, line.find('"', first) - first);
}

}  // namespace

CallGraph::CallGraph(std::istream& in) {
  static const std::regex frame(R"(\\n([0-9]+) bytes \(([a-z,]+)\)$)");
  for (std::string line; std::getline(in, line);) {
    if (line.compare(0, 5, "edge:") == 0) {
      calls_.emplace(quoted(line, "sourcename"), quoted(line, "targetname"));
      called_by_name_.insert(quoted(line, "targetname"));
    }
    if (line.compare(0, 5, "node:") != 0) continue;
    const std::string label = quoted(line, "label");
    std::smatch match;
    if (!std::regex_search(label, match, frame)) continue;  // of another file
    const bool fixed = match[2] == "static" || match[2] == "dynamic,bounded";
    bytes_[quoted(line, "title")] = fixed ? std::stod(match[1]) : -1.0;
  }
}

double CallGraph::deepest(const std::string& function) const {
  std::vector<std::string> path;
  return walk(function, path);
}

double CallGraph::walk(const std::string& function, std::vector<std::string>& path) const {
  if (function == "__indirect_call") return walk_pointer(path);
  if (std::find(path.begin(), path.end(), function) != path.end()) throw std::runtime_error(function + " is recursive");
  const auto own = bytes_.find(function);
  if (own == bytes_.end()) return 0.0;
  if (own->second < 0.0) throw std::runtime_error(function + " has a frame of no fixed size");
  const auto known = known_.find(function);
  if (known != known_.end()) return known->second;
  path.push_back(function);
  double below = 0.0;
  const auto [first, last] = calls_.equal_range(function);
  for (auto call = first; call != last; ++call) below = std::max(below, walk(call->second, path));
  path.pop_back();
  return known_[function] = own->second + below;
}

double CallGraph::walk_pointer(std::vector<std::string>& path) const {
  double deepest = -1.0;
  for (const auto& [function, bytes] : bytes_) {
    const bool own = function.find(':') != std::string::npos;  // "FILE:NAME"; names that others see have no FILE
    if (own && called_by_name_.count(function) == 0) deepest = std::max(deepest, walk(function, path));
  }
  if (deepest < 0.0) throw std::runtime_error(path.back() + " calls by pointer, and nothing is there to be called");
  return deepest;
}

}  // namespace shortshot_bench::firmware
