#pragma once

#include "solver/energy/energy.h"

namespace supple {

/// Leads samples to targets: r = f(x_k) − x'_k (Adams & Wicke 2009, Eq. 74). The sample weights
/// make it a weighted mean over the handles' area.
class SUPPLE_API HandleEnergy final : public Energy {
 public:
  /// `targets` x'_k [m], one a sample.
  explicit HandleEnergy(Points targets) : targets_(std::move(targets)) {}

  std::string_view name() const override { return "handles"; }
  Argument argument() const override { return Argument::position; }
  int rows() const override { return 3; }
  double stiffness() const override { return 2; }
  void evaluate(const LocalField& at, LocalResidual& out) const override;
  double add_square(const LocalField& at, double weight,
                    LocalDerivative& derivative) const override;

  void set_targets(const Points& targets) { targets_ = targets; }

 private:
  Points targets_;
};

}  // namespace supple
