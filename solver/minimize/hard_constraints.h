#pragma once

#include <vector>

#include "solver/field/samples.h"
#include "solver/minimize/preconditioner.h"

namespace supple {

/// Samples of the field that shall be at given places exactly: Φ u = b, the same rows for x, y, z.
///
/// Rank-revealing: of √W Φ = U Σ Vᵀ, with the samples' weights W, the displacements along the
/// columns of V with a σ above rounding are tied to Σ⁻¹ Uᵀ √W b. Rows that contradict each other
/// are met in the least squares, along the directions of great σ alone: along others that would
/// ask for wild displacements. The preconditioned unknowns y (Preconditioner) that leave the tied
/// directions alone are those across an orthonormal basis Q.
class SUPPLE_API HardConstraints {
 public:
  using Basis = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// `weights` ω_k > 0 of the samples; `targets` [m] n×3: where they will be led at last.
  HardConstraints(const Samples& samples, const Eigen::VectorXd& weights, const Points& targets,
                  const Preconditioner& preconditioner);

  /// Decides again what is tied, for other targets [m], n×3, to be led to at last.
  void decide(const Points& targets);

  /// Takes u [N×3] to the displacements that meet the targets [m], n×3, nearest in the measure of
  /// the preconditioner.
  void meet(const Points& targets, Points& u) const;

  /// Takes from y [N×4] what moves the tied directions, in place; `along` is scratch.
  void project(PaddedPoints& y, PaddedPoints& along) const;

  const Basis& Q() const { return Q_; }  ///< N×tied
  Index tied() const { return Q_.cols(); }
  Index left_free() const { return left_free_; }  ///< directions, where targets contradict

 private:
  void tie(Index count);
  Eigen::MatrixXd rows_by_unknowns(Index tied) const;

  const Samples& samples_;
  const Preconditioner& preconditioner_;
  std::vector<int> particles_;   ///< that the samples feel
  Eigen::VectorXd roots_;        ///< √W
  Eigen::VectorXd sigma_;        ///< those above rounding, descending
  Eigen::MatrixXd V_;            ///< particles_ × rank
  Eigen::MatrixXd from_places_;  ///< Uᵀ √W, rank × n
  Basis Q_;                      ///< of L⁻¹ P V, its tied columns
  Eigen::MatrixXd R_;
  Index left_free_ = 0;
};

}  // namespace supple
