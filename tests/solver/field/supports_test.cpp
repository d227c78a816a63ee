#include "solver/field/supports.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "solver/field/samples.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

Points random_points_in(const Vec3& size, Index count) {
  Random random(8);
  Points points(count, 3);
  for (Index i = 0; i < count; ++i)
    points.row(i) = random.in_cube(0, 1).cwiseProduct(size).transpose();
  return points;
}

long covering(const Particles& particles, const Eigen::VectorXd& supports, const Vec3& x) {
  const Eigen::VectorXd distances =
      (particles.positions.rowwise() - x.transpose()).rowwise().norm();
  return (distances.array() < supports.array()).count();
}

TEST(Supports, AreTheUsualOnesInABody) {
  const Particles particles = lattice_particles({1, 1, 1}, 0.1);
  Points middle(1, 3);
  middle << 0.5, 0.5, 0.5;
  const Supports supports = choose_supports(particles.positions, 0.1, middle);
  EXPECT_EQ(supports.thin, 0);
  EXPECT_NEAR(supports.radii.minCoeff(), 0.1 * std::cbrt(25 * 0.75 / EIGEN_PI), 1e-12);
  EXPECT_EQ(supports.radii.minCoeff(), supports.radii.maxCoeff());
}

TEST(Supports, ReachEveryPointByEnoughParticlesInGeneralPosition) {
  // A body with a fin one particle thick.
  const Particles body = lattice_particles({1, 1, 1}, 0.2, 0.1);
  const Particles fin = lattice_particles({0.8, 0.2, 1}, 0.2, 0.1);
  Particles both = body;
  both.positions.conservativeResize(body.size() + fin.size(), 3);
  both.positions.bottomRows(fin.size()) = fin.positions.rowwise() + Eigen::RowVector3d(1, 0.4, 0);
  Points cover(1000, 3);
  cover.topRows(500) = random_points_in({1, 1, 1}, 500);
  cover.bottomRows(500) =
      random_points_in({0.8, 0.2, 1}, 500).rowwise() + Eigen::RowVector3d(1, 0.4, 0);
  const Supports supports = choose_supports(both.positions, 0.2, cover);
  for (Index k = 0; k < cover.rows(); ++k)
    EXPECT_GE(covering(both, supports.radii, cover.row(k).transpose()), 8);
  const MovingLeastSquares<3> field(both.positions, supports.radii);
  const Samples samples = sample_field(field, cover, SampleContent::values);
  EXPECT_EQ(samples.uncovered, 0);
  EXPECT_EQ(samples.rank_lost, 0);
  // They grow smoothly.
  for (Index i = 0; i < both.size(); ++i)
    for (Index j = 0; j < both.size(); ++j)
      EXPECT_LE(std::abs(supports.radii[i] - supports.radii[j]),
                (both.positions.row(i) - both.positions.row(j)).norm() + 1e-12);
}

TEST(Supports, NameASheetThin) {
  Particles sheet = lattice_particles({1, 1, 0.1}, 0.1, 0.1);
  sheet.positions.col(2).setZero();
  const Supports supports = choose_supports(sheet.positions, 0.1, sheet.positions);
  EXPECT_EQ(supports.thin, sheet.size());
}

TEST(Supports, StretchAlongThinPartsAndStayRoundInside) {
  const Particles plate = lattice_particles({2, 2, 0.1}, 0.1);
  const auto stretches = stretches_along(plate.positions, 0.181, 3);
  for (const Mat3& N : stretches) {
    EXPECT_NEAR(N.determinant(), 1, 1e-12);
    const Vec3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(N).eigenvalues().cwiseInverse();
    EXPECT_LE(axes[0] / axes[2], 3 + 1e-12);
  }
  const Index middle = 210;
  EXPECT_GT((stretches[middle] * Vec3::UnitZ()).norm(), 1.9);  // 3^(2/3): short across
  EXPECT_LT((stretches[middle] * Vec3::UnitX()).norm(), 0.9);

  const Particles body = lattice_particles({1, 1, 1}, 0.1);
  EXPECT_LT((stretches_along(body.positions, 0.3, 3)[555] - Mat3::Identity()).norm(), 0.15);
}

TEST(Supports, StretchedReachEveryPointByEnoughParticles) {
  const Particles bar = lattice_particles({3, 0.3, 0.15}, 0.15);
  const Points cover = random_points_in({3, 0.3, 0.15}, 500);
  const Supports supports = choose_supports(bar.positions, 0.15, cover, KernelKind::polynomial,
                                            {.kind = SupportKind::stretched});
  const MovingLeastSquares<3> field(bar.positions, supports.radii, {}, nullptr, supports.stretches);
  ShapeFunctions<3> at_x;
  for (Index k = 0; k < cover.rows(); ++k) {
    field.evaluate(cover.row(k).transpose(), Derivatives::none, at_x);
    EXPECT_GE(at_x.particles.size(), 8u);
    EXPECT_EQ(at_x.rank, 4);
  }
}

}  // namespace
}  // namespace supple
