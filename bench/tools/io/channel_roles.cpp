#include "channel_roles.hpp"

#include <string>

#include "lower_case.hpp"

namespace shortshot_bench {
namespace {

struct KnownName {
  std::string_view name;
  Role role;
};

// Without separators and in lower case; of two names of one role the upper one counts where a file has both.
constexpr KnownName known_names[] = {
    {"x", Role::x},
    {"y", Role::y},
    {"z", Role::z},
    {"red", Role::red},
    {"green", Role::green},
    {"blue", Role::blue},
    {"r", Role::red},
    {"g", Role::green},
    {"b", Role::blue},
    {"rgb", Role::packed_color},
    {"rgba", Role::packed_color},
    {"normalx", Role::normal_x},
    {"normaly", Role::normal_y},
    {"normalz", Role::normal_z},
    {"nx", Role::normal_x},
    {"ny", Role::normal_y},
    {"nz", Role::normal_z},
    {"normx", Role::normal_x},
    {"normy", Role::normal_y},
    {"normz", Role::normal_z},
    {"intensity", Role::intensity},
    {"intensities", Role::intensity},
    {"reflectance", Role::intensity},
    {"reflectivity", Role::intensity},
    {"remission", Role::intensity},
    {"i", Role::intensity},
};

bool drop_prefix(std::string& name, std::string_view prefix) {
  if (name.size() <= prefix.size() || name.compare(0, prefix.size(), prefix) != 0) return false;
  name.erase(0, prefix.size());
  return true;
}

std::string without_separators(std::string_view name) {
  std::string result;
  for (const char c : lower_case(name)) {
    if (c != '_' && c != '.' && c != '-') result += c;
  }
  return result;
}

NamedRole look_up(std::string_view name) {
  std::size_t rank = 0;
  for (const KnownName& known : known_names) {
    if (known.name == name) return {known.role, rank};
    ++rank;
  }
  return {};
}

bool is_one_color(Role role) { return role == Role::red || role == Role::green || role == Role::blue; }

}  // namespace

NamedRole role_of_name(std::string_view name) {
  std::string plain = lower_case(name);
  const bool is_scalar = drop_prefix(plain, "scalar_");  // CloudCompare's, before the names of its fields
  plain = without_separators(plain);
  for (const char* const prefix : {"diffuse", "color", "colour"}) {
    std::string color = plain;
    if (drop_prefix(color, prefix) && is_one_color(look_up(color).role)) return look_up(color);
  }
  const NamedRole found = look_up(plain);
  return is_scalar && found.role <= Role::z ? NamedRole{} : found;  // a copy of a coordinate, colored by
}

std::array<Role, 3> roles_of_triple(std::string_view name) {
  const std::string plain = without_separators(name);
  if (plain == "xyz" || plain == "position" || plain == "points") return {Role::x, Role::y, Role::z};
  if (plain == "rgb" || plain == "color" || plain == "colors") return {Role::red, Role::green, Role::blue};
  if (plain == "normal" || plain == "normals" || plain == "nxyz" || plain == "normalxyz") {
    return {Role::normal_x, Role::normal_y, Role::normal_z};
  }
  return {Role::none, Role::none, Role::none};
}

bool is_padding(std::string_view name) { return name.find_first_not_of('_') == std::string_view::npos; }

}  // namespace shortshot_bench
