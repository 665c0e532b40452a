// What chooses lanes for itself, for check_dispatch.sh.
#include <cstdint>
#include <vector>

#include "shortshot/shortshot.hpp"

using namespace shortshot;

template <class D>
Status described(const CloudView& cloud, const std::vector<std::uint32_t>& keypoints, Features<D>& out) {
  const GridSearch grid(cloud, 0.04f);
  return extract(cloud, grid, keypoints, 0.04f, out);
}

Status describe_all(const CloudView& cloud, const std::vector<std::uint32_t>& keypoints) {
  Features<Scsh336> plain;
  Features<ShapeColor95> soft;
  Features<Shot352> normals;
  const Status statuses[] = {described(cloud, keypoints, plain), described(cloud, keypoints, soft),
                             described(cloud, keypoints, normals)};
  return statuses[0] == Status::ok ? statuses[1] : statuses[2];
}

#if defined(LEAK)
[[gnu::target("avx2")]] void leak(float* p) {
  for (int i = 0; i < 8; ++i) p[i] += 1.0f;
}
#endif
