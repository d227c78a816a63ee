#include "io/picture/smooth_corners.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace supple {
namespace {

SmoothCorners corners_of(const Mesh& mesh, double crease_angle_deg = 40) {
  return smooth_corners(mesh.positions, triangles_of(mesh), crease_angle_deg);
}

TEST(SmoothCorners, ABoxHasOneNormalForEachFaceAndVertex) {
  const Mesh box = as_fans(make_box(Vec3(1, 2, 3)));
  const SmoothCorners corners = corners_of(box);
  EXPECT_EQ(corners.vertex.size(), 24u);
  for (const Vec3& normal : corners.normal)
    EXPECT_NEAR(normal.normalized().cwiseAbs().maxCoeff(), 1, 1e-15);
}

TEST(SmoothCorners, ABoxIsRoundWhereCreasesStartAbove90Degrees) {
  const Mesh box = as_fans(make_box(Vec3(1, 1, 1)));
  const SmoothCorners corners = corners_of(box, 91);
  EXPECT_EQ(corners.vertex.size(), 8u);
}

TEST(SmoothCorners, ABallHasOneRadialNormalForEachVertex) {
  const Mesh ball = make_icosphere(1, 4);
  const SmoothCorners corners = corners_of(ball);
  ASSERT_EQ(static_cast<Index>(corners.vertex.size()), ball.positions.rows());
  for (std::size_t g = 0; g < corners.vertex.size(); ++g) {
    const Vec3 radial = ball.positions.row(corners.vertex[g]);
    EXPECT_GT(corners.normal[g].normalized().dot(radial), 0.999);
  }
}

TEST(SmoothCorners, EachCornersGroupIsOfItsOwnVertex) {
  const Mesh torus = make_torus(1, 0.4, 30, 8);  // 45° across the tube: creased along it
  const Triangles triangles = triangles_of(torus);
  const SmoothCorners corners = smooth_corners(torus.positions, triangles, 40);
  ASSERT_EQ(static_cast<Index>(corners.group.size()), triangles.size());
  for (std::size_t c = 0; c < corners.group.size(); ++c)
    EXPECT_EQ(corners.vertex[corners.group[c]], triangles.data()[c]);
  EXPECT_GT(static_cast<Index>(corners.vertex.size()), torus.positions.rows());
}

TEST(SmoothCorners, FacesOfOppositeTurnDoNotCancel) {
  const Mesh sheet =
      make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}});
  for (const Vec3& normal : corners_of(sheet).normal) EXPECT_NEAR(normal.norm(), 1, 1e-15);
}

TEST(SmoothCorners, TrianglesWithoutAreaDoNotSplitASurface) {
  const Mesh sheet = make_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                               {{0, 2, 3}, {0, 1, 2}, {1, 0, 4}, {2, 1, 4}});
  for (const Vec3& normal : corners_of(sheet).normal) {
    EXPECT_GT(normal.z(), 0);
    EXPECT_EQ(normal.head<2>(), Eigen::Vector2d::Zero());
  }
}

}  // namespace
}  // namespace supple
