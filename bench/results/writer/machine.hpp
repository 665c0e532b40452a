// The machine, the compiler and its flags: written down when the measurements are taken, and told in the documents.
#pragma once

#include <string>

namespace shortshot_bench::results {

struct Machine {
  std::string cpu;
  unsigned cores = 0;
  std::string system;
  std::string compiler;
  std::string flags;
};

/// This machine, and what this program was compiled with: all programs of one build directory have the same.
Machine this_machine();

/// Throw std::runtime_error or InputError with the file's name.
void write_machine(const std::string& path, const Machine& machine);
Machine read_machine(const std::string& path);

}  // namespace shortshot_bench::results
