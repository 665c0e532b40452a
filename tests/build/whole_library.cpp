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
  shortshot::Features<D, shortshot::PackedLab> packed;
  if (shortshot::extract<D>(cloud, search, keypoints, 0.1f, packed, Executor{}) != shortshot::Status::ok) return 0;
  return features.size() + packed.size();
}

std::size_t describe_all(const shortshot::CloudView& cloud) {
  const shortshot::GridSearch grid(cloud, 0.1f);
  shortshot::OrganizedSearch image;
  std::size_t rows = describe<shortshot::Ssh32>(cloud, grid);
  rows += describe<shortshot::Scsh336>(cloud, shortshot::BruteSearch{cloud});
  if (image.build(cloud) == shortshot::Status::ok) rows += describe<shortshot::Ssh96>(cloud, image);
#if defined(__cpp_exceptions)
  rows += describe<shortshot::Scsh696>(cloud, shortshot::NanoflannSearch(cloud));
#endif
  return rows;
}

}  // namespace

int main() {
  const std::vector<ColoredPoint> points(10);
  std::size_t rows = describe_all(shortshot::view_of(points));
  shortshot::CloudView view{};
  const Message message{};
  if (shortshot::view_point_cloud2(message, view) == shortshot::Status::ok) rows += describe_all(view);
#if defined(__cpp_exceptions)
  const Eigen::Matrix3Xf matrix = Eigen::Matrix3Xf::Zero(3, 10);
  rows += describe_all(shortshot::view_eigen(matrix));
#endif
  return rows > 0 ? 0 : 1;
}
