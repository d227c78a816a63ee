#include "modeler/domain/self_intersections.h"

#include <gtest/gtest.h>

#include "tests/support/region_shapes.h"

namespace supple {
namespace {

SelfIntersections intersections_of(const Mesh& mesh, const SelfIntersectionOptions& options = {}) {
  return self_intersections(mesh.positions, triangles_of(mesh), options);
}

Mesh shifted(const Mesh& mesh, const Vec3& by) {
  return mapped(mesh, [&](const Vec3& x) -> Vec3 { return x + by; });
}

TEST(SelfIntersections, NeighboursThatShareVerticesAndEdgesDoNotCount) {
  EXPECT_EQ(intersections_of(make_icosphere(1, 3)).count, 0);
  EXPECT_EQ(intersections_of(make_bar({1, 2, 3}, {3, 4, 5})).count, 0);  // flat faces
  EXPECT_EQ(intersections_of(make_torus(1, 0.3, 24, 12)).count, 0);
}

TEST(SelfIntersections, TwoTrianglesMeetOrMiss) {
  const auto count = [](const std::vector<Vec3>& points) {
    return intersections_of(make_mesh(points, {{0, 1, 2}, {3, 4, 5}})).count;
  };
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_EQ(count({a, b, c, {1, 1, -1}, {1, 1, 1}, {1, 2, 1}}), 1) << "pierced";
  EXPECT_EQ(count({a, b, c, {1, 1, 0}, {1, 1, 1}, {1, 2, 1}}), 1) << "touched by a corner";
  EXPECT_EQ(count({a, b, c, {1, 1, 1e-16}, {1, 1, 1}, {1, 2, 1}}), 0) << "nearly touched";
  EXPECT_EQ(count({a, b, c, {3, 3, -1}, {3, 3, 1}, {3, 4, 1}}), 0) << "beside it";
  EXPECT_EQ(count({a, b, c, {1, 1, 0}, {2, 1, 0}, {1, 2, 0}}), 1) << "inside it, in its plane";
  EXPECT_EQ(count({a, b, c, {-1, 1, 0}, {5, 1, 0}, {5, 2, 0}}), 1) << "across it, in its plane";
  EXPECT_EQ(count({a, b, c, {3, 3, 0}, {5, 3, 0}, {3, 5, 0}}), 0) << "beside it, in its plane";
}

TEST(SelfIntersections, TrianglesThatShareAVertexOrAnEdge) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  const auto sharing = [&](const Vec3& d, const Vec3& e) {
    return intersections_of(make_mesh({a, b, c, d, e}, {{0, 1, 2}, {0, 3, 4}})).count;
  };
  EXPECT_EQ(sharing({1, 1, 1}, {1, 1, -1}), 1) << "goes through from the shared corner";
  EXPECT_EQ(sharing({-1, -1, 1}, {-1, -1, -1}), 0);
  EXPECT_EQ(sharing({1, 0.5, 0}, {0.5, 1, 0}), 1) << "in its plane";
  const auto hinged = [&](const Vec3& d) {
    return intersections_of(make_mesh({a, b, c, d}, {{0, 1, 2}, {1, 0, 3}})).count;
  };
  EXPECT_EQ(hinged({1, 1, 1e-9}), 0);
  EXPECT_EQ(hinged({1, 1, 0}), 1) << "folded over";
  EXPECT_EQ(hinged({1, -1, 0}), 0);
}

TEST(SelfIntersections, CopiesAndTrianglesWithoutAreaDoNotCount) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}};
  EXPECT_EQ(intersections_of(make_mesh(points, {{0, 1, 2}, {2, 1, 0}, {0, 3, 1}})).count, 0);
}

/// Two balls that pass through each other along a circle.
TEST(SelfIntersections, DoNotDependOnUnitsOrOrder) {
  const Mesh ball = make_icosphere(1, 3);
  const Mesh two = joined(ball, shifted(ball, {0.7, 0.31, 0.17}));
  const long count = intersections_of(two).count;
  EXPECT_GT(count, 80);
  for (const double scale : {0x1p-60, 0x1p60}) {
    const Mesh scaled = mapped(two, [&](const Vec3& x) -> Vec3 { return scale * x; });
    EXPECT_EQ(intersections_of(scaled).count, count) << scale;
  }
  const Mesh other = joined(shifted(ball, {0.7, 0.31, 0.17}), ball);
  EXPECT_EQ(intersections_of(other).count, count);
  EXPECT_EQ(intersections_of(turned(two)).count, count);
}

TEST(SelfIntersections, PairsNameTrianglesThatMeet) {
  const Mesh ball = make_icosphere(1, 2);
  const Mesh two = joined(ball, shifted(ball, {1, 0, 0}));
  const SelfIntersections found = intersections_of(two, {.most_pairs = 3});
  ASSERT_EQ(found.pairs.size(), 3u);
  EXPECT_EQ(found.tested, 1);
  for (const auto& [s, t] : found.pairs) {
    EXPECT_LT(s, ball.face_count());
    EXPECT_GE(t, ball.face_count());
  }
}

TEST(SelfIntersections, OfTooManyOnlyASampleIsTested) {
  Mesh heap = make_icosphere(1, 1);  // sixty balls nearly at one place
  const Mesh ball = heap;
  for (int k = 1; k < 60; ++k) heap = joined(heap, shifted(ball, {0.002 * k, 0.001 * k, 0}));
  const SelfIntersections all = intersections_of(heap);
  const SelfIntersections some = intersections_of(heap, {.most_candidates = 1e5});
  EXPECT_EQ(all.tested, 1);
  EXPECT_LT(some.tested, 0.5);
  EXPECT_NEAR(double(some.count) / double(all.count), 1, 0.1);
}

}  // namespace
}  // namespace supple
