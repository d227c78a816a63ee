#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/mesh_comparison.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace supple {
namespace {

namespace fs = std::filesystem;

const fs::path shared_data = fs::path(SUPPLE_SHARED_DATA) / "data";

struct Counts {
  long vertices = 0, faces = 0;
};

/// The columns `file`, `vertices` and `faces` of the table in data/README.md.
std::map<std::string, Counts> listed_counts() {
  std::map<std::string, Counts> counts;
  std::ifstream readme(shared_data / "README.md");
  for (std::string line; std::getline(readme, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) {
      cell.erase(std::remove(cell.begin(), cell.end(), ' '), cell.end());
      cells.push_back(cell);
    }
    if (cells.size() > 4 && can_write_mesh(cells[1]))
      counts[cells[1]] = {std::stol(cells[3]), cells[4] == "-" ? 0 : std::stol(cells[4])};
  }
  return counts;
}

TEST(SharedMeshes, HaveTheListedCountsAndComeBack) {
  if (!fs::exists(shared_data)) GTEST_SKIP() << "skipped: no shared data";
  const std::map<std::string, Counts> listed = listed_counts();
  ASSERT_GT(listed.size(), 50u);
  const TemporaryFolder folder;
  for (const auto& [name, counts] : listed) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_mesh(shared_data / name);
    EXPECT_EQ(mesh.face_count(), counts.faces);
    // The list counts the corners of STL welded.
    const bool soup = fs::path(name).extension() == ".stl";
    EXPECT_EQ(mesh.positions.rows(), soup ? 3 * counts.faces : counts.vertices);
    write_mesh(mesh, folder / name);
    const Mesh back = read_mesh(folder / name);
    expect_same_mesh(mesh, back, 1e-7);
    write_mesh(back, folder / ("again_" + name));
    EXPECT_TRUE(bytes_of(folder / name) == bytes_of(folder / ("again_" + name)));
  }
}

TEST(SharedMeshes, StripsAreAClosedSurface) {
  if (!fs::exists(shared_data)) GTEST_SKIP() << "skipped: no shared data";
  const Mesh igea = read_mesh(shared_data / "igea_134k.ply");
  EXPECT_TRUE(is_closed(triangles_of(igea)));
  EXPECT_GT(enclosed_volume(igea.positions, triangles_of(igea)), 0);
}

TEST(SharedMeshes, QuadsGiveAClosedTriangleMesh) {
  if (!fs::exists(shared_data)) GTEST_SKIP() << "skipped: no shared data";
  const Mesh spot = read_mesh(shared_data / "spot_quads.obj");
  EXPECT_EQ(spot.texcoords.values.rows(), 267);
  EXPECT_EQ(spot.texcoords.corners.size(), spot.face_vertices.size());
  const Triangulation cut = triangulate(spot);
  EXPECT_EQ(cut.triangles.rows(), 4 + 2 * 160 + 3 * 16);
  EXPECT_TRUE(is_closed(cut.triangles));
}

TEST(SharedMeshes, PolygonsWithGroupsAndMaterials) {
  if (!fs::exists(shared_data)) GTEST_SKIP() << "skipped: no shared data";
  const Mesh chair = read_mesh(shared_data / "office_chair_ngons.obj");
  const auto count = [&](FaceTag::Kind kind) {
    return std::count_if(chair.tags.begin(), chair.tags.end(),
                         [&](const FaceTag& tag) { return tag.kind == kind; });
  };
  EXPECT_EQ(count(FaceTag::Kind::group), 124);
  EXPECT_EQ(count(FaceTag::Kind::material), 32);
  EXPECT_EQ(count(FaceTag::Kind::object), 1);
  std::map<int, int> sides;
  for (int face = 0; face < chair.face_count(); ++face) ++sides[chair.face_size(face)];
  EXPECT_EQ(sides, (std::map<int, int>{{3, 24}, {4, 3355}, {15, 11}, {18, 1}}));
}

TEST(SharedMeshes, PointCloudsKeepNormalsAndColors) {
  if (!fs::exists(shared_data)) GTEST_SKIP() << "skipped: no shared data";
  const Mesh hippo = read_mesh(shared_data / "scan_hippo_6k.ply");
  EXPECT_EQ(hippo.normals.values.rows(), 6104);
  EXPECT_NEAR(hippo.normals.values.rowwise().norm().maxCoeff(), 1, 1e-6);
  const Mesh lidar = read_mesh(shared_data / "scan_b9_utm_22k.ply");
  EXPECT_EQ(lidar.colors.values.rows(), 22300);
  EXPECT_EQ(lidar.notes,
            (std::vector<std::string>{"left out: property \"label\" of element \"vertex\""}));
}

}  // namespace
}  // namespace supple
