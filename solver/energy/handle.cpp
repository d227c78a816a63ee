#include "solver/energy/handle.h"

namespace supple {

void HandleEnergy::evaluate(const LocalField& at, LocalResidual& out) const {
  out.r.head<3>() = at.f - targets_.row(at.sample).transpose();
  out.jacobian.topLeftCorner<3, 3>().setIdentity();
}

}  // namespace supple
