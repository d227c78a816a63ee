#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/energy/energy.h"
#include "solver/field/samples.h"

namespace supple {

/// Terms that share samples and the samples' weights, so that f or F is found once for all.
struct EnergyGroup {
  struct Term {
    const Energy* energy;
    double weight;  ///< λ
  };
  const Samples* samples;
  Eigen::VectorXd sample_weights;  ///< ω_k, n
  Energy::Argument argument;
  std::vector<Term> terms;
};

/// E(u) = Σ_terms λ Σ_k ω_k |r_k|² as a function of the particles' displacements. Holds pointers
/// to energies and samples that outlive it.
class SUPPLE_API EnergySum {
 public:
  explicit EnergySum(Index particles) : particles_(particles) {}

  /// `sample_weights` ω_k ≥ 0, one a sample; `weight` λ > 0.
  void add(const Energy& energy, const Samples& samples, const Eigen::VectorXd& sample_weights,
           double weight);

  /// E(u), and ∂E/∂u [N×3] where `gradient` is given. `u` [m] N×3.
  double evaluate(const Points& u, Points* gradient = nullptr) const;
  double evaluate_padded(const PaddedPoints& u, PaddedPoints* gradient = nullptr) const;

  /// λ Σ ω |r|² by the energy's name, over all its samples.
  std::vector<std::pair<std::string, double>> values(const Points& u) const;

  Index particles() const { return particles_; }
  const std::vector<EnergyGroup>& groups() const { return groups_; }

 private:
  Index particles_;
  std::vector<EnergyGroup> groups_;
};

}  // namespace supple
