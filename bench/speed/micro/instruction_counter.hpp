// The CPU's own counter of this thread's instructions, where the kernel lets a program read it.
#pragma once

#include <cstdint>
#include <string>

namespace shortshot_bench {

class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  bool counts() const { return file_ >= 0; }
  const std::string& why_not() const { return why_not_; }

  /// Instructions in user mode so far; 0 if there is no counter.
  std::uint64_t instructions() const;

 private:
  int file_;
  std::string why_not_;
};

}  // namespace shortshot_bench
