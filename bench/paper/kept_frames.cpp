#include "paper/kept_frames.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace shortshot_bench::paper {
namespace {

constexpr const char* best = "-best";
constexpr const char* random = "-random";

bool is_percentage(const std::string& text) {
  return !text.empty() && text.size() <= 2 && text.front() != '0' &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

KeptName kept_name_of(const std::string& name) {
  for (const std::string which : {best, random}) {
    const std::size_t place = name.rfind(which);
    if (place == std::string::npos) continue;
    const std::string percentage = name.substr(place + which.size());
    if (!is_percentage(percentage)) continue;
    return {name.substr(0, place), {static_cast<unsigned>(std::stoul(percentage)), which == random}};
  }
  return {name, {}};
}

std::string name_of(const KeptName& name) {
  return name.descriptor + (name.kept.at_random ? random : best) + std::to_string(name.kept.percent);
}

bool keeps_frames(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [](const auto& n) { return kept_name_of(n).kept.percent < 100; });
}

std::vector<std::string> with_kept_frames(const std::vector<std::string>& names,
                                          const std::vector<unsigned>& percentages) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    all.push_back(name);
    for (const unsigned percent : percentages) {
      for (const bool at_random : {false, true}) all.push_back(name_of({name, {percent, at_random}}));
    }
  }
  return all;
}

float hash_of(const shortshot::KeyPoint& key) {
  const float position[3] = {key.position.x, key.position.y, key.position.z};
  std::uint32_t hash = 1;
  for (const float coordinate : position) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B1u;  // odd, so that nothing is lost; shifts bring the high bits down again
    hash ^= hash >> 15;
    hash *= 0x85EBCA77u;
    hash ^= hash >> 13;
  }
  return static_cast<float>(hash >> 8) / 16777216.0f;
}

}  // namespace shortshot_bench::paper
