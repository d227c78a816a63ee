#include "modeler/domain/partition_of_unity.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "modeler/domain/polygonize.h"
#include "tests/support/point_clouds.h"

namespace supple {
namespace {

TEST(Quadric, FollowsAParaboloid) {
  // z = 0.1 + 0.2 x − 0.3 y + x² / 2 − x y / 4.
  Random random(2);
  Points points(40, 3), normals(40, 3);
  for (Index i = 0; i < 40; ++i) {
    const double x = random.uniform(-0.3, 0.3), y = random.uniform(-0.3, 0.3);
    points.row(i) << x, y, 0.1 + 0.2 * x - 0.3 * y + 0.5 * x * x - 0.25 * x * y;
    normals.row(i) = Eigen::RowVector3d(-0.2 - x + 0.25 * y, 0.3 + 0.25 * x, 1).normalized();
  }
  std::vector<int> all(40);
  std::iota(all.begin(), all.end(), 0);
  const QuadricFit fit = fit_quadric(points, normals, all, Vec3(0, 0, 0.1), 0.6, 0.01);
  EXPECT_LT(fit.rms, 0.005);  // the plane of the mean normal is another than z = 0
  EXPECT_EQ(fit.beyond, 0);
  for (Index i = 0; i < 40; ++i) {
    const Vec3 x = points.row(i);
    EXPECT_GT(fit.quadric.gradient(x).normalized().dot(normals.row(i)), 0.999);
    const Vec3 step(1e-6, 2e-6, -1e-6);
    EXPECT_NEAR(fit.quadric.value(x + step) - fit.quadric.value(x - step),
                2 * fit.quadric.gradient(x).dot(step), 1e-12);
  }
}

TEST(PartitionOfUnity, GradientIsTheSlope) {
  const Mesh torus = make_torus(0.3, 0.12, 96, 48);
  const PointCloud cloud = points_on(torus, 3000);
  const PartitionOfUnity partition(cloud.positions, cloud.normals, {});
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = cloud.positions.row(5 * i).transpose() + 0.01 * random.in_cube(-1, 1);
    const PartitionOfUnity::Value at = partition.at(x);
    ASSERT_GT(at.weight, 0);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-6 * Vec3::Unit(axis);
      EXPECT_NEAR(at.gradient[axis], (partition.at(x + step).f - partition.at(x - step).f) / 2e-6,
                  1e-4);
    }
  }
  EXPECT_EQ(partition.at({3, 3, 3}).weight, 0);
}

TEST(PartitionOfUnity, TellsTheNoise) {
  const Mesh torus = make_torus(0.3, 0.12, 96, 48);
  const PointCloud cloud = points_on(torus, 10000);
  PartitionOptions options;
  options.neighbors = 100;
  const PartitionOfUnity partition(with_noise(cloud.positions, 0.005), cloud.normals, options);
  EXPECT_NEAR(partition.noise() / 0.005, 1, 0.15);
}

TEST(Polygonize, FindsAClosedBallFromOneSeed) {
  PolygonizeOptions options;
  options.box.extend(Vec3::Constant(-1.1));
  options.box.extend(Vec3::Constant(1.1));
  options.width = 0.05;
  const auto ball = [](const Vec3& x) { return x.norm() - 1; };
  const Polygons found = polygonize(ball, Points(Eigen::RowVector3d(0, 0, 1)), options);
  EXPECT_TRUE(is_closed(found.triangles));
  EXPECT_NEAR(enclosed_volume(found.positions, found.triangles) / (4 * std::numbers::pi / 3), 1,
              0.005);
  EXPECT_LT((found.positions.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-3);
}

TEST(Polygonize, ClosesWhatRunsOutOfTheBox) {
  PolygonizeOptions options;
  options.box.extend(Vec3::Constant(-1));
  options.box.extend(Vec3::Constant(1));
  options.width = 0.1;
  const auto below = [](const Vec3& x) { return x.z(); };
  const Polygons found = polygonize(below, Points(Eigen::RowVector3d(0, 0, 0)), options);
  EXPECT_TRUE(is_closed(found.triangles));
  EXPECT_GT(enclosed_volume(found.positions, found.triangles), 4);
}

}  // namespace
}  // namespace supple
