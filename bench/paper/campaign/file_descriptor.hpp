// An open file as POSIX knows it, for what streams cannot do: locks, cutting off an end.
#pragma once

#include <string>

namespace shortshot_bench::campaign {

/// Closes its file when it goes.
class FileDescriptor {
 public:
  /// Opens or makes the file for appending. Throws InputError if it cannot.
  explicit FileDescriptor(const std::string& path);
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&&) = delete;

  int number() const { return number_; }

 private:
  int number_ = -1;
};

}  // namespace shortshot_bench::campaign
