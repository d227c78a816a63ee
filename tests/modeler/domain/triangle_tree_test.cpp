#include "modeler/domain/triangle_tree.h"

#include <cmath>

#include <gtest/gtest.h>

#include "modeler/domain/mesh_region.h"
#include "solver/core/random.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const Mesh& mesh, int t) {
  Corners corners;
  for (int k = 0; k < 3; ++k) corners[k] = mesh.positions.row(mesh.face_vertices[3 * t + k]);
  return corners;
}

/// Girard: the signed area of the spherical triangle, from its angles.
double solid_angle(const Corners& corners, const Vec3& x) {
  const Vec3 a = (corners[0] - x).normalized(), b = (corners[1] - x).normalized(),
             c = (corners[2] - x).normalized();
  const auto angle = [](const Vec3& at, const Vec3& p, const Vec3& q) {
    const Vec3 u = at.cross(p), v = at.cross(q);
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  const double area = angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - std::numbers::pi;
  return a.dot(b.cross(c)) > 0 ? area : -area;
}

/// Distance to a triangle by a search over barycentric coordinates that narrows down.
double distance_by_search(const Corners& t, const Vec3& x) {
  double u = 1.0 / 3, v = 1.0 / 3, step = 0.5;
  const auto distance = [&](double p, double q) {
    if (p < 0 || q < 0 || p + q > 1) return std::numeric_limits<double>::infinity();
    return (t[0] + p * (t[1] - t[0]) + q * (t[2] - t[0]) - x).norm();
  };
  double best = distance(u, v);
  while (step > 1e-9) {
    bool better = false;
    for (auto [du, dv] :
         {std::pair{1., 0.}, {-1., 0.}, {0., 1.}, {0., -1.}, {1., -1.}, {-1., 1.}}) {
      const double d = distance(u + step * du, v + step * dv);
      if (d >= best) continue;
      best = d, u += step * du, v += step * dv;
      better = true;
      break;
    }
    if (!better) step *= 0.5;
  }
  return best;
}

TEST(TriangleTree, ClosestPointIsThatOfAllTriangles) {
  const Mesh mesh = make_icosphere(1, 1);
  const TriangleTree tree(mesh.positions, triangles_of(mesh));
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 x = random.in_cube(-2, 2);
    double expected = std::numeric_limits<double>::infinity();
    for (int t = 0; t < mesh.face_count(); ++t)
      expected = std::min(expected, distance_by_search(corners_of(mesh, t), x));
    const ClosestPoint closest = tree.closest(x);
    EXPECT_NEAR(std::sqrt(closest.squared_distance), expected, 1e-6);
    EXPECT_NEAR((closest.point - x).squaredNorm(), closest.squared_distance, 1e-12);
    EXPECT_NEAR(distance_by_search(corners_of(mesh, closest.triangle), x), expected, 1e-6);
  }
}

TEST(TriangleTree, ClosestPointOfSliversLinesAndPoints) {
  Points points(6, 3);
  points << 0, 0, 0, 1, 0, 0, 0.5, 1e-9, 0, 0.5, 0, 0, 0, 0, 5, 0, 0, 5;
  Triangles triangles(3, 3);
  triangles << 0, 1, 2, 0, 3, 1, 4, 5, 4;
  const TriangleTree tree(points, triangles);
  EXPECT_NEAR(std::sqrt(tree.closest({0.25, 2, 0}).squared_distance), 2, 1e-8);
  EXPECT_NEAR(std::sqrt(tree.closest({-3, 0, 0}).squared_distance), 3, 1e-12);
  EXPECT_NEAR(std::sqrt(tree.closest({0, 0, 6}).squared_distance), 1, 1e-12);
}

TEST(TriangleTree, WindingNumberIsTheSumOfSolidAngles) {
  const Mesh torus = make_torus(1, 0.4, 48, 24);
  const TriangleTree tree(torus.positions, triangles_of(torus));
  Random random(5);
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 x = random.in_cube(-1.6, 1.6);
    double exact = 0;
    for (int t = 0; t < torus.face_count(); ++t) exact += solid_angle(corners_of(torus, t), x);
    exact /= 4 * std::numbers::pi;
    EXPECT_NEAR(exact, std::round(exact), 1e-9);
    worst = std::max(worst, std::abs(tree.winding_number(x) - exact));
  }
  EXPECT_LT(worst, 0.1);
}

TEST(TriangleTree, OpenSheetHasHalfTheWindingNearIt) {
  Points points(4, 3);
  points << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const TriangleTree tree(points, triangles);
  EXPECT_NEAR(tree.winding_number({0.1, 0.2, -1e-6}), 0.5, 1e-5);
  EXPECT_NEAR(tree.winding_number({0.1, 0.2, 1e-6}), -0.5, 1e-5);
}

TEST(TriangleTree, CrossingsAddUpToTheChangeOfTheWindingNumber) {
  const Mesh torus = make_torus(1, 0.4, 48, 24);
  const TriangleTree tree(torus.positions, triangles_of(torus));
  Random random(6);
  std::vector<Crossing> crossings;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random.in_cube(-1.5, 1.5), b = random.in_cube(-1.5, 1.5);
    tree.crossings(a, b, crossings);
    int change = 0;
    for (const Crossing& crossing : crossings) change += crossing.outward ? -1 : 1;
    EXPECT_EQ(change, std::round(tree.winding_number(b)) - std::round(tree.winding_number(a)));
    for (const Crossing& crossing : crossings)
      EXPECT_LT(tree.closest(a + crossing.share * (b - a)).squared_distance, 1e-24);
  }
}

}  // namespace
}  // namespace supple
