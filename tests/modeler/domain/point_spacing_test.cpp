#include "modeler/domain/point_spacing.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "solver/core/random.h"

namespace supple {
namespace {

/// Points on a sphere of radius 2, evenly but for the golden angle, or at random.
Points sphere_points(int count, bool at_random) {
  Random random(5);
  Points points(count, 3);
  for (int i = 0; i < count; ++i) {
    const double z = at_random ? 2 * random.uniform() - 1 : (2 * i + 1.0) / count - 1;
    const double turn = at_random ? random.uniform() : i / (std::numbers::phi * std::numbers::phi);
    const double r = std::sqrt(1 - z * z), angle = 2 * std::numbers::pi * turn;
    points.row(i) << 2 * r * std::cos(angle), 2 * r * std::sin(angle), 2 * z;
  }
  return points;
}

constexpr double area = 16 * std::numbers::pi;

TEST(PointSpacing, KnowsTheAreaThatPointsLieOn) {
  for (const bool at_random : {false, true}) {
    const PointSpacing spacing = measure_spacing(sphere_points(4000, at_random));
    EXPECT_NEAR(spacing.area / area, 1, 0.1) << at_random;
    EXPECT_NEAR(spacing.density * area / 4000, 1, 0.15) << at_random;
  }
}

TEST(PointSpacing, OfALatticeIsItsStep) {
  Points points(402, 3);
  for (int i = 0; i < 400; ++i) points.row(i) << 0.5 * (i % 20), 0.5 * (i / 20), 7;
  points.row(400) = points.row(17);
  points.row(401) = points.row(18);
  const PointSpacing spacing = measure_spacing(points);
  EXPECT_DOUBLE_EQ(spacing.median, 0.5);
  EXPECT_DOUBLE_EQ(spacing.least, 0.5);
  EXPECT_DOUBLE_EQ(spacing.greatest, 0.5);
  EXPECT_EQ(spacing.duplicated, 2);
}

TEST(PointSpacing, OfVeryFewPoints) {
  EXPECT_EQ(measure_spacing(Points::Zero(1, 3)).median, 0);
  EXPECT_EQ(measure_spacing(Points::Zero(3, 3)).duplicated, 2);
  Points two(2, 3);
  two << 0, 0, 0, 3, 4, 0;
  EXPECT_DOUBLE_EQ(measure_spacing(two).median, 5);
  EXPECT_TRUE(std::isfinite(measure_spacing(two).density));
}

}  // namespace
}  // namespace supple
