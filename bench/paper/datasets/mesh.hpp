// A triangle mesh with a texture, as 3-D scanners make it: OBJ, MTL and an image.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/input/image.hpp"

namespace shortshot_bench::datasets {

struct MeshTriangle {
  std::array<std::uint32_t, 3> vertices{};
  std::array<Eigen::Vector2f, 3> uvs;  // the texture coordinates of the corners
};

struct TexturedMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<MeshTriangle> triangles;  // at least one; all of their vertices exist
  ColorImage texture;
};

/// Reads an OBJ file with the material file and the image that it names, which must be one and the same for all of
/// its faces. Vertex normals are not used. Throws InputError for a file that is missing or broken.
TexturedMesh read_textured_mesh(const std::string& path);

/// 0 to 255 for each channel, bilinear between the pixels' centers. The texture repeats outside of [0, 1]; v counts
/// from the bottom, as OBJ files have it.
Eigen::Vector3d texture_color(const ColorImage& texture, const Eigen::Vector2d& uv);

}  // namespace shortshot_bench::datasets
