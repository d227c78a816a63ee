#include "modeler/domain/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace supple {
namespace {

SurfaceSamples box_samples(double width) {
  const Mesh box = make_bar({1, 2, 0.5}, {1, 1, 1});
  return sample_surface(box.positions, triangles_of(box), width);
}

std::vector<int> all_of(const SurfaceSamples& samples) {
  std::vector<int> indices(samples.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

TEST(SurfaceSamples, KeepTheAreaAndTheFirstMoment) {
  for (double width : {10.0, 0.7, 0.05}) {
    const SurfaceSamples samples = box_samples(width);
    EXPECT_NEAR(samples.areas.sum(), 2 * (2 + 0.5 + 1), 1e-12);
    const Vec3 centroid = samples.positions.transpose() * samples.areas / samples.areas.sum();
    EXPECT_NEAR((centroid - Vec3(0.5, 1, 0.25)).norm(), 0, 1e-12);
    EXPECT_GT(samples.areas.minCoeff(), 0);
  }
}

TEST(SurfaceSamples, PartsAreNoWiderThanAsked) {
  for (double width : {10.0, 0.7, 0.05}) {
    const SurfaceSamples samples = box_samples(width);
    const Mesh box = make_bar({1, 2, 0.5}, {1, 1, 1});
    const Triangles triangles = triangles_of(box);
    std::vector<int> parts(triangles.rows(), 0);
    for (int t : samples.triangles) ++parts[t];
    for (Index t = 0; t < triangles.rows(); ++t) {
      double longest = 0;
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (box.positions.row(triangles(t, k)) -
                                     box.positions.row(triangles(t, (k + 1) % 3)))
                                        .norm());
      const double pieces = std::sqrt(parts[t]);
      EXPECT_EQ(pieces, std::max(1.0, std::ceil(longest / width)));
    }
  }
}

TEST(SurfaceSamples, NeedlesAreCutAcross) {
  Points corners(3, 3);
  corners << 0, 0, 0, 1, 0, 0, 1, 0.02, 0;
  Triangles needle(1, 3);
  needle << 0, 1, 2;
  const SurfaceSamples fine = sample_surface(corners, needle, 0.005);
  EXPECT_LT(fine.size(), 200 * 5);
  EXPECT_NEAR(fine.areas.sum(), 0.01, 1e-14);
  const Vec3 centroid = fine.positions.transpose() * fine.areas / fine.areas.sum();
  EXPECT_NEAR((centroid - corners.colwise().mean().transpose()).norm(), 0, 1e-12);
  EXPECT_LE(sample_surface(corners, needle, 0.05).size(), 21);
}

TEST(SurfaceSamples, KnowTheirNearestCorner) {
  const Mesh box = make_bar({1, 2, 0.5}, {1, 1, 1});
  const Triangles triangles = triangles_of(box);
  const SurfaceSamples samples = box_samples(0.2);
  for (Index i = 0; i < samples.size(); ++i) {
    const auto corners = triangles.row(samples.triangles[i]);
    const auto distance = [&](int vertex) {
      return (box.positions.row(vertex) - samples.positions.row(i)).norm();
    };
    EXPECT_TRUE((corners.array() == samples.vertices[i]).any());
    for (int k = 0; k < 3; ++k)
      EXPECT_LE(distance(samples.vertices[i]), distance(corners[k]) + 1e-15);
  }
}

TEST(SurfaceSamples, FacesWithoutAreaHaveNone) {
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  EXPECT_EQ(sample_surface(points, triangles, 0.1).size(), 0);
}

TEST(ThinSamples, KeepTheAreaAndLeaveAboutOneACell) {
  const SurfaceSamples samples = box_samples(0.03);
  const ThinnedSamples thin = thin_samples(samples, all_of(samples), 0.25);
  EXPECT_NEAR(thin.areas.sum() / samples.areas.sum(), 1, 1e-12);
  ASSERT_EQ(thin.areas.size(), static_cast<Index>(thin.indices.size()));
  EXPECT_LT(thin.indices.size(), 200u);
  EXPECT_GT(thin.indices.size(), 60u);
  // A cell's samples are no farther apart than its diagonal.
  for (Index i = 0; i < samples.size(); ++i) {
    double nearest = 1e9;
    for (int kept : thin.indices)
      nearest = std::min(nearest, (samples.positions.row(kept) - samples.positions.row(i)).norm());
    EXPECT_LT(nearest, 0.25 * std::sqrt(3.0));
  }
}

TEST(ThinSamples, OneCellHasOneSampleNearTheCentroid) {
  const SurfaceSamples samples = box_samples(0.1);
  const ThinnedSamples thin = thin_samples(samples, {3, 4, 5, 6}, 100);
  ASSERT_EQ(thin.indices.size(), 1u);
  EXPECT_NEAR(thin.areas[0],
              samples.areas[3] + samples.areas[4] + samples.areas[5] + samples.areas[6], 1e-15);
  EXPECT_TRUE(thin_samples(samples, {}, 1).indices.empty());
}

TEST(ThinSamples, WorksFarFromTheOrigin) {
  SurfaceSamples samples = box_samples(0.03);
  const ThinnedSamples near = thin_samples(samples, all_of(samples), 0.3);
  samples.positions.array() += 65536;
  const ThinnedSamples far = thin_samples(samples, all_of(samples), 0.3);
  EXPECT_NEAR(far.areas.sum() / near.areas.sum(), 1, 1e-12);
}

}  // namespace
}  // namespace supple
