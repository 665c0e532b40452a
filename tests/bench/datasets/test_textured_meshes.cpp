// Meshes with textures, and the folders of virtual views: what is read and what is refused.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "cube_scan.hpp"
#include "paper/datasets/mesh.hpp"
#include "paper/datasets/mesh_ray_caster.hpp"
#include "paper/datasets/virtual_views.hpp"

namespace test_textured_meshes {
namespace {

using namespace shortshot_bench::datasets;
using namespace cube_scan;

}  // namespace

TEST_CASE("textures are blended between pixel centers, repeat, and have v upwards") {
  const shortshot_bench::ColorImage texture{2, 2, {0, 0, 0, 100, 0, 0, 0, 200, 0, 100, 200, 40}};
  const auto is_at = [&](double u, double v, const Vec3& color) {
    return (texture_color(texture, {u, v}) - color).norm() < 1e-9;
  };
  CHECK(is_at(0.25, 0.75, {0, 0, 0}));
  CHECK(is_at(0.75, 0.75, {100, 0, 0}));
  CHECK(is_at(0.25, 0.25, {0, 200, 0}));
  CHECK(is_at(0.75, 0.25, {100, 200, 40}));
  CHECK(is_at(0.5, 0.5, {50, 100, 10}));
  CHECK(is_at(0.375, 0.75, {25, 0, 0}));
  CHECK(is_at(-0.25, 1.75, {100, 0, 0}));
  for (const double edge : {0.0, 1.0}) CHECK(is_at(edge, edge, {50, 100, 10}));  // with the opposite edges
}

TEST_CASE("rays find the nearest triangle, where they meet it and its texture there") {
  TexturedMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}};
  mesh.triangles = {{{3, 4, 5}, {{{0, 0}, {0, 0}, {0, 0}}}}, {{0, 1, 2}, {{{0.5f, 0}, {1, 0.25f}, {0, 1}}}}};
  const MeshRayCaster caster(mesh);
  const auto hit = caster.nearest_hit({0.2, 0.3, 4}, {0, 0, -2});
  REQUIRE(hit.has_value());
  CHECK(std::fabs(hit->distance - 2.0) < 1e-12);
  CHECK(std::fabs(std::fabs(hit->normal.z()) - 1.0) < 1e-12);
  CHECK((hit->uv - Eigen::Vector2d(0.5 * 0.5 + 0.2, 0.2 * 0.25 + 0.3)).norm() < 1e-12);
  const auto from_behind = caster.nearest_hit({0.2, 0.3, -4}, {0, 0, 1});
  REQUIRE(from_behind.has_value());
  CHECK(std::fabs(from_behind->distance - 3.0) < 1e-12);
  CHECK_FALSE(caster.nearest_hit({0.7, 0.7, 4}, {0, 0, -1}).has_value());
  CHECK_FALSE(caster.nearest_hit({0.2, 0.3, 4}, {0, 0, 1}).has_value());
}

TEST_CASE("what is missing or broken is named") {
  const dataset_test::Folder folder;
  const auto error = [&] { return dataset_test::error_in(folder, [&] { open_virtual_views(folder.path()); }); };
  const auto says = [&](const std::string& begin) {
    INFO(error());
    return error().rfind("SET/" + begin, 0) == 0;
  };
  CHECK(says("classes.csv: "));
  add_set(folder);
  CHECK(error() == "no error");

  folder.add("classes.csv", "object,class\none,cube\n");
  CHECK(says("classes.csv:1: "));
  folder.add("classes.csv", "object,object_class\none,cube\nother\n");
  CHECK(says("classes.csv:3: "));
  folder.add("classes.csv", "object,object_class\nother,box\nthird,cube\n");
  CHECK(says("third/textured.obj: expected a mesh, found no file"));
  folder.add("classes.csv", "object,object_class\nother,box\n");

  const auto says_of_faces = [&](const std::string& faces, const std::string& message) {
    folder.add("other/textured.obj", cube_vertices() + faces);
    return says("other/textured.obj: " + message);
  };
  CHECK(says_of_faces("", "there is no face"));
  CHECK(says_of_faces("f 1/1 2/1 4/1 3/1\n", "there are faces which are not triangles"));
  CHECK(says_of_faces("f 1/1 2/1 3/1\nf 1/1 2/1 9/1\n", "face 2 has a corner without a vertex"));
  CHECK(says_of_faces("f 1/1 2/1 -9/1\n", ""));
  CHECK(says_of_faces("f 1/1 2/1 0/1\n", ""));
  CHECK(says_of_faces("f 1/1 2/1 3/3\n", "face 1 has a corner without a texture coordinate"));
  CHECK(says_of_faces("f 1 2 3\n", "face 1 has a corner without a texture coordinate"));
  CHECK(says_of_faces("usemtl unknown\nf 1/1 2/1 3/1\n", "there are faces without a texture"));
  folder.add("other/textured.obj", cube_vertices(1000.0) + cube_faces());
  CHECK(says("other/textured.obj: expected an object smaller than"));
  add_cube(folder, "other");

  folder.add("other/textured.mtl", "newmtl paper\nKd 1 1 1\n");
  CHECK(says("other/textured.obj: there are faces without a texture"));
  folder.remove("other/textured.mtl");
  CHECK(says("other/textured.obj: there are faces without a texture. "));
  CHECK(error().find("textured.mtl") != std::string::npos);
  add_cube(folder, "other");
  folder.add("other/texture.png", texture_image().substr(0, 40));
  CHECK(says("other/texture.png: "));
  folder.remove("other/texture.png");
  CHECK(says("other/texture.png: "));
}

TEST_CASE("faces of two textures are refused") {
  const dataset_test::Folder folder;
  add_set(folder);
  folder.add("one/textured.mtl", "newmtl paper\nmap_Kd texture.png\nnewmtl metal\nmap_Kd metal.png\n");
  folder.add("one/textured.obj", cube_vertices() + cube_faces() + "usemtl metal\nf 1/1 2/1 3/1\n");
  CHECK(dataset_test::error_in(folder, [&] { open_virtual_views(folder.path()); }) ==
        "SET/one/textured.obj: the faces have more than one texture");
}

}  // namespace test_textured_meshes
