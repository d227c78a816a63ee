#include "solver/energy/volume.h"

#include <Eigen/Geometry>

namespace supple {

void VolumeEnergy::evaluate(const LocalField& at, LocalResidual& out) const {
  // ∂det F/∂F is the cofactor matrix: its rows are cross products of F's rows.
  const Vec3 a = at.F.row(0), b = at.F.row(1), c = at.F.row(2);
  const Vec3 cofactor_a = b.cross(c);
  out.r[0] = a.dot(cofactor_a) - 1;
  out.jacobian.row(0) << cofactor_a.transpose(), c.cross(a).transpose(), a.cross(b).transpose();
}

double VolumeEnergy::add_square(const LocalField& at, double weight,
                                LocalDerivative& derivative) const {
  // The cofactor's columns are cross products of F's columns.
  const Vec3 a = at.F.col(0), b = at.F.col(1), c = at.F.col(2);
  const Vec3 cofactor_a = b.cross(c);
  const double r = a.dot(cofactor_a) - 1;
  derivative.by_F.col(0) += 2 * weight * r * cofactor_a;
  derivative.by_F.col(1) += 2 * weight * r * c.cross(a);
  derivative.by_F.col(2) += 2 * weight * r * a.cross(b);
  return weight * r * r;
}

}  // namespace supple
