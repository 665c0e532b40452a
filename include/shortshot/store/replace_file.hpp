// shortshot/store/replace_file.hpp: files as a whole: all bytes of one, or new ones in its place. Hosted only.
//
// A file is never written to where it lies: a disk that is full, or a program that ends, would leave half of the new
// file and nothing of the old one. What is new is written beside it, and then takes its name, which is one step.
//
// By the C library: `<fstream>` takes more time to compile than all that would be used of it.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "../config.hpp"
#include "../status.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Makes a file that was not there before, of a name that nobody else has: "x" fails for one that is. Null, and no
/// name, if there can be none. What programs that ended in between have left is never touched.
[[nodiscard]] inline std::FILE* create_beside(const std::string& path, std::string& name) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    name = path;
    name += ".tmp-";
    name += static_cast<char>('0' + attempt / 10);
    name += static_cast<char>('0' + attempt % 10);
    std::FILE* const file = std::fopen(name.c_str(), "wbx");
    if (file != nullptr) return file;
    if (errno != EEXIST) break;
  }
  name.clear();
  return nullptr;
}

/// Can a file take that name? Not where a folder or a device is: a program with all rights could replace /dev/null.
/// Whoever could read the old file can read the new one.
[[nodiscard]] inline bool adopt_rights(const std::string& path, std::FILE* file) noexcept {
#if defined(__unix__) || defined(__APPLE__)
  struct stat old;
  if (::stat(path.c_str(), &old) != 0) return true;  // there is none
  return S_ISREG(old.st_mode) && ::fchmod(::fileno(file), old.st_mode & 07777) == 0;
#else
  static_cast<void>(path);
  static_cast<void>(file);
  return true;
#endif
}

/// Only when the disk has it: a full one may say so as late as that.
[[nodiscard]] inline bool flush_to_disk(std::FILE* file) noexcept {
  if (std::fflush(file) != 0) return false;
#if defined(__unix__) || defined(__APPLE__)
  return ::fsync(::fileno(file)) == 0 || errno == EINVAL;  // EINVAL: a file system without
#else
  return true;
#endif
}

/// Puts a file that has `bytes` in place of what is at `path`, or where nothing is. ok or no_file; then what was there
/// still is, as it was, and nothing else is left. A symbolic link is replaced, not the file that it leads to.
[[nodiscard]] inline Status replace_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  std::string name;
  std::FILE* const file = create_beside(path, name);
  if (file == nullptr) return Status::no_file;
  bool is_written = adopt_rights(path, file) && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() &&
                    flush_to_disk(file);
  is_written = std::fclose(file) == 0 && is_written;
  if (is_written && std::rename(name.c_str(), path.c_str()) == 0) return Status::ok;
#if defined(_WIN32)  // where a name that is in use cannot be taken over
  if (is_written && std::remove(path.c_str()) == 0 && std::rename(name.c_str(), path.c_str()) == 0) return Status::ok;
#endif
  static_cast<void>(std::remove(name.c_str()));
  return Status::no_file;
}

/// All bytes of a file. ok or no_file; `bytes` may be the first ones then.
[[nodiscard]] inline Status read_file(const std::string& path, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return Status::no_file;
  struct Closer {
    std::FILE* file;
    ~Closer() { static_cast<void>(std::fclose(file)); }
  } const closer{file};  // memory may be short
  std::uint8_t block[4096];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file)) {
    bytes.insert(bytes.end(), block, block + count);
  }
  return std::ferror(file) == 0 ? Status::ok : Status::no_file;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
