// A generated depth image of a curved, colored surface. Every number is made of integers and powers of two, so that it
// has the same bits on all machines, whatever their compilers do with floating point.
#pragma once

#include "shortshot.hpp"

namespace patch {

inline constexpr int width = 50;
inline constexpr int height = 40;
inline constexpr std::size_t points = 2000;

struct Memory {
  float xyz[points][3];
  unsigned char rgb[points][3];
  shortshot::SurfaceNormal normals[points];
};

/// Without normals. Pixel p is point p * step modulo their number: an image if step is 1, else all over the place.
inline shortshot::CloudView make(Memory& memory, int step = 1) {
  std::uint32_t random = 1;
  const auto noise = [&random](int steps) {  // 0 to steps - 1
    random = random * 1664525u + 1013904223u;
    return static_cast<int>((random >> 16) % static_cast<std::uint32_t>(steps));
  };
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int i = (v * width + u) * step % static_cast<int>(points);
      const int column = u - width / 2;
      const int row = v - height / 2;
      const int depth = 16384 + 6 * column * column - 4 * column * row + 9 * row * row + 40 * row + noise(64);
      const float z = static_cast<float>(depth) * (1.0f / 16384.0f);
      memory.xyz[i][0] = static_cast<float>(column * depth) * (1.0f / 1048576.0f);  // a focal length of 64 pixels
      memory.xyz[i][1] = static_cast<float>(row * depth) * (1.0f / 1048576.0f);
      memory.xyz[i][2] = z;
      memory.rgb[i][0] = static_cast<unsigned char>(u * 4 + noise(32));
      memory.rgb[i][1] = static_cast<unsigned char>(v * 5 + noise(32));
      memory.rgb[i][2] = static_cast<unsigned char>((u / 8 + v / 8) % 2 * 128 + noise(64));
    }
  }
  const shortshot::CloudView cloud = shortshot::view_xyz_rgb(memory.xyz[0], memory.rgb[0], points);
  return shortshot::organized(cloud, width, height);
}

/// The same with normals, by the library; NaN where it finds none.
template <class Workspace>
shortshot::CloudView with_normals(const shortshot::CloudView& cloud, float radius, Memory& memory,
                                  Workspace& workspace) {
  const shortshot::BruteSearch search{cloud};
  for (std::size_t i = 0; i < cloud.size; ++i) {
    auto n = shortshot::neighborhood_in(workspace);
    shortshot::Status status = search.gather(shortshot::point(cloud, i), radius, n);
    if (status == shortshot::Status::ok) status = shortshot::estimate_normal(n, radius, memory.normals[i]);
    if (status != shortshot::Status::ok) memory.normals[i] = shortshot::SurfaceNormal{__builtin_nanf(""), 0.0f, 0.0f};
  }
  return shortshot::with_normals(cloud, memory.normals);
}

}  // namespace patch
