#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

using Kind = FaceTag::Kind;

Mesh through(const Mesh& mesh, const std::string& name) {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / name);
  return read_mesh(folder / name);
}

std::string bytes_written(const Mesh& mesh, const std::string& name) {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / name);
  return bytes_of(folder / name);
}

/// A box in triangles, with a value of each kind at every vertex.
Mesh box_of_triangles() {
  Mesh mesh = make_box({1, 2, 3});
  const Triangulation triangulation = triangulate(mesh);
  mesh.face_starts = {0};
  mesh.face_vertices.clear();
  for (Index t = 0; t < triangulation.triangles.rows(); ++t) {
    for (const int vertex : triangulation.triangles.row(t)) mesh.face_vertices.push_back(vertex);
    mesh.face_starts.push_back(static_cast<int>(mesh.face_vertices.size()));
  }
  mesh.normals.values =
      (mesh.positions.rowwise() - mesh.positions.colwise().mean()).rowwise().normalized();
  mesh.texcoords.values = 0.3 * mesh.positions.leftCols<2>();
  mesh.colors.values.setConstant(8, 4, 0.6);
  mesh.colors.values.col(0).setLinSpaced(0.0, 1.0);
  return mesh;
}

TEST(GltfWriter, AllComesBack) {
  Mesh mesh = box_of_triangles();
  mesh.tags = {
      {Kind::object, "lower \"half\"\n", 0}, {Kind::material, "red", 0}, {Kind::material, "", 6}};
  for (const char* name : {"a.glb", "a.gltf"}) {
    const Mesh back = through(mesh, name);
    expect_same_mesh(mesh, back, 1e-6);
    EXPECT_EQ(bytes_written(back, name), bytes_written(through(back, name), name));
  }
}

TEST(GltfWriter, ByteColorsComeBackExactly) {
  Mesh mesh = box_of_triangles();
  for (Index i = 0; i < mesh.colors.values.size(); ++i)
    mesh.colors.values.data()[i] = static_cast<double>((37 * i) % 256) / 255;
  EXPECT_EQ(through(mesh, "a.glb").colors.values.leftCols(3), mesh.colors.values.leftCols(3));
}

TEST(GltfWriter, FarFromTheOriginNothingIsLost) {
  Mesh mesh = box_of_triangles();
  const Points near = mesh.positions;
  mesh.positions.rowwise() += Eigen::RowVector3d(4.5e6, 5e5, -3e6);
  const Mesh back = through(mesh, "a.glb");
  EXPECT_LE((back.positions - mesh.positions).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(bytes_written(back, "a.glb"), bytes_written(through(back, "a.glb"), "a.glb"));
}

TEST(GltfWriter, ObjectsHaveVerticesOfTheirOwn) {
  Mesh mesh = box_of_triangles();
  const Mesh other = box_of_triangles();
  Points both(16, 3);
  both << mesh.positions, other.positions.array() + 5;
  mesh.positions = both;
  mesh.normals = {};
  mesh.texcoords = {};
  mesh.colors = {};
  for (const int vertex : other.face_vertices) mesh.face_vertices.push_back(vertex + 8);
  for (int face = 13; face <= 24; ++face) mesh.face_starts.push_back(3 * face);
  mesh.tags = {{Kind::object, "left", 0}, {Kind::object, "right", 12}};
  const Mesh back = through(mesh, "a.glb");
  expect_same_mesh(mesh, back, 1e-7);
  // Objects that share vertices cannot have their own: all stay in their order instead.
  mesh.face_vertices.back() = 0;
  const Mesh joined = through(mesh, "a.glb");
  expect_same_shape(mesh, joined, 1e-7);
  for (const FaceTag& tag : joined.tags) EXPECT_NE(tag.name, "left");
  EXPECT_EQ(left_out_by("a.glb", mesh).size(), 1u);
}

TEST(GltfWriter, CornersWithValuesOfTheirOwnAreDoubledBehindTheOthers) {
  Mesh mesh = box_of_triangles();
  mesh.normals = {};
  mesh.colors = {};
  mesh.texcoords.values.setZero(2, 2);
  mesh.texcoords.values.row(1) << 0.25, 0.5;
  for (int corner = 0; corner < 36; ++corner) mesh.texcoords.corners.push_back(corner < 18 ? 0 : 1);
  const Mesh back = through(mesh, "a.glb");
  ASSERT_GT(back.positions.rows(), 8);
  EXPECT_EQ(back.positions.topRows(8), mesh.positions);
  EXPECT_EQ(corner_values(back, back.texcoords), corner_values(mesh, mesh.texcoords));
  for (std::size_t corner = 0; corner < 36; ++corner)
    EXPECT_EQ(back.positions.row(back.face_vertices[corner]),
              mesh.positions.row(mesh.face_vertices[corner]));
}

TEST(GltfWriter, NamesOfAnyBytesDoNoHarmInObj) {
  Mesh mesh = box_of_triangles();
  mesh.normals = {};
  mesh.texcoords = {};
  mesh.colors = {};
  for (const char* name : {"a\nv 9 9 9\nf 1 2 9", "line\\", "#x", "a #b", "\r", " "}) {
    mesh.tags = {{Kind::object, name, 0}, {Kind::material, name, 3}};
    const Mesh back = through(mesh, "a.obj");
    expect_same_shape(mesh, back, 0);
    EXPECT_EQ(back.tags.size(), 2u) << name;
    EXPECT_EQ(left_out_by("a.obj", mesh).size(), 1u) << name;
  }
}

TEST(GltfWriter, PointClouds) {
  Mesh cloud = points_of(box_of_triangles());
  expect_same_mesh(cloud, through(cloud, "a.glb"), 1e-6);
}

TEST(GltfWriter, PolygonsBecomeTrianglesAndNamesAnyBytes) {
  Mesh mesh = make_box({1, 2, 3});
  mesh.tags = {{Kind::object, "\xff\xfe", 0}};
  const Mesh back = through(mesh, "a.glb");
  EXPECT_EQ(back.positions, mesh.positions);
  EXPECT_EQ(back.face_count(), 12);
}

}  // namespace
}  // namespace supple
