#include <cstring>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "io/points/lzf.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

Mesh read_text(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  return read_mesh(folder.put(name, bytes));
}

using Notes = std::vector<std::string>;

Points rows(std::initializer_list<Vec3> vectors) {
  Points points(static_cast<Index>(vectors.size()), 3);
  Index row = 0;
  for (const Vec3& v : vectors) points.row(row++) = v.transpose();
  return points;
}

const Points two_points = rows({{1.5, 2, -3e-2}, {4, 5, 6}});

TEST(ReadXyz, SeparatorsCommentsHeadersAndLineEnds) {
  for (const char* text :
       {"1.5 2 -3e-2\n4 5 6\n", "1.5,2,-3e-2\r\n4,5,6\r\n", "1.5, 2, -3e-2\n4 , 5 , 6\n",
        "1.5;2;-3e-2\n4;5;6\n", "\t1.5\t2\t-3e-2 \n\n\n 4\t5\t6\n", "2\n1.5 2 -3e-2\n4 5 6\n",
        "# a scan\n1.5 2 -3e-2 # first\n// more\n4 5 6 // last\n", "//X Y Z\n1.5 2 -3e-2\n4 5 6\n",
        "\"X\",\"Y\",\"Z\"\n1.5,2,-3e-2\n4,5,6\n", "\xEF\xBB\xBFx;y;z\n1.5;2;-3e-2\n4;5;6\n",
        "1.5 2 -3e-2\r4 5 6\r", "1.5,2,-3e-2,\n4,5,6,\n"}) {
    const Mesh cloud = read_text("a.xyz", text);
    EXPECT_EQ(cloud.positions, two_points) << text;
    EXPECT_EQ(cloud.face_count(), 0);
    EXPECT_TRUE(cloud.normals.empty() && cloud.colors.empty()) << text;
    EXPECT_TRUE(cloud.notes.empty()) << text << cloud.notes[0];
  }
}

TEST(ReadXyz, TellsNormalsFromColors) {
  const Mesh normals = read_text("a.xyz", "0 0 0 0 0 1\n1 1 1 1 0 0\n");
  EXPECT_EQ(normals.normals.values, rows({{0, 0, 1}, {1, 0, 0}}));
  EXPECT_TRUE(normals.colors.empty());
  const Mesh colors = read_text("a.xyz", "0 0 0 255 0 51\n1 1 1 0 0 0\n");
  EXPECT_TRUE(colors.normals.empty());
  EXPECT_EQ(colors.colors.values.row(0), Eigen::RowVector4d(1, 0, 0.2, 1));
  for (const char* both : {"0 0 0 0 0 1 255 0 51\n", "0 0 0 255 0 51 0 0 1\n"}) {
    const Mesh mesh = read_text("a.xyz", both);
    EXPECT_EQ(mesh.normals.values, rows({{0, 0, 1}}));
    EXPECT_EQ(mesh.colors.values.row(0), Eigen::RowVector4d(1, 0, 0.2, 1));
  }
}

TEST(ReadXyz, NamedColumnsStandInAnyOrder) {
  const Mesh mesh = read_text("a.xyz", "# r g b intensity z y x\n1 0 0 77 3 2 1\n0 1 0 78 6 5 4\n");
  EXPECT_EQ(mesh.positions, rows({{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(mesh.colors.values.row(1), Eigen::RowVector4d(0, 1, 0, 1));
  EXPECT_EQ(mesh.notes, Notes{"left out: column \"intensity\""});
}

TEST(ReadXyz, SaysWhatItLeavesOut) {
  EXPECT_EQ(read_text("a.xyz", "0 0 0 17\n").notes, Notes{"left out: column 4"});
  EXPECT_EQ(read_text("a.xyz", "a scan of\na thing\n0 0 0\n").notes,
            Notes{"left out: 2 lines before the first point"});
  EXPECT_EQ(read_text("a.xyz", "x,y,z,what,else\n0,0,0\n").notes,
            Notes{"left out: a header with 5 names for 3 columns"});
}

TEST(ReadPwn, EveryArrangement) {
  const Points normals = rows({{0, 0, 1}, {0, 1, 0}});
  for (const char* text :
       {"1.5 2 -3e-2 0 0 1\n4 5 6 0 1 0\n", "2\n1.5 2 -3e-2 0 0 1\n4 5 6 0 1 0\n",
        "2\n1.5 2 -3e-2\n4 5 6\n0 0 1\n0 1 0\n",
        "# points\n 2 \r\n\r\n1.5 2 -3e-2\r\n4 5 6\r\n0 0 1\r\n0 1 0\r\n"}) {
    const Mesh cloud = read_text("a.pwn", text);
    EXPECT_EQ(cloud.positions, two_points) << text;
    EXPECT_EQ(cloud.normals.values, normals) << text;
    EXPECT_TRUE(cloud.notes.empty()) << text;
  }
}

std::string pcd_header(const std::string& fields, const std::string& sizes,
                       const std::string& types, const std::string& data) {
  return "# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS " + fields + "\nSIZE " +
         sizes + "\nTYPE " + types + "\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n" +
         "DATA " + data + "\n";
}

template <class... Numbers>
std::string bytes_of_numbers(Numbers... numbers) {
  std::string bytes;
  const auto append = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  (append(numbers), ...);
  return bytes;
}

TEST(ReadPcd, TextAndBinary) {
  const std::string fields = "x _ y z label", sizes = "8 2 8 8 1", types = "F U F F I";
  const std::uint16_t pad = 0;
  const std::int8_t label = 9;
  const std::string first = bytes_of_numbers(1.5, pad, 2.0, -3e-2, label);
  const std::string second = bytes_of_numbers(4.0, pad, 5.0, 6.0, label);
  const std::string by_field =
      bytes_of_numbers(1.5, 4.0, pad, pad, 2.0, 5.0, -3e-2, 6.0, label, label);
  // Runs of up to 32 bytes as they are.
  const std::string packed = std::string("\x1f") + by_field.substr(0, 32) +
                             static_cast<char>(by_field.size() - 33) + by_field.substr(32);
  const std::string sizes_of_packed = bytes_of_numbers(static_cast<std::uint32_t>(packed.size()),
                                                       static_cast<std::uint32_t>(by_field.size()));
  for (const std::string& file :
       {pcd_header(fields, sizes, types, "ascii") + "1.5 0 2 -3e-2 9\n4 0 5 6 9\n",
        pcd_header(fields, sizes, types, "binary") + first + second,
        pcd_header(fields, sizes, types, "binary_compressed") + sizes_of_packed + packed}) {
    const Mesh cloud = read_text("a.pcd", file);
    EXPECT_EQ(cloud.positions, two_points);
    EXPECT_EQ(cloud.notes, Notes{"left out: field \"label\""});
  }
}

/// An organised cloud has a point for every pixel, nan where the sensor saw nothing.
TEST(ReadPcd, LeavesOutMissingPointsAndSaysSo) {
  const Mesh cloud =
      read_text("a.pcd",
                "FIELDS x y z normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n"
                "WIDTH 2\nHEIGHT 2\nVIEWPOINT 1 0 0 1 0 0 0\nDATA ascii\n"
                "nan nan nan nan nan nan\n1.5 2 -3e-2 0 0 1\n-nan 0 0 0 0 1\n4 5 6 nan nan nan\n");
  EXPECT_EQ(cloud.positions, two_points);
  EXPECT_EQ(cloud.normals.values, rows({{0, 0, 1}, {0, 0, 0}}));
  EXPECT_EQ(cloud.notes,
            (Notes{"left out: 2 points that are nan: pixels that saw nothing",
                   "1 normals are nan: read as zero vectors", "left out: where the sensor stood"}));
}

/// PCL packs red, green, blue into the bits of a float or an integer.
TEST(ReadPcd, UnpacksColors) {
  const std::uint32_t bits = 0x00ff3300;
  float as_float = 0;
  std::memcpy(&as_float, &bits, sizeof(bits));
  const std::string fields = "x y z rgb", sizes = "4 4 4 4";
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", static_cast<double>(as_float));
  const auto line = [](const std::string& color) { return "0 0 0 " + color + "\n"; };
  const auto point = [&](auto color) { return bytes_of_numbers(0.f, 0.f, 0.f, color); };
  for (const std::string& file :
       {pcd_header(fields, sizes, "F F F F", "ascii") + line(text) + line(text),
        pcd_header(fields, sizes, "F F F F", "ascii") + line("16724736") + line("1.6724736e+07"),
        pcd_header(fields, sizes, "F F F U", "ascii") + line("16724736") + line("16724736"),
        pcd_header(fields, sizes, "F F F F", "binary") + point(as_float) + point(as_float),
        pcd_header("x y z rgba", sizes, "F F F U", "binary") + point(bits) + point(bits)}) {
    const Mesh cloud = read_text("a.pcd", file);
    ASSERT_EQ(cloud.colors.values.rows(), 2);
    for (Index i = 0; i < 2; ++i)
      EXPECT_EQ(cloud.colors.values.row(i), Eigen::RowVector4d(1, 0.2, 0, 1));
  }
}

TEST(UnpackLzf, RepeatsWhatWasUnpacked) {
  using namespace std::string_literals;
  EXPECT_EQ(unpack_lzf("\x02"
                       "abc"
                       "\x80\x02",
                       9),
            "abcabcabc");                                             // 6 bytes from 3 before
  EXPECT_EQ(unpack_lzf("\0z\xe0\x0a\0"s, 20), std::string(20, 'z'));  // 19 bytes from 1 before
  EXPECT_EQ(unpack_lzf("\x02"
                       "abc",
                       4),
            std::nullopt);
  EXPECT_EQ(unpack_lzf("\x02"
                       "abc",
                       2),
            std::nullopt);
  EXPECT_EQ(unpack_lzf("\x02"
                       "abc"
                       "\x80\x03",
                       9),
            std::nullopt);
}

TEST(ReadPly, RadiiOfPoints) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nproperty float ";
  for (const char* name : {"radius", "radii"}) {
    const Mesh cloud =
        read_text("a.ply", header + name + "\nend_header\n1.5 2 -3e-2 0.5\n4 5 6 0.25\n");
    EXPECT_EQ(cloud.radii, Eigen::Vector2d(0.5, 0.25));
    EXPECT_TRUE(cloud.notes.empty());
  }
  const std::string message = message_of<InputError>(
      [&] { read_text("a.ply", header + "radius\nend_header\n0 0 0 1\n0 0 0 -1\n"); });
  EXPECT_NE(message.find("the radius -1 of point 1"), std::string::npos) << message;
  const Mesh mesh =
      read_text("a.ply", header +
                             "radius\nelement face 1\nproperty list uchar int "
                             "vertex_indices\nend_header\n0 0 0 1\n0 0 0 1\n3 0 1 1\n");
  EXPECT_EQ(mesh.radii.size(), 0);
  EXPECT_EQ(mesh.notes[0], "left out: property \"radius\" of element \"vertex\"");
}

TEST(ReadMesh, KnowsPcdByItsFirstWord) {
  EXPECT_EQ(read_text("a", pcd_header("x y z", "4 4 4", "F F F", "ascii") + "1.5 2 -3e-2\n4 5 6\n")
                .positions,
            two_points);
}

}  // namespace
}  // namespace supple
