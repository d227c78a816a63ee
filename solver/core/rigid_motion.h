#pragma once

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// x ↦ R x + t.
struct RigidMotion {
  Mat3 R = Mat3::Identity();
  Vec3 t = Vec3::Zero();

  Vec3 operator()(const Vec3& x) const { return R * x + t; }
};

/// The rigid motion that takes `from` nearest to `to` [m, n×3], least Σ w |R x + t − y|², w ≥ 0.
/// Where the points leave a turn open (one point, points on a line) it takes the smallest turn;
/// with no points, or no weight, the identity. Source: Kabsch 1976; Horn 1987.
SUPPLE_API RigidMotion best_fit_motion(const Points& from, const Points& to,
                                       const Eigen::VectorXd& weights);

}  // namespace supple
