#include "modeler/domain/cut_cube.h"

#include <cmath>

#include <gtest/gtest.h>

#include "solver/core/random.h"

namespace supple {
namespace {

TEST(CutCube, AxisPlaneCutsABox) {
  for (double share : {0.1, 0.5, 0.9}) {
    const CutVolume cut = cut_cube(Vec3::UnitY(), 2 * share - 1, 1);
    EXPECT_NEAR(cut.volume, 8 * share, 1e-12);
    EXPECT_NEAR((cut.centroid - Vec3(0, share - 1, 0)).norm(), 0, 1e-12);
  }
}

TEST(CutCube, DiagonalPlaneCutsACorner) {
  // A corner with three edges of length a: volume a³/6, centroid a/4 from each face.
  const double a = 0.7;
  const CutVolume cut = cut_cube(Vec3(1, 1, 1).normalized(), (a - 3) / std::sqrt(3.0), 1);
  EXPECT_NEAR(cut.volume, a * a * a / 6, 1e-12);
  EXPECT_NEAR((cut.centroid - Vec3::Constant(a / 4 - 1)).norm(), 0, 1e-12);
}

TEST(CutCube, BothSidesAreTheWholeCube) {
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 normal = random.in_cube(-1, 1).normalized();
    const double offset = random.uniform(-1.2, 1.2), half_width = random.uniform(0.1, 3);
    const CutVolume below = cut_cube(normal, offset, half_width);
    const CutVolume above = cut_cube(-normal, -offset, half_width);
    const double whole = std::pow(2 * half_width, 3);
    EXPECT_NEAR(below.volume + above.volume, whole, 1e-12 * whole);
    const Vec3 first = below.volume * below.centroid + above.volume * above.centroid;
    EXPECT_LT(first.norm(), 1e-12 * whole * half_width);
    if (below.volume > 0) {
      EXPECT_LE(normal.dot(below.centroid), offset + 1e-12);
    }
  }
}

TEST(CutCube, APlaneBesideTheCubeCutsNothingOrAll) {
  EXPECT_EQ(cut_cube(Vec3::UnitX(), -1.001, 1).volume, 0);
  EXPECT_NEAR(cut_cube(Vec3::UnitX(), 1.001, 1).volume, 8, 1e-12);
}

}  // namespace
}  // namespace supple
