#include "paper/datasets/mesh.hpp"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>

#include "tools/labels/dataset_files.hpp"

namespace shortshot_bench::datasets {
namespace {

// tinyobjloader's messages are lines.
std::string on_one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

tinyobj::ObjReader parse_obj(const std::string& path) {
  require_file(path, "a mesh");
  tinyobj::ObjReaderConfig config;
  config.triangulate = false;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromFile(path, config)) throw InputError::about(path, on_one_line(reader.Error()));
  return reader;
}

template <int Size>
std::vector<Eigen::Matrix<float, Size, 1>> finite_rows(const std::vector<float>& values, const std::string& path) {
  std::vector<Eigen::Matrix<float, Size, 1>> rows;
  for (std::size_t first = 0; first + Size <= values.size(); first += Size) {
    rows.emplace_back(&values[first]);
    if (!rows.back().allFinite()) throw InputError::about(path, "there are coordinates which are not finite");
  }
  return rows;
}

// The parser checks no index. Faces count from 1 in the message.
std::size_t checked_index(int index, std::size_t count, const char* what, const std::string& path, std::size_t face) {
  if (index < 0 || static_cast<std::size_t>(index) >= count) {
    throw InputError::about(path, "face " + std::to_string(face) + " has a corner without " + what);
  }
  return static_cast<std::size_t>(index);
}

void add_triangles(const tinyobj::mesh_t& faces, const std::vector<Eigen::Vector2f>& uvs, const std::string& path,
                   TexturedMesh& mesh) {
  if (faces.indices.size() != 3 * faces.num_face_vertices.size()) {
    throw InputError::about(path, "there are faces which are not triangles");
  }
  for (std::size_t first = 0; first < faces.indices.size(); first += 3) {
    const std::size_t face = mesh.triangles.size() + 1;
    MeshTriangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const tinyobj::index_t& index = faces.indices[first + corner];
      triangle.vertices[corner] =
          static_cast<std::uint32_t>(checked_index(index.vertex_index, mesh.vertices.size(), "a vertex", path, face));
      triangle.uvs[corner] = uvs[checked_index(index.texcoord_index, uvs.size(), "a texture coordinate", path, face)];
    }
    mesh.triangles.push_back(triangle);
  }
}

// The one texture of all faces, as the material file names it.
std::string texture_name(const tinyobj::ObjReader& reader, const std::string& path) {
  std::string name;
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    for (const int material : shape.mesh.material_ids) {
      const std::string& found =
          material < 0 ? std::string() : reader.GetMaterials()[static_cast<std::size_t>(material)].diffuse_texname;
      if (found.empty()) {
        throw InputError::about(path, "there are faces without a texture. " + on_one_line(reader.Warning()));
      }
      if (!name.empty() && found != name) throw InputError::about(path, "the faces have more than one texture");
      name = found;
    }
  }
  return name;
}

}  // namespace

TexturedMesh read_textured_mesh(const std::string& path) {
  const tinyobj::ObjReader reader = parse_obj(path);
  TexturedMesh mesh;
  mesh.vertices = finite_rows<3>(reader.GetAttrib().vertices, path);
  const auto uvs = finite_rows<2>(reader.GetAttrib().texcoords, path);
  for (const tinyobj::shape_t& shape : reader.GetShapes()) add_triangles(shape.mesh, uvs, path, mesh);
  if (mesh.triangles.empty()) throw InputError::about(path, "there is no face");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  mesh.texture = read_color_image((folder / texture_name(reader, path)).string());
  return mesh;
}

Eigen::Vector3d texture_color(const ColorImage& texture, const Eigen::Vector2d& uv) {
  const double x = (uv.x() - std::floor(uv.x())) * static_cast<double>(texture.width) - 0.5;
  const double y = (1.0 - (uv.y() - std::floor(uv.y()))) * static_cast<double>(texture.height) - 0.5;
  const double left = std::floor(x);
  const double top = std::floor(y);
  const auto wrapped = [](double index, std::size_t size) {  // for an index from -1 to the size
    return static_cast<std::size_t>(index + static_cast<double>(size)) % size;
  };
  const auto pixel = [&](double column, double row) {
    const std::size_t i = wrapped(row, texture.height) * texture.width + wrapped(column, texture.width);
    return Eigen::Vector3d(texture.rgb[3 * i], texture.rgb[3 * i + 1], texture.rgb[3 * i + 2]);
  };
  const auto blended_row = [&](double row) -> Eigen::Vector3d {
    return (left + 1.0 - x) * pixel(left, row) + (x - left) * pixel(left + 1.0, row);
  };
  return (top + 1.0 - y) * blended_row(top) + (y - top) * blended_row(top + 1.0);
}

}  // namespace shortshot_bench::datasets
