#pragma once

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <optional>

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

  Index particles() const { return particles_; }

  /// Pᵀ L⁻ᵀ y, in place on y [N×3].
  void to_displacements(Points& y) const;
  /// ∂E/∂y = L⁻¹ P ∂E/∂u, in place.
  void to_gradient(Points& gradient) const;

 private:
  using Sparse = Eigen::SparseMatrix<double>;

  /// Above this size the sparse factor is the faster one.
  static constexpr Index most_dense = 400;

  Index particles_;
  std::optional<Eigen::LLT<Eigen::MatrixXd>> dense_;
  Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> sparse_;
};

}  // namespace supple
