#include <gtest/gtest.h>

#include "io/mesh/mesh_checks.h"
#include "io/mesh/mesh_files.h"
#include "solver/core/random.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

bool is_same(const Mesh& a, const Mesh& b) {
  return relative_difference(a.positions, b.positions) == 0 && a.face_starts == b.face_starts &&
         a.face_vertices == b.face_vertices &&
         relative_difference(a.colors.values, b.colors.values) == 0 &&
         relative_difference(corner_values(a, a.normals), corner_values(b, b.normals)) == 0 &&
         relative_difference(a.radii, b.radii) == 0 &&
         relative_difference(corner_values(a, a.texcoords), corner_values(b, b.texcoords)) == 0 &&
         a.tags.size() == b.tags.size();
}

bool has_note(const Mesh& mesh, std::string_view words) {
  for (const std::string& note : mesh.notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

/// Every beginning of the file is refused, noted as cut, or still the whole mesh.
void expect_no_silent_part(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  const Mesh whole = read_mesh(folder.put(name, bytes));
  int refused = 0;
  for (std::size_t length = bytes.size(); length-- > 0;) {
    std::filesystem::resize_file(folder / name, length);
    try {
      const Mesh part = read_mesh(folder / name);
      EXPECT_TRUE(is_same(part, whole) || has_note(part, "may be cut short"))
          << name << " of " << length << " bytes";
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0.9 * static_cast<double>(bytes.size())) << name;
}

std::string written(const Mesh& mesh, const std::string& name) {
  const TemporaryFolder folder;
  write_mesh(mesh, folder / name);
  return bytes_of(folder / name);
}

Mesh colored_box() {
  Mesh mesh = make_box({1.25, 2, 3});
  mesh.colors.values.setConstant(8, 4, 0.4);
  mesh.texcoords.values.setRandom(5, 2);
  for (int corner = 0; corner < 24; ++corner) mesh.texcoords.corners.push_back(corner % 5);
  return mesh;
}

TEST(TruncatedMesh, Ply) {
  expect_no_silent_part("a.ply", written(colored_box(), "a.ply"));
  expect_no_silent_part(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1.25 0 0\n0 1 0\n3 0 1 2\n\n \n");
}

TEST(TruncatedMesh, Off) {
  expect_no_silent_part("a.off", written(colored_box(), "a.off") + "\n");
}

TEST(TruncatedMesh, Stl) {
  expect_no_silent_part("a.stl", written(make_box({1, 2, 3}), "a.stl"));
  expect_no_silent_part("a.stl",
                        "solid box\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                        "vertex 0 1 0\nendloop\nendfacet\nendsolid box\n\n");
}

/// Without counts a file cut at the end of a line is a whole file. Any other cut is told.
void expect_cut_lines_told(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  folder.put(name, bytes);
  int refused = 0, told = 0;
  for (std::size_t length = bytes.size(); length-- > 0;) {
    std::filesystem::resize_file(folder / name, length);
    try {
      const Mesh read = read_mesh(folder / name);
      if (bytes[length - 1] == '\n') continue;
      EXPECT_TRUE(has_note(read, "may be cut short")) << length;
      ++told;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
  EXPECT_GT(told, 50);
}

TEST(TruncatedMesh, Obj) {
  Mesh mesh = colored_box();
  mesh.tags = {{FaceTag::Kind::group, "g", 0}, {FaceTag::Kind::material, "m", 3}};
  mesh.material_libraries = {"a.mtl"};
  expect_cut_lines_told("a.obj", written(mesh, "a.obj"));
}

Mesh cloud_with_all() {
  Mesh cloud;
  cloud.positions = Points::Random(9, 3);
  cloud.normals.values = cloud.positions.rowwise().normalized();
  cloud.colors.values.setConstant(9, 4, 0.4);
  cloud.colors.values.col(3).setOnes();
  cloud.radii = Eigen::VectorXd::LinSpaced(9, 0.5, 1);
  return cloud;
}

TEST(TruncatedMesh, PointClouds) {
  for (const char* name : {"a.ply", "a.pcd", "a.pwn"})
    expect_no_silent_part(
        name, written(cloud_with_all(), name) + (name == std::string_view("a.pwn") ? "\n" : ""));
  expect_no_silent_part("a.pcd",
                        "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nPOINTS 2\nDATA ascii\n"
                        "0.5 0.25 0.125\n1.25 2.5 nan\n\n \n");
  expect_cut_lines_told("a.xyz", written(cloud_with_all(), "a.xyz"));
}

/// Some bytes changed: refused, or a mesh that holds together.
void expect_refused_or_whole(const Mesh& mesh, const std::string& name, Random& random) {
  const TemporaryFolder folder;
  const std::string bytes = written(mesh, name);
  int refused = 0, read = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::string damaged = bytes;
    for (int change = 0; change <= trial % 3; ++change)
      damaged[random.next() % damaged.size()] = static_cast<char>(random.next());
    try {
      const Mesh part = read_mesh(folder.put(name, damaged));
      check_mesh(part);
      EXPECT_TRUE((triangulate(part).triangles.array() >= 0).all());
      ++read;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10) << name;
  EXPECT_GT(read, 10) << name;
}

TEST(MutatedMesh, NeverGivesABrokenMesh) {
  Random random(11);
  for (const char* name : {"a.ply", "a.off", "a.obj", "a.stl"})
    expect_refused_or_whole(colored_box(), name, random);
  for (const char* name : {"a.ply", "a.pcd", "a.pwn", "a.xyz"})
    expect_refused_or_whole(cloud_with_all(), name, random);
}

}  // namespace
}  // namespace supple
