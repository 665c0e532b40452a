// Lists of flat objects, as the measuring programs write them: JSON files read so that every error names the file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shortshot_bench::scaling {

/// The file's JSON. Throws std::runtime_error with the file's name if there is none.
nlohmann::ordered_json read_json(const std::string& path);

/// One object of a file's list. Asking for what it does not have throws std::runtime_error with the file's name, the
/// number of the object (from 1) and the key.
class JsonRow {
 public:
  JsonRow(std::string path, std::size_t number, nlohmann::ordered_json object);

  bool has(const char* key) const { return object_.contains(key); }
  std::string text(const char* key) const;
  double number(const char* key) const;
  bool flag(const char* key) const;
  const nlohmann::ordered_json& value(const char* key) const;
  const nlohmann::ordered_json& object() const { return object_; }

  /// Throws std::runtime_error: file, number of the object, `what`.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string path_;
  std::size_t number_;
  nlohmann::ordered_json object_;
};

/// The objects of `list`, which was read from `path`; it must be a list of one or more objects.
std::vector<JsonRow> rows_of(const std::string& path, const nlohmann::ordered_json& list);

/// read_json() and rows_of().
std::vector<JsonRow> read_rows(const std::string& path);

}  // namespace shortshot_bench::scaling
