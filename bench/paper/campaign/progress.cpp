#include "paper/campaign/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "speed/timing/clock.hpp"

namespace shortshot_bench::campaign {
namespace {

std::string hours(double seconds) {
  const long whole = std::lround(seconds);
  char text[64];
  std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

}  // namespace

std::string progress_text(std::size_t all, std::size_t done_before, std::size_t done_since, double seconds,
                          unsigned threads) {
  const std::size_t done = done_before + done_since;
  const std::string text = std::to_string(done) + "/" + std::to_string(all) + " done, " + hours(seconds) + " elapsed";
  if (done < all && done_since < 3 * static_cast<std::size_t>(threads)) return text;
  const double at_work = 0.5 * static_cast<double>(std::min<std::size_t>(threads, all - done));
  const double left =
      seconds * (static_cast<double>(all - done) - at_work) / (static_cast<double>(done_since) + at_work);
  return text + ", about " + hours(left) + " left";
}

Progress::Progress(std::FILE* file, std::size_t all, std::size_t done_before, unsigned threads)
    : file_(file),
      is_terminal_(file != nullptr && isatty(fileno(file)) != 0),
      all_(all),
      done_before_(done_before),
      threads_(threads),
      start_seconds_(now_seconds(Clock::wall)) {}

Progress::~Progress() {
  if (is_terminal_ && done_since_ > 0) std::fputc('\n', file_);
}

void Progress::finished(const std::string& key) {
  ++done_since_;
  if (file_ == nullptr) return;
  const std::string text =
      progress_text(all_, done_before_, done_since_, now_seconds(Clock::wall) - start_seconds_, threads_);
  if (is_terminal_) {
    std::fprintf(file_, "\r%s\x1b[K", text.c_str());  // over the line before, and erases what is left of it
  } else {
    std::fprintf(file_, "%s: %s\n", text.c_str(), key.c_str());
  }
  std::fflush(file_);
}

}  // namespace shortshot_bench::campaign
