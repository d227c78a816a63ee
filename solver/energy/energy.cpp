#include "solver/energy/energy.h"

namespace supple {

double Energy::add_square(const LocalField& at, double weight, LocalDerivative& derivative) const {
  LocalResidual local;
  evaluate(at, local);
  const auto r = local.r.head(rows());
  if (argument() == Argument::position) {
    derivative.by_f += 2 * weight * (local.jacobian.topLeftCorner(rows(), 3).transpose() * r);
  } else {
    const Eigen::Matrix<double, 9, 1> by_F = local.jacobian.topRows(rows()).transpose() * r;
    derivative.by_F +=
        2 * weight * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(by_F.data());
  }
  return weight * r.squaredNorm();
}

}  // namespace supple
