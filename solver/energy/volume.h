#pragma once

#include "solver/energy/energy.h"

namespace supple {

/// Keeps local volume: r = det F − 1 (Adams & Wicke 2009, Eq. 77).
class SUPPLE_API VolumeEnergy final : public Energy {
 public:
  std::string_view name() const override { return "volume"; }
  Argument argument() const override { return Argument::gradient; }
  int rows() const override { return 1; }
  double stiffness() const override { return 2; }
  void evaluate(const LocalField& at, LocalResidual& out) const override;
  double add_square(const LocalField& at, double weight,
                    LocalDerivative& derivative) const override;
};

}  // namespace supple
