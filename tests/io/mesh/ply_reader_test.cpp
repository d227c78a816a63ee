#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Mesh read(std::string_view bytes) {
  const TemporaryFolder folder;
  return read_mesh(folder.put("a.ply", bytes));
}

/// A body of binary numbers in one of the two byte orders.
class Body {
 public:
  explicit Body(bool big_endian) : big_endian_(big_endian) {}

  template <class Number>
  Body& add(std::initializer_list<Number> numbers) {
    for (const Number number : numbers) {
      char copy[sizeof(Number)];
      std::memcpy(copy, &number, sizeof(Number));
      if (big_endian_) std::reverse(copy, copy + sizeof(Number));
      bytes_.append(copy, sizeof(Number));
    }
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool big_endian_;
  std::string bytes_;
};

TEST(PlyReader, AsciiAndBothBinariesAgree) {
  const std::string tables =
      "comment made by hand\nobj_info x\nelement vertex 4\nproperty float x\nproperty double y\n"
      "property short z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float32 u\n"
      "property float64 v\nelement face 2\nproperty uint8 flags\n"
      "property list ushort uint vertex_index\nend_header\n";
  const Mesh text = read("ply\nformat ascii 1.0\n" + tables +
                         "0.5 0.1 -3 255 0 51 0 0 1 0 0\n1 0 0 0 0 0 0 1 0 0.5 0.25\n"
                         "0 1 0 0 0 0 0 0 1 0 1\n1 1 0 255 255 255 1 0 0 1 1\n"
                         "7 3 0 1 2\n8 4 0 1 3 2\n");
  for (const bool big : {false, true}) {
    Body body(big);
    const auto vertex = [&](float x, double y, short z, std::initializer_list<std::uint8_t> color,
                            std::initializer_list<float> normal_and_u, double v) {
      body.add({x}).add({y}).add({z}).add(color).add(normal_and_u).add({v});
    };
    vertex(0.5f, 0.1, -3, {255, 0, 51}, {0, 0, 1, 0}, 0);
    vertex(1, 0, 0, {0, 0, 0}, {0, 1, 0, 0.5f}, 0.25);
    vertex(0, 1, 0, {0, 0, 0}, {0, 0, 1, 0}, 1);
    vertex(1, 1, 0, {255, 255, 255}, {1, 0, 0, 1}, 1);
    body.add<std::uint8_t>({7}).add<std::uint16_t>({3}).add<std::uint32_t>({0, 1, 2});
    body.add<std::uint8_t>({8}).add<std::uint16_t>({4}).add<std::uint32_t>({0, 1, 3, 2});
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    const Mesh binary = read("ply\nformat " + format + " 1.0\n" + tables + body.bytes());
    expect_same_mesh(text, binary, 0);
    EXPECT_EQ(binary.notes,
              (std::vector<std::string>{"left out: property \"flags\" of element \"face\""}));
  }
  EXPECT_EQ(text.face_starts, (std::vector<int>{0, 3, 7}));
  EXPECT_EQ(text.positions.row(0), Eigen::RowVector3d(0.5, 0.1, -3));
  EXPECT_EQ(text.colors.values.row(0), Eigen::RowVector4d(1, 0, 0.2, 1));
  EXPECT_EQ(text.texcoords.values.row(1), Eigen::RowVector2d(0.5, 0.25));
}

TEST(PlyReader, StripsAlternateAndRestart) {
  const Mesh mesh = read(
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 2\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n"
      "10 0 1 2 3 -1 2 3 4 4 5\n3 0 1 5\n");
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2, 2, 1, 3, 2, 3, 4, 0, 1, 5}));
}

TEST(PlyReader, StripsBesideFacesHaveNoTextureCoordinates) {
  const std::string face =
      "element face 1\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\n";
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::string begin =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\n";
  const std::string vertices = "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const std::string triangle = "3 0 1 2 6 0 0 1 0 0 1\n", strip = "3 2 1 3\n";
  EXPECT_EQ(read(begin + face + strips + vertices + triangle + strip).texcoords.corners,
            (std::vector<int>{0, 1, 2, -1, -1, -1}));
  EXPECT_EQ(read(begin + strips + face + vertices + strip + triangle).texcoords.corners,
            (std::vector<int>{-1, -1, -1, 0, 1, 2}));
}

TEST(PlyReader, SkipsWhatItDoesNotKnow) {
  const Mesh mesh = read(
      "ply\r\nformat ascii 1.0\r\nelement camera 1\r\nproperty float f\r\nelement vertex 3\r\n"
      "property list uchar int ring\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nproperty float quality\r\nelement face 3\r\n"
      "property list uchar int vertex_indices\r\nend_header\r\n"
      "35\r\n2 7 8 0 0 0 nan\r\n0 1 0 0 inf\r\n1 5 0 1 0 1\r\n3 0 1 2\r\n2 0 1\r\n3 0 1 1\r\n");
  EXPECT_EQ(mesh.positions, (Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished());
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{0, 1, 2, 0, 1, 1}));
  EXPECT_EQ(mesh.notes,
            (std::vector<std::string>{"left out: 1 rows of element \"camera\"",
                                      "left out: property \"ring\" of element \"vertex\"",
                                      "left out: property \"quality\" of element \"vertex\"",
                                      "left out: 1 faces of fewer than 3 vertices",
                                      "1 faces use a vertex twice"}));
}

TEST(PlyReader, FacesBeforeVerticesAndColorsOfFloats) {
  const Mesh mesh = read(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty float red\nproperty float green\n"
      "property float blue\nproperty float alpha\nend_header\n"
      "3 2 1 0 6 0 0 1 0 0 1\n0 0 0 1 0 0.5 0.25\n1 0 0 0 0 0 1\n0 1 0 0 0 0 1\n");
  EXPECT_EQ(mesh.face_vertices, (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(mesh.colors.values.row(0), Eigen::RowVector4d(1, 0, 0.5, 0.25));
  EXPECT_EQ(mesh.texcoords.corners, (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace supple
