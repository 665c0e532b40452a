// How far a campaign is, for the person who waits for it.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace shortshot_bench::campaign {

/// "12/153 done, 0:01:05 elapsed, about 0:12:44 left". What was done before has taken none of the seconds; the rest is
/// expected to take as long as what was done since, and what `threads` are at to be half done. Nothing is expected
/// before three units of each thread are done: the first ones also read what all others share.
std::string progress_text(std::size_t all, std::size_t done_before, std::size_t done_since, double seconds,
                          unsigned threads = 1);

/// Writes a line for each finished unit, with its key; to a terminal one line over and over, which must not wrap.
class Progress {
 public:
  /// The clock starts here. `file` is kept; nothing is written if it is null.
  Progress(std::FILE* file, std::size_t all, std::size_t done_before, unsigned threads = 1);
  ~Progress();  // leaves the terminal on a line of its own
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void finished(const std::string& key);

 private:
  std::FILE* file_;
  bool is_terminal_;
  std::size_t all_;
  std::size_t done_before_;
  unsigned threads_;
  std::size_t done_since_ = 0;
  double start_seconds_;
};

}  // namespace shortshot_bench::campaign
