// shortshot/batch/known_normals.hpp: normals of places where points lie on top of each other, to be computed once.
// Hosted only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t place_slots = 256;

/// Which of them a place has; -0 is 0.
[[nodiscard]] inline std::size_t slot_of_place(const Point& p, std::uint32_t seed = 0) noexcept {
  std::uint32_t hash = seed;
  for (const float v : {p.x, p.y, p.z}) hash = (hash ^ math::bits_of(v + 0.0f)) * 2654435769u;
  return hash >> 24;
}

/// The normals of the last few crowded places. Many drivers write (0, 0, 0) for "no measurement": as many points in one
/// place, each of which has all the others as neighbors. One per thread and call; of two places that meet in an entry
/// the later one stays.
class KnownNormals {
 public:
  /// Points that are looked at together, all of them in one place, may get other roundings than one alone.
  enum class Way : std::uint8_t { none, together, alone };

  /// Fewest neighbors of a place that is worth an entry: all others leave the entries to those.
  static constexpr std::uint32_t crowd = 64;

  /// Null if it is not known.
  [[nodiscard]] const SurfaceNormal* find(const Point& p, Way way) const noexcept {
    const Entry& entry = entries_[slot_of_place(p, static_cast<std::uint32_t>(way))];
    const bool is_it = entry.way == way && entry.at.x == p.x && entry.at.y == p.y && entry.at.z == p.z;
    return is_it ? &entry.normal : nullptr;
  }

  void keep(const Point& p, Way way, std::uint32_t neighbors, const SurfaceNormal& normal) noexcept {
    if (neighbors >= crowd) entries_[slot_of_place(p, static_cast<std::uint32_t>(way))] = {p, normal, way};
  }

 private:
  struct Entry {
    Point at;
    SurfaceNormal normal;
    Way way;
  };

  std::array<Entry, place_slots> entries_{};
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
