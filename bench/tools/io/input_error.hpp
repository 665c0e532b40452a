// The one exception of the file I/O: a file cannot be used, and where in it the reason stands.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace shortshot_bench {

// Output files that cannot be written throw it too, so that a tool has one thing to catch and to print.
class InputError : public std::runtime_error {
 public:
  // "FILE:LINE: what"; lines count from 1.
  static InputError at_line(const std::string& path, std::uint64_t line, const std::string& what) {
    return InputError(path + ":" + std::to_string(line) + ": " + what);
  }

  // "PATH: what", of a folder, or of a file as a whole.
  static InputError about(const std::string& path, const std::string& what) { return InputError(path + ": " + what); }

  // "FILE: byte N: what"; bytes count from 0.
  static InputError at_byte(const std::string& path, std::uint64_t byte, const std::string& what) {
    return InputError(path + ": byte " + std::to_string(byte) + ": " + what);
  }

 private:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace shortshot_bench
