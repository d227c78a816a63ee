#include "modeler/domain/region_cover.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "modeler/domain/welded_surface.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

constexpr double pi = std::numbers::pi;

/// The unit ball below z = height; its sphere is the input, its lid is missing.
ImplicitRegion ball_below(double height) {
  ImplicitRegion region;
  region.value = [=](const Vec3& x) { return x.z() < height && x.norm() < 1 ? 1.0 : 0.0; };
  region.distance = [=](const Vec3& x) {
    if (x.z() < height * x.norm()) return std::abs(x.norm() - 1);
    const double rim = std::sqrt(1 - height * height);
    return std::hypot(std::hypot(x.x(), x.y()) - rim, x.z() - height);
  };
  region.box.extend(Vec3(-1, -1, -1));
  region.box.extend(Vec3(1, 1, height));
  return region;
}

TEST(RegionCover, WholeSphereIsCovered) {
  const RegionCover cover = cover_region(ball_below(1), {});
  EXPECT_NEAR(cover.area / (4 * pi), 1, 0.02);
  EXPECT_EQ(cover.covered, 1);
  EXPECT_EQ(cover.greatest_opening, 0);
  EXPECT_EQ(cover.caps.rows(), 0);
}

TEST(RegionCover, HemisphereLacksAThird) {
  const RegionCover cover = cover_region(ball_below(0), {});
  EXPECT_NEAR(cover.area / (3 * pi), 1, 0.03);
  EXPECT_NEAR(cover.covered, 2.0 / 3, 0.02);
  EXPECT_NEAR(cover.greatest_opening, 1.0 / 3, 0.02);
  EXPECT_NEAR(cover.opening.norm(), 0, 0.02);
  double area = 0, upward = 0;
  for (Index t = 0; t < cover.caps.rows(); ++t) {
    const Vec3 a = cover.cap_positions.row(cover.caps(t, 0)),
               b = cover.cap_positions.row(cover.caps(t, 1)),
               c = cover.cap_positions.row(cover.caps(t, 2));
    const Vec3 normal = (b - a).cross(c - a);
    area += 0.5 * normal.norm();
    upward += 0.5 * normal.z();
  }
  EXPECT_NEAR(area / pi, 1, 0.1);
  EXPECT_NEAR(upward / area, 1, 0.05);
}

TEST(RegionCover, ReachCoversAndNoInsideIsNoArea) {
  RegionCoverOptions options;
  options.reach = 2;
  EXPECT_EQ(cover_region(ball_below(0), options).covered, 1);
  ImplicitRegion nothing = ball_below(0);
  nothing.value = [](const Vec3&) { return 0.5; };
  const RegionCover cover = cover_region(nothing, {});
  EXPECT_EQ(cover.area, 0);
  EXPECT_EQ(cover.covered, 0);
}

TEST(RegionCover, TheBoundaryOfASmoothValueIsClosed) {
  ImplicitRegion ball = ball_below(1);
  ball.value = [](const Vec3& x) { return 1.5 - x.norm(); };
  ball.distance = [](const Vec3&) { return 1.0; };
  const RegionCover cover = cover_region(ball, {});
  EXPECT_EQ(cover.covered, 0);
  EXPECT_NEAR(cover.greatest_opening, 1, 1e-12);
  EXPECT_TRUE(boundary_edges(cover.caps).empty());
  EXPECT_NEAR(enclosed_volume(cover.cap_positions, cover.caps) / (4 * pi / 3), 1, 5e-3);
}

}  // namespace
}  // namespace supple
