// Calls every public function template once, so that compilers and clang-tidy see all of the bodies.
#if defined(__cpp_exceptions)  // nanoflann throws
#include <Eigen/Core>
#include <nanoflann.hpp>
#endif

#include <shortshot/shortshot.hpp>
#include <string>

namespace {

struct ColoredPoint {
  float x, y, z;
  unsigned char r, g, b;
};

struct PointNormal {
  float normal_x, normal_y, normal_z;
};

template <class D>
struct Signatures {  // as pcl::PointCloud<pcl::SHOT352>
  struct Signature {
    float descriptor[D::size];
    float rf[9];
  };
  std::vector<Signature> points;
  unsigned width, height;
  bool is_dense;
};

struct Field {
  std::string name;
  unsigned offset;
  unsigned char datatype;
};

struct Message {
  std::vector<unsigned char> data;
  std::vector<Field> fields;
  unsigned width, height, point_step, row_step;
  bool is_bigendian;
};

struct Executor {
  static int threads() { return 1; }
  template <class Work>
  void run(const Work& work) {
    work();
  }
};

template <class D, class Search>
std::size_t describe(const shortshot::CloudView& cloud, const Search& search) {
  std::vector<std::uint32_t> keypoints;
  shortshot::Features<D> features;
  if (shortshot::sample_uniform(cloud, 0.1f, keypoints) != shortshot::Status::ok) return 0;
  if (shortshot::extract<D>(cloud, search, keypoints, 0.1f, features, 2) != shortshot::Status::ok) return 0;
  shortshot::Extractor<D, shortshot::PackedLab> extractor;
  shortshot::Features<D> packed;
  if (extractor.extract(cloud, search, keypoints, 0.1f, packed, Executor{}) != shortshot::Status::ok) return 0;
  Signatures<D> signatures{};
  shortshot::to_pcl(features, signatures);
  return signatures.points.size() + packed.size();
}

template <class D, class Search>
std::size_t describe_with_normals(const shortshot::CloudView& cloud, const Search& search) {
  std::vector<shortshot::SurfaceNormal> normals;
  if (shortshot::estimate_normals(cloud, search, 0.1f, {}, normals) != shortshot::Status::ok) return 0;
  std::vector<float> row(D::size);
  shortshot::BinaryDescriptor<D> bits;
  shortshot::binarize(row.data(), bits);
  const auto distance = static_cast<std::size_t>(shortshot::hamming_distance(bits, bits));
  return describe<D>(shortshot::with_normals(cloud, normals.data()), search) + distance;
}

std::size_t describe_all(const shortshot::CloudView& cloud) {
  const shortshot::GridSearch grid(cloud, 0.1f);
  shortshot::OrganizedSearch image;
  std::size_t rows = describe<shortshot::Ssh32>(cloud, grid);
  rows += describe<shortshot::Scsh336>(cloud, shortshot::BruteSearch{cloud});
  rows += describe_with_normals<shortshot::Shot352>(cloud, grid);
  rows += describe_with_normals<shortshot::PclCshot1344>(cloud, grid);
  if (image.build(cloud) == shortshot::Status::ok) rows += describe<shortshot::Ssh96>(cloud, image);
#if defined(__cpp_exceptions)
  rows += describe<shortshot::Scsh696>(cloud, shortshot::NanoflannSearch(cloud));
#endif
  return rows;
}

template <class Rows>
std::size_t match(const Rows& rows) {
  std::vector<shortshot::Match> matches;
  std::vector<shortshot::MatchedPair> mutual, distinct;
  if (shortshot::nearest(rows, rows, 2, matches) != shortshot::Status::ok) return 0;
  if (shortshot::reciprocal_correspondences(rows, rows, mutual) != shortshot::Status::ok) return 0;
  if (shortshot::ratio_correspondences(rows, rows, 0.8f, distinct) != shortshot::Status::ok) return 0;
  return matches.size() + mutual.size() + distinct.size();
}

std::size_t store(const shortshot::Features<shortshot::Ssh32>& features) {
  std::vector<shortshot::ByteDescriptor<shortshot::Ssh32>> bytes(features.size());
  std::vector<shortshot::BinaryDescriptor<shortshot::Ssh32>> bits(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    shortshot::quantize(features[i], bytes[i]);
    shortshot::binarize(features[i], bits[i]);
  }
  std::vector<std::uint8_t> file;
  shortshot::Features<shortshot::Ssh32> loaded;
  if (shortshot::save(features, file) != shortshot::Status::ok) return 0;
  if (shortshot::load(file.data(), file.size(), loaded) != shortshot::Status::ok) return 0;
  if (shortshot::save(loaded, std::string("/dev/null/none")) == shortshot::Status::ok) return 0;
  if (shortshot::load(std::string("/dev/null/none"), loaded) == shortshot::Status::ok) return 0;
  const auto squares = static_cast<std::size_t>(shortshot::l2_distance(features[0], loaded[0], 32));
  return match(shortshot::rows_of(bytes)) + match(shortshot::rows_of(bits, features.status.data())) + squares;
}

std::size_t recognize(const shortshot::CloudView& cloud) {
  std::vector<shortshot::KeyPoint> keypoints;
  shortshot::Features<shortshot::Ssh32> features;
  const shortshot::GridSearch search(cloud, 0.1f);
  if (shortshot::sample_centroids(cloud, 0.1f, keypoints) != shortshot::Status::ok) return 0;
  if (shortshot::extract(cloud, search, keypoints, 0.1f, features) != shortshot::Status::ok) return 0;

  std::vector<shortshot::Match> matches;
  std::vector<shortshot::MatchedPair> correspondences;
  if (shortshot::nearest(rows_of(features), rows_of(features), 2, matches) != shortshot::Status::ok) return 0;
  if (shortshot::reciprocal_correspondences(rows_of(features), rows_of(features), correspondences, 2) !=
      shortshot::Status::ok) {
    return 0;
  }
  if (shortshot::ratio_correspondences(rows_of(features), rows_of(features), 0.8f, correspondences) !=
      shortshot::Status::ok) {
    return 0;
  }
  std::vector<shortshot::PointPair> pairs;
  pairs.reserve(correspondences.size());
  for (const auto& c : correspondences) pairs.push_back({keypoints[c.source].position, keypoints[c.target].position});
  shortshot::Pose pose{};
  std::vector<std::uint32_t> inliers;
  if (shortshot::fit_pose(pairs, pose) != shortshot::Status::ok) return 0;
  if (shortshot::estimate_pose(pairs, {}, pose, inliers) != shortshot::Status::ok) return 0;

  shortshot::Recognizer recognizer;
  if (shortshot::train(recognizer, features, {}, "class", "instance") != shortshot::Status::ok) return 0;
  std::vector<std::uint8_t> model;
  if (shortshot::save(recognizer, model) != shortshot::Status::ok) return 0;
  const std::string layout = shortshot::layout_of<shortshot::Ssh32>();
  if (shortshot::load(model.data(), model.size(), layout, recognizer) != shortshot::Status::ok) return 0;
  std::vector<shortshot::Hypothesis> hypotheses;
  shortshot::ActivationShares shares;
  if (shortshot::recognize(recognizer, features, hypotheses) != shortshot::Status::ok) return 0;
  if (shortshot::activation_shares(recognizer, features, shares) != shortshot::Status::ok) return 0;
  return hypotheses.size() + shares.classes.size() + inliers.size() + store(features);
}

}  // namespace

int main() {
  const std::vector<ColoredPoint> points(10);
  const std::vector<PointNormal> normals(10);
  std::size_t rows = describe_all(shortshot::view_of(points)) + describe_all(shortshot::view_of(points, normals));
  shortshot::CloudView view{};
  const Message message{};
  if (shortshot::view_point_cloud2(message, view) == shortshot::Status::ok) rows += describe_all(view);
  shortshot::CloudCopy copy;
  const bool is_copied = shortshot::copy_point_cloud2(message, copy, view) == shortshot::Status::ok;
  if (is_copied && shortshot::point_cloud2_channels(message).colors == shortshot::Status::ok)
    rows += describe_all(view);
#if defined(__cpp_exceptions)
  const Eigen::Matrix3Xf matrix = Eigen::Matrix3Xf::Zero(3, 10);
  rows += describe_all(shortshot::view_eigen(matrix));
#endif
  rows += recognize(shortshot::view_of(points));
  return rows > 0 ? 0 : 1;
}
