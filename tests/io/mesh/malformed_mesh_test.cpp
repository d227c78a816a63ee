#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/malformed_files.h"

namespace supple {
namespace {

const std::string one_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string ply(const std::string& format, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\n" + rest;
}

std::string ply_points(const std::string& count, const std::string& body) {
  return ply("ascii", "element vertex " + count +
                          "\nproperty float x\nproperty float y\nproperty float z\n"
                          "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                          body);
}

std::string stl_binary(std::uint32_t count, std::size_t triangles) {
  std::string bytes(84 + 50 * triangles, '\0');
  for (int k = 0; k < 4; ++k) bytes[80 + k] = static_cast<char>(count >> (8 * k));
  return bytes;
}

std::vector<Malformed> obj_cases() {
  return {
      {"a.obj", "", "cannot read: the file is empty"},
      {"a.obj", "\n\n", ": the file has no vertices"},
      {"a.obj", "v 1 2\n", ":1: vertex 1: the line ends too early"},
      {"a.obj", "v 0 0 0\nv 0 nan 0\n", ":2: vertex 2: \"nan\" is not a finite number"},
      {"a.obj", "v 0 0 -inf\n", ":1: vertex 1: \"-inf\" is not a finite number"},
      {"a.obj", "v 0 0 1e400\n", ":1: vertex 1: \"1e400\" is not a finite number"},
      {"a.obj", "v 0 0 1,5\n", ":1: vertex 1: \"1,5\" is not a number"},
      {"a.obj", "v 0 0 1.#QNAN\n", ":1: vertex 1: \"1.#QNAN\" is not a number"},
      {"a.obj", "v 0 0 0x10\n", "\"0x10\" is not a number"},
      {"a.obj", "v 0 0 --1\n", "\"--1\" is not a number"},
      {"a.obj", "v 0 0 +-1\n", "\"+-1\" is not a number"},
      {"a.obj", "v 1 2 3 4 5\n", "\"4\" is more than belongs on this line"},
      {"a.obj", one_triangle + "f 1 2\n", ":4: face 1: it has 2 vertices, fewer than 3"},
      {"a.obj", one_triangle + "f 1 2 4\n", ":4: vertex 4 does not exist, the file has 3"},
      {"a.obj", one_triangle + "f 1 2 3\nf 1 2 -4\n", ":5: face 2: vertex -4 does not exist"},
      {"a.obj", one_triangle + "f 0 1 2\n", ":4: face 1: \"0\" is no corner"},
      {"a.obj", one_triangle + "f 1/1 2 3\n", ":4: vt 1 does not exist, the file has 0"},
      {"a.obj", one_triangle + "f 1//2 2 3\n", ":4: vn 2 does not exist, the file has 0"},
      {"a.obj", one_triangle + "f 1 2 3x\n", "\"3x\" is no corner"},
      {"a.obj", one_triangle + "f 1 2 3/1/1/1\n", "\"3/1/1/1\" is no corner"},
      {"a.obj", one_triangle + "f 1 2 99999999999999999999\n", "is no corner"},
      {"a.obj", one_triangle + "f 1 2 9999999999\n", "vertex 9999999999 does not exist"},
      {"a.obj", std::string("v 0 0 0\n\0", 9), ": byte 8 is zero: this is not a text file"},
      {"a.obj", "\x89PNG\r\n", ":1: this is not an OBJ file"},
      {"a.obj", "v 0 0 0 -1 0 0\n", "is outside [0, 1] and [0, 255]"},
      {"a.obj", "v 0 0 0 1e9 0 0\n", "the color 1000000000 of vertex 0"},
  };
}

std::vector<Malformed> off_cases() {
  return {
      {"a.off", "3 1 0\n", ":1: the first word is not OFF"},
      {"a.off", "4OFF\n", ":1: the first word is not OFF"},
      {"a.off", "OFF\n", ":1: the file is cut short"},
      {"a.off", "OFF\n1\n", ":2: the line ends too early"},
      {"a.off", "OFF\n0 0 0\n", ": the file has no vertices"},
      {"a.off", "OFF\n3000000000 1 0\n0 0 0\n", ":2: 3000000000 vertices cannot be in a file of"},
      {"a.off", "OFF\n1 3000000000 0\n0 0 0\n", ":2: 3000000000 faces cannot be in a file of"},
      {"a.off", "OFF\n-1 1 0\n", ":2: -1 vertices cannot"},
      {"a.off", "OFF\n1 99999999999999999999 0\n", "\"99999999999999999999\" is too large"},
      {"a.off", "OFF\n2 0 0\n0 0 0\n       \n", ":4: vertex 1: the file is cut short"},
      {"a.off", "OFF\n1 0 0\n0 0 nan\n", ":3: vertex 0: \"nan\" is not a finite number"},
      {"a.off", "OFF\n2 0 0\n0 0 0\n0 0 0 1 1 1\n", ":4: vertex 1: \"1\" is more than belongs"},
      {"a.off", "OFF\n1 0 0\n0 0 0 1\n", ":3: vertex 0: the line has 4 numbers; 3, 6 or 7"},
      {"a.off", "COFF\n1 0 0\n0 0 0\n", ":3: vertex 0: the line has 3 numbers; 6 or 7"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", ":4: face 0: vertex 1 does not exist"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", ":4: face 0: vertex -1 does not exist"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n", ":4: face 0: the line ends too early"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n0\n3 0\n", ":4: face 0: 0 vertices"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n4000000000 0\n", ":4: face 0: the line ends too early"},
  };
}

std::vector<Malformed> ply_cases() {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  return {
      {"a.ply", "plx\n", ":1: the first line is not \"ply\""},
      {"a.ply", "ply\n", ":1: the file is cut short"},
      {"a.ply", ply("utf8", ""), ":2: the format is not ascii"},
      {"a.ply", "ply\nformat ascii 2.0\n", ":2: \"1.0\" is expected here, not \"2.0\""},
      {"a.ply", ply("ascii", "end_header\n"), ":3: the header has no element \"vertex\""},
      {"a.ply", "ply\nelement vertex 0\nend_header\n", ":3: the header has no line \"format\""},
      {"a.ply", ply("ascii", "property float x\n"), ":3: \"property\" does not belong here"},
      {"a.ply", ply("ascii", "element vertex 1\nproperty half x\n"), "\"half\" is no type of PLY"},
      {"a.ply", ply("ascii", "element vertex 1\nproperty int x\nproperty int x\n"),
       ":5: property \"x\" stands twice"},
      {"a.ply", ply("ascii", "element vertex 1\nelement vertex 1\n"),
       ":4: element \"vertex\" stands twice"},
      {"a.ply", ply("ascii", "element vertex 1\nproperty list float int x\n"),
       "the length of a list is not an integer type"},
      {"a.ply", ply("ascii", "element vertex 1\nend_header\n1\n"), "has no properties"},
      {"a.ply", ply("ascii", "element vertex 1\nproperty float x\nend_header\n1\n"),
       "has no properties x, y and z"},
      {"a.ply", ply_points("4000000000", points), "4000000000 rows of at least 6 bytes"},
      {"a.ply", ply_points("99999999999999999999", points), "is too large"},
      {"a.ply", ply_points("-1", points), "the count is negative"},
      {"a.ply", ply_points("0", "3 0 0 0\n"), ":9: the file has no vertices"},
      {"a.ply", ply_points("3", points + "3 0 1 3\n"),
       ":13: face 0: vertex 3 does not exist, the file has 3, counted from 0"},
      {"a.ply", ply_points("3", points + "3 0 1 -1\n"), ":13: face 0: vertex -1 does not exist"},
      {"a.ply", ply_points("3", points + "3 0 1 1.5\n"), "\"1.5\" is not a whole number"},
      {"a.ply", ply_points("3", points + "-3 0 1 1\n"), "-3 does not fit the type"},
      {"a.ply", ply_points("3", points + "300 0 1 1\n"), "300 does not fit the type"},
      {"a.ply", ply_points("3", points + "3 0 1\n"), ":13: face 0: the line ends too early"},
      {"a.ply", ply_points("3", points + "3 0 1 2 2\n"), "\"2\" is more than belongs"},
      {"a.ply", ply_points("3", "0 0 0\n0 0 inf\n0 1 0\n3 0 1 2\n"),
       ":11: vertex 1: \"inf\" is not a finite number"},
      {"a.ply", ply_points("3", "0 0 0\n0 0 1e999\n0 1 0\n3 0 1 2\n"),
       ":11: vertex 1: \"1e999\" is not a finite number"},
      {"a.ply",
       ply("binary_little_endian",
           "element vertex 4000000000\nproperty float x\n"
           "property float y\nproperty float z\nend_header\n0123456789ab"),
       ":7: the file is cut short: element \"vertex\" has 4000000000 rows of at least 12 bytes"},
      {"a.ply",
       ply("binary_little_endian",
           "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n" +
               std::string("\0\0\0\0\0\0\0\0\0\0\xc0\x7f", 12)),
       ": byte 123: vertex 0: z is not a finite number"},
      {"a.ply",
       ply("binary_little_endian",
           "element vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
           "element face 1\nproperty list uint uint vertex_indices\nend_header\n" +
               std::string("\1\2\3\xff\xff\xff\xff\0\0\0\0\0\0", 13)),
       "face 0: the file is cut short"},
      {"a.ply",
       ply("binary_little_endian",
           "element vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
           "element face 1\nproperty list char int vertex_indices\nend_header\n\1\2\3\xff"),
       "face 0: a list of -1 values"},
      {"a.ply",
       ply("ascii",
           "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty int vertex_indices\nend_header\n0 0 0\n1\n"),
       "has no list \"vertex_indices\""},
      {"a.ply",
       ply("ascii",
           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\n"
           "property list uchar float texcoord\nend_header\n" +
               points + "3 0 1 2 4 0 0 1 1\n"),
       "face 0: 4 texture coordinates for 3 corners"},
  };
}

std::vector<Malformed> other_cases() {
  std::string not_finite = stl_binary(1, 1);
  not_finite[84 + 12 + 12 + 2] = '\x80';
  not_finite[84 + 12 + 12 + 3] = '\x7f';
  const std::string facet = "solid\nfacet normal 0 0 1\nouter loop\n";
  return {
      {"a.stl", stl_binary(0xffffffffu, 1), "4294967295 triangles need 214748364834 bytes"},
      {"a.stl", stl_binary(2, 1), "the file is cut short: 2 triangles need 184 bytes, it has 134"},
      {"a.stl", stl_binary(0, 0), ": the file has no vertices"},
      {"a.stl", "soli", "4 bytes are no STL file"},
      {"a.stl", "solid\nendsolid\n", ": the file has no vertices"},
      {"a.stl", "solid\n", ":1: triangle 0: the file is cut short"},
      {"a.stl", not_finite, ": byte 108: vertex 1: inf is not a finite number"},
      {"a.stl", facet + "vertex 0 0 nan\n", ":4: vertex 0: \"nan\" is not a finite number"},
      {"a.stl", facet + "vertex 0 0\n", ":4: vertex 0: the line ends too early"},
      {"a.stl", facet + "endloop\n",
       ":4: triangle 0: \"vertex\" is expected here, not \"endloop\""},
      {"a.stl", "solid\nface\n", ":2: triangle 0: \"facet\" or \"endsolid\" is expected here"},
      {"a.pts", "1 2 3\n", "cannot read: it is of none of our formats"},
      {"a", "\n", "cannot read: it is of none of our formats"},
  };
}

TEST(MalformedMesh, IsRefusedWithAMessage) {
  for (const auto& cases : {obj_cases(), off_cases(), ply_cases(), other_cases()})
    expect_refused(cases);
}

TEST(MalformedMesh, WhatIsNoFileIsRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.ply").c_str(), 0600), 0);
  std::filesystem::create_directory(folder / "folder.ply");
  const std::pair<std::string, std::string> cases[] = {{"missing.ply", "No such file or directory"},
                                                       {"folder.ply", "it is a folder"},
                                                       {"pipe.ply", "it is not a regular file"}};
  for (const auto& wrong : cases) {
    const std::string message = message_of<InputError>([&] { read_mesh(folder / wrong.first); });
    EXPECT_NE(message.find(wrong.second), std::string::npos) << message;
  }
}

TEST(MalformedMesh, TooLargeFileIsRefusedBeforeItIsRead) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.put("a.obj", "v 0 0 0\n");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40);  // a hole, no bytes on the disk
  const std::string message = message_of<InputError>([&] { read_mesh(path); });
  EXPECT_NE(message.find("more than 4294967296"), std::string::npos) << message;
}

TEST(MalformedMesh, TinyNumbersAreZeroNotErrors) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh(folder.put("a.obj", "v 1e-400 -1e-400 1e-320\n"));
  EXPECT_EQ(mesh.positions(0, 0), 0);
  EXPECT_EQ(mesh.positions(0, 1), 0);
  EXPECT_EQ(mesh.positions(0, 2), 1e-320);
}

}  // namespace
}  // namespace supple
