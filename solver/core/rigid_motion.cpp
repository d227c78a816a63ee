#include "solver/core/rigid_motion.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "solver/core/check.h"

namespace supple {
namespace {

/// Horn's matrix: its greatest eigenvector is the quaternion of the rotation that maximises
/// tr(R H), H = Σ w x yᵀ.
Eigen::Matrix4d quaternion_matrix(const Mat3& H) {
  Eigen::Matrix4d N;
  const Vec3 skew(H(1, 2) - H(2, 1), H(2, 0) - H(0, 2), H(0, 1) - H(1, 0));
  N(0, 0) = H.trace();
  N.block<1, 3>(0, 1) = skew.transpose();
  N.block<3, 1>(1, 0) = skew;
  N.block<3, 3>(1, 1) = H + H.transpose() - H.trace() * Mat3::Identity();
  return N;
}

}  // namespace

RigidMotion best_fit_motion(const Points& from, const Points& to, const Eigen::VectorXd& weights) {
  SUPPLE_CHECK(from.rows() == to.rows() && from.rows() == weights.size(), "points correspond");
  const double total = weights.sum();
  RigidMotion motion;
  if (!(total > 0)) return motion;
  const Vec3 from_center = from.transpose() * weights / total;
  const Vec3 to_center = to.transpose() * weights / total;
  Mat3 H = Mat3::Zero();
  for (Index i = 0; i < from.rows(); ++i)
    H += (weights[i] * (from.row(i).transpose() - from_center)) *
         (to.row(i) - to_center.transpose());

  // The identity's small share settles the turns that the points leave open, and no others.
  const double size = H.norm();
  if (size > 0) {
    const Mat3 settled = H + 1e-12 * size * Mat3::Identity();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(quaternion_matrix(settled));
    const Eigen::Vector4d q = eigen.eigenvectors().col(3);
    motion.R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }
  motion.t = to_center - motion.R * from_center;
  return motion;
}

}  // namespace supple
