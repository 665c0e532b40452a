#include "speed/scaling/json_rows.hpp"

#include <fstream>
#include <stdexcept>
#include <utility>

namespace shortshot_bench::scaling {

using json = nlohmann::ordered_json;

json read_json(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot open the file");
  try {
    return json::parse(file);
  } catch (const json::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

JsonRow::JsonRow(std::string path, std::size_t number, json object)
    : path_(std::move(path)), number_(number), object_(std::move(object)) {
  if (!object_.is_object()) fail("expected an object, found " + object_.dump());
}

void JsonRow::fail(const std::string& what) const {
  throw std::runtime_error(path_ + ": entry " + std::to_string(number_) + ": " + what);
}

const json& JsonRow::value(const char* key) const {
  if (!has(key)) fail(std::string("'") + key + "' is missing");
  return object_[key];
}

std::string JsonRow::text(const char* key) const {
  const json& found = value(key);
  if (!found.is_string()) fail(std::string("'") + key + "' must be text, not " + found.dump());
  return found.get<std::string>();
}

double JsonRow::number(const char* key) const {
  const json& found = value(key);
  if (!found.is_number()) fail(std::string("'") + key + "' must be a number, not " + found.dump());
  return found.get<double>();
}

bool JsonRow::flag(const char* key) const {
  const json& found = value(key);
  if (!found.is_boolean()) fail(std::string("'") + key + "' must be true or false, not " + found.dump());
  return found.get<bool>();
}

std::vector<JsonRow> rows_of(const std::string& path, const json& list) {
  if (!list.is_array() || list.empty()) throw std::runtime_error(path + ": expected a list of one or more objects");
  std::vector<JsonRow> rows;
  for (const json& object : list) rows.emplace_back(path, rows.size() + 1, object);
  return rows;
}

std::vector<JsonRow> read_rows(const std::string& path) { return rows_of(path, read_json(path)); }

}  // namespace shortshot_bench::scaling
