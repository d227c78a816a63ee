#include "modeler/surface/fill_gaps.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <gtest/gtest.h>

#include "io/mesh/mesh_checks.h"
#include "io/points/spacing.h"
#include "modeler/surface/deform_mesh.h"
#include "solver/core/random.h"
#include "solver/field/neighbors.h"
#include "tests/support/shapes.h"

namespace supple {
namespace {

constexpr int side = 21;
constexpr double step = 0.1;

/// A square of points across z, each off its place by less than `jitter` steps.
Mesh plane_of_points(double jitter) {
  Random random(3);
  Mesh cloud;
  cloud.positions.resize(side * side, 3);
  for (int i = 0; i < side * side; ++i)
    cloud.positions.row(i) << step * (i % side + jitter * random.uniform(-1, 1)),
        step * (i / side + jitter * random.uniform(-1, 1)), 0;
  cloud.normals.values = Points::Zero(side * side, 3);
  cloud.normals.values.col(2).setOnes();
  cloud.colors.values.setOnes(side * side, 4);
  cloud.colors.values.col(0) = cloud.positions.col(0) / (step * (side + 1));
  cloud.radii = Eigen::VectorXd::Constant(side * side, 0.8 * step);
  return cloud;
}

DeformPoints linear(const Mat3& F) {
  return [F](const Points& rest) {
    return DeformedSurface{rest * F.transpose(), std::vector<Mat3>(std::size_t(rest.rows()), F)};
  };
}

FilledCloud filled(const Mesh& cloud, const DeformPoints& deform,
                   const FillGapsOptions& options = {}) {
  return fill_gaps(cloud, deform_mesh(cloud, deform(cloud.positions)), deform, options);
}

/// The largest distance of a place on the deformed square from the nearest point.
double largest_hole(const Points& points, const Mat3& F) {
  const Neighbors<3> tree(points, Eigen::VectorXd::Ones(points.rows()));
  const double width = step * (side - 1);
  double largest = 0;
  for (double x = 0.1; x < 0.9; x += 0.004)
    for (double y = 0.1; y < 0.9; y += 0.02) {
      const Vec3 place = F * Vec3(x * width, y * width, 0);
      const int nearest = tree.nearest(place, 1).front();
      largest = std::max(largest, (points.row(nearest).transpose() - place).norm());
    }
  return largest;
}

TEST(FillGaps, AStretchedPlaneIsAsDenseAsBefore) {
  for (const double jitter : {0.0, 0.2})
    for (const Vec3& stretch : {Vec3(3, 1, 1), Vec3(3, 3, 1), Vec3(7, 2, 1)}) {
      const Mesh cloud = plane_of_points(jitter);
      const Mat3 F = stretch.asDiagonal();
      const FilledCloud result = filled(cloud, linear(F));
      EXPECT_EQ(result.gaps, 0);
      // 1.5 times what the plane had at rest.
      EXPECT_LE(largest_hole(result.deformed.positions, F),
                1.5 * largest_hole(cloud.positions, Mat3::Identity()) + 1e-12)
          << stretch.transpose() << " jitter " << jitter;
      // No more points than that takes: at least 2/3 of a step apart.
      EXPECT_LE(double(result.rest.positions.rows()),
                2.3 * double(cloud.positions.rows()) * stretch.prod());
      const Neighbors<3> tree(result.deformed.positions,
                              Eigen::VectorXd::Ones(result.deformed.positions.rows()));
      for (Index i = cloud.positions.rows(); i < result.deformed.positions.rows(); ++i) {
        const Vec3 x = result.deformed.positions.row(i).transpose();
        const int next = tree.nearest(x, 2).back();
        EXPECT_GT((result.deformed.positions.row(next).transpose() - x).norm(), 0.5 * step);
      }
    }
}

TEST(FillGaps, KeepsTheOriginalPointsFirstAndInOrder) {
  const Mesh cloud = plane_of_points(0.2);
  const Mat3 F = Vec3(3, 1, 1).asDiagonal();
  const FilledCloud result = filled(cloud, linear(F));
  check_mesh(result.rest);
  check_mesh(result.deformed);
  const Index n = cloud.positions.rows();
  ASSERT_GT(result.added, n);
  EXPECT_EQ(result.rest.positions.rows(), n + result.added);
  EXPECT_EQ(result.rest.positions.topRows(n), cloud.positions);
  EXPECT_EQ(result.deformed.positions.topRows(n), cloud.positions * F.transpose());
  EXPECT_EQ(result.rest.colors.values.topRows(n), cloud.colors.values);
  EXPECT_EQ(result.deformed.normals.values.topRows(n), cloud.normals.values);
}

TEST(FillGaps, NewPointsFollowTheFieldAndTakeMeans) {
  const Mesh cloud = plane_of_points(0.2);
  const Mat3 F = Vec3(3, 1, 1).asDiagonal();
  const FilledCloud result = filled(cloud, linear(F));
  EXPECT_LT((result.deformed.positions - result.rest.positions * F.transpose()).norm(), 1e-12);
  // Colors that grow with x still do.
  EXPECT_LT((result.rest.colors.values.col(0) * step * (side + 1) - result.rest.positions.col(0))
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
  EXPECT_EQ(result.deformed.colors.values, result.rest.colors.values);
  // Splats reach half of the largest distance that is left, and no radius swells.
  EXPECT_GE(result.deformed.radii.minCoeff(), 0.75 * step);
  EXPECT_LE(result.deformed.radii.maxCoeff(), 1.5 * 0.8 * step + 1e-12);
}

TEST(FillGaps, LeavesWhatHasNotParted) {
  const Mesh cloud = plane_of_points(0.3);
  const Mat3 turn = Eigen::AngleAxisd(2, Vec3(1, 2, 2).normalized()).toRotationMatrix();
  for (const Mat3& F : {turn, Mat3(1.4 * turn), Mat3(0.2 * turn)})
    EXPECT_EQ(filled(cloud, linear(F)).added, 0);
}

/// The middle of two points of a ball bulges to the ball.
TEST(FillGaps, NewPointsLieOnTheSurface) {
  Mesh cloud;
  cloud.positions = make_icosphere(1, 3).positions;
  cloud.normals.values = cloud.positions;
  const FilledCloud result = filled(cloud, linear(Vec3(4, 4, 4).asDiagonal()));
  ASSERT_GT(result.added, 0);
  EXPECT_EQ(result.gaps, 0);
  const double chord = neighbor_spacing(cloud.positions).maxCoeff();
  const double sagitta = chord * chord / 8;  // what middles of chords would miss
  EXPECT_LT((result.rest.positions.rowwise().norm().array() - 1).abs().maxCoeff(), 0.05 * sagitta);
  EXPECT_LT((result.rest.normals.values.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

/// Two sheets closer to each other than their points are: nothing goes between them.
TEST(FillGaps, DoesNotJoinTwoSides) {
  Mesh cloud = plane_of_points(0);
  const Index n = cloud.positions.rows();
  Mesh other = cloud;
  other.positions.col(2).setConstant(0.4 * step);
  other.normals.values.col(2).setConstant(-1);
  cloud.positions.conservativeResize(2 * n, 3);
  cloud.positions.bottomRows(n) = other.positions;
  cloud.normals.values.conservativeResize(2 * n, 3);
  cloud.normals.values.bottomRows(n) = other.normals.values;
  cloud.colors = {};
  cloud.radii = {};
  const FilledCloud result = filled(cloud, linear(Vec3(1, 1, 20).asDiagonal()));
  EXPECT_EQ(result.added, 0);
}

TEST(FillGaps, PointsWithoutANormalGetNeighborsWithoutOne) {
  Mesh cloud = plane_of_points(0);
  cloud.normals.values.setZero();
  const FilledCloud result = filled(cloud, linear(Vec3(3, 1, 1).asDiagonal()));
  EXPECT_GT(result.added, 0);
  EXPECT_TRUE(result.deformed.positions.allFinite());
  EXPECT_TRUE(result.deformed.normals.values.isZero(0));
}

TEST(FillGaps, SaysWhatStaysOpen) {
  const FillGapsOptions options{.most_growth = 2};
  const FilledCloud result =
      filled(plane_of_points(0), linear(Vec3(9, 9, 1).asDiagonal()), options);
  EXPECT_GT(result.gaps, 0);
  EXPECT_GT(result.added, 0) << "the widest are filled first";
  EXPECT_LE(result.rest.positions.rows(), 2 * side * side);
}

}  // namespace
}  // namespace supple
