#include "modeler/domain/mesh_defects.h"

#include <fstream>
#include <numbers>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/mesh/mesh_files.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

/// The kinds that were found, with their counts: "boundary_edges 3, duplicate_faces 1".
std::string found(const Mesh& mesh) {
  const MeshSurvey survey = survey_mesh(mesh);
  std::string text;
  for (const Defect& defect : survey.defects)
    if (defect.count > 0)
      text +=
          fmt::format("{}{} {}", text.empty() ? "" : ", ", enum_name(defect.kind), defect.count);
  return text;
}

/// `mesh` without some of its triangles.
Mesh without(const Mesh& mesh, const std::vector<int>& faces) {
  Mesh result;
  result.positions = mesh.positions;
  for (int face = 0; face < mesh.face_count(); ++face) {
    if (std::find(faces.begin(), faces.end(), face) != faces.end()) continue;
    for (int k = 0; k < 3; ++k) result.face_vertices.push_back(mesh.face_vertices[3 * face + k]);
    result.face_starts.push_back(static_cast<int>(result.face_vertices.size()));
  }
  return result;
}

Mesh with_face(Mesh mesh, std::vector<int> vertices) {
  mesh.face_vertices.insert(mesh.face_vertices.end(), vertices.begin(), vertices.end());
  mesh.face_starts.push_back(static_cast<int>(mesh.face_vertices.size()));
  return mesh;
}

/// Every triangle with vertices of its own.
Mesh as_soup(const Mesh& mesh) {
  Mesh soup;
  soup.positions = mesh.positions(mesh.face_vertices, Eigen::all);
  for (int k = 0; k < static_cast<int>(mesh.face_vertices.size()); ++k)
    soup.face_vertices.push_back(k);
  soup.face_starts = mesh.face_starts;
  return soup;
}

TEST(MeshDefects, ClosedMeshesHaveNone) {
  EXPECT_EQ(found(make_icosphere(1, 3)), "");
  EXPECT_EQ(found(make_quad_bar({1, 2, 3}, {2, 3, 4})), "");
  const MeshSurvey torus = survey_mesh(make_torus(1, 0.25, 32, 16));
  EXPECT_TRUE(torus.topology.watertight());
  EXPECT_EQ(torus.topology.genus(), 1);
  EXPECT_EQ(survey_mesh(make_icosphere(1, 1)).topology.genus(), 0);
}

TEST(MeshDefects, CountsWhatThereIs) {
  const MeshSurvey box = survey_mesh(make_box({1, 2, 3}));
  EXPECT_EQ(box.vertices, 8);
  EXPECT_EQ(box.faces, 6);
  EXPECT_EQ(box.triangles, 12);
  EXPECT_EQ(box.faces_by_sides, (std::map<int, long>{{4, 6}}));
  EXPECT_EQ(box.topology.edges, 12);
  EXPECT_NEAR(box.area, 22, 1e-12);
  EXPECT_NEAR(box.volume, 6, 1e-12);
  EXPECT_NEAR(survey_mesh(turned(make_icosphere(1, 4))).volume, -4.18, 0.03);
}

TEST(MeshDefects, AHoleHasBoundaryEdges) {
  const Mesh open = without(make_icosphere(1, 2), {10});
  EXPECT_EQ(found(open), "boundary_edges 3");
  const MeshSurvey survey = survey_mesh(open);
  EXPECT_FALSE(survey.topology.closed());
  EXPECT_FALSE(survey.components[0].closed);
  const std::vector<DefectPlace>& places = survey.defect(DefectKind::boundary_edges).places;
  ASSERT_EQ(places.size(), 3u);
  for (const DefectPlace& place : places) {
    ASSERT_EQ(place.vertices.size(), 2u);
    ASSERT_EQ(place.faces.size(), 1u);
    const Vec3 middle =
        0.5 * (open.positions.row(place.vertices[0]) + open.positions.row(place.vertices[1]));
    EXPECT_LT((place.position - middle).norm(), 1e-15);
  }
}

TEST(MeshDefects, NonManifoldEdgesAndVertices) {
  const Mesh box = as_fans(make_box({1, 1, 1}));
  Mesh wing = box;
  wing.positions.conservativeResize(9, 3);
  wing.positions.row(8) << -1, -1, 2;
  const int a = box.face_vertices[0], b = box.face_vertices[1];
  EXPECT_EQ(survey_mesh(with_face(wing, {a, b, 8})).defect(DefectKind::nonmanifold_edges).count, 1);

  const Mesh two = make_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
  EXPECT_EQ(found(two), "nonmanifold_vertices 1") << "two tetrahedra that share a corner";
  EXPECT_EQ(survey_mesh(two).defect(DefectKind::nonmanifold_vertices).places[0].vertices,
            std::vector<int>{0});
  EXPECT_EQ(survey_mesh(two).components.size(), 1u);
}

TEST(MeshDefects, TurnedFacesAreInconsistentWithTheirNeighbours) {
  Mesh ball = make_icosphere(1, 2);
  std::swap(ball.face_vertices[31], ball.face_vertices[32]);  // face 10
  EXPECT_EQ(found(ball), "inconsistent_edges 3");
  EXPECT_TRUE(survey_mesh(ball).topology.orientable);
}

TEST(MeshDefects, AMoebiusStripIsNotOrientable) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  constexpr int parts = 12;
  for (int i = 0; i < parts; ++i) {
    const double u = 2 * std::numbers::pi * i / parts;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(u / 2);
      points.emplace_back(r * std::cos(u), r * std::sin(u), side * std::sin(u / 2));
    }
    const int next = 2 * (i + 1) % (2 * parts), twist = i + 1 == parts ? 1 : 0;
    faces.push_back({2 * i, 2 * i + 1, next + 1 - twist});
    faces.push_back({2 * i, next + 1 - twist, next + twist});
  }
  const Topology strip = survey_mesh(make_mesh(points, faces)).topology;
  EXPECT_FALSE(strip.orientable);
  EXPECT_EQ(strip.boundary_edges, 2 * parts);
  EXPECT_EQ(strip.nonmanifold_edges, 0);
}

TEST(MeshDefects, FacesThatAreNone) {
  const Mesh ball = make_icosphere(1, 2);
  const int a = ball.face_vertices[0], b = ball.face_vertices[1], c = ball.face_vertices[2];
  const MeshSurvey survey = survey_mesh(with_face(with_face(ball, {c, a, b}), {a, a, b}));
  EXPECT_EQ(survey.defect(DefectKind::duplicate_faces).count, 1);
  EXPECT_EQ(survey.defect(DefectKind::duplicate_faces).places[0].faces,
            (std::vector<int>{ball.face_count(), 0}));
  EXPECT_EQ(survey.defect(DefectKind::repeated_index_faces).count, 1);
  const Mesh flat = make_mesh({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_EQ(survey_mesh(flat).defect(DefectKind::zero_area_triangles).count, 1);
}

TEST(MeshDefects, VerticesThatStandAloneOrTwice) {
  Mesh ball = make_icosphere(1, 1);
  const Index count = ball.positions.rows();
  ball.positions.conservativeResize(count + 2, 3);
  ball.positions.row(count) << 5, 5, 5;
  ball.positions.row(count + 1) = ball.positions.row(3);
  EXPECT_EQ(found(ball), "unreferenced_vertices 2, duplicated_vertices 1");
  EXPECT_LT(survey_mesh(ball).box.upper.x(), 2) << "the box is that of the faces";
}

TEST(MeshDefects, ASeamCutsTheFileButNotTheWeldedSurface) {
  const Mesh ball = make_icosphere(1, 2);
  const int count = static_cast<int>(ball.positions.rows());
  Mesh seam = ball;
  seam.positions.conservativeResize(2 * count, 3);
  seam.positions.bottomRows(count) = ball.positions;
  for (std::size_t k = seam.face_vertices.size() / 2; k < seam.face_vertices.size(); ++k)
    seam.face_vertices[k] += count;
  const MeshSurvey survey = survey_mesh(seam);
  EXPECT_FALSE(survey.loose);
  EXPECT_EQ(survey.defect(DefectKind::duplicated_vertices).count, count);
  EXPECT_GT(survey.topology.boundary_edges, 0);
  EXPECT_TRUE(survey.welded.watertight());
  EXPECT_EQ(survey.welded.components, 1);
  EXPECT_EQ(survey.defect(DefectKind::self_intersections).count, 0);
}

TEST(MeshDefects, TrianglesWithVerticesOfTheirOwnJoinByPosition) {
  const Mesh ball = make_icosphere(1, 2);
  const Mesh soup = as_soup(ball);
  const MeshSurvey survey = survey_mesh(soup);
  EXPECT_TRUE(survey.loose);
  EXPECT_EQ(found(soup), "");
  EXPECT_TRUE(survey.topology.watertight());
  EXPECT_EQ(survey.topology.genus(), 0);
  EXPECT_EQ(survey.components[0].vertices, ball.positions.rows());
}

TEST(MeshDefects, ComponentsTellTheirShareOfTheVolume) {
  const Mesh big = make_bar({1, 1, 3}, {1, 1, 3});
  const Mesh small = mapped(make_bar({1, 1, 1}, {1, 1, 1}),
                            [](const Vec3& x) -> Vec3 { return x + Vec3(4, 0, 0); });
  const MeshSurvey survey = survey_mesh(joined(small, big));
  ASSERT_EQ(survey.components.size(), 2u);
  EXPECT_NEAR(survey.components[0].volume, 3, 1e-12);
  EXPECT_NEAR(survey.components[0].volume_share, 0.75, 1e-12);
  EXPECT_NEAR(survey.components[1].area, 6, 1e-12);
  EXPECT_EQ(survey.components[1].faces, 12);
  EXPECT_NEAR(survey.components[1].box.lower.x(), 4, 1e-12);
}

/// What the table beside the shared meshes says of a file: "54 non-manifold edges".
long table_count(const std::string& state, const std::string& words) {
  std::smatch match;
  if (!std::regex_search(state, match, std::regex("(\\d+) " + words))) return 0;
  return std::stol(match[1]);
}

/// Counts made by another program, with exact arithmetic.
TEST(MeshDefects, AgreeWithTheTableOfTheSharedMeshes) {
  const std::filesystem::path folder = std::filesystem::path(SUPPLE_SHARED_DATA) / "data";
  std::ifstream table(folder / "README.md");
  if (!table) GTEST_SKIP() << "skipped: no shared data";
  // Their counts depend on how polygons are cut into triangles.
  const std::set<std::string> others = {"spot_quads.obj", "office_chair_ngons.obj"};
  constexpr long most_faces = 40000;  // the test shall be short
  int files = 0;
  const std::regex row(
      "^\\| (\\S+\\.(?:obj|off|ply|stl)) \\| [^|]* \\| (\\d+) \\| (\\d+) \\| ([^|]*) \\|.*");
  std::smatch cells;
  for (std::string line; std::getline(table, line);) {
    if (!std::regex_match(line, cells, row) || others.contains(cells[1])) continue;
    if (std::stol(cells[3]) > most_faces) continue;
    const std::string name = cells[1], state = cells[4];
    const MeshSurvey survey = survey_mesh(read_mesh(folder / name));
    EXPECT_EQ(survey.faces, std::stol(cells[3])) << name;
    if (!survey.loose) {
      EXPECT_EQ(survey.vertices, std::stol(cells[2])) << name;
    }
    const std::pair<DefectKind, std::string> kinds[] = {
        {DefectKind::boundary_edges, "boundary edges"},
        {DefectKind::nonmanifold_edges, "non-manifold edges"},
        {DefectKind::nonmanifold_vertices, "non-manifold vertices"},
        {DefectKind::inconsistent_edges, "inconsistent edges"},
        {DefectKind::duplicate_faces, "duplicate faces"},
        {DefectKind::zero_area_triangles, "zero-area triangles"},
        {DefectKind::unreferenced_vertices, "unreferenced vertices"},
        {DefectKind::duplicated_vertices, "duplicated vertices"},
        {DefectKind::self_intersections, "self-intersecting triangle pairs"}};
    for (const auto& [kind, words] : kinds)
      EXPECT_EQ(survey.defect(kind).count, table_count(state, words)) << name << ": " << words;
    EXPECT_EQ(survey.topology.watertight(), state.find("not watertight") == state.npos) << name;
    EXPECT_EQ(survey.topology.components, std::max(1L, table_count(state, "pieces"))) << name;
    std::smatch genus;
    if (std::regex_search(state, genus, std::regex("genus (\\d+)"))) {
      EXPECT_EQ(survey.topology.genus(), std::stol(genus[1])) << name;
    }
    ++files;
  }
  EXPECT_GT(files, 40);
}

}  // namespace
}  // namespace supple
