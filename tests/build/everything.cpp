// everything: calls every function of the library that computes on floats, with clouds of many kinds, and names those
// that raised a floating-point exception (exit code 1): a program that traps them (feenableexcept()) would end there.
// Also run by valgrind, which sees what depends on memory that nobody wrote.
#include <cfenv>
#include <cstdio>
#include <cstring>
#include <limits>
#include <shortshot/shortshot.hpp>
#include <string>
#include <vector>

namespace {

namespace ss = shortshot;

bool quiet = true;
bool may_overflow = false;  // squares of distances do where points are more than 1e19 apart
std::string cloud_name;

/// What comes of f, which must raise nothing. (Its status may be any; its values are read, every byte.)
template <class Function>
void step(const std::string& name, Function f) {
  std::feclearexcept(FE_ALL_EXCEPT);
  f();
  const int raised = std::fetestexcept(FE_INVALID | FE_DIVBYZERO | (may_overflow ? 0 : FE_OVERFLOW));
  if (raised == 0) return;
  quiet = false;
  std::printf("%s, %s:%s%s%s\n", cloud_name.c_str(), name.c_str(), (raised & FE_INVALID) != 0 ? " invalid" : "",
              (raised & FE_DIVBYZERO) != 0 ? " divided by zero" : "", (raised & FE_OVERFLOW) != 0 ? " overflow" : "");
}

unsigned checksum = 0;  // printed: the branch below is on what was read

/// Reads every byte, in a way that valgrind notices if nobody wrote it.
template <class T>
void read_all(const std::vector<T>& values) {
  std::vector<unsigned char> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  for (const unsigned char byte : bytes) checksum += byte > 127 ? 3u : 1u;
}

template <class Rows>
void match(const std::string& name, const Rows& rows) {
  step(name, [&] {
    std::vector<ss::Match> matches;
    std::vector<ss::MatchedPair> pairs;
    checksum += ss::nearest(rows, rows, 3, matches) == ss::Status::ok;
    checksum += ss::reciprocal_correspondences(rows, rows, pairs) == ss::Status::ok;
    checksum += ss::ratio_correspondences(rows, rows, 0.9f, pairs) == ss::Status::ok;
    for (const ss::Match& m : matches) checksum += m.distance > 0.5f ? 3u : 1u;
  });
}

template <class D>
void store_and_match(const std::string& name, const ss::Features<D>& f) {
  match(name + " nearest", ss::rows_of(f));
  std::vector<ss::ByteDescriptor<D>> bytes(f.size());
  std::vector<ss::NibbleDescriptor<D>> nibbles(f.size());
  std::vector<ss::BinaryDescriptor<D>> bits(f.size());
  std::vector<ss::HalfDescriptor<D>> halves(f.size());
  step(name + " stored", [&] {
    for (std::size_t i = 0; i < f.size(); ++i) {
      ss::quantize(f[i], bytes[i]);
      ss::quantize(f[i], nibbles[i]);
      ss::quantize(f[i], halves[i]);
      ss::binarize(f[i], bits[i]);
    }
  });
  match(name + " bytes", ss::rows_of(bytes));
  match(name + " nibbles", ss::rows_of(nibbles));
  match(name + " bits", ss::rows_of(bits));
  match(name + " halves", ss::rows_of(halves));
}

template <class D>
void recognize(const std::string& name, const ss::Features<D>& f) {
  step(name + " recognizer", [&] {
    ss::Recognizer recognizer;
    if (ss::train(recognizer, f, {}, "class", "instance") != ss::Status::ok) return;
    std::vector<ss::Hypothesis> objects;
    ss::ActivationShares shares;
    checksum += ss::recognize(recognizer, f, objects) == ss::Status::ok;
    checksum += ss::activation_shares(recognizer, f, shares) == ss::Status::ok;
  });
}

template <class D, class Search, class Key>
void describe(const std::string& name, const ss::CloudView& cloud, const Search& search, const std::vector<Key>& keys,
              float radius) {
  ss::Features<D> features;
  step(name, [&] { checksum += ss::extract(cloud, search, keys, radius, features) == ss::Status::ok; });
  read_all(features.values);
  read_all(features.frames);
  step(name + " from a viewpoint", [&] {
    ss::Support support{radius};
    support.viewpoint = ss::Viewpoint::towards({0.0f, 0.1f, 0.2f});
    checksum += ss::extract(cloud, search, keys, support, features) == ss::Status::ok;
  });
  step(name + " surest frames", [&] { checksum += ss::keep_best_frames(features, 0.5f) == ss::Status::ok; });
  store_and_match(name, features);
  recognize(name, features);
}

void match_poses(const ss::CloudView& cloud) {
  std::vector<ss::PointPair> pairs;
  for (std::size_t i = 0; i < cloud.size; i += 3) {
    const ss::Point p = ss::point(cloud, i);
    pairs.push_back({p, {1.0f - p.y, p.x, p.z}});
  }
  step("poses", [&] {
    ss::Pose pose{};
    std::vector<std::uint32_t> inliers;
    checksum += ss::fit_pose(pairs, pose) == ss::Status::ok;
    checksum += ss::estimate_pose(pairs, {}, pose, inliers) == ss::Status::ok;
  });
}

template <class Search>
void describe_all(const std::string& name, const ss::CloudView& cloud, const Search& search, float radius) {
  std::vector<int> keys;
  for (std::size_t i = 0; i < cloud.size; i += 1 + cloud.size / 24) keys.push_back(static_cast<int>(i));
  std::vector<ss::SurfaceNormal> normals;
  step(name + " normals", [&] {
    checksum +=
        ss::estimate_normals(cloud, search, radius, ss::Viewpoint::towards({0, 0, 1}), normals) == ss::Status::ok;
  });
  read_all(normals);
  step(name + " image normals", [&] {
    std::vector<ss::SurfaceNormal> of_image;
    checksum += ss::estimate_image_normals(cloud, radius, {}, of_image) == ss::Status::ok;
    read_all(of_image);
    std::vector<std::uint8_t> marks;
    checksum += ss::mark_neighbors(cloud, search, keys, radius, marks) == ss::Status::ok;
    checksum += ss::estimate_normals(cloud, search, radius, {}, marks, of_image) == ss::Status::ok;
  });
  describe<ss::Ssh96>(name + " Ssh96", cloud, search, keys, radius);
  describe<ss::Scsh336>(name + " Scsh336", cloud, search, keys, radius);
  describe<ss::IntensityShape336>(name + " IntensityShape336", cloud, search, keys, radius);
  describe<ss::ShapeColor95>(name + " ShapeColor95", cloud, search, keys, radius);
  describe<ss::RoomColor95>(name + " RoomColor95", cloud, search, keys, radius);
  describe<ss::HeightShape96>(name + " HeightShape96", cloud, search, keys, radius);
  describe<ss::ColorRings27>(name + " ColorRings27", cloud, search, keys, radius);
  if (normals.size() != cloud.size) return;
  const ss::CloudView with_normals = ss::with_normals(cloud, normals.data());
  describe<ss::Shot352>(name + " Shot352", with_normals, search, keys, radius);
  describe<ss::Cshot1344>(name + " Cshot1344", with_normals, search, keys, radius);
  describe<ss::PclCshot1344>(name + " PclCshot1344", with_normals, search, keys, radius);
}

struct Cloud {
  std::vector<float> xyz;
  std::vector<unsigned char> rgb;
  std::vector<float> intensities;
  void add(float x, float y, float z) {
    const auto i = static_cast<unsigned>(intensities.size());
    xyz.insert(xyz.end(), {x, y, z});
    for (const unsigned v : {i * 4, i * 7, i * 11}) rgb.push_back(static_cast<unsigned char>(v & 255u));
    intensities.push_back(static_cast<float>(i % 9));
  }
};

void compute_all(const std::string& name, const Cloud& memory, float radius) {
  cloud_name = name;
  const std::size_t size = memory.xyz.size() / 3;
  ss::CloudView cloud = ss::view_xyz_rgb(memory.xyz.data(), memory.rgb.data(), size);
  cloud = ss::with_intensities(cloud, memory.intensities.data());
  step("searches", [&] {
    const ss::GridSearch grid(cloud, radius);
    static ss::StaticGrid<1024, 2048> small;
    checksum += small.build(cloud, radius) == ss::Status::ok;
    static ss::Workspace<1024> workspace;
    for (std::size_t i = 0; i < size; i += 7) {
      ss::Neighborhood n = ss::neighborhood_in(workspace);
      checksum += small.gather(ss::point(cloud, i), radius, n) == ss::Status::ok;
      checksum += grid.gather(ss::point(cloud, i), radius / 3.0f, n) == ss::Status::ok;
    }
  });
  step("key points", [&] {
    std::vector<std::uint32_t> indices;
    std::vector<ss::KeyPoint> centroids;
    checksum += ss::sample_uniform(cloud, radius, indices) == ss::Status::ok;
    checksum += ss::sample_centroids(cloud, radius, centroids) == ss::Status::ok;
  });
  match_poses(cloud);
  describe_all("grid", cloud, ss::GridSearch(cloud, radius), radius);
  if (size % 20 == 0) {
    cloud.width = 20;
    cloud.height = size / 20;
    ss::OrganizedSearch image;
    step("image", [&] { checksum += image.build(cloud) == ss::Status::ok; });
    if (image.status() == ss::Status::ok) describe_all("image", cloud, image, radius);
  }
}

float noise(unsigned i) { return static_cast<float>(i * 2654435761u >> 20) / 4096.0f; }

Cloud sheet(unsigned side) {
  Cloud cloud;
  for (unsigned i = 0; i < side * side; ++i) {
    const float x = 0.01f * (static_cast<float>(i % side) + noise(i)), y = 0.01f * static_cast<float>(i / side);
    cloud.add(x, y, 1.0f + 7.0f * x * x - 3.0f * x * y + 0.002f * noise(i + 1000));
  }
  return cloud;
}

}  // namespace

int main() {
#if defined(__AVX2__)
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2")) return 77;
#endif
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  compute_all("a sheet", sheet(20), 0.05f);

  Cloud holes = sheet(20);
  for (std::size_t i = 0; i < holes.xyz.size(); i += 31) holes.xyz[i] = i % 2 == 0 ? nan : infinity;
  for (std::size_t i = 0; i < holes.intensities.size(); i += 13) holes.intensities[i] = nan;
  compute_all("a sheet with holes", holes, 0.05f);

  Cloud lattice;
  for (int i = 0; i < 343; ++i) {
    const auto at = [&](int k) { return 0.25f * static_cast<float>(k % 7 - 3); };
    lattice.add(at(i), at(i / 7), at(i / 49));
  }
  compute_all("a lattice", lattice, 0.75f);

  Cloud line, heap, few, far, tiny;
  for (int i = 0; i < 60; ++i) line.add(0.01f * static_cast<float>(i), 0.0f, 0.0f);
  for (int i = 0; i < 60; ++i) heap.add(0.5f, 0.25f, 1.0f);
  for (int i = 0; i < 3; ++i) few.add(0.01f * static_cast<float>(i * i), 0.02f * static_cast<float>(i), 0.0f);
  compute_all("a line", line, 0.05f);
  compute_all("a heap in one place", heap, 0.05f);
  compute_all("three points", few, 0.05f);

  far = sheet(20);
  for (int i = 0; i < 20; ++i) far.add(i % 2 == 0 ? 3e38f : -3e38f, 1e38f * static_cast<float>(i % 3), 0.0f);
  may_overflow = true;
  compute_all("a sheet with points at 3e38", far, 0.05f);
  compute_all("a sheet with points at 3e38, of radius 1e18", far, 1e18f);

  may_overflow = false;
  tiny = sheet(20);
  for (float& v : tiny.xyz) v *= 1e-18f;
  compute_all("a sheet of 2e-19", tiny, 5e-20f);

  std::printf("%s (%u)\n", quiet ? "nothing raised" : "raised", checksum);
  return quiet ? 0 : 1;
}
