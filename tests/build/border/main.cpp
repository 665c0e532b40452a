// A program of two libraries with different flags: what one makes, the other uses, and both give the same bits.
#include <cstdio>
#include <cstring>

#include "library.hpp"

namespace {

using border::D;
using border::Library;
using namespace shortshot;

struct ColoredPoint {
  float x, y, z;
  unsigned char r, g, b;
};

std::vector<ColoredPoint> sheet() {
  std::vector<ColoredPoint> points;
  for (int i = 0; i < 120; ++i) {
    for (int k = 0; k < 120; ++k) {
      const float x = 0.003f * static_cast<float>(i - 60);
      const float y = 0.003f * static_cast<float>(k - 60);
      points.push_back({x, y, 1.0f + 4.0f * x * x * y - 2.0f * y * y, static_cast<unsigned char>(i),
                        static_cast<unsigned char>(2 * k), static_cast<unsigned char>(i * k / 64)});
    }
  }
  return points;
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

int failures = 0;
void expect(bool holds, const char* what) {
  std::printf("%s: %s\n", what, holds ? "yes" : "NO");
  failures += holds ? 0 : 1;
}

/// What `maker` makes, `user` uses.
void exchange(const Library& maker, const Library& user, const CloudView& cloud) {
  Features<D> made, own;
  const Support support = user.support(Radius(0.05f));
  expect(maker.describe(cloud, support, made) == Status::ok && user.describe(cloud, support, own) == Status::ok,
         "rows");
  expect(made.size() > 50 && same(made.values, own.values), "the same bits of descriptors");
  Features<D> copy = made;  // whoever's copy it is
  made = {};

  std::vector<SurfaceNormal> normals, others;
  const Viewpoint camera = Viewpoint::towards({0.0f, 0.0f, 0.0f});
  expect(maker.normals(cloud, camera, normals) == Status::ok && user.normals(cloud, camera, others) == Status::ok &&
             same(normals, others),
         "the same bits of normals");

  std::vector<MatchedPair> pairs;
  expect(user.match(copy, own, pairs) == Status::ok && pairs.size() > 50, "matches");
  std::vector<PointPair> points;
  for (const MatchedPair& pair : pairs) {
    points.push_back({copy.keypoints[pair.source].position, own.keypoints[pair.target].position});
  }
  Pose pose{}, again{};
  std::vector<std::uint32_t> inliers;
  expect(user.pose(points, pose, inliers) == Status::ok && maker.pose(points, again, inliers) == Status::ok &&
             std::memcmp(&pose, &again, sizeof pose) == 0,
         "the same bits of poses");

  Recognizer trained;
  std::vector<Hypothesis> objects;
  expect(maker.train(trained, copy) == Status::ok && user.recognize(trained, own, objects) == Status::ok &&
             objects.size() == 1,
         "a recognizer of the other's");
  std::vector<std::uint8_t> bytes;
  Recognizer loaded;
  expect(user.save(trained, bytes) == Status::ok && maker.load(bytes, loaded) == Status::ok &&
             maker.train(loaded, own) == Status::ok && loaded.codeword_count() == 2 * trained.codeword_count(),
         "a model of the other's");
}

}  // namespace

int main() {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::puts("skipped: this CPU has no AVX2");
    return 77;
  }
  const std::vector<ColoredPoint> points = sheet();
  const CloudView cloud = view_of(points);
  exchange(border::plain(), border::small_avx2(), cloud);
  exchange(border::small_avx2(), border::plain(), cloud);
  return failures == 0 ? 0 : 1;
}
