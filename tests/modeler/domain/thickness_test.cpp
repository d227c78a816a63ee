#include "modeler/domain/thickness.h"

#include <numeric>

#include <gtest/gtest.h>

#include "modeler/domain/surface_samples.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

Thickness thickness_of(const Mesh& mesh, double width) {
  const auto region = region_of(mesh);
  const SurfaceSamples samples = sample_surface(mesh.positions, triangles_of(mesh), width);
  return measure_thickness(region, samples.positions, samples.areas);
}

TEST(Thickness, OfABallIsItsDiameter) {
  const Thickness ball = thickness_of(make_icosphere(1, 4), 0.2);
  EXPECT_NEAR(ball.quantile(0.05), 2, 0.02);
  EXPECT_NEAR(ball.quantile(0.95), 2, 0.02);
  EXPECT_EQ(ball.share_below(1.5), 0);
  EXPECT_EQ(ball.share_below(2.5), 1);
}

TEST(Thickness, OfASlabIsItsHeightButAtItsRim) {
  const Vec3 size(2, 0.1, 3);
  const Thickness slab = thickness_of(make_bar(size, {4, 1, 6}), 0.05);
  EXPECT_NEAR(slab.quantile(0.5), 0.1, 1e-3);
  const double faces = 2 * size.x() * size.z(), rim = 2 * size.y() * (size.x() + size.z());
  EXPECT_NEAR(slab.share_below(0.11), faces / (faces + rim), 1e-3);
  EXPECT_EQ(slab.share_below(0.09), 0);
  EXPECT_NEAR(slab.quantile(0.999), 3, 0.01) << "from one end of the rim to the other";
}

TEST(Thickness, ScalesWithTheShape) {
  const Mesh bar = make_bar({1, 2, 3}, {2, 4, 6});
  for (const double scale : {1e-6, 1e6}) {
    const Mesh scaled = mapped(bar, [&](const Vec3& x) -> Vec3 { return scale * x; });
    const double thin = thickness_of(bar, 0.2).quantile(0.2);
    EXPECT_NEAR(thickness_of(scaled, 0.2 * scale).quantile(0.2), scale * thin, 1e-6 * scale);
    EXPECT_NEAR(thickness_of(bar, 0.2).scaled(scale).quantile(0.2), scale * thin, 1e-9 * scale);
  }
}

TEST(Thickness, WallsInsideDoNotEndIt) {
  // Two bars that overlap: the end of each lies within the other.
  const Mesh bar = make_bar({1, 1, 2}, {2, 2, 4});
  const Mesh two =
      joined(bar, mapped(bar, [](const Vec3& x) -> Vec3 { return x + Vec3(0, 0, 1); }));
  const Thickness thickness = thickness_of(two, 0.11);
  EXPECT_NEAR(thickness.quantile(0.5), 1, 1e-2) << "across";
  EXPECT_NEAR(thickness.quantile(1), 3, 3e-2) << "along, past the walls inside";
}

TEST(Thickness, OfNothingIsEmpty) {
  const Thickness none({}, {});
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.quantile(0.5), 0);
  EXPECT_EQ(none.share_below(1), 0);
}

}  // namespace
}  // namespace supple
