// match: where one cloud is in another, how sure that is, and a picture of it.

#include <cstdio>
#include <exception>

#include "tools/match/options.hpp"
#include "tools/match/run.hpp"

int main(int argc, char** argv) {
  using namespace shortshot_bench;
  MatchCommand command;
  int exit_code = 0;
  if (!parse_match_options(argc, argv, command, exit_code)) return exit_code;
  try {
    return run_match(command) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 2;
}
