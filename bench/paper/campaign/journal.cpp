#include "paper/campaign/journal.hpp"

#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "paper/campaign/atomic_file.hpp"
#include "tools/io/input_error.hpp"

namespace shortshot_bench::campaign {

using json = nlohmann::ordered_json;

namespace {

json header_line(const json& parameters) { return {{"parameters", parameters}}; }

json result_line(const std::string& key, const json& result) { return {{"key", key}, {"result", result}}; }

/// Makes the folder too. The kernel drops the lock with the process that holds it, however that ends: no stale lock is
/// ever left to be deleted by hand, only an empty file. It is not the journal itself, which merging replaces.
FileDescriptor lock_journal(const std::string& directory) {
  make_directory(directory);
  const std::string path = (std::filesystem::path(directory) / "journal.lock").string();
  FileDescriptor file(path);
  if (flock(file.number(), LOCK_EX | LOCK_NB) == 0) return file;
  if (errno != EWOULDBLOCK) {
    throw InputError::about(path, "cannot lock the file: " + std::generic_category().message(errno));
  }
  throw InputError::about(path,
                          "another process is writing results into this folder: wait for its end, or give each "
                          "process a folder of its own (--out) and merge them");
}

std::string read_text(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || file.bad()) throw InputError::at_byte(path, text.size(), "cannot read the file");
  return text;
}

json parse_line(const std::string& path, std::uint64_t number, std::string_view text) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw InputError::at_line(path, number, std::string("damaged journal: ") + error.what());
  }
}

/// The same key with the same result is there twice where shards overlap; with another result: false.
bool add(JournalContent& content, const std::string& key, const json& result) {
  const auto [found, is_new] = content.results.emplace(key, result);
  return is_new || found->second == result;
}

void add_line(JournalContent& content, const std::string& path, std::uint64_t number, std::string_view text) {
  const json line = parse_line(path, number, text);
  if (number == 1) {
    if (!line.is_object() || !line.contains("parameters")) {
      throw InputError::at_line(path, number, "expected {\"parameters\": ...}");
    }
    content.parameters = line["parameters"];
    return;
  }
  if (!line.is_object() || !line.contains("key") || !line["key"].is_string() || !line.contains("result")) {
    throw InputError::at_line(path, number, "expected {\"key\": TEXT, \"result\": ...}");
  }
  const auto key = line["key"].get<std::string>();
  if (add(content, key, line["result"])) return;
  throw InputError::at_line(path, number, "another result for '" + key + "' than on a line before");
}

std::string shown(const nlohmann::json& parameters, const nlohmann::json::json_pointer& where) {
  return parameters.contains(where) ? parameters[where].dump() : "not there";
}

}  // namespace

std::string journal_path(const std::string& directory) {
  return (std::filesystem::path(directory) / "journal.jsonl").string();
}

std::optional<JournalContent> read_journal(const std::string& directory) {
  const std::string path = journal_path(directory);
  const std::string text = read_text(path);
  JournalContent content;
  std::uint64_t number = 0;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    add_line(content, path, ++number, std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
  if (number == 0) return std::nullopt;
  content.size_bytes = begin;
  return content;
}

void check_parameters(const std::string& directory, const json& journaled, const json& parameters) {
  // Plain JSON does not mind the order of the keys. By way of text, as the journal's were: NaN is null there.
  const nlohmann::json there = journaled;
  const nlohmann::json here = nlohmann::json::parse(parameters.dump());
  const nlohmann::json difference = nlohmann::json::diff(there, here);
  if (difference.empty()) return;
  const auto key = difference[0]["path"].get<std::string>();
  const nlohmann::json::json_pointer where(key);
  throw InputError::at_line(journal_path(directory), 1,
                            "the folder holds results for other parameters: '" + key + "' is " + shown(there, where) +
                                " there and " + shown(here, where) +
                                " now; use another folder (--out) or delete this one");
}

Journal::Journal(const std::string& directory, const json& parameters)
    : path_(journal_path(directory)), lock_(lock_journal(directory)), file_(path_) {
  const std::optional<JournalContent> content = read_journal(directory);
  if (content) {
    check_parameters(directory, content->parameters, parameters);
    size_bytes_ = content->size_bytes;
    for (const auto& [key, result] : content->results) keys_.insert(key);
  }
  if (ftruncate(file_.number(), static_cast<off_t>(size_bytes_)) != 0) {
    throw InputError::at_byte(path_, size_bytes_, "cannot cut off what an interrupted process left");
  }
  if (!content) write_line(header_line(parameters));
}

void Journal::append(const std::string& key, const json& result) {
  write_line(result_line(key, result));
  keys_.insert(key);
}

void Journal::write_line(const json& line) {
  const std::string text = line.dump() + "\n";
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = write(file_.number(), text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      std::string reason = std::generic_category().message(errno);
      // No other line may come after a part of one.
      if (ftruncate(file_.number(), static_cast<off_t>(size_bytes_)) != 0) reason += "; its last line is incomplete";
      throw InputError::at_byte(path_, size_bytes_, "cannot write the file: " + reason);
    }
    written += static_cast<std::size_t>(count);
  }
  size_bytes_ += text.size();
}

void merge_journals(const std::vector<std::string>& from, const std::string& into) {
  const FileDescriptor lock = lock_journal(into);
  std::optional<JournalContent> merged = read_journal(into);
  for (const std::string& directory : from) {
    const std::optional<JournalContent> part = read_journal(directory);
    if (!part) throw InputError::about(journal_path(directory), "there are no results in this folder");
    if (!merged) merged.emplace().parameters = part->parameters;
    check_parameters(directory, part->parameters, merged->parameters);
    for (const auto& [key, result] : part->results) {
      if (add(*merged, key, result)) continue;
      throw InputError::about(journal_path(directory),
                              "another result for '" + key + "' than in a folder before: " + result.dump());
    }
  }
  if (!merged) return;
  std::string text = header_line(merged->parameters).dump() + "\n";
  for (const auto& [key, result] : merged->results) text += result_line(key, result).dump() + "\n";
  write_atomically(journal_path(into), text);
}

}  // namespace shortshot_bench::campaign
