#include "tools/demo/slow_stage.hpp"

#include <cstdio>
#include <utility>

namespace shortshot_bench {

SlowStage::SlowStage(const std::string& what, std::chrono::milliseconds patience, Say say) {
  watch_ = std::thread([this, what, patience, say = std::move(say)] {
    std::chrono::milliseconds elapsed = patience;
    std::unique_lock<std::mutex> lock(mutex_);
    for (auto wait = patience; !ends_.wait_for(lock, wait, [this] { return has_ended_; }); elapsed += wait) {
      say("... " + what + ": " + std::to_string(elapsed.count() / 1000) + " s");
      wait = std::chrono::seconds(10);
    }
  });
}

SlowStage::~SlowStage() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    has_ended_ = true;
  }
  ends_.notify_one();
  watch_.join();
}

void SlowStage::to_stderr(const std::string& line) { std::fprintf(stderr, "  %s\n", line.c_str()); }

}  // namespace shortshot_bench
