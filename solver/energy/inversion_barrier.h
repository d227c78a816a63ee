#pragma once

#include "solver/energy/energy.h"

namespace supple {

/// Keeps points from turning inside out: r = (J₀ − J)³ / (J₀² J) where J = det F < J₀, else 0.
/// Twice continuously differentiable while J > 0, infinite from 0 on; starts must have J > 0.
class SUPPLE_API InversionBarrier final : public Energy {
 public:
  static constexpr double felt_below = 0.2;  ///< J₀

  std::string_view name() const override { return "no_inversion"; }
  Argument argument() const override { return Argument::gradient; }
  int rows() const override { return 1; }
  double stiffness() const override { return 0; }  // not felt at rest
  void evaluate(const LocalField& at, LocalResidual& out) const override;
};

}  // namespace supple
