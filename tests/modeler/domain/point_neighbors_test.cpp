#include "modeler/domain/point_neighbors.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "modeler/domain/point_cleaning.h"
#include "modeler/domain/point_normals.h"
#include "modeler/domain/site_tree.h"
#include "modeler/domain/surface_samples.h"
#include "tests/support/point_clouds.h"

namespace supple {
namespace {

PointCloud ball(Index count) {
  PointCloud cloud = points_on(make_icosphere(1, 4), count);
  cloud.positions.rowwise().normalize();
  cloud.normals = cloud.positions;
  return cloud;
}

TEST(PointNeighbors, AreTheNearestOthers) {
  const Points points = ball(300).positions;
  const PointNeighbors neighbors(points, 5);
  for (Index i = 0; i < 300; i += 17) {
    double last = 0;
    for (int k = 0; k < 5; ++k) {
      const int j = neighbors.of(i)[k];
      const double squared_distance = (points.row(j) - points.row(i)).squaredNorm();
      EXPECT_NE(j, i);
      EXPECT_NEAR(neighbors.squared_distances(i)[k], squared_distance, 1e-15);
      EXPECT_GE(squared_distance, last);
      last = squared_distance;
    }
    int nearer = 0;
    for (Index j = 0; j < 300; ++j)
      nearer += j != i && (points.row(j) - points.row(i)).squaredNorm() < last ? 1 : 0;
    EXPECT_EQ(nearer, 4);
  }
  EXPECT_EQ(PointNeighbors(points.topRows(3), 5).count(), 2);
}

TEST(PointAreas, SumUpToTheSurface) {
  const PointCloud cloud = ball(3000);
  EXPECT_NEAR(point_areas(cloud.positions, cloud.normals).sum() / (4 * std::numbers::pi), 1, 0.03);
}

TEST(PointAreas, OfAThinPartDoNotSeeItsOtherSide) {
  PointCloud both = ball(3000);
  both.positions.conservativeResize(6000, 3);
  both.normals.conservativeResize(6000, 3);
  both.positions.bottomRows(3000) = 0.999 * both.positions.topRows(3000);
  both.normals.bottomRows(3000) = -both.normals.topRows(3000);
  // Half of the sixteen neighbours are left: the estimate scatters more.
  EXPECT_NEAR(point_areas(both.positions, both.normals).sum() / (8 * std::numbers::pi), 1, 0.1);
}

TEST(PointSamples, StandForThemselves) {
  const Points points = ball(10).positions;
  const SurfaceSamples samples = point_samples(points, Eigen::VectorXd::LinSpaced(10, 1, 10));
  EXPECT_EQ(samples.positions, points);
  EXPECT_EQ(samples.areas[9], 10);
  EXPECT_EQ(samples.triangles, std::vector<int>(10, -1));
  EXPECT_EQ(samples.vertices[7], 7);
}

TEST(CleanPoints, KeepAClosedSurfaceWhole) {
  const CleanPoints clean = clean_points(points_on(make_bar({1, 1, 1}, {1, 1, 1}), 4000).positions);
  EXPECT_EQ(clean.duplicates, 0);
  EXPECT_LE(clean.outliers, 2);
}

TEST(CleanPoints, AFarOutlierDoesNotJoinTheOthers) {
  Points points = points_on(make_bar({1, 1, 1}, {1, 1, 1}), 2000).positions;
  points.row(7) << 1e12, 0, 0;
  const CleanPoints clean = clean_points(points);
  EXPECT_EQ(clean.duplicates, 0);
  EXPECT_GE(clean.outliers, 1);
  EXPECT_LE(clean.outliers, 3);
}

TEST(CleanPoints, ManyCopiesAreOne) {
  Points points = ball(200).positions.replicate(40, 1);
  points.row(17) += Eigen::RowVector3d::Constant(1e-13);
  const CleanPoints clean = clean_points(points);
  EXPECT_EQ(clean.duplicates, 39 * 200);
  EXPECT_EQ(clean.kept.size() + clean.outliers, 200);
}

TEST(EstimateNormals, LookOutwardsOnEachPart) {
  Points points(4000, 3);
  points.topRows(2000) = ball(2000).positions;
  points.bottomRows(2000) = ball(2000).positions.rowwise() + Eigen::RowVector3d(5, 0, 0);
  const PointNormals estimated = estimate_normals(points);
  EXPECT_EQ(estimated.parts, 2);
  EXPECT_EQ(estimated.unoriented, 0);
  for (Index i = 0; i < 2000; ++i) {
    EXPECT_GT(estimated.normals.row(i).dot(points.row(i)), 0.97);
    EXPECT_GT(estimated.normals.row(2000 + i).dot(points.row(i)), 0.97);
  }
}

TEST(EstimateNormals, AgreeAcrossAThinPart) {
  const PointCloud plate = points_on(make_bar({1, 1, 0.06}, {1, 1, 1}), 6000);
  const PointNormals estimated = estimate_normals(plate.positions);
  int wrong = 0;
  for (Index i = 0; i < 6000; ++i)
    wrong += estimated.normals.row(i).dot(plate.normals.row(i)) < 0 ? 1 : 0;
  EXPECT_LE(wrong, 12);
}

TEST(EstimateNormals, TakeMoreNeighborsWhereThereIsNoise) {
  const Points clean = ball(4000).positions;
  EXPECT_LE(estimate_normals(clean).neighbors, 18);
  const PointNormals noisy = estimate_normals(with_noise(clean, 0.04));
  EXPECT_GE(noisy.neighbors, 40);
  double cosines = 0;
  for (Index i = 0; i < 4000; ++i) cosines += noisy.normals.row(i).dot(clean.row(i));
  EXPECT_GT(cosines / 4000, 0.95);
}

}  // namespace
}  // namespace supple
