// The descriptors that the experiments compare: each a type of the library, known here by its name.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "paper/kept_frames.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/io/require_ok.hpp"

namespace shortshot_bench::paper {

/// Descriptors of key points, whose type is known at run time only.
struct Described {
  std::vector<float> values;  // row by row
  std::vector<shortshot::Status> status;
  std::vector<shortshot::Frame> frames;
  std::vector<shortshot::KeyPoint> keypoints;
  std::size_t size = 0;  // of a row

  shortshot::FeatureRows rows() const {
    return {{values.data(), status.size(), size, status.data()}, keypoints.data(), frames.data()};
  }
};

using Describe =
    std::function<Described(const shortshot::CloudView&, const shortshot::GridSearch&,
                            const std::vector<shortshot::KeyPoint>&, const shortshot::Support&, const KeptFrames&)>;

struct Configuration {
  std::string name;
  std::size_t size;  // floats
  bool needs_colors;
  bool needs_normals;
  bool wants_viewpoint;  // of the camera
  std::string layout;    // what its values mean
  Describe describe;     // throws std::runtime_error with the library's message
  KeptFrames kept;       // for describe()

  std::size_t size_bytes() const { return size * sizeof(float); }
};

template <class D>
Described described_by(shortshot::Features<D> features) {
  return {std::move(features.values), std::move(features.status), std::move(features.frames),
          std::move(features.keypoints), static_cast<std::size_t>(D::size)};
}

/// In frames that are given; a row has none if its status is not ok, which becomes that of the descriptor.
template <class D>
void extract_in(const std::vector<shortshot::Frame>& frames, const std::vector<shortshot::Status>& status,
                const shortshot::CloudView& cloud, const shortshot::GridSearch& search,
                const std::vector<shortshot::KeyPoint>& keypoints, const shortshot::Support& support,
                shortshot::Features<D>& features) {
  require(shortshot::extract(cloud, search, keypoints, frames, support.radius, features));
  for (std::size_t row = 0; row < features.size(); ++row) {
    if (status[row] != shortshot::Status::ok) features.status[row] = status[row];
  }
}

template <class D>
Described describe_as(const shortshot::CloudView& cloud, const shortshot::GridSearch& search,
                      const std::vector<shortshot::KeyPoint>& keypoints, const shortshot::Support& support,
                      const KeptFrames& kept) {
  shortshot::Features<D> features;
  if constexpr (D::needs_frame) {
    require(shortshot::extract(cloud, search, keypoints, support, features));
  } else {  // recognition casts votes from frames all the same
    shortshot::Features<shortshot::Ssh32> framed;
    require(shortshot::extract(cloud, search, keypoints, support, framed));
    extract_in(framed.frames, framed.status, cloud, search, keypoints, support, features);
    features.frame_confidence = std::move(framed.frame_confidence);
  }
  require(keep_frames(features, keypoints, kept));
  return described_by(std::move(features));
}

template <class D>
Configuration configuration(std::string name) {
  return {std::move(name),    static_cast<std::size_t>(D::size), D::needs_colors, D::needs_normals,
          D::wants_viewpoint, shortshot::layout_of<D>(),         describe_as<D>,  {}};
}

/// All that `--descriptor` knows, the paper's baseline first.
std::vector<Configuration> known_configurations();

/// Those of them with these names, in that order; a name may say which key points are kept. Throws std::runtime_error
/// with the names that there are.
std::vector<Configuration> configurations_named(const std::vector<std::string>& names);

}  // namespace shortshot_bench::paper
