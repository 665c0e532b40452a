// Everything that a user calls, by its bare name, where the names of the standard library and PCL's are bare as well.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <shortshot/shortshot.hpp>
#include <tuple>

namespace pcl {  // names that PCL 1.13 has
struct PointXYZ {};
struct PointXYZI {};
struct Normal {};
struct Correspondence {};
struct Axis {};
struct ReferenceFrame {};
struct RGB {};
struct Label {};
template <class>
class Feature {};
template <class Point>
bool isFinite(const Point&);
template <class Point>
Point transformPoint(const Point&, int);
template <class Cloud>
void copyPointCloud(const Cloud&, Cloud&);
}  // namespace pcl

using namespace std;
using namespace pcl;
using namespace shortshot;

Status everything(const CloudView& cloud) {
  Features<Shot352> features;
  vector<SurfaceNormal> normals;
  vector<MatchedPair> pairs;
  vector<PointPair> points;
  vector<std::uint32_t> inliers, keypoints;
  Pose pose;
  const GridSearch search(cloud, 0.04f);
  Status status = validate(cloud);
  if (status == Status::ok) status = sample_uniform(cloud, 0.02f, keypoints);
  if (status == Status::ok) status = estimate_normals(cloud, search, 0.02f, Viewpoint::towards({0, 0, 0}), normals);
  const CloudView with = with_normals(cloud, normals.data());
  if (status == Status::ok) status = extract(with, search, keypoints, 0.04f, features);
  if (status == Status::ok) status = reciprocal_correspondences(rows_of(features), rows_of(features), pairs);
  if (status == Status::ok) status = fit_pose(points, pose);
  if (status == Status::ok) status = estimate_pose(points, RansacOptions{}, pose, inliers);
  const Point moved = transform_point(pose, point(cloud, 0));
  const KeyPoint key = keypoint(cloud, 0);
  if (has_colors(cloud)) return convert_colors<PublishedLab>(cloud, static_cast<Lab*>(nullptr));
  BinaryDescriptor<Shot352> bits;
  binarize(features[0], bits);
  ByteDescriptor<Shot352> bytes;
  quantize(features[0], bytes);
  const auto apart = squared_distance(moved, key.position) + static_cast<float>(hamming_distance(bits, bits)) +
                     static_cast<float>(squared_distance(bytes, bytes));
  const string text = layout_of<Shot352>() + message(status);
  return apart > 0.0f && !text.empty() && self_check() ? keep_best_frames(features, 0.5f) : status;
}
