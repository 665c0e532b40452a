// What a Status other than ok is to a tool.
#pragma once

#include <stdexcept>

#include "shortshot/status.hpp"

namespace shortshot_bench {

/// Throws std::runtime_error with the library's own words unless `status` is ok.
inline void require(shortshot::Status status) {
  if (status != shortshot::Status::ok) throw std::runtime_error(shortshot::message(status));
}

}  // namespace shortshot_bench
