#pragma once

#include <limits>
#include <string_view>

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// The field at one sample.
struct LocalField {
  Index sample = 0;
  Vec3 f = Vec3::Zero();      ///< deformed position [m]
  Mat3 F = Mat3::Identity();  ///< deformation gradient
};

/// Residual r of a term at one sample and its derivative by the term's argument.
struct LocalResidual {
  static constexpr int most_rows = 9;
  Eigen::Matrix<double, most_rows, 1> r;
  /// ∂r/∂f in the first three columns, or ∂r/∂F with F(a, b) in column 3a + b.
  Eigen::Matrix<double, most_rows, 9> jacobian;
};

/// ∂/∂f or ∂/∂F of a sum of squares at one sample; energies add theirs.
struct LocalDerivative {
  Vec3 by_f = Vec3::Zero();
  Mat3 by_F = Mat3::Zero();
};

/// A sum of squares over samples, Σ_k ω_k |r(f_k or F_k)|², told by its residual at one sample.
/// Value, gradient, Gauss–Newton matrix and least-squares blocks all come from that one place;
/// an energy knows neither particles nor weights.
class SUPPLE_API Energy {
 public:
  enum class Argument { position, gradient };

  virtual ~Energy() = default;

  /// As in reports: "rigidity".
  virtual std::string_view name() const = 0;

  /// Whether r is a function of f or of F.
  virtual Argument argument() const = 0;

  /// How many rows of the residual are used, ≤ LocalResidual::most_rows.
  virtual int rows() const = 0;

  /// A scalar c with c·|δ|² above the second-order change of |r|² at rest, for a change δ of the
  /// argument: what this term adds to the constant preconditioner.
  virtual double stiffness() const = 0;

  virtual void evaluate(const LocalField& at, LocalResidual& out) const = 0;

  /// weight·|r|², and adds weight·∂|r|²/∂(f or F) to `derivative`: what a solve asks for millions
  /// of times. The same as by evaluate(); energies override it where there is a shorter way.
  virtual double add_square(const LocalField& at, double weight, LocalDerivative& derivative) const;
};

/// +∞ is what a barrier answers outside of its domain; whatever else is not finite is trouble.
inline bool beyond_a_barrier(double energy) {
  return energy == std::numeric_limits<double>::infinity();
}

}  // namespace supple
