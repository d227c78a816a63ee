#include "modeler/domain/mesh_region.h"

#include <cmath>

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

TEST(MeshRegion, OpenSurfaceIsRefusedWithWords) {
  Mesh bar = make_bar({1, 1, 1}, {2, 2, 2});
  bar.face_vertices.resize(bar.face_vertices.size() - 3);
  bar.face_starts.pop_back();
  const std::string words = refusal(bar);
  EXPECT_NE(words.find("open: 3 boundary edges, for example at vertex "), std::string::npos)
      << words;
  EXPECT_NE(words.find("fill the holes"), std::string::npos) << words;
}

TEST(MeshRegion, FacesThatDisagreeAreRefusedWithWords) {
  Mesh bar = make_bar({1, 1, 1}, {2, 2, 2});
  std::swap(bar.face_vertices[0], bar.face_vertices[1]);
  const std::string words = refusal(bar);
  EXPECT_NE(words.find("at 3 edges"), std::string::npos) << words;
  EXPECT_NE(words.find("normals consistent"), std::string::npos) << words;
}

TEST(MeshRegion, NoVolumeIsRefusedWithWords) {
  const std::vector<Vec3> quad = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Mesh doubled = make_mesh(quad, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}});
  EXPECT_NE(refusal(doubled).find("no volume"), std::string::npos);
  EXPECT_NE(refusal(mapped(doubled,
                           [](const Vec3&) -> Vec3 {
                             return {1, 1, 1};
                           }))
                .find("no volume"),
            std::string::npos);
  EXPECT_NE(refusal(make_mesh(quad, {})).find("no volume"), std::string::npos);
}

TEST(MeshRegion, ThinPlateHasAVolume) {
  EXPECT_NEAR(region_of(make_bar({100, 100, 1e-3}, {4, 4, 1})).volume(), 10, 1e-9);
}

}  // namespace
}  // namespace supple
