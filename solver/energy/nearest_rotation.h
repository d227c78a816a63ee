#pragma once

#include <vector>

#include "solver/energy/energy.h"
#include "solver/field/samples.h"

namespace supple {

/// As rigid as possible: r = F − R_k with a rotation for each sample, det R = +1 (Sorkine & Alexa
/// 2007). Convex while the rotations stand; pulls also what is flat, mirrored or a point back to a
/// shape, where the other energies may be stationary.
class SUPPLE_API NearestRotationEnergy final : public Energy {
 public:
  explicit NearestRotationEnergy(Index samples)
      : rotations_(static_cast<std::size_t>(samples), Mat3::Identity()) {}

  std::string_view name() const override { return "nearest_rotation"; }
  Argument argument() const override { return Argument::gradient; }
  int rows() const override { return 9; }
  double stiffness() const override { return 4; }  // 2 where no F is completed by a rotation
  void evaluate(const LocalField& at, LocalResidual& out) const override;
  double add_square(const LocalField& at, double weight,
                    LocalDerivative& derivative) const override;

  /// R_k ← the rotation nearest to F_k.
  void turn_to(const Samples& samples, const Points& u);

 private:
  std::vector<Mat3> rotations_;
};

}  // namespace supple
