#include "solver/minimize/preconditioner.h"

#include <vector>

#include "solver/core/check.h"

namespace supple {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Adds weight·(ρ_i·ρ_j) for every pair of particles in one sample's row.
void add_row(const Samples& samples, Index k, Energy::Argument argument, double weight,
             Triplets& triplets) {
  for (int a = samples.row_begin(k); a < samples.row_end(k); ++a)
    for (int b = samples.row_begin(k); b < samples.row_end(k); ++b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      const double product = argument == Energy::Argument::position
                                 ? samples.values[i] * samples.values[j]
                                 : samples.gradients[i].dot(samples.gradients[j]);
      triplets.emplace_back(samples.particles[i], samples.particles[j], weight * product);
    }
}

Eigen::SparseMatrix<double> proxy(const EnergySum& energy) {
  const Index n = energy.particles();
  Triplets triplets;
  for (const EnergyGroup& group : energy.groups()) {
    double stiffness = 0;
    for (const EnergyGroup::Term& term : group.terms)
      stiffness += term.weight * term.energy->stiffness();
    for (Index k = 0; k < group.samples->size(); ++k)
      add_row(*group.samples, k, group.argument, stiffness * group.sample_weights[k], triplets);
  }
  Eigen::SparseMatrix<double> C(n, n);
  C.setFromTriplets(triplets.begin(), triplets.end());
  // Without enough handles C has null directions; ε keeps them finite and far from the rest.
  const double mean = C.diagonal().sum() / static_cast<double>(n);
  Eigen::SparseMatrix<double> shift(n, n);
  shift.setIdentity();
  return C + (1e-8 * mean + 1e-300) * shift;
}

}  // namespace

Preconditioner::Preconditioner(const EnergySum& energy) : particles_(energy.particles()) {
  const Sparse C = proxy(energy);
  if (energy.particles() <= most_dense) {
    dense_.emplace(Eigen::MatrixXd(C));
    SUPPLE_CHECK(dense_->info() == Eigen::Success, "C is positive definite");
  } else {
    sparse_.compute(C);
    SUPPLE_CHECK(sparse_.info() == Eigen::Success, "C is positive definite");
  }
}

void Preconditioner::to_displacements(Points& y) const {
  if (dense_) {
    dense_->matrixU().solveInPlace(y);
    return;
  }
  sparse_.matrixU().solveInPlace(y);
  y = sparse_.permutationPinv() * y;
}

void Preconditioner::to_gradient(Points& gradient) const {
  if (dense_) {
    dense_->matrixL().solveInPlace(gradient);
    return;
  }
  gradient = sparse_.permutationP() * gradient;
  sparse_.matrixL().solveInPlace(gradient);
}

}  // namespace supple
