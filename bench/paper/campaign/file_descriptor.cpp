#include "paper/campaign/file_descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "tools/io/input_error.hpp"

namespace shortshot_bench::campaign {

FileDescriptor::FileDescriptor(const std::string& path)
    : number_(open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (number_ >= 0) return;
  throw InputError::about(path, "cannot open the file for writing: " + std::generic_category().message(errno));
}

FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) close(number_);
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

}  // namespace shortshot_bench::campaign
