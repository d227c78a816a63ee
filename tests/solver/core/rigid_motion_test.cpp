#include "solver/core/rigid_motion.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "solver/core/random.h"

namespace supple {
namespace {

Points random_points(Index count, std::uint64_t seed) {
  Random random(seed);
  Points points(count, 3);
  for (Index i = 0; i < count; ++i) points.row(i) = random.in_cube(-1, 1).transpose();
  return points;
}

TEST(BestFitMotion, FindsAnExactMotionAlsoByHalfATurn) {
  const Points from = random_points(20, 1);
  for (const double degrees : {0.0, 30.0, 90.0, 179.0, 180.0}) {
    const Mat3 R = Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Vec3(1, -2, 0.5).normalized())
                       .toRotationMatrix();
    const Eigen::RowVector3d t(1000, -3, 7);
    const Points to = (from * R.transpose()).rowwise() + t;
    const RigidMotion motion = best_fit_motion(from, to, Eigen::VectorXd::Ones(20));
    EXPECT_LT((motion.R - R).norm(), 1e-9) << degrees;
    EXPECT_LT((motion.t - t.transpose()).norm(), 1e-9) << degrees;
  }
}

TEST(BestFitMotion, NeverReflects) {
  const Points from = random_points(20, 2);
  Points to = from;
  to.col(0) *= -1;
  const RigidMotion motion = best_fit_motion(from, to, Eigen::VectorXd::Ones(20));
  EXPECT_NEAR(motion.R.determinant(), 1, 1e-12);
}

TEST(BestFitMotion, TakesTheSmallestTurnWhereItIsOpen) {
  const Points one = random_points(1, 3);
  const RigidMotion translation =
      best_fit_motion(one, one.rowwise() + Eigen::RowVector3d(1, 2, 3), Eigen::VectorXd::Ones(1));
  EXPECT_LT((translation.R - Mat3::Identity()).norm(), 1e-12);
  EXPECT_LT((translation.t - Vec3(1, 2, 3)).norm(), 1e-12);

  // Points on a line: no spin about it.
  Points line(4, 3);
  line << 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0;
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  const RigidMotion turn = best_fit_motion(line, line * R.transpose(), Eigen::VectorXd::Ones(4));
  EXPECT_LT((turn.R - R).norm(), 1e-6);
}

TEST(BestFitMotion, IsTheIdentityWithoutWeight) {
  const RigidMotion motion =
      best_fit_motion(random_points(3, 4), random_points(3, 5), Eigen::VectorXd::Zero(3));
  EXPECT_EQ(motion.R, Mat3::Identity());
  EXPECT_EQ(motion.t, Vec3::Zero());
}

}  // namespace
}  // namespace supple
