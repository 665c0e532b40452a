// One of the libraries: LIBRARY is its name.
#include "library.hpp"

namespace border {
namespace {

using namespace shortshot;

Support make_support(Radius radius) {
  Support support = radius;
  support.viewpoint = Viewpoint::towards({0.0f, 0.0f, 0.0f});
  return support;
}

Status describe_features(const CloudView& cloud, const Support& support, Features<D>& features) {
  std::vector<KeyPoint> keypoints;
  const Status status = sample_centroids(cloud, 0.03f, keypoints);
  if (status != Status::ok) return status;
  return extract(cloud, GridSearch(cloud, support.radius.value), keypoints, support, features, 2);
}

Status normals_of_cloud(const CloudView& cloud, const Viewpoint& viewpoint, std::vector<SurfaceNormal>& normals) {
  return estimate_normals(cloud, GridSearch(cloud, 0.02f), 0.02f, viewpoint, normals, 2);
}

Status match_features(const Features<D>& a, const Features<D>& b, std::vector<MatchedPair>& pairs) {
  return reciprocal_correspondences(rows_of(a), rows_of(b), pairs, 2);
}

Status pose_of_pairs(const std::vector<PointPair>& pairs, Pose& pose, std::vector<std::uint32_t>& inliers) {
  return estimate_pose(pairs, RansacOptions{}, pose, inliers);
}

Status train_on(Recognizer& recognizer, const Features<D>& features) {
  return train(recognizer, features, {0.0f, 0.0f, 1.0f}, "sheet", "wavy");
}

Status recognize_in(const Recognizer& recognizer, const Features<D>& features, std::vector<Hypothesis>& objects) {
  return recognize(recognizer, features, objects, 2);
}

Status save_bytes(const Recognizer& recognizer, std::vector<std::uint8_t>& bytes) { return save(recognizer, bytes); }

Status load_bytes(const std::vector<std::uint8_t>& bytes, Recognizer& recognizer) {
  return load(bytes.data(), bytes.size(), layout_of<D>(), recognizer);
}

}  // namespace

Library LIBRARY() {
  return {make_support, describe_features, normals_of_cloud, match_features, pose_of_pairs,
          train_on,     recognize_in,      save_bytes,       load_bytes};
}

}  // namespace border
