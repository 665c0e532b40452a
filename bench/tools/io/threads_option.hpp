// How many threads a tool may use.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

namespace shortshot_bench {

/// Adds --threads, by default one for each core: results have the same bits with any number.
inline void add_threads_option(CLI::App& app, unsigned& threads) {
  threads = std::min(256u, std::max(1u, std::thread::hardware_concurrency()));
  app.add_option("--threads", threads, "threads, 1 to 256 [one for each core]")->check(CLI::Range(1, 256));
}

}  // namespace shortshot_bench
