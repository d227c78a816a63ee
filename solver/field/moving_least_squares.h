#pragma once

#include <memory>
#include <vector>

#include "solver/field/derivatives.h"
#include "solver/field/detours.h"
#include "solver/field/kernel.h"
#include "solver/field/moving_least_squares_options.h"
#include "solver/field/neighbors.h"

namespace supple {

template <int Dim>
using MatrixOf = Eigen::Matrix<double, Dim, Dim>;

/// The shape functions that do not vanish at one point. Meant to be reused from point to point.
template <int Dim>
struct ShapeFunctions {
  static constexpr int pairs = Dim * (Dim + 1) / 2;

  std::vector<int> particles;  ///< n, ascending
  Eigen::VectorXd values;      ///< φ_i, n
  PointsOf<Dim> gradients;     ///< ∇φ_i [1/m], n×Dim
  PointsOf<pairs> seconds;     ///< ∂²φ_i [1/m²], n×pairs: xx, xy, xz, yy, yz, zz
  int rank = 0;  ///< of the moment matrix, directions kept by half at least; the basis's size
                 ///< where nothing is lost

  /// Orthonormal columns in which the linear block falls apart, and the share of each that it
  /// keeps: affine fields are exact where all are 1.
  MatrixOf<Dim> axes;
  VectorOf<Dim> shares;

  bool covered() const { return !particles.empty(); }
};

struct MovingLeastSquaresOptions {
  BasisOrder order = BasisOrder::linear;
  KernelKind kernel = KernelKind::polynomial;
  GradientKind gradient = GradientKind::full;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("order", self.order, {.doc = "polynomials that the field reproduces exactly"});
    visit("kernel", self.kernel, {.doc = "weight function"});
    visit("gradient", self.gradient, {.doc = "where first derivatives come from"});
  }
};

/// Moving least squares shape functions φ_i(x) over particles with their own supports.
///
/// They reproduce all polynomials of the basis's order wherever the particles that reach x span
/// it. The weighted basis is orthogonalised block by block (constant, linear, quadratic), centred
/// at the particles' weighted mean and scaled by their support; inside a block, directions that
/// the particles do not span fade out smoothly. So Σφ_i = 1 holds to rounding everywhere, and
/// values and derivatives stay bounded and continuous where the rank falls.
///
/// The singular kernel makes φ_j(x_i) = δ_ij: the weights are multiplied by the square of the
/// distance to the nearest particle, and the moments divided by it, before any number is formed;
/// so values and derivatives are exact at and near the particles too.
/// Source: Adams & Wicke 2009, Eq. 21–32; errata.
template <int Dim>
class SUPPLE_API MovingLeastSquares {
 public:
  static constexpr int basis_size(BasisOrder order) {
    if (order == BasisOrder::constant) return 1;
    return order == BasisOrder::linear ? 1 + Dim : 1 + Dim + Dim * (Dim + 1) / 2;
  }

  /// `positions` [m] n×Dim, `supports` h_i [m] n. With `detours` (in space only) particles reach
  /// a point by the way inside the shape. With `stretches` N_i, symmetric and of determinant 1,
  /// the support of a particle is the ellipsoid |N_i (x − x_i)| < h_i.
  MovingLeastSquares(const PointsOf<Dim>& positions, const Eigen::VectorXd& supports,
                     const MovingLeastSquaresOptions& options = {},
                     std::shared_ptr<const Detours> detours = nullptr,
                     std::vector<MatrixOf<Dim>> stretches = {});

  /// Shape functions at x [m] with the derivatives asked for; none where x is not covered.
  /// Second derivatives come with the full first ones.
  void evaluate(const VectorOf<Dim>& x, Derivatives derivatives, ShapeFunctions<Dim>& at_x) const;

  /// φ and the fit's gradients (GradientKind::least_squares), whatever the options say: the linear
  /// block's share P of an affine field's gradient is exact in them also where the rank is short.
  void evaluate_fitted(const VectorOf<Dim>& x, ShapeFunctions<Dim>& at_x) const;

  /// The same over the same particles, with other options.
  MovingLeastSquares with(const MovingLeastSquaresOptions& options) const {
    return {positions_, supports_, options, detours_, stretches_};
  }

  const PointsOf<Dim>& positions() const { return positions_; }
  const Eigen::VectorXd& supports() const { return supports_; }
  const std::vector<MatrixOf<Dim>>& stretches() const { return stretches_; }
  const MovingLeastSquaresOptions& options() const { return options_; }
  Support<Dim> support(int particle) const {
    const auto i = static_cast<std::size_t>(particle);
    return {supports_[particle], stretches_.empty() ? nullptr : &stretches_[i]};
  }
  const std::shared_ptr<const Detours>& detours() const { return detours_; }
  const Neighbors<Dim>& neighbors() const { return neighbors_; }

 private:
  PointsOf<Dim> positions_;
  Eigen::VectorXd supports_;
  MovingLeastSquaresOptions options_;
  std::shared_ptr<const Detours> detours_;
  std::vector<MatrixOf<Dim>> stretches_;
  Neighbors<Dim> neighbors_;
};

}  // namespace supple
