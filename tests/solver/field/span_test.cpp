#include "solver/field/span.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "solver/core/random.h"

namespace supple {
namespace {

Mat3 random_rotation(Random& random) {
  return Eigen::AngleAxisd(random.uniform(0, EIGEN_PI), random.in_cube(-1, 1).normalized())
      .toRotationMatrix();
}

Mat3 random_matrix(Random& random, double size) {
  Mat3 M;
  for (int a = 0; a < 3; ++a) M.row(a) = random.in_cube(-size, size).transpose();
  return M;
}

/// The part of an affine map that a span carries.
Mat3 carried(const Mat3& F, const Span& span) {
  return F * (Mat3::Identity() - span.missing());
}

/// Full, fading, in a plane, on a line, in a point.
const Vec3 all_shares[] = {{1, 1, 1},   {1, 1, 0.4},   {1, 1, 1e-8}, {1, 1, 0},
                           {1, 0.3, 0}, {1, 0.3, 0.2}, {1, 0, 0},    {0, 0, 0}};

TEST(Completion, MakesATurnOfWhatASpanCarriesOfIt) {
  Random random(1);
  for (const Vec3& shares : all_shares)
    for (int trial = 0; trial < 20; ++trial) {
      const Span span{random_rotation(random), shares};
      const Mat3 R = random_rotation(random);
      const Mat3 F = Completion(carried(R, span), span).F();
      EXPECT_LT((F.transpose() * F - Mat3::Identity()).norm(), 1e-12) << shares.transpose();
      EXPECT_GT(F.determinant(), 0);
      if (shares[1] > 1e-3) {
        EXPECT_LT((F - R).norm(), 1e-12) << shares.transpose();
      }
    }
}

TEST(Completion, LeavesAPlanesNormalAsTheThirdAxis) {
  Random random(2);
  const Span plane{random_rotation(random), {1, 1, 0}};
  const Mat3 affine = random_matrix(random, 1.5);
  const Mat3 F = Completion(carried(affine, plane), plane).F();
  const Vec3 a = affine * plane.axes.col(0), b = affine * plane.axes.col(1);
  EXPECT_LT((F * plane.axes.col(0) - a).norm() + (F * plane.axes.col(1) - b).norm(), 1e-13);
  EXPECT_LT((F * plane.axes.col(2) - a.cross(b).normalized()).norm(), 1e-13);
  EXPECT_NEAR(F.determinant(), a.cross(b).norm(), 1e-13);
}

TEST(Completion, TurnsALinesOtherAxesAsLittleAsItCan) {
  const Span line{Mat3::Identity(), {1, 0, 0}};
  for (const double angle : {0.0, 1.0, 3.0}) {
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    EXPECT_LT((Completion(carried(R, line), line).F() - R).norm(), 1e-13);
    const Mat3 twisted = R * Eigen::AngleAxisd(1.3, Vec3::UnitX()).toRotationMatrix();
    EXPECT_LT((Completion(carried(twisted, line), line).F() - R).norm(), 1e-13);
  }
  const Mat3 F = Completion(carried(-2 * Mat3::Identity(), line), line).F();  // half a turn
  EXPECT_NEAR(F.determinant(), 2, 1e-12);
}

TEST(Completion, HasItsDerivative) {
  Random random(3);
  constexpr double step = 1e-7;
  for (const Vec3& shares : all_shares) {
    if (shares[2] == 1e-8) continue;  // differences would be all rounding there
    for (int trial = 0; trial < 20; ++trial) {
      const Span span{random_rotation(random), shares};
      const Mat3 F = random_rotation(random) + random_matrix(random, 0.3);
      const Mat3 A = carried(F, span), direction = carried(random_matrix(random, 1), span);
      const Mat3 by_F = random_matrix(random, 1);
      const Mat3 difference = (Completion(A + step * direction, span).F() -
                               Completion(A - step * direction, span).F()) /
                              (2 * step);
      const double slope = Completion(A, span).by_carried(by_F).cwiseProduct(direction).sum();
      EXPECT_NEAR(by_F.cwiseProduct(difference).sum(), slope, 1e-5) << shares.transpose();
    }
  }
}

TEST(Completion, StaysFiniteWhereTheSpanCollapses) {
  for (const Vec3& shares : all_shares) {
    const Span span{Mat3::Identity(), shares};
    for (const Mat3& A :
         {Mat3(Mat3::Zero()), Mat3(Vec3(1, 0, 0).asDiagonal()), Mat3(Vec3(0, 1, 0).asDiagonal())}) {
      const Completion completion(A, span);
      EXPECT_TRUE(completion.F().allFinite());
      EXPECT_TRUE(completion.by_carried(Mat3::Ones()).allFinite());
    }
  }
}

}  // namespace
}  // namespace supple
