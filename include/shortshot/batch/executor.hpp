// shortshot/batch/executor.hpp: who does extract()'s work: threads started for one call, or an executor of the
// caller's. Hosted only.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The executor that a plain number of threads stands for. One of them is the caller's; the others are started and
/// joined by each run().
class StartedThreads {
 public:
  explicit StartedThreads(std::size_t threads) noexcept : threads_(threads) {}
  [[nodiscard]] std::size_t threads() const noexcept { return threads_; }

  template <class Work>
  void run(const Work& work) const {
    run_erased([](const void* erased) { (*static_cast<const Work*>(erased))(); }, &work);
  }

 private:
  /// Compiled once for all work: std::thread and a vector of them take a compiler their time.
  void run_erased(void (*call)(const void* work), const void* work) const {
    struct Threads : std::vector<std::thread> {
      ~Threads() {  // also when one more thread cannot be started: those that run finish the work
        for (std::thread& thread : *this) thread.join();
      }
    } others;
    others.reserve(threads_ - 1);
    for (std::size_t t = 1; t < threads_; ++t) others.emplace_back(call, work);
    call(work);
  }

  std::size_t threads_;
};

struct NoWork {
  void operator()() const noexcept {}
};

template <class T, class = void>
struct IsExecutor : std::false_type {};
template <class T>
struct IsExecutor<T, std::void_t<decltype(static_cast<std::size_t>(std::declval<T&>().threads())),
                                 decltype(std::declval<T&>().run(NoWork{}))>> : std::true_type {};

/// The executor meant by `threads`; a number is cut to what `blocks` of work can keep busy.
template <class Threads>
[[nodiscard]] decltype(auto) executor_of(Threads& threads, std::size_t blocks) {
  constexpr bool is_number = std::is_integral<Threads>::value;
  static_assert(
      is_number || IsExecutor<Threads>::value,
      "extract() and estimate_normals() support a number of threads, or an executor with threads() and run(work)");
  if constexpr (is_number) {
    const std::size_t wanted = threads > 0 ? static_cast<std::size_t>(threads) : 1;
    return StartedThreads(std::max<std::size_t>(1, std::min(wanted, blocks)));
  } else {
    return (threads);
  }
}

/// Blocks of [0, count), to be taken one after the other by whoever is free.
class Blocks {
 public:
  Blocks(std::size_t count, std::size_t size) noexcept : count_(count), size_(size) {}

  /// Calls work(begin, end) for blocks until there are none left.
  template <class Work>
  void take(const Work& work) {
    for (std::size_t begin = next_.fetch_add(size_); begin < count_; begin = next_.fetch_add(size_)) {
      work(begin, std::min(begin + size_, count_));
    }
  }

 private:
  std::atomic<std::size_t> next_{0};
  std::size_t count_;
  std::size_t size_;
};

/// Calls work(thread, begin, end) for blocks of [0, count) on an executor; `thread` is below `threads`, and no two
/// calls at the same time have the same.
template <class Executor, class Work>
void for_blocks(Executor& executor, std::size_t threads, std::size_t count, std::size_t block_size, const Work& work) {
  Blocks blocks(count, block_size);
  std::atomic<std::size_t> arrived{0};
  const auto take_part = [&] {
    const std::size_t thread = arrived.fetch_add(1);
    if (thread >= threads) return;  // called more often than announced
    blocks.take([&](std::size_t begin, std::size_t end) { work(thread, begin, end); });
  };
  executor.run([&take_part] { take_part(); });  // one pointer: a std::function holds it without memory of its own
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
