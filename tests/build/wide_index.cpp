// Key points' indices of 64 bits, for a compiler whose std::size_t has 32: none of them wraps around.
#include <cstdint>
#include <cstdio>
#include <shortshot/shortshot.hpp>
#include <vector>

namespace ss = shortshot;

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::printf("not so: %s\n", what);
  ++failures;
}

}  // namespace

int main() {
  static_assert(sizeof(std::size_t) == 4, "compiled with -m32, or for a machine of 32 bits");
  std::vector<float> xyz;
  for (int i = 0; i < 400; ++i) {
    const float x = 0.004f * static_cast<float>(i % 20), y = 0.004f * static_cast<float>(i / 20);
    xyz.insert(xyz.end(), {x, y, 1.0f + 9.0f * x * x * y});
  }
  const ss::CloudView cloud = ss::view_xyz(xyz.data(), 400);
  const ss::BruteSearch search(cloud);
  constexpr std::int64_t beyond = std::int64_t{1} << 32;
  const std::vector<std::int64_t> keypoints{210, beyond, beyond + 210, -1, -beyond, 210 - beyond, INT64_MIN, INT64_MAX};
  ss::Features<ss::Ssh32> features;
  expect(ss::extract(cloud, search, keypoints, 0.03f, features) == ss::Status::ok, "extract() is ok");
  static ss::Workspace<512> workspace;
  float out[ss::Ssh32::size];
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const ss::Status right = i == 0 ? ss::Status::ok : ss::Status::bad_keypoint;
    expect(features.status[i] == right, "extract() describes index 210 and no other");
    expect(ss::describe_at<ss::Ssh32>(cloud, search, keypoints[i], 0.03f, workspace, out) == right,
           "describe_at() describes index 210 and no other");
    const auto whole = static_cast<std::uint64_t>(keypoints[i]);
    expect(ss::describe_at<ss::Ssh32>(cloud, search, whole, 0.03f, workspace, out) == right,
           "describe_at() takes unsigned indices, too");
  }
  return failures;
}
