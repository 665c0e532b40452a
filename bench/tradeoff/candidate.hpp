// What the map is drawn of: descriptors, each in several formats.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "paper/configuration.hpp"
#include "paper/storage.hpp"

namespace shortshot_bench::tradeoff {

using paper::coded;
using paper::float_storage;
using paper::packed_storage;
using paper::Storage;

/// Of the papers, of the library, or a relative of those with other grids.
enum class Kind { published, compact, relative };

struct Candidate {
  paper::Configuration configuration;
  paper::Describe describe_alone;  // without the frames of descriptors that need none: what describing costs
  std::vector<Storage> storages;   // floats first
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

struct FixedLampFrames {
  std::vector<shortshot::Frame> frames;
  std::vector<shortshot::Status> status;
};
FixedLampFrames fixed_lamp_frames(const shortshot::CloudView& cloud, const shortshot::GridSearch& search,
                                  const std::vector<shortshot::KeyPoint>& keypoints, const shortshot::Support& support);

/// extract(), and nothing else.
template <class D>
paper::Described extract_as(const shortshot::CloudView& cloud, const shortshot::GridSearch& search,
                            const std::vector<shortshot::KeyPoint>& keypoints, const shortshot::Support& support,
                            const paper::KeptFrames&) {
  shortshot::Features<D> features;
  require(shortshot::extract(cloud, search, keypoints, support, features));
  return paper::described_by(std::move(features));
}

/// The frames' x axes point to where it is brighter.
template <class D>
paper::Described describe_under_fixed_lamp(const shortshot::CloudView& cloud, const shortshot::GridSearch& search,
                                           const std::vector<shortshot::KeyPoint>& keypoints,
                                           const shortshot::Support& support, const paper::KeptFrames&) {
  const FixedLampFrames frames = fixed_lamp_frames(cloud, search, keypoints, support);
  shortshot::Features<D> features;
  paper::extract_in(frames.frames, frames.status, cloud, search, keypoints, support, features);
  return paper::described_by(std::move(features));
}

/// One with nothing but floats.
template <class D>
Candidate candidate(std::string name, Kind kind, std::string board_name = {}) {
  return {paper::configuration<D>(std::move(name)), extract_as<D>, {float_storage<D>()}, kind, std::move(board_name)};
}

/// `name` says the format, `code_size` how many numbers a code has.
template <class Packed>
Candidate& with_format(Candidate& c, std::string name, int code_size) {
  c.storages.push_back(packed_storage<Packed>(std::move(name), static_cast<std::size_t>(code_size)));
  return c;
}
template <class D, int Scale = shortshot::code_scale<D, 4>>
Candidate& with_nibbles(Candidate& c) {
  return with_format<shortshot::NibbleDescriptor<D, Scale>>(c, "4bit", D::size);
}
/// Whole numbers of steps, coarser and coarser, and in half the bits of a float.
template <class D>
Candidate& with_codes(Candidate& c) {
  with_format<shortshot::HalfDescriptor<D>>(c, "half", D::size);
  with_format<shortshot::ByteDescriptor<D>>(c, "8bit", D::size);
  with_nibbles<D>(c);
  return with_format<shortshot::CodedDescriptor<D, 3>>(c, "3bit", D::size);
}

/// All: the library's own, CSHOT first, then the family. `quick`: a few of them.
std::vector<Candidate> candidates(bool quick);

}  // namespace shortshot_bench::tradeoff
