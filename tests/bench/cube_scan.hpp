// For the tests of the virtual views: a scanned object made up, a cube whose top is red and whose sides are blue.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>

#include "dataset_samples.hpp"

namespace cube_scan {

using Vec3 = Eigen::Vector3d;

constexpr double side = 0.1;
inline const Vec3 cube_center(0.02, -0.03, 0.5 * side);
constexpr std::array<std::array<int, 3>, 2> colors{{{200, 40, 60}, {50, 80, 180}}};  // of the top and of the sides

// Lower left like the top of the cube, upper right like its sides, the rest black.
inline std::string texture_image() {
  constexpr std::size_t size = 16;
  std::string samples(3 * size * size, '\0');
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column < size; ++column) {
      const bool is_left = column < size / 2;
      if (is_left != (row >= size / 2)) continue;
      for (std::size_t i = 0; i < 3; ++i)
        samples[3 * (row * size + column) + i] = static_cast<char>(colors[is_left ? 0 : 1][i]);
    }
  }
  return dataset_test::png(samples, size, size, 8, dataset_test::PngColor::rgb);
}

inline std::string cube_vertices(double scale = 1.0) {
  std::string text = "mtllib textured.mtl\n";
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = scale * (cube_center + side * Vec3((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5));
    text +=
        "v " + std::to_string(corner.x()) + ' ' + std::to_string(corner.y()) + ' ' + std::to_string(corner.z()) + '\n';
  }
  return text + "vt 0.25 0.25\nvt 0.75 0.75\nusemtl paper\n";
}

inline std::string cube_faces() {
  std::string text;
  for (const char* const quad : {"1 2 4 3", "5 6 8 7", "1 2 6 5", "3 4 8 7", "1 3 7 5", "2 4 8 6"}) {
    const std::string uv = quad[0] == '5' ? "/1 " : "/2 ";
    const auto corner = [&](std::size_t i) { return quad[2 * i] + uv; };
    text += "f " + corner(0) + corner(1) + corner(2) + "\nf " + corner(0) + corner(2) + corner(3) + '\n';
  }
  return text;
}

inline void add_cube(const dataset_test::Folder& folder, const std::string& name, double scale = 1.0) {
  folder.add(name + "/textured.obj", cube_vertices(scale) + cube_faces());
  folder.add(name + "/textured.mtl", "newmtl paper\nmap_Kd texture.png\n");
  folder.add(name + "/texture.png", texture_image());
}

// Two cubes, one twice as wide as the other: 48 views.
inline void add_set(const dataset_test::Folder& folder) {
  folder.add("classes.csv", "object,unit,object_class\none,m,cube\nother,m,box\n");
  add_cube(folder, "one");
  add_cube(folder, "other", 0.5);
}

}  // namespace cube_scan
