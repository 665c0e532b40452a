// What the format says about each array it knows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shortshot_bench::golden {

enum class Role {
  input,      // taken as it is: what the library is given
  reference,  // what the library must reproduce
  later,      // the reference of something that the library does not have yet
};

struct KnownArray {
  std::string dtype;
  std::string counted_by;              // it has one row per row of the array of this name; empty: any number
  std::vector<std::uint64_t> columns;  // the shape of one row
  Role role;
};

std::optional<KnownArray> find_known_array(const std::string& name);

}  // namespace shortshot_bench::golden
