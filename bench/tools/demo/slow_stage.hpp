// What a stage is busy with, said while it is, if it takes long: nobody has to guess whether a program hangs.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace shortshot_bench {

/// While it lives it says `what`, and for how long already, after two seconds and then every ten: a line on stderr. A
/// stage that is faster says nothing.
class SlowStage {
 public:
  using Say = std::function<void(const std::string& line)>;

  explicit SlowStage(const std::string& what, std::chrono::milliseconds patience = std::chrono::seconds(2),
                     Say say = to_stderr);
  SlowStage(const SlowStage&) = delete;
  SlowStage& operator=(const SlowStage&) = delete;
  ~SlowStage();

 private:
  static void to_stderr(const std::string& line);

  std::mutex mutex_;
  std::condition_variable ends_;
  bool has_ended_ = false;
  std::thread watch_;
};

}  // namespace shortshot_bench
