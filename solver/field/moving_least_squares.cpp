#include "solver/field/moving_least_squares.h"

#include <algorithm>
#include <cmath>

#include "solver/core/check.h"
#include "solver/field/point_evaluation.h"
#include "solver/field/symmetric_eigen.h"

namespace supple {
namespace {

/// Distance within which a particle can reach, for the neighbour search.
template <int Dim>
Eigen::VectorXd reaches_of(const Eigen::VectorXd& supports,
                           const std::vector<MatrixOf<Dim>>& stretches, KernelKind kernel) {
  Eigen::VectorXd reaches = supports;
  if (kernel == KernelKind::box) reaches *= std::sqrt(static_cast<double>(Dim));
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    MatrixOf<Dim> axes;
    VectorOf<Dim> factors;
    symmetric_eigen<Dim>(stretches[i], axes, factors);
    reaches[static_cast<Index>(i)] /= factors[0];  // the longest axis
  }
  return reaches;
}

}  // namespace

template <int Dim>
MovingLeastSquares<Dim>::MovingLeastSquares(const PointsOf<Dim>& positions,
                                            const Eigen::VectorXd& supports,
                                            const MovingLeastSquaresOptions& options,
                                            std::shared_ptr<const Detours> detours,
                                            std::vector<MatrixOf<Dim>> stretches)
    : positions_(positions),
      supports_(supports),
      options_(options),
      detours_(std::move(detours)),
      stretches_(std::move(stretches)),
      neighbors_(positions, reaches_of<Dim>(supports, stretches_, options.kernel)) {
  SUPPLE_CHECK(stretches_.empty() || static_cast<Index>(stretches_.size()) == supports.size(),
               "one stretch a particle");
}

template <int Dim>
void MovingLeastSquares<Dim>::evaluate(const VectorOf<Dim>& x, Derivatives derivatives,
                                       ShapeFunctions<Dim>& at_x) const {
  if (derivatives == Derivatives::first && options_.gradient == GradientKind::least_squares)
    return evaluate_fitted(x, at_x);
  SUPPLE_CHECK(x.allFinite(), "the point is finite");
  neighbors_.reaching(x, at_x.particles);
  switch (derivatives) {
    case Derivatives::none:
      return evaluate_at<Dim, 0>(*this, x, at_x);
    case Derivatives::first:
      return evaluate_at<Dim, 1>(*this, x, at_x);
    case Derivatives::second:
      return evaluate_at<Dim, 2>(*this, x, at_x);
  }
}

template <int Dim>
void MovingLeastSquares<Dim>::evaluate_fitted(const VectorOf<Dim>& x,
                                              ShapeFunctions<Dim>& at_x) const {
  SUPPLE_CHECK(x.allFinite(), "the point is finite");
  neighbors_.reaching(x, at_x.particles);
  fit_at<Dim>(*this, x, at_x);
}

template class MovingLeastSquares<1>;
template class MovingLeastSquares<2>;
template class MovingLeastSquares<3>;

}  // namespace supple
