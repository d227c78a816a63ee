#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "io/mesh/mesh.h"
#include "solver/core/random.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

using Chain = std::map<std::pair<int, int>, int>;

void add_edge(Chain& chain, int a, int b) {
  if (a == b) return;
  const int sign = a < b ? 1 : -1;
  const std::pair<int, int> edge = std::minmax(a, b);
  if ((chain[edge] += sign) == 0) chain.erase(edge);
}

/// Sum of the directed edges of all faces.
Chain boundary(const Mesh& mesh) {
  Chain chain;
  for (int face = 0; face < mesh.face_count(); ++face)
    for (int k = 0; k < mesh.face_size(face); ++k)
      add_edge(chain, mesh.face_vertices[mesh.face_starts[face] + k],
               mesh.face_vertices[mesh.face_starts[face] + (k + 1) % mesh.face_size(face)]);
  return chain;
}

Chain boundary(const Triangles& triangles) {
  Chain chain;
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) add_edge(chain, triangles(t, k), triangles(t, (k + 1) % 3));
  return chain;
}

/// Twice the area of every triangle, seen along z.
std::vector<double> areas(const Mesh& mesh, const Triangles& triangles) {
  std::vector<double> result;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = mesh.positions.row(triangles(t, 0)), b = mesh.positions.row(triangles(t, 1)),
               c = mesh.positions.row(triangles(t, 2));
    result.push_back((b - a).cross(c - a).z());
  }
  return result;
}

Mesh polygon(const std::vector<Vec3>& points) {
  std::vector<int> corners;
  for (std::size_t i = 0; i < points.size(); ++i) corners.push_back(static_cast<int>(i));
  return make_mesh(points, {corners});
}

/// A back with `teeth` teeth that point down: 4·teeth + 2 corners, half of them reflex.
std::vector<Vec3> comb(int teeth) {
  std::vector<Vec3> points;
  for (int i = 0; i < teeth; ++i) {
    points.emplace_back(2 * i, 0, 0);
    points.emplace_back(2 * i + 1, 0, 0);
    points.emplace_back(2 * i + 1, 3, 0);
    points.emplace_back(2 * i + 2, 3, 0);
  }
  points.emplace_back(2 * teeth, 4, 0);
  points.emplace_back(0, 4, 0);
  return points;
}

double shoelace(const std::vector<Vec3>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += points[i].cross(points[(i + 1) % points.size()]).z();
  return sum;
}

/// All triangles turn like the polygon and their areas add up to its own: no overlap, no gap.
void expect_exact_cover(const std::vector<Vec3>& points) {
  const Mesh mesh = polygon(points);
  const Triangulation result = triangulate(mesh);
  EXPECT_EQ(result.triangles.rows(), static_cast<Index>(points.size()) - 2);
  EXPECT_EQ(boundary(mesh), boundary(result.triangles));
  double sum = 0;
  for (const double area : areas(mesh, result.triangles)) {
    EXPECT_GE(area, 0);
    sum += area;
  }
  EXPECT_NEAR(sum, shoelace(points), 1e-12 * std::abs(sum));
}

TEST(Triangulate, TrianglesStayAsTheyAre) {
  const Mesh mesh = make_icosphere(1, 3);
  const Triangulation result = triangulate(mesh);
  EXPECT_EQ(result.triangles, triangles_of(mesh));
  for (int face = 0; face < mesh.face_count(); ++face) EXPECT_EQ(result.faces[face], face);
}

TEST(Triangulate, ClosedPolygonsGiveClosedTriangles) {
  const Mesh mesh = make_quad_bar({1, 2, 3}, {3, 4, 5});
  const Triangulation result = triangulate(mesh);
  EXPECT_EQ(result.triangles.rows(), 2 * mesh.face_count());
  EXPECT_TRUE(is_closed(result.triangles));
  EXPECT_NEAR(enclosed_volume(mesh.positions, result.triangles), 6, 1e-12);
  for (std::size_t t = 0; t < result.faces.size(); ++t)
    EXPECT_EQ(result.faces[t], static_cast<int>(t / 2));
}

TEST(Triangulate, QuadTakesTheShorterDiagonal) {
  const Mesh mesh = polygon({{0, 0, 0}, {3, -1, 0}, {6, 0, 0}, {3, 1, 0}});
  const Triangles triangles = triangulate(mesh).triangles;
  ASSERT_EQ(triangles.rows(), 2);
  EXPECT_TRUE((triangles.row(0).array() == 1).any() && (triangles.row(0).array() == 3).any());
  EXPECT_TRUE((triangles.row(1).array() == 1).any() && (triangles.row(1).array() == 3).any());
}

TEST(Triangulate, ConcaveQuadTakesTheDiagonalInside) {
  const std::vector<Vec3> arrow = {{0, 0, 0}, {4, 1, 0}, {0, 2, 0}, {3, 1, 0}};
  for (std::size_t turn = 0; turn < 4; ++turn) {
    std::vector<Vec3> points = arrow;
    std::rotate(points.begin(), points.begin() + static_cast<long>(turn), points.end());
    expect_exact_cover(points);
  }
}

TEST(Triangulate, ConcavePolygons) {
  expect_exact_cover({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
  expect_exact_cover(comb(1));
  expect_exact_cover(comb(7));
  std::vector<Vec3> star;
  for (int i = 0; i < 24; ++i) {
    const double angle = std::numbers::pi * i / 12, radius = i % 2 ? 1 : 3;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  expect_exact_cover(star);
}

TEST(Triangulate, PointsOnTheSides) {
  expect_exact_cover(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

TEST(Triangulate, EveryPlaneAndSense) {
  const std::vector<Vec3> flat = comb(3);
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1), Vec3(1, 2, -3)}) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal.normalized());
    std::vector<Vec3> points;
    for (const Vec3& p : flat) points.push_back(turn * p + Vec3(100, -50, 7));
    const Mesh mesh = polygon(points);
    const Triangles triangles = triangulate(mesh).triangles;
    Mesh back = mesh;
    for (Index i = 0; i < back.positions.rows(); ++i)
      back.positions.row(i) = flat[static_cast<std::size_t>(i)].transpose();
    double sum = 0;
    for (const double area : areas(back, triangles)) sum += std::abs(area);
    EXPECT_NEAR(sum, shoelace(flat), 1e-9);
  }
}

TEST(Triangulate, HoleByABridge) {
  // A square with a square hole: the bridge 3-4 is walked both ways.
  const Mesh mesh = make_mesh(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}},
      {{0, 1, 2, 3, 4, 5, 6, 7, 4, 3}});
  const Triangles triangles = triangulate(mesh).triangles;
  EXPECT_EQ(boundary(mesh), boundary(triangles));
  double sum = 0;
  for (const double area : areas(mesh, triangles)) {
    EXPECT_GE(area, 0);
    sum += area;
  }
  EXPECT_NEAR(sum, 2 * (16 - 4), 1e-12);
}

TEST(Triangulate, AnyPolygonKeepsItsBoundary) {
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const int points = 3 + static_cast<int>(random.uniform() * 6);
    const int corners = 3 + static_cast<int>(random.uniform() * 9);
    std::vector<Vec3> positions;
    // Coarse coordinates make coinciding and collinear points common.
    for (int i = 0; i < points; ++i)
      positions.push_back(random.in_cube(0, 3).array().floor().matrix());
    std::vector<int> face;
    for (int k = 0; k < corners; ++k) face.push_back(static_cast<int>(random.uniform() * points));
    const Mesh mesh = make_mesh(positions, {face});
    const Triangles triangles = triangulate(mesh).triangles;
    ASSERT_EQ(boundary(mesh), boundary(triangles)) << trial;
    for (Index t = 0; t < triangles.rows(); ++t) {
      ASSERT_NE(triangles(t, 0), triangles(t, 1));
      ASSERT_NE(triangles(t, 1), triangles(t, 2));
      ASSERT_NE(triangles(t, 2), triangles(t, 0));
    }
  }
}

TEST(Triangulate, FacesThatRepeatAVertexVanish) {
  const Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                              {{0, 0, 1}, {0, 1, 2}, {0, 1, 0, 1}, {2, 2, 2}, {0, 1, 1, 2}});
  const Triangulation result = triangulate(mesh);
  EXPECT_EQ(result.faces, (std::vector<int>{1, 4}));
  EXPECT_EQ(result.triangles.rows(), 2);
}

TEST(Triangulate, LargePolygonsEnd) {
  expect_exact_cover(comb(1000));
}

TEST(Triangulate, NoFaces) {
  EXPECT_EQ(triangulate(make_mesh({{0, 0, 0}}, {})).triangles.rows(), 0);
}

}  // namespace
}  // namespace supple
