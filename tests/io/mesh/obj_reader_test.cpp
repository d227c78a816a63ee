#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Mesh read(std::string_view text) {
  const TemporaryFolder folder;
  return read_mesh(folder.put("a.obj", text));
}

TEST(ObjReader, CornerForms) {
  const Mesh mesh = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
      "vt 0.5 0.25\nvt 1\nvn 0 0 1\n"
      "f 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//1 4//1\nf 1/2/1 3/1/1 4/2/1\n");
  EXPECT_EQ(mesh.face_starts, (std::vector<int>{0, 3, 6, 9, 12}));
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2, 0, 1, 2, 0, 1, 3, 0, 2, 3}));
  EXPECT_EQ(mesh.texcoords.corners, (std::vector<int>{-1, -1, -1, 0, 1, 0, -1, -1, -1, 1, 0, 1}));
  EXPECT_EQ(mesh.normals.corners, (std::vector<int>{-1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(mesh.texcoords.values.row(1), Eigen::RowVector2d(1, 0));
}

TEST(ObjReader, NegativeIndicesCountBackFromTheirLine) {
  const Mesh mesh = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nf -3/-2 -2/-1 -1/-2\n"
      "v 9 9 9\nf -1 -2 -3\n");
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2, 3, 2, 1}));
  EXPECT_EQ(mesh.texcoords.corners, (std::vector<int>{0, 1, 0, -1, -1, -1}));
}

TEST(ObjReader, FacesMayComeBeforeTheirVertices) {
  const Mesh mesh = read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2}));
}

TEST(ObjReader, LineEndsCommentsContinuationAndBom) {
  const std::string expected_tag = "a # b";
  const Mesh mesh = read(
      "\xEF\xBB\xBF# head \\\r\nv 0 0 0 # first\r\n\tv  1 0\\\r\n 0\r\n\r\nv +0 1e0 .0\r\n"
      "g a # b\r\nf 1 \\\r\n 2 \\\r\n 3\r\n");
  EXPECT_EQ(mesh.positions, (Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished());
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2}));
  ASSERT_EQ(mesh.tags.size(), 1u);
  EXPECT_EQ(mesh.tags[0].name, expected_tag);
  EXPECT_TRUE(mesh.notes.empty());
}

TEST(ObjReader, OldMacLineEnds) {
  EXPECT_EQ(read("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").face_count(), 1);
}

TEST(ObjReader, Colors) {
  const Mesh floats = read("v 0 0 0 0.5 0.25 1\nv 1 0 0\n");
  EXPECT_EQ(floats.colors.values.row(0), Eigen::RowVector4d(0.5, 0.25, 1, 1));
  EXPECT_EQ(floats.colors.values.row(1), Eigen::RowVector4d(1, 1, 1, 1));
  EXPECT_EQ(floats.notes, (std::vector<std::string>{"1 vertices have no color: now white"}));
  const Mesh bytes = read("v 0 0 0 255 0 51\nv 1 0 0 0 0 0\n");
  EXPECT_EQ(bytes.colors.values.row(0), Eigen::RowVector4d(1, 0, 0.2, 1));
}

TEST(ObjReader, PointCloudWithNormals) {
  const Mesh mesh = read("vn 0 0 1\nv 1 2 3\nvn 0 1 0\nv 4 5 6\n");
  EXPECT_EQ(mesh.face_count(), 0);
  EXPECT_FALSE(mesh.normals.per_corner());
  EXPECT_EQ(mesh.normals.values.row(1), Eigen::RowVector3d(0, 1, 0));
}

TEST(ObjReader, NamesWhatIsLeftOut) {
  const Mesh mesh = read(
      "v 0 0 0 2\nv 1 0 0\nv 0 1 0\nvt 0 0 0.5\np 1\nl 1 2\nl 2 3\nf 1 2 3\nf 1 1 2\n"
      "vp 1 2");
  EXPECT_EQ(mesh.notes,
            (std::vector<std::string>{
                "left out: 1 weights of vertices (a fourth number that is not 1)",
                "left out: 1 third texture coordinates that are not 0", "left out: 2 lines \"l\"",
                "left out: 1 lines \"p\"", "left out: 1 lines \"vp\"",
                "the last line has no end: the file may be cut short there",
                "1 faces use a vertex twice"}));
}

}  // namespace
}  // namespace supple
