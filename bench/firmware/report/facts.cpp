#include "firmware/report/facts.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace shortshot_bench::firmware {

Facts::Facts(std::string name, std::istream& in) : name_(std::move(name)) {
  for (std::string line; std::getline(in, line);) {
    const std::size_t end = line.find(' ');
    lines_.emplace_back(line.substr(0, end), end == std::string::npos ? "" : line.substr(end + 1));
  }
}

std::vector<std::string> Facts::all(const std::string& key) const {
  std::vector<std::string> found;
  for (const auto& [word, rest] : lines_) {
    if (word == key) found.push_back(rest);
  }
  return found;
}

std::string Facts::text(const std::string& key) const {
  const std::vector<std::string> found = all(key);
  return found.empty() ? "" : found.back();
}

double Facts::number(const std::string& key, const std::string& name, double missing) const {
  for (const std::string& rest : all(key)) {
    if (rest.compare(0, name.size() + 1, name + " ") == 0) return whole_number(rest.substr(name.size() + 1));
  }
  return missing;
}

double whole_number(const std::string& text) {
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (!digits) throw std::runtime_error("no whole number: '" + text + "'");
  return std::stod(text);
}

std::vector<Facts> read_all(const std::string& list) {
  const auto open = [](const std::string& path) {
    std::ifstream in(path);
    if (!in) throw std::runtime_error(path + ": cannot be read");
    return in;
  };
  std::vector<Facts> all;
  std::ifstream names = open(list);
  for (std::string path; std::getline(names, path);) {
    std::ifstream in = open(path);
    all.emplace_back(std::filesystem::path(path).stem().string(), in);
  }
  if (all.empty()) throw std::runtime_error(list + ": names no file");
  return all;
}

}  // namespace shortshot_bench::firmware
