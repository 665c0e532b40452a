// What the map is drawn of: descriptors, each in several formats.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "paper/configuration.hpp"
#include "tradeoff/storage.hpp"

namespace shortshot_bench::tradeoff {

/// Of the papers, of the library, or a relative of those with other grids.
enum class Kind { published, compact, relative };

struct Candidate {
  paper::Configuration configuration;
  std::vector<Storage> storages;  // floats first
  Kind kind;
  std::string board_name;  // in the tables of microcontrollers; empty: it was not built for them
};

/// "shapecolor95-4bit".
inline std::string entry_name(const Candidate& candidate, const Storage& storage) {
  return candidate.configuration.name + "-" + storage.name;
}

/// What others are compared with: where there is color, and where there is none.
inline constexpr const char* color_baseline = "cshot1344-float";
inline constexpr const char* shape_baseline = "shot352-float";
inline constexpr const char* plain_baseline = "shot352-view-float";  // where there is color that tells nothing

/// One with nothing but floats.
template <class D>
Candidate candidate(std::string name, Kind kind, std::string board_name = {}) {
  return {paper::configuration<D>(std::move(name)), {float_storage<D>()}, kind, std::move(board_name)};
}

template <class D>
Candidate& with_bytes(Candidate& c) {
  c.storages.push_back(packed_storage<shortshot::ByteDescriptor<D>>("8bit", D::size));
  return c;
}
template <class D, int Scale = shortshot::nibble_scale<D>>
Candidate& with_nibbles(Candidate& c) {
  c.storages.push_back(packed_storage<shortshot::NibbleDescriptor<D, Scale>>("4bit", D::size));
  return c;
}
template <class D>
Candidate& with_bits(Candidate& c) {
  c.storages.push_back(packed_storage<shortshot::BinaryDescriptor<D>>("bshot", D::size));
  return c;
}

/// All: the library's own, CSHOT first, then the family. `quick`: a few of them.
std::vector<Candidate> candidates(bool quick);

}  // namespace shortshot_bench::tradeoff
