#pragma once

#include <Eigen/Eigenvalues>
#include <span>

#include "solver/core/types.h"

namespace supple {

/// Mean and covariance of points, by growing spread.
struct PrincipalAxes {
  Vec3 mean = Vec3::Zero();
  Vec3 variances = Vec3::Zero();  ///< ascending [m²]
  Mat3 axes = Mat3::Identity();   ///< one a column, in the order of `variances`

  /// Share of the spread that is off the best plane: 0 in a plane, 1/3 in a ball.
  double off_plane() const {
    const double sum = variances.sum();
    return sum > 0 ? std::max(variances[0], 0.0) / sum : 0.0;
  }
};

/// Of the chosen rows of `positions` and of row `self`.
inline PrincipalAxes principal_axes(const Points& positions, Index self,
                                    std::span<const int> others) {
  const Vec3 origin = positions.row(self);
  Vec3 sum = Vec3::Zero();
  Mat3 products = Mat3::Zero();
  for (int j : others) {
    const Vec3 way = positions.row(j).transpose() - origin;
    sum += way;
    products += way * way.transpose();
  }
  const double count = static_cast<double>(others.size()) + 1;
  const Vec3 mean = sum / count;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(products / count - mean * mean.transpose());
  return {origin + mean, solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace supple
