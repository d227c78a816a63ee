#include "solver/energy/rigidity.h"

#include <numbers>

namespace supple {

void RigidityEnergy::evaluate(const LocalField& at, LocalResidual& out) const {
  const Mat3& F = at.F;
  int row = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b, ++row) {
      // The off-diagonal entries stand twice in the norm.
      const double weight = a == b ? 1 : std::numbers::sqrt2;
      out.r[row] = weight * (F.col(a).dot(F.col(b)) - (a == b ? 1 : 0));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          out.jacobian(row, 3 * i + j) = weight * ((j == a ? F(i, b) : 0) + (j == b ? F(i, a) : 0));
    }
}

double RigidityEnergy::add_square(const LocalField& at, double weight,
                                  LocalDerivative& derivative) const {
  const Mat3 r = at.F.transpose() * at.F - Mat3::Identity();
  derivative.by_F += 4 * weight * (at.F * r);
  return weight * r.squaredNorm();
}

}  // namespace supple
