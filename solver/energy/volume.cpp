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

}  // namespace supple
