#include "solver/energy/nearest_rotation.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "solver/core/check.h"

namespace supple {

void NearestRotationEnergy::evaluate(const LocalField& at, LocalResidual& out) const {
  const Mat3& R = rotations_[static_cast<std::size_t>(at.sample)];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) out.r[3 * a + b] = at.F(a, b) - R(a, b);
  out.jacobian.setIdentity();
}

void NearestRotationEnergy::turn_to(const Samples& samples, const Points& u) {
  SUPPLE_CHECK(samples.size() == static_cast<Index>(rotations_.size()), "one rotation a sample");
  for (Index k = 0; k < samples.size(); ++k) {
    const Mat3 F = samples.deformation_gradient(k, u);
    const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 U = svd.matrixU();
    if (U.determinant() * svd.matrixV().determinant() < 0) U.col(2) *= -1;
    rotations_[static_cast<std::size_t>(k)] = U * svd.matrixV().transpose();
  }
}

double NearestRotationEnergy::add_square(const LocalField& at, double weight,
                                         LocalDerivative& derivative) const {
  const Mat3 r = at.F - rotations_[static_cast<std::size_t>(at.sample)];
  derivative.by_F += 2 * weight * r;
  return weight * r.squaredNorm();
}

}  // namespace supple
