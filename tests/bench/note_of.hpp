// What a reader said about a cloud.
#pragma once

#include <string>

#include "tools/io/rgbd_cloud.hpp"

namespace cloud_file_test {

/// The first note that begins so, or nothing.
inline std::string note_of(const shortshot_bench::RgbdCloud& cloud, const std::string& begin) {
  for (const std::string& note : cloud.notes) {
    if (note.compare(0, begin.size(), begin) == 0) return note;
  }
  return {};
}

}  // namespace cloud_file_test
