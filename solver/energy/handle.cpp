#include "solver/energy/handle.h"

namespace supple {

void HandleEnergy::evaluate(const LocalField& at, LocalResidual& out) const {
  out.r.head<3>() = at.f - targets_.row(at.sample).transpose();
  out.jacobian.topLeftCorner<3, 3>().setIdentity();
}

double HandleEnergy::add_square(const LocalField& at, double weight,
                                LocalDerivative& derivative) const {
  const Vec3 r = at.f - targets_.row(at.sample).transpose();
  derivative.by_f += 2 * weight * r;
  return weight * r.squaredNorm();
}

}  // namespace supple
