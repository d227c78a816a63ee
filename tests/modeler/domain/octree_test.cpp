#include "modeler/domain/octree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "modeler/domain/shape_error.h"
#include "solver/core/parallel.h"
#include "solver/core/random.h"
#include "tests/support/region_shapes.h"

namespace supple {
namespace {

/// A shape with curved, sharp and thin parts.
Mesh lollipop() {
  const auto stick = [](const Vec3& x) -> Vec3 { return x + Vec3(-0.06, -0.05, -3); };
  return joined(make_icosphere(1, 3), mapped(make_bar({0.12, 0.1, 2.5}, {2, 2, 8}), stick));
}

Octree octree_of(const Region& region, double width, int coarser_inside = 0) {
  OctreeOptions options;
  options.width = width;
  options.coarser_inside = coarser_inside;
  return {region, options};
}

Index count(const Octree& octree, LeafKind kind) {
  return std::count_if(octree.leaves().begin(), octree.leaves().end(),
                       [&](const OctreeLeaf& leaf) { return leaf.kind == kind; });
}

/// Leaves whose neighbour across a face or an edge is less than half as wide.
int unbalanced(const Octree& octree) {
  int found = 0;
  for (const OctreeLeaf& leaf : octree.leaves())
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          if (std::abs(x) + std::abs(y) + std::abs(z) == 3) continue;
          // Just across the middle of the face or edge.
          const Vec3 beyond = leaf.center + 1.001 * leaf.half_width * Vec3(x, y, z);
          const Index at = octree.leaf_at(beyond);
          if (at >= 0 && octree.leaves()[at].half_width > 2.001 * leaf.half_width) ++found;
        }
  return found;
}

TEST(Octree, LeavesTileTheRootCube) {
  const auto region = region_of(lollipop());
  for (int coarser : {0, 2}) {
    const Octree octree = octree_of(region, 0.11, coarser);
    Box root;
    double volume = 0;
    for (const OctreeLeaf& leaf : octree.leaves()) {
      root.extend(leaf.center - Vec3::Constant(leaf.half_width));
      root.extend(leaf.center + Vec3::Constant(leaf.half_width));
      volume += std::pow(2 * leaf.half_width, 3);
    }
    EXPECT_NEAR(volume, root.size().prod(), 1e-9 * volume);
    EXPECT_TRUE((root.lower.array() <= region.bounds().lower.array()).all());
    EXPECT_TRUE((root.upper.array() >= region.bounds().upper.array()).all());
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 x = root.lower + random.in_cube(0, 1).cwiseProduct(root.size());
      const Index at = octree.leaf_at(x);
      ASSERT_GE(at, 0);
      const OctreeLeaf& leaf = octree.leaves()[at];
      EXPECT_LE((x - leaf.center).lpNorm<Eigen::Infinity>(), leaf.half_width * (1 + 1e-9));
    }
    EXPECT_EQ(octree.leaf_at(root.upper + Vec3(0.01, 0, 0)), -1);
  }
}

TEST(Octree, NeighboursAcrossFacesAndEdgesDifferByOneLevelAtMost) {
  const auto region = region_of(lollipop());
  for (int coarser : {0, 1, 4}) {
    const Octree octree = octree_of(region, 0.05, coarser);
    EXPECT_EQ(unbalanced(octree), 0) << coarser;
    const auto widest = std::max_element(
        octree.leaves().begin(), octree.leaves().end(),
        [](const OctreeLeaf& a, const OctreeLeaf& b) { return a.half_width < b.half_width; });
    EXPECT_GT(widest->half_width, 0.15);  // else there is nothing to balance
  }
}

TEST(Octree, LeavesAtTheBoundaryAreOfTheWidthAskedForAndThoseInsideAsGraded) {
  const auto region = region_of(lollipop());
  for (int coarser : {0, 1, 2}) {
    const Octree octree = octree_of(region, 0.05, coarser);
    double widest = 0;
    for (const OctreeLeaf& leaf : octree.leaves()) {
      if (leaf.kind == LeafKind::interior_boundary || leaf.kind == LeafKind::exterior_boundary) {
        EXPECT_NEAR(2 * leaf.half_width, 0.05, 1e-12);
      }
      if (leaf.kind == LeafKind::interior) widest = std::max(widest, 2 * leaf.half_width);
    }
    EXPECT_NEAR(widest, std::ldexp(0.05, coarser), 1e-12);
  }
}

TEST(Octree, KindsAreWhatRandomPointsOfTheLeavesSay) {
  const auto region = region_of(lollipop());
  const Octree octree = octree_of(region, 0.13);
  Random random(7);
  double missed = 0;  // volume inside exterior leaves or outside interior ones
  for (const OctreeLeaf& leaf : octree.leaves()) {
    int inside = 0;
    constexpr int trials = 40;
    for (int i = 0; i < trials; ++i)
      inside += region.contains(leaf.center + leaf.half_width * random.in_cube(-1, 1));
    const bool center_inside = region.contains(leaf.center);
    EXPECT_EQ(center_inside,
              leaf.kind == LeafKind::interior || leaf.kind == LeafKind::interior_boundary);
    const double share = std::pow(2 * leaf.half_width, 3) / trials;
    if (leaf.kind == LeafKind::interior) missed += share * (trials - inside);
    if (leaf.kind == LeafKind::exterior) missed += share * inside;
  }
  EXPECT_LT(missed, 1e-4 * region.volume());
}

TEST(Octree, CubesThatFillABoxAreAllInterior) {
  const auto region = region_of(make_bar({1, 1, 2}, {1, 1, 1}));
  for (int across : {1, 4, 5, 7}) {
    const Octree octree = octree_of(region, 1.0 / across);
    EXPECT_EQ(count(octree, LeafKind::interior), across * across * 2 * across);
    EXPECT_EQ(count(octree, LeafKind::interior_boundary), 0);
    EXPECT_EQ(count(octree, LeafKind::exterior_boundary), 0);
  }
}

TEST(Octree, CoarserLeavesInsideAreFewer) {
  const auto region = region_of(make_icosphere(1, 3));
  const Index even = count(octree_of(region, 0.06), LeafKind::interior);
  const Index graded = count(octree_of(region, 0.06, 3), LeafKind::interior);
  EXPECT_LT(graded, even / 3);
}

TEST(Octree, SameForEveryNumberOfThreads) {
  const auto region = region_of(lollipop());
  const auto leaves = [&](int threads) {
    const ThreadLimit limit(threads);
    return octree_of(region, 0.08, 2).leaves();
  };
  const std::vector<OctreeLeaf> one = leaves(1), two = leaves(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].center, two[i].center);
    EXPECT_EQ(one[i].half_width, two[i].half_width);
    EXPECT_EQ(one[i].kind, two[i].kind);
  }
}

TEST(Octree, ALeafWiderThanTheShapeIsTheWholeTree) {
  const Octree octree = octree_of(region_of(make_bar({1, 1, 1}, {1, 1, 1})), 3);
  ASSERT_EQ(octree.leaves().size(), 1u);
  EXPECT_EQ(octree.leaves()[0].kind, LeafKind::interior_boundary);
}

TEST(Octree, TooFineAWidthIsRefused) {
  EXPECT_THROW(octree_of(region_of(make_bar({1, 1, 1}, {1, 1, 1})), 1e-8), ShapeError);
}

}  // namespace
}  // namespace supple
