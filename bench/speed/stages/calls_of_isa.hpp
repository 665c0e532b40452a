// The calls under test, for stages_of_isa.cpp alone: functions of their own, so that a profile shows them and a
// compiler cannot merge them with the loops of the benchmark.
#pragma once

#include <cstdint>
#include <vector>

#include "shortshot/shortshot.hpp"

namespace shortshot_bench {
namespace {

using shortshot::Status;

[[gnu::noinline]] Status sample(const shortshot::CloudView& view, float leaf, shortshot::KeypointSampler& sampler,
                                std::vector<std::uint32_t>& keypoints) {
  return sampler.sample_uniform(view, leaf, keypoints);
}

template <class Search>
[[gnu::noinline]] Status search_around(const Search& search, const shortshot::Point& center, float radius,
                                       shortshot::Neighborhood& n) {
  return search.gather(center, radius, n);
}

[[gnu::noinline]] Status frame_of(const shortshot::Neighborhood& n, float radius, shortshot::Frame& frame) {
  return shortshot::estimate_frame(n, radius, frame);
}

[[gnu::noinline]] Status normals_of_cloud(const shortshot::CloudView& view, const shortshot::GridSearch& search,
                                          float radius, const shortshot::Viewpoint& camera,
                                          std::vector<shortshot::SurfaceNormal>& normals) {
  return shortshot::estimate_normals(view, search, radius, camera, normals);
}

[[gnu::noinline]] Status normals_of_image(const shortshot::CloudView& view, float radius,
                                          const shortshot::Viewpoint& camera,
                                          shortshot::ImageNormalEstimator& estimator,
                                          std::vector<shortshot::SurfaceNormal>& normals) {
  return estimator.estimate(view, radius, camera, normals);
}

template <class D, class Sources>
[[gnu::noinline]] Status kernel(const shortshot::Neighborhood& n, const Sources& sources, const shortshot::Frame& frame,
                                float radius, float* out) {
  return shortshot::describe<D>(n, sources, frame, radius, out);
}

template <class Rule>
[[gnu::noinline]] Status lab_of_cloud(const shortshot::CloudView& view, shortshot::Lab* lab) {
  return shortshot::convert_colors<Rule>(view, lab);
}

template <class D>
[[gnu::noinline]] void bits_of(const float* values, shortshot::BinaryDescriptor<D>& bits) {
  shortshot::binarize(values, bits);
}

template <class D>
[[gnu::noinline]] int distance_to_all(const shortshot::BinaryDescriptor<D>& one,
                                      const std::vector<shortshot::BinaryDescriptor<D>>& all) {
  int sum = 0;
  for (const auto& other : all) sum += shortshot::hamming_distance(one, other);
  return sum;
}

}  // namespace
}  // namespace shortshot_bench
