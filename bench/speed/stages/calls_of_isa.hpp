// The calls under test, for stages_of_isa.cpp alone: functions of their own, so that a profile shows them and a
// compiler cannot merge them with the loops of the benchmark.
#pragma once

#include <malloc.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "speed/spread_keypoints.hpp"
#include "speed/stages/stages.hpp"

namespace shortshot_bench {
namespace {

using shortshot::Status;

std::size_t allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

template <class Search>
std::size_t index_bytes(const Workload& workload) {
  const std::size_t before = allocated_bytes();
  const Search search(workload.view(), workload.radius);
  return allocated_bytes() - before;
}

[[gnu::noinline]] Status sample(const shortshot::CloudView& view, float leaf, shortshot::KeypointSampler& sampler,
                                std::vector<std::uint32_t>& keypoints) {
  return sampler.sample_uniform(view, leaf, keypoints);
}

/// What is kept from frame to frame.
template <class D>
struct FrameMemory {
  shortshot::KeypointSampler sampler;
  std::vector<std::uint32_t> keypoints;
  shortshot::GridSearch search;
  shortshot::Extractor<D> extractor;
  shortshot::Features<D> features;
};

template <class D>
[[gnu::noinline]] Status whole_frame(const shortshot::CloudView& view, float leaf, float radius,
                                     FrameMemory<D>& memory) {
  Status status = memory.sampler.sample_uniform(view, leaf, memory.keypoints);
  if (status != Status::ok) return status;
  keep_spread(memory.keypoints, frame_keypoints);
  status = memory.search.build(view, radius);
  if (status != Status::ok) return status;
  return memory.extractor.extract(view, memory.search, memory.keypoints, radius, memory.features);
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

/// As extract() does it.
template <class Rule>
[[gnu::noinline]] Status lab_of_cloud_by(const shortshot::LabTable<Rule>& table, const shortshot::CloudView& view,
                                         shortshot::Lab* lab) {
  shortshot::detail::convert_range(view, 0, view.size, table, lab);
  return Status::ok;
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
