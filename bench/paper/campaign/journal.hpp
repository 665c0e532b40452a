// What a campaign has done so far: DIRECTORY/journal.jsonl. Its first line is {"parameters": ...}; each further line is
// {"key": ..., "result": ...}, in the order in which the units were finished. JSON has no NaN: it comes back as null.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "paper/campaign/file_descriptor.hpp"

namespace shortshot_bench::campaign {

struct JournalContent {
  nlohmann::ordered_json parameters{};
  std::map<std::string, nlohmann::ordered_json> results{};  // by key
  std::uint64_t size_bytes = 0;  // of the complete lines; an interrupted process leaves an incomplete last one
};

/// DIRECTORY/journal.jsonl.
std::string journal_path(const std::string& directory);

/// Everything but an incomplete last line; nothing if there is no journal or not even its first line is complete.
/// Throws InputError, with file and line, for lines that are not as above and for a key with two different results. May
/// be called while another process appends.
std::optional<JournalContent> read_journal(const std::string& directory);

/// Throws InputError unless the journal in `directory`, which holds `journaled`, is one for `parameters`; it names the
/// first parameter that differs.
void check_parameters(const std::string& directory, const nlohmann::ordered_json& journaled,
                      const nlohmann::ordered_json& parameters);

/// The journal of one running campaign. Throws InputError for what read_journal() refuses, for other parameters than
/// the journal's, for a folder in which another process (or this one) has a journal open, and for failed writes.
class Journal {
 public:
  /// Opens the journal or begins a new one, also the folder; cuts off an incomplete last line.
  Journal(const std::string& directory, const nlohmann::ordered_json& parameters);

  bool has(const std::string& key) const { return keys_.count(key) != 0; }

  /// The line is with the operating system when this returns: it survives the end of the process, kill -9 included. Not
  /// to be called by two threads at once.
  void append(const std::string& key, const nlohmann::ordered_json& result);

 private:
  void write_line(const nlohmann::ordered_json& line);

  std::string path_;
  FileDescriptor lock_;
  FileDescriptor file_;
  std::set<std::string> keys_;
  std::uint64_t size_bytes_ = 0;
};

/// Brings the results of several folders, as shards leave them, together in one; what it holds already stays. The lines
/// are in the order of their keys, so the file depends on neither who did what nor when. Throws InputError if a folder
/// has no journal, if two have different parameters or different results for one key, or if somebody writes to `into`.
void merge_journals(const std::vector<std::string>& from, const std::string& into);

}  // namespace shortshot_bench::campaign
