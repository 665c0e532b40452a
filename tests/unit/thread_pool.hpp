// Threads that wait for work: what a robot's program has, and an executor for extract().
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace unit {

class ThreadPool {
 public:
  explicit ThreadPool(std::size_t threads) {
    for (std::size_t t = 0; t < threads; ++t) threads_.emplace_back([this] { serve(); });
  }
  ~ThreadPool() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] std::size_t threads() const { return threads_.size(); }

  void run(std::function<void()> work) {
    std::unique_lock<std::mutex> lock(mutex_);
    work_ = std::move(work);
    ++round_;
    at_work_ = threads_.size();
    changed_.notify_all();
    changed_.wait(lock, [this] { return at_work_ == 0; });
  }

 private:
  void serve() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (std::size_t served = 0;; ++served) {
      changed_.wait(lock, [&] { return stop_ || round_ != served; });
      if (stop_) return;
      lock.unlock();
      work_();
      lock.lock();
      if (--at_work_ == 0) changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> work_;
  std::size_t round_ = 0;
  std::size_t at_work_ = 0;
  bool stop_ = false;
  std::vector<std::thread> threads_;  // last: they use all of the above
};

}  // namespace unit
