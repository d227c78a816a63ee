#pragma once

#include "solver/energy/energy.h"

namespace supple {

/// Keeps local shape: |r|² = ‖FᵀF − I‖² (Adams & Wicke 2009, Eq. 76, with V_i the particle's part
/// of the volume).
class SUPPLE_API RigidityEnergy final : public Energy {
 public:
  std::string_view name() const override { return "rigidity"; }
  Argument argument() const override { return Argument::gradient; }
  int rows() const override { return 6; }
  double stiffness() const override { return 8; }
  void evaluate(const LocalField& at, LocalResidual& out) const override;
  double add_square(const LocalField& at, double weight,
                    LocalDerivative& derivative) const override;
};

}  // namespace supple
