#pragma once

#include <vector>

#include "solver/energy/energy_sum.h"

namespace supple {

/// A constant scalar stand-in for the energy's Hessian, shared by x, y and z:
///
///     C = Σ_terms λ c Σ_k ω_k ρ_k ρ_kᵀ + ε I,   ρ = φ or each component of ∇φ,
///
/// with c the term's stiffness. It lies above the rigidity's Hessian at every rotation, so a
/// quasi-Newton method on y, u = Pᵀ L⁻ᵀ y with P C Pᵀ = L Lᵀ, needs few iterations whatever the
/// number of particles. It depends on where the handles are, not on where they go.
class SUPPLE_API Preconditioner {
 public:
  explicit Preconditioner(const EnergySum& energy);

  Index particles() const { return static_cast<Index>(order_.size()); }

  /// u = Pᵀ L⁻ᵀ y; N×4, not the same as y.
  void to_displacements(const PaddedPoints& y, PaddedPoints& u) const;
  /// ∂E/∂y = L⁻¹ P ∂E/∂u; N×4, not the same as by_u.
  void to_gradient(const PaddedPoints& by_u, PaddedPoints& by_y) const;

  /// The same in place, on N×3.
  void to_displacements(Points& y) const;
  void to_gradient(Points& gradient) const;

 private:
  struct Entry {
    double value;
    int row, particle;  ///< in L, and the particle that stands there
  };

  std::vector<int> order_;           ///< the particle in each row of L
  std::vector<double> by_diagonal_;  ///< 1 / L_jj
  std::vector<int> starts_{0};       ///< N+1 offsets into entries_, by columns of L
  std::vector<Entry> entries_;       ///< below the diagonal
};

}  // namespace supple
