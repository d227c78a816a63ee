#include "solver/energy/inversion_barrier.h"

#include <Eigen/Geometry>
#include <limits>

namespace supple {

void InversionBarrier::evaluate(const LocalField& at, LocalResidual& out) const {
  const Vec3 a = at.F.row(0), b = at.F.row(1), c = at.F.row(2);
  const Vec3 cofactor_a = b.cross(c);
  const double J = a.dot(cofactor_a), missing = felt_below - J;
  out.r[0] = 0;
  out.jacobian.row(0).setZero();
  if (missing <= 0) return;
  if (!(J > 0)) {
    out.r[0] = std::numeric_limits<double>::infinity();
    return;
  }
  const double square = missing * missing / (felt_below * felt_below);
  out.r[0] = square * missing / J;
  const double by_J = -square * (3 / J + missing / (J * J));
  out.jacobian.row(0) << by_J * cofactor_a.transpose(), by_J * c.cross(a).transpose(),
      by_J * a.cross(b).transpose();
}

}  // namespace supple
