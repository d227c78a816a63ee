#include "modeler/domain/mesh_region.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "modeler/domain/shape_error.h"
#include "solver/core/random.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

/// Distance to the box [0, size], negative inside.
double box_distance(const Vec3& size, const Vec3& x) {
  const Vec3 out = (x - 0.5 * size).cwiseAbs() - 0.5 * size;
  return out.cwiseMax(0).norm() + std::min(out.maxCoeff(), 0.0);
}

std::string refusal(const Mesh& mesh) {
  try {
    region_of(mesh);
  } catch (const ShapeError& error) {
    return error.what();
  }
  return "";
}

TEST(MeshRegion, BoxIsExactAtAllScalesAndFarAway) {
  const Vec3 size(1, 2, 0.5);
  for (double scale : {1e-9, 1.0, 1e9})
    for (double offset : {0.0, 1e6}) {
      const Vec3 shift = Vec3(1, -2, 3) * offset * scale;
      const MeshRegion region = region_of(mapped(
          make_bar(size, {3, 2, 1}), [&](const Vec3& x) -> Vec3 { return scale * x + shift; }));
      const double slack = offset > 0 ? 1e-9 : 1e-13;
      EXPECT_NEAR(region.volume() / std::pow(scale, 3), 1, 10 * slack);
      Random random(7);
      for (int i = 0; i < 300; ++i) {
        const Vec3 x = random.in_cube(-1, 3);
        const double expected = box_distance(size, x);
        EXPECT_NEAR(region.signed_distance(scale * x + shift) / scale, expected, slack);
        EXPECT_EQ(region.contains(scale * x + shift), expected < 0);
      }
      EXPECT_NEAR((region.bounds().size() / scale - size).norm(), 0, slack);
    }
}

TEST(MeshRegion, IcosphereAndTorusComeCloseToTheirSmoothShapes) {
  const Mesh ball = make_icosphere(1, 4);
  const MeshRegion sphere = region_of(ball);
  EXPECT_NEAR(sphere.volume(), 4 * std::numbers::pi / 3, 0.01);
  EXPECT_NEAR(sphere.signed_distance(Vec3::Zero()), -1, 3e-3);
  EXPECT_NEAR(sphere.signed_distance({0, 3, 0}), 2, 3e-3);

  const MeshRegion torus = region_of(make_torus(2, 0.5, 192, 96));
  EXPECT_NEAR(torus.volume(), 2 * std::numbers::pi * std::numbers::pi * 2 * 0.25, 0.01);
  EXPECT_NEAR(torus.signed_distance({2, 0, 0}), -0.5, 1e-3);
  EXPECT_NEAR(torus.signed_distance({0, 0, 0}), 1.5, 1e-3);
}

TEST(MeshRegion, DistanceHasAGradientOfUnitLength) {
  const MeshRegion region = region_of(make_torus(1, 0.4, 48, 24));
  Random random(11);
  int asked = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 x = random.in_cube(-1.6, 1.6);
    const double d = region.signed_distance(x);
    const Vec3 normal = (x - region.closest_boundary_point(x)) / d;
    EXPECT_NEAR(normal.norm(), 1, 1e-12);
    if (std::abs(d) < 0.01) continue;
    const double step = 1e-4;
    const double slope =
        (region.signed_distance(x + step * normal) - region.signed_distance(x - step * normal)) /
        (2 * step);
    asked += std::abs(slope - 1) < 1e-6 ? 1 : 0;
  }
  EXPECT_GT(asked, 350);  // all but those on the medial axis or next to the boundary
}

TEST(MeshRegion, CavityIsOutside) {
  const Mesh hollow = joined(make_icosphere(1, 3), turned(make_icosphere(0.5, 3)));
  const MeshRegion region = region_of(hollow);
  EXPECT_FALSE(region.contains({0, 0, 0}));
  EXPECT_TRUE(region.contains({0.75, 0, 0}));
  EXPECT_NEAR(region.signed_distance({0, 0, 0}), 0.5, 0.01);
  EXPECT_NEAR(region.signed_distance({0.75, 0, 0}), -0.25, 0.01);
  EXPECT_NEAR(region.volume() / (4 * std::numbers::pi / 3 * (1 - 0.125)), 1, 0.02);
}

TEST(MeshRegion, OverlappingPartsAreInside) {
  const auto shifted = [](const Vec3& x) -> Vec3 { return x + Vec3(0.5, 0.25, 0.25); };
  const Mesh box = make_bar({1, 1, 1}, {1, 1, 1});
  const MeshRegion region = region_of(joined(box, mapped(box, shifted)));
  EXPECT_TRUE(region.contains({0.75, 0.5, 0.5}));
  EXPECT_NEAR(region.winding_number({0.75, 0.5, 0.5}), 2, 0.1);
  EXPECT_TRUE(region.contains({1.4, 0.5, 0.5}));
}

TEST(MeshRegion, InsideOutIsTurned) {
  const MeshRegion region = region_of(turned(make_bar({1, 1, 1}, {2, 2, 2})));
  EXPECT_TRUE(region.defects().inside_out);
  EXPECT_TRUE(region.contains({0.5, 0.5, 0.5}));
  EXPECT_NEAR(region.volume(), 1, 1e-12);
  EXPECT_FALSE(region_of(make_bar({1, 1, 1}, {2, 2, 2})).defects().inside_out);
}

TEST(MeshRegion, PartThatIsInsideOutIsTurnedButNoCavity) {
  const Mesh box = make_bar({1, 1, 1}, {1, 1, 1});
  const auto beside = [](const Vec3& x) -> Vec3 { return 0.5 * x + Vec3(2, 0, 0); };
  const auto within = [](const Vec3& x) -> Vec3 { return 0.5 * x + Vec3(0.25, 0.25, 0.25); };
  const MeshRegion two = region_of(joined(box, turned(mapped(box, beside))));
  EXPECT_TRUE(two.defects().inside_out);
  EXPECT_TRUE(two.contains({2.25, 0.25, 0.25}));
  EXPECT_NEAR(two.volume(), 1.125, 1e-12);
  const MeshRegion hollow = region_of(joined(box, turned(mapped(box, within))));
  EXPECT_FALSE(hollow.defects().inside_out);
  EXPECT_NEAR(hollow.volume(), 0.875, 1e-12);
}

TEST(MeshRegion, VerticesAtOnePlaceAreOneAndDegenerateFacesAreCounted) {
  const Mesh bar = make_bar({1, 1, 1}, {1, 1, 1});
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int vertex : bar.face_vertices) {
    if (points.size() % 3 == 0) faces.push_back({});
    faces.back().push_back(static_cast<int>(points.size()));
    points.push_back(bar.positions.row(vertex));
  }
  faces.push_back({0, 0, 1});  // a vertex twice
  const int middle = static_cast<int>(points.size());
  points.push_back(0.5 * (points[0] + points[1]));
  faces.push_back({0, 1, middle});     // no area
  points.emplace_back(100, 100, 100);  // unused
  const MeshRegion region = region_of(make_mesh(points, faces));
  EXPECT_EQ(region.defects().degenerate_faces, 2);
  EXPECT_NEAR(region.volume(), 1, 1e-12);
  EXPECT_NEAR(region.bounds().diagonal(), std::sqrt(3), 1e-12);
}

TEST(MeshRegion, TwoCubesThatShareAnEdgeAreClosed) {
  const Mesh box = make_bar({1, 1, 1}, {1, 1, 1});
  const auto across = [](const Vec3& x) -> Vec3 { return x + Vec3(1, 1, 0); };
  const MeshRegion region = region_of(joined(box, mapped(box, across)));
  EXPECT_NEAR(region.volume(), 2, 1e-12);
  EXPECT_TRUE(region.contains({1.5, 1.5, 0.5}));
  EXPECT_FALSE(region.contains({1.5, 0.5, 0.5}));
}

TEST(MeshRegion, SmallHolesAreFilled) {
  Random random(5);
  const Mesh torus = make_torus(1, 0.4, 48, 24);
  const MeshRegion whole = region_of(torus);
  const MeshRegion holed =
      region_of(without(torus, [&](const Vec3&) { return random.uniform() < 0.05; }));
  EXPECT_GT(holed.defects().small_holes, 20);
  EXPECT_NEAR(holed.volume() / whole.volume(), 1, 2e-3);
  EXPECT_NEAR(holed.cover().covered, 0.95, 0.02);
  EXPECT_TRUE(holed.contains({1, 0, 0}));
}

TEST(MeshRegion, ALidIsPutOnABoxWithoutOne) {
  const MeshRegion box = region_of(
      without(make_bar({1, 1, 2}, {8, 8, 16}), [](const Vec3& x) { return x.z() > 1.99; }));
  EXPECT_NEAR(box.volume(), 2, 0.02);
  EXPECT_NEAR(box.cover().covered, 0.9, 0.01);
  EXPECT_NEAR(box.cover().greatest_opening, 0.1, 0.01);
  EXPECT_NEAR(box.signed_distance({0.5, 0.5, 1.8}), -0.2, 0.02);
  EXPECT_NEAR(box.signed_distance({0.5, 0.5, 2.4}), 0.4, 0.02);
  EXPECT_TRUE(connects(box, {0.5, 0.5, 0.5}, {0.2, 0.7, 1.9}));
  EXPECT_FALSE(connects(box, {0.5, 0.5, 0.5}, {0.5, 0.5, 2.5}));
}

TEST(MeshRegion, TheBoundaryIsCarriedAlong) {
  const Mesh mesh =
      without(make_bar({1, 1, 2}, {8, 8, 16}), [](const Vec3& x) { return x.z() > 1.99; });
  const MeshRegion region = region_of(mesh);
  const CarriedBoundary boundary = region.boundary();
  EXPECT_GT(boundary.extra.rows(), 0);
  EXPECT_NEAR(enclosed_volume(boundary, mesh.positions, boundary.extra), region.volume(), 1e-12);
  EXPECT_NEAR(enclosed_volume(boundary, 2 * mesh.positions, 2 * boundary.extra),
              8 * region.volume(), 1e-12);
}

TEST(MeshRegion, FacesThatDisagreeAreTurned) {
  Mesh bar = make_bar({1, 1, 1}, {2, 2, 2});
  std::swap(bar.face_vertices[0], bar.face_vertices[1]);
  const MeshRegion one = region_of(bar);
  EXPECT_EQ(one.defects().turned_faces, 1);
  EXPECT_FALSE(one.defects().inside_out);
  EXPECT_NEAR(one.volume(), 1, 1e-12);

  const Mesh hollow = joined(make_icosphere(1, 3), turned(make_icosphere(0.5, 3)));
  for (double chance : {0.05, 0.5})
    EXPECT_NEAR(
        region_of(turned_at_random(hollow, chance, 3)).volume() / region_of(hollow).volume(), 1,
        1e-12);
}

TEST(MeshRegion, OpenSurfacesTurnOutwards) {
  const Mesh ball = without(make_icosphere(1, 4), [](const Vec3& x) { return x.z() > 0.7; });
  const double volume = region_of(ball).volume();
  const MeshRegion inverted = region_of(turned(ball));
  EXPECT_TRUE(inverted.defects().inside_out);
  EXPECT_NEAR(inverted.volume() / volume, 1, 1e-12);
  EXPECT_TRUE(inverted.contains({0, 0, 0}));
}

TEST(MeshRegion, DoubledFacesCountOnce) {
  const Mesh ball = make_icosphere(1, 3);
  const MeshRegion once = region_of(ball), twice = region_of(joined(ball, ball));
  EXPECT_EQ(twice.defects().duplicate_faces, ball.face_count());
  EXPECT_EQ(twice.volume(), once.volume());
}

TEST(MeshRegion, OverlapsAreOneWallsThatTouchAreNot) {
  const Mesh box = make_bar({1, 1, 1}, {1, 1, 1});
  const auto beside = [&](double x) {
    return region_of(
        joined(box, mapped(box, [x](const Vec3& p) -> Vec3 { return p + Vec3(x, 0.25, 0.25); })));
  };
  const Vec3 left(0.3, 0.6, 0.6), right(1.4, 0.6, 0.6);
  const MeshRegion overlapping = beside(0.5);
  EXPECT_TRUE(connects(overlapping, left, right));
  EXPECT_NEAR(overlapping.volume(), 2 - 0.5 * 0.75 * 0.75, 0.02);
  EXPECT_GT(overlapping.cover().contact.other, 0.1);
  EXPECT_EQ(overlapping.cover().contact.own, 0);
  // To the edges where a side of one goes into the other, not to the sides within.
  EXPECT_NEAR(overlapping.signed_distance({0.75, 0.6, 0.6}), -std::hypot(0.25, 0.35), 0.01);
  const MeshRegion touching = beside(1);
  EXPECT_FALSE(connects(touching, left, right));
  EXPECT_TRUE(connects(touching, left, {0.9, 0.6, 0.6}));
  EXPECT_FALSE(connects(beside(1.1), left, right));
}

TEST(MeshRegion, WallsThatAreTheSameTrianglesSeparate) {
  const Mesh box = make_bar({1, 1, 1}, {2, 2, 2});
  const MeshRegion region =
      region_of(joined(box, mapped(box, [](const Vec3& x) -> Vec3 { return x + Vec3(1, 0, 0); })));
  EXPECT_NEAR(region.volume(), 2, 1e-12);
  EXPECT_FALSE(connects(region, {0.5, 0.4, 0.45}, {1.5, 0.4, 0.45}));
  EXPECT_TRUE(connects(region, {0.1, 0.4, 0.45}, {0.9, 0.4, 0.45}));
  EXPECT_GT(region.cover().contact.own, 0.1);  // they share vertices, so they are one part
}

TEST(MeshRegion, PartsKnowTheirParticles) {
  const Mesh ball = make_icosphere(1, 2);
  const auto small = [](const Vec3& x) -> Vec3 { return 0.5 * x + Vec3(3, 0, 0); };
  const MeshRegion region = region_of(joined(ball, mapped(ball, small)));
  Points points(3, 3);
  points << 0, 0, 0, 0.5, 0.1, 0, 0, -0.5, 0.3;
  const std::vector<MeshPart> parts = region.parts(points);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].particles, 3);
  EXPECT_EQ(parts[1].particles, 0);
  EXPECT_NEAR(parts[1].volume_share, 1.0 / 9, 1e-12);
}

TEST(MeshRegion, OpenSurfaceIsRefusedWithWords) {
  const Mesh bowl = without(make_icosphere(1, 4), [](const Vec3& x) { return x.z() > 0; });
  const std::string words = refusal(bowl);
  for (const char* part : {"open surface: ", " boundary edges, for example at vertex ", "takes 3",
                           "shell (not available yet)"})
    EXPECT_NE(words.find(part), std::string::npos) << words;
  const Mesh sheet =
      make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_NE(refusal(sheet).find("open surface"), std::string::npos) << refusal(sheet);
}

TEST(MeshRegion, NoVolumeIsRefusedWithWords) {
  const std::vector<Vec3> quad = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Mesh doubled = make_mesh(quad, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}});
  const auto to_a_point = [](const Vec3&) -> Vec3 { return {1, 1, 1}; };
  for (const Mesh& mesh : {doubled, mapped(doubled, to_a_point), make_mesh(quad, {})})
    EXPECT_NE(refusal(mesh).find("zero volume"), std::string::npos) << refusal(mesh);
}

TEST(MeshRegion, ThinPlateHasAVolume) {
  EXPECT_NEAR(region_of(make_bar({100, 100, 1e-3}, {4, 4, 1})).volume(), 10, 1e-9);
}

}  // namespace
}  // namespace supple
