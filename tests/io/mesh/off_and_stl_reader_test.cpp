#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Mesh read(std::string_view name, std::string_view bytes) {
  const TemporaryFolder folder;
  return read_mesh(folder.put(name, bytes));
}

TEST(OffReader, CommentsCountsAndFaceColors) {
  const Mesh mesh = read("a.off",
                         "# head\nOFF # here\n\n4 3 # no edges\n0 0 0\n# between\n1 0 0 # x\n"
                         "0 1 0\n1 1 0\n\n4 0 1 3 2 255 0 0\n3 0 1 2\n2 0 1\nmore\n");
  EXPECT_EQ(mesh.positions.rows(), 4);
  EXPECT_EQ(mesh.face_starts, (std::vector<int>{0, 4, 7}));
  EXPECT_EQ(mesh.notes,
            (std::vector<std::string>{"left out: 1 faces of fewer than 3 vertices",
                                      "left out: 1 colors of faces",
                                      "left out: what follows the last face, from line 14"}));
}

TEST(OffReader, CountsOnTheFirstLine) {
  EXPECT_EQ(read("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").face_count(), 1);
}

TEST(OffReader, LettersInFrontOfOff) {
  const Mesh mesh = read("a.off", "STCNOFF\n1 0 0\n1 2 3 0 0 1 255 0 51 0.25 0.75\n");
  EXPECT_EQ(mesh.positions.row(0), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(mesh.normals.values.row(0), Eigen::RowVector3d(0, 0, 1));
  EXPECT_EQ(mesh.colors.values.row(0), Eigen::RowVector4d(1, 0, 0.2, 1));
  EXPECT_EQ(mesh.texcoords.values.row(0), Eigen::RowVector2d(0.25, 0.75));
}

TEST(OffReader, ColorsWithoutTheLetter) {
  const Mesh mesh = read("a.off", "OFF\n2 0 0\n1 2 3 255 0 51 255\n1 2 3 0 0 0 0\n");
  EXPECT_EQ(mesh.colors.values.row(0), Eigen::RowVector4d(1, 0, 0.2, 1));
  EXPECT_EQ(mesh.colors.values.row(1), Eigen::RowVector4d(0, 0, 0, 0));
}

TEST(StlReader, TextWithSeveralSolids) {
  const std::string facet =
      "  facet normal nan nan nan\n outer loop\n  vertex 0 0 0\n  VERTEX 1 0 0\n"
      "  vertex 0 1 0\n endloop\n endfacet\n";
  const Mesh mesh = read("a.stl", "solid one\n" + facet + facet + "endsolid one\nsolid\n" + facet +
                                      "endsolid\nSOLID third one\nendsolid\n");
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  ASSERT_EQ(mesh.tags.size(), 2u);
  EXPECT_EQ(mesh.tags[1].name, "third one");
  EXPECT_EQ(mesh.tags[1].first_face, 3);
}

TEST(StlReader, BinaryWhoseTitleSaysSolid) {
  std::string bytes = "solid but binary";
  bytes.resize(84 + 50, '\0');
  bytes[80] = 1;
  EXPECT_EQ(read("a.stl", bytes).face_count(), 1);
  EXPECT_EQ(read("a.stl", bytes + "xx").notes[0], "left out: 2 bytes after the last triangle");
}

TEST(ReadMesh, KnowsAFileWithoutExtensionByItsFirstWord) {
  EXPECT_EQ(read("a", "OFF\n1 0 0\n1 2 3\n").positions.rows(), 1);
  EXPECT_EQ(read("a.mesh", "# x\nv 1 2 3\n").positions.rows(), 1);
  EXPECT_EQ(read("ply",
                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\n"
                 "property int y\nproperty int z\nend_header\n1 2 3\n")
                .positions.rows(),
            1);
}

}  // namespace
}  // namespace supple
