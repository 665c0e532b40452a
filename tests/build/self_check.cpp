// self_check [upward | downward | toward_zero | flush]: prints hashes of what the library computes, and says whether
// they are promised to be the same everywhere: exit code 0, 1, or 77 without the CPU. Compiled with flags of all kinds;
// without the hashes (CHECK_ALONE) where nothing is promised.
#include <cfenv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#if defined(CHECK_ALONE)
#include <shortshot/self_check.hpp>
#else
#include <shortshot/shortshot.hpp>
#endif

namespace {

namespace ss = shortshot;

#if defined(CHECK_ALONE)
std::uint64_t hash_of_library(float) { return 0; }
#else
struct Hash {
  std::uint64_t value = 14695981039346656037u;
  template <class T>
  void add(const std::vector<T>& values) {
    std::vector<unsigned char> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    for (const unsigned char byte : bytes) value = (value ^ byte) * 1099511628211u;
  }
};

struct Cloud {
  std::vector<float> xyz;
  std::vector<unsigned char> rgb;
};

// Coordinates are whole numbers times `step`, a power of two: no flag changes the cloud.
Cloud wavy_sheet(int side, float step) {
  Cloud cloud;
  for (int i = 0; i < side * side; ++i) {
    const int x = 64 * (i % side) + (i * 7) % 29;
    const int y = 64 * (i / side) + (i * 5) % 31;
    const int z = x * x / 4000 - x * y / 9000 + i % 5;
    for (const int v : {x, y, z}) cloud.xyz.push_back(static_cast<float>(v) * step);
    for (const int v : {i * 4, i / side * 3, i * 11}) cloud.rgb.push_back(static_cast<unsigned char>(v & 255));
  }
  return cloud;
}

template <class D>
void add_features(Hash& hash, const ss::CloudView& cloud, const ss::GridSearch& search, float radius) {
  std::vector<int> keypoints;
  for (int i = 0; i < static_cast<int>(cloud.size); i += 17) keypoints.push_back(i);
  ss::Features<D> features;
  if (ss::extract(cloud, search, keypoints, radius, features) != ss::Status::ok) std::printf("no features\n");
  hash.add(features.values);
  hash.add(features.frames);
}

std::uint64_t hash_of_library(float step) {
  Hash hash;
  const Cloud sheet = wavy_sheet(32, step);
  const float radius = 400.0f * step;
  ss::CloudView cloud = ss::view_xyz_rgb(sheet.xyz.data(), sheet.rgb.data(), sheet.rgb.size() / 3);
  const ss::GridSearch search(cloud, radius);
  std::vector<ss::SurfaceNormal> normals;
  const ss::Status status = ss::estimate_normals(cloud, search, radius, ss::Viewpoint::towards({0, 0, 1}), normals);
  if (status != ss::Status::ok) std::printf("no normals\n");
  hash.add(normals);
  cloud = ss::with_normals(cloud, normals.data());
  add_features<ss::Scsh336>(hash, cloud, search, radius);
  add_features<ss::Cshot1344>(hash, cloud, search, radius);
  add_features<ss::ShapeColor95>(hash, cloud, search, radius);
  return hash.value;
}
#endif

bool set_up(const std::string& mode) {
#if defined(FE_UPWARD) && defined(FE_DOWNWARD) && defined(FE_TOWARDZERO)
  if (mode == "upward") return std::fesetround(FE_UPWARD) == 0;
  if (mode == "downward") return std::fesetround(FE_DOWNWARD) == 0;
  if (mode == "toward_zero") return std::fesetround(FE_TOWARDZERO) == 0;
#endif
#if defined(__SSE2__)
  if (mode == "flush") _mm_setcsr(_mm_getcsr() | 0x8040u);  // denormal operands, and results, are zero
  if (mode == "flush") return true;
#endif
  return mode.empty();
}

}  // namespace

int main(int argc, char** argv) {
#if defined(__AVX__)  // as -mfma implies, whatever else is undefined
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2")) return 77;
#endif
  if (!set_up(argc > 1 ? argv[1] : "")) return 77;
  const bool promised = ss::self_check();
  std::printf("bits %016llx %016llx\n", static_cast<unsigned long long>(hash_of_library(0x1p-12f)),
              static_cast<unsigned long long>(hash_of_library(0x1p-70f)));
  return promised ? 0 : 1;
}
