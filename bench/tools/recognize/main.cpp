// recognize: learns objects, and says which one a cloud shows, how sure that is, and who voted for it.

#include <cstdio>
#include <exception>

#include "tools/recognize/options.hpp"
#include "tools/recognize/run.hpp"

int main(int argc, char** argv) {
  using namespace shortshot_bench;
  RecognizeCommand command;
  int exit_code = 0;
  if (!parse_recognize_options(argc, argv, command, exit_code)) return exit_code;
  try {
    if (!command.learns) return run_recognize(command) ? 0 : 1;
    run_learn(command);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 2;
}
