// Private to the readers: which channel is meant by a name, the same for PCD fields and PLY properties.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace shortshot_bench {

enum class Role : std::uint8_t {
  x,
  y,
  z,
  red,
  green,
  blue,
  packed_color,  // all three in four bytes
  intensity,
  normal_x,
  normal_y,
  normal_z,
  none
};
constexpr std::size_t role_count = static_cast<std::size_t>(Role::none);

struct NamedRole {
  Role role = Role::none;
  std::size_t rank = 0;  // of two channels of one role the lower one counts
};

/// In any case, with "_", "." and "-" between the words or not: Red, diffuse_red, NormalX, scalar_Intensity, ...
NamedRole role_of_name(std::string_view name);

/// The roles of three values under one name ("xyz", "rgb", "normal"), or none of them.
std::array<Role, 3> roles_of_triple(std::string_view name);

/// "_", of any length, or no name: bytes that mean nothing.
bool is_padding(std::string_view name);

}  // namespace shortshot_bench
