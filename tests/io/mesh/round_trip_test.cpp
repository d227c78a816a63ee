#include <cmath>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

constexpr double float_rounding = 1e-7;

/// Values that no short decimal holds.
template <int Columns>
void fill(Attribute<Columns>& attribute, Index rows, double scale) {
  attribute.values.resize(rows, Columns);
  for (Index i = 0; i < attribute.values.size(); ++i)
    attribute.values.data()[i] = scale * (0.5 + 0.5 * std::sin(1.7 * static_cast<double>(i)));
}

/// A bar of quads with normals, texture coordinates and colors of every vertex.
Mesh bar_with_values() {
  Mesh mesh = make_quad_bar({1, 2, 0.3}, {2, 3, 2});
  fill(mesh.normals, mesh.positions.rows(), 1);
  fill(mesh.texcoords, mesh.positions.rows(), 1);
  fill(mesh.colors, mesh.positions.rows(), 1);
  return mesh;
}

/// A box whose corners have values of their own, some none; with groups and materials.
Mesh box_with_corner_values() {
  Mesh mesh = make_box({1, 2, 3});
  fill(mesh.normals, 7, 1);
  fill(mesh.texcoords, 11, 1);
  for (int corner = 0; corner < 24; ++corner) {
    mesh.normals.corners.push_back(corner % 7);
    mesh.texcoords.corners.push_back((corner * 5) % 11);
  }
  using Kind = FaceTag::Kind;
  mesh.tags = {{Kind::object, "box of mine", 0},
               {Kind::group, "base side", 0},
               {Kind::material, "M\xc3\xa4rz", 0},
               {Kind::smoothing, "off", 2},
               {Kind::group, "", 2},
               {Kind::material, "red", 5},
               {Kind::group, "after all", 6}};
  mesh.material_libraries = {"a b.mtl", "c.mtl"};
  return mesh;
}

Mesh without_faces(Mesh mesh) {
  mesh.face_starts = {0};
  mesh.face_vertices.clear();
  return mesh;
}

/// What comes back from a file of that name.
Mesh through(const Mesh& mesh, const std::string& name) {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / name);
  return read_mesh(folder / name);
}

/// Write, read, write again: the same bytes.
void expect_stable_bytes(const Mesh& mesh, const std::string& name) {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / name);
  const std::string first = bytes_of(folder / name);
  write_mesh(read_mesh(folder / name), folder / name);
  EXPECT_TRUE(first == bytes_of(folder / name)) << name;
}

TEST(RoundTrip, ShapesInEveryFormat) {
  for (const Mesh& mesh : {make_box({1, 1, 1}), make_bar({1, 2, 3}, {4, 2, 3}),
                           make_icosphere(0.7, 2), make_torus(2, 0.5, 12, 7)})
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.PLY"}) {
      const Mesh back = through(mesh, name);
      expect_same_mesh(mesh, back, float_rounding);
      EXPECT_TRUE(back.notes.empty()) << name;
      expect_stable_bytes(mesh, name);
    }
}

TEST(RoundTrip, TextFormatsKeepDoubles) {
  Mesh mesh = make_icosphere(1.0 / 3, 2);
  mesh.positions.row(0) << 1e-300, -1e300, 0.1 + 0.2;
  mesh.positions.row(1) << 5e-324, -0.0, 123456789.123456789;
  for (const char* name : {"a.obj", "a.off"})
    EXPECT_EQ(mesh.positions, through(mesh, name).positions) << name;
}

TEST(RoundTrip, VertexValues) {
  const Mesh mesh = bar_with_values();
  for (const char* name : {"a.ply", "a.off"}) {
    expect_same_mesh(mesh, through(mesh, name), float_rounding);
    expect_stable_bytes(mesh, name);
  }
  Mesh opaque = mesh;
  opaque.colors.values.col(3).setOnes();
  expect_same_mesh(opaque, through(opaque, "a.obj"), 0);
  EXPECT_FALSE(through(opaque, "a.obj").normals.per_corner());
  expect_stable_bytes(opaque, "a.obj");
}

TEST(RoundTrip, ColorsOfBytesStayBytes) {
  Mesh mesh = make_box({1, 1, 1});
  mesh.colors.values.resize(8, 4);
  for (Index i = 0; i < 32; ++i) mesh.colors.values.data()[i] = static_cast<double>(8 * i) / 255;
  EXPECT_EQ(through(mesh, "a.ply").colors.values, mesh.colors.values);
  const TemporaryFolder folder;
  write_mesh(mesh, folder / "a.ply");
  EXPECT_NE(bytes_of(folder / "a.ply").find("property uchar alpha"), std::string::npos);
}

TEST(RoundTrip, CornerValuesGroupsAndMaterialsInObj) {
  Mesh mesh = box_with_corner_values();
  expect_same_mesh(mesh, through(mesh, "a.obj"), 0);
  expect_stable_bytes(mesh, "a.obj");
  mesh.normals.corners[3] = -1;
  mesh.texcoords.corners[0] = mesh.texcoords.corners[3] = -1;
  expect_same_mesh(mesh, through(mesh, "a.obj"), 0);
  EXPECT_EQ(through(mesh, "a.obj").texcoords.values, mesh.texcoords.values);
}

TEST(RoundTrip, CornerTextureInPly) {
  Mesh mesh = box_with_corner_values();
  const Mesh back = through(mesh, "a.ply");
  expect_same_shape(mesh, back, float_rounding);
  EXPECT_LE(
      relative_difference(corner_values(mesh, mesh.texcoords), corner_values(back, back.texcoords)),
      float_rounding);
  expect_stable_bytes(mesh, "a.ply");
  EXPECT_EQ(left_out_by("a.ply", mesh),
            (std::vector<std::string>{
                "ply cannot hold the names of objects and materials", "ply cannot hold groups",
                "ply cannot hold material libraries", "ply cannot hold normals per corner"}));
}

TEST(RoundTrip, PointClouds) {
  Mesh cloud = without_faces(bar_with_values());
  for (const char* name : {"a.ply", "a.off"})
    expect_same_mesh(cloud, through(cloud, name), float_rounding);
  cloud.colors.values.col(3).setOnes();
  expect_same_mesh(cloud, through(cloud, "a.obj"), 0);
  const TemporaryFolder folder;
  const std::string message = message_of<OutputError>([&] { write_mesh(cloud, folder / "a.stl"); });
  EXPECT_NE(message.find("point cloud"), std::string::npos) << message;
  EXPECT_EQ(folder.entries(), 0);
}

/// Colors of bytes, as formats for points have them.
Mesh scan() {
  Mesh cloud = without_faces(bar_with_values());
  cloud.texcoords = {};
  cloud.colors.values = (255 * cloud.colors.values).array().round() / 255;
  cloud.colors.values.col(3).setOnes();
  return cloud;
}

TEST(RoundTrip, FormatsForPoints) {
  Mesh cloud = scan();
  for (const char* name : {"a.pcd", "a.xyz", "a.ply"}) {
    const Mesh back = through(cloud, name);
    expect_same_mesh(cloud, back, float_rounding);
    if (name != std::string_view("a.pcd")) {
      EXPECT_EQ(cloud.positions, back.positions) << name;  // to the last bit
    }
    const bool says_that_colors_ran_to_255 = name == std::string_view("a.xyz");
    EXPECT_EQ(back.notes.size(), says_that_colors_ran_to_255 ? 1 : 0) << name;
    expect_stable_bytes(cloud, name);
  }
  cloud.radii = Eigen::VectorXd::LinSpaced(cloud.positions.rows(), 0.1, 0.3);
  for (const char* name : {"a.pcd", "a.ply"}) {
    expect_same_mesh(cloud, through(cloud, name), float_rounding);
    expect_stable_bytes(cloud, name);
  }
  cloud.radii = {};
  cloud.colors = {};
  expect_same_mesh(cloud, through(cloud, "a.pwn"), 0);
  expect_stable_bytes(cloud, "a.pwn");
  cloud.normals = {};
  for (const char* name : {"a.ply", "a.xyz"}) expect_same_mesh(cloud, through(cloud, name), 0);
}

TEST(RoundTrip, ScansFarFromTheOriginKeepDoubles) {
  Mesh cloud = scan();
  cloud.positions.rowwise() += Eigen::RowVector3d(596612.125, 243578.5, 73.03);
  for (const char* name : {"a.pcd", "a.xyz", "a.ply", "a.pwn"})
    EXPECT_EQ(through(cloud, name).positions, cloud.positions) << name;
}

TEST(RoundTrip, DarkAndFineColorsInXyz) {
  Mesh cloud = scan();
  for (const double brightest : {1.0 / 255, 0.0, 0.123}) {
    cloud.colors.values.leftCols<3>().setConstant(brightest);
    EXPECT_LE(relative_difference(through(cloud, "a.xyz").colors.values, cloud.colors.values),
              1e-15);
  }
}

TEST(RoundTrip, PcdKeepsAlpha) {
  Mesh cloud = scan();
  cloud.colors.values.col(3).setConstant(51.0 / 255);
  expect_same_mesh(cloud, through(cloud, "a.pcd"), float_rounding);
}

TEST(WriteMesh, SaysWhatFormatsForPointsLeaveOut) {
  Mesh mesh = bar_with_values();
  mesh.texcoords = {};
  EXPECT_EQ(left_out_by("a.pwn", mesh),
            (std::vector<std::string>{"pwn cannot hold faces: only the vertices are written",
                                      "pwn cannot hold colors", "pwn cannot hold alpha"}));
  EXPECT_EQ(left_out_by("a.pcd", mesh),
            (std::vector<std::string>{"pcd cannot hold faces: only the vertices are written",
                                      "pcd cannot hold colors finer than bytes: rounded"}));
  Mesh cloud = scan();
  cloud.radii.setOnes(cloud.positions.rows());
  EXPECT_EQ(left_out_by("a.xyz", cloud), std::vector<std::string>{"xyz cannot hold radii"});
  EXPECT_TRUE(left_out_by("a.ply", cloud).empty());
  cloud.normals = {};
  const TemporaryFolder folder;
  EXPECT_NE(message_of<OutputError>([&] { write_mesh(cloud, folder / "a.pwn"); }).find("normal"),
            std::string::npos);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(RoundTrip, StlKeepsEveryTriangleInOrder) {
  const Mesh mesh = make_torus(2, 0.5, 12, 7);
  const Mesh back = through(mesh, "a.stl");
  ASSERT_EQ(back.face_count(), mesh.face_count());
  for (int corner = 0; corner < 3 * mesh.face_count(); ++corner) {
    EXPECT_EQ(back.face_vertices[corner], corner);
    const auto x = mesh.positions.row(mesh.face_vertices[corner]);
    EXPECT_LE((back.positions.row(corner) - x).norm(), 3e-7);
  }
  expect_stable_bytes(mesh, "a.stl");
}

TEST(RoundTrip, StlFacetNormalsPointOutwards) {
  const TemporaryFolder folder;
  write_mesh(make_icosphere(2, 2), folder / "a.stl");
  const std::string bytes = bytes_of(folder / "a.stl");
  ASSERT_EQ(bytes.size(), 84u + 50 * 320);
  for (std::size_t triangle = 0; triangle < 320; ++triangle) {
    float n[3], x[3];
    std::memcpy(n, &bytes[84 + 50 * triangle], sizeof(n));
    std::memcpy(x, &bytes[84 + 50 * triangle + 12], sizeof(x));
    EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-6);
    EXPECT_GT(n[0] * x[0] + n[1] * x[1] + n[2] * x[2], 1.9);
  }
}

TEST(RoundTrip, PlyTakesDoublesFarFromTheOrigin) {
  Mesh mesh = make_icosphere(1, 2);
  mesh.positions.rowwise() += Eigen::RowVector3d(5e5, 2e5, 0);
  EXPECT_EQ(through(mesh, "a.ply").positions, mesh.positions);
  mesh.positions *= 1e-60;
  EXPECT_EQ(through(mesh, "a.ply").positions, mesh.positions);
}

TEST(RoundTrip, PlyHoldsLargePolygons) {
  std::vector<Vec3> points;
  std::vector<int> polygon;
  for (int i = 0; i < 300; ++i) {
    points.emplace_back(std::cos(i * 0.02), std::sin(i * 0.02), 0);
    polygon.push_back(i);
  }
  const Mesh mesh = make_mesh(points, {polygon});
  for (const char* name : {"a.ply", "a.obj", "a.off"})
    expect_same_mesh(mesh, through(mesh, name), float_rounding);
}

TEST(WriteMesh, RefusesWhatItCannotWrite) {
  const TemporaryFolder folder;
  const Mesh mesh = make_box({1, 1, 1});
  for (const char* name : {"a.pts", "a", "a.fbx"}) {
    EXPECT_FALSE(can_write_mesh(folder / name));
    const std::string message = message_of<OutputError>([&] { write_mesh(mesh, folder / name); });
    EXPECT_NE(message.find("obj, off, ply, stl, glb, gltf, pcd, pwn, xyz"), std::string::npos)
        << message;
  }
  Mesh far = mesh;
  far.positions *= 1e100;
  EXPECT_NE(message_of<OutputError>([&] { write_mesh(far, folder / "a.stl"); }).find("float32"),
            std::string::npos);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(WriteMesh, NeverWritesWhatIsNotFinite) {
  const TemporaryFolder folder;
  Mesh mesh = make_box({1, 1, 1});
  mesh.positions(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_mesh(mesh, folder / "a.obj"), std::logic_error);
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace supple
