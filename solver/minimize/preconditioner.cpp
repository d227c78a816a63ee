#include "solver/minimize/preconditioner.h"

#include <Eigen/SparseCholesky>
#include <vector>

#include "solver/core/check.h"

namespace supple {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Up to here C is summed in a dense matrix, which is quicker than sorting its entries.
constexpr Index most_dense = 2000;

/// Calls add(i, j, C_ij's share) for every pair i ≥ j of particles in one sample's row.
template <class Add>
void add_row(const Samples& samples, Index k, Energy::Argument argument, double weight,
             const Add& add) {
  for (int a = samples.row_begin(k); a < samples.row_end(k); ++a)
    for (int b = samples.row_begin(k); b < samples.row_end(k); ++b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      if (samples.particles[i] < samples.particles[j]) continue;
      const double product = argument == Energy::Argument::position
                                 ? samples.values[i] * samples.values[j]
                                 : samples.gradients[i].dot(samples.gradients[j]);
      add(samples.particles[i], samples.particles[j], weight * product);
    }
}

template <class Add>
void add_rows(const EnergySum& energy, const Add& add) {
  for (const EnergyGroup& group : energy.groups()) {
    double stiffness = 0;
    for (const EnergyGroup::Term& term : group.terms)
      stiffness += term.weight * term.energy->stiffness();
    for (Index k = 0; k < group.samples->size(); ++k)
      add_row(*group.samples, k, group.argument, stiffness * group.sample_weights[k], add);
  }
}

/// The lower half of C.
Sparse proxy(const EnergySum& energy) {
  const Index n = energy.particles();
  Sparse C(n, n);
  if (n <= most_dense) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    add_rows(energy, [&](int i, int j, double share) { dense(i, j) += share; });
    C = dense.sparseView();
  } else {
    Triplets triplets;
    add_rows(energy, [&](int i, int j, double share) { triplets.emplace_back(i, j, share); });
    C.setFromTriplets(triplets.begin(), triplets.end());
  }
  // Without enough handles C has null directions; ε keeps them finite and far from the rest.
  const double mean = C.diagonal().sum() / static_cast<double>(n);
  Sparse shift(n, n);
  shift.setIdentity();
  return C + (1e-8 * mean + 1e-300) * shift;
}

}  // namespace

Preconditioner::Preconditioner(const EnergySum& energy) {
  const Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> factor(proxy(energy));
  SUPPLE_CHECK(factor.info() == Eigen::Success, "C is positive definite");
  const Sparse L = factor.matrixL();
  order_.resize(static_cast<std::size_t>(L.cols()));
  for (Index particle = 0; particle < L.cols(); ++particle)
    order_[static_cast<std::size_t>(factor.permutationP().indices()[particle])] =
        static_cast<int>(particle);
  entries_.reserve(static_cast<std::size_t>(L.nonZeros() - L.cols()));
  for (Index j = 0; j < L.cols(); ++j) {
    Sparse::InnerIterator at(L, j);  // the diagonal comes first
    by_diagonal_.push_back(1 / at.value());
    for (++at; at; ++at)
      entries_.push_back(
          {at.value(), static_cast<int>(at.row()), order_[static_cast<std::size_t>(at.row())]});
    starts_.push_back(static_cast<int>(entries_.size()));
  }
}

void Preconditioner::to_displacements(const PaddedPoints& y, PaddedPoints& u) const {
  u.resize(y.rows(), 4);
  for (std::size_t j = order_.size(); j-- > 0;) {
    Eigen::Vector4d sum = y.row(static_cast<Index>(j)), other = Eigen::Vector4d::Zero();
    const Entry *e = entries_.data() + starts_[j], *end = entries_.data() + starts_[j + 1];
    // Two sums, so that one need not wait for the other.
    for (; e + 1 < end; e += 2) {
      sum -= e[0].value * u.row(e[0].particle).transpose();
      other -= e[1].value * u.row(e[1].particle).transpose();
    }
    if (e < end) sum -= e->value * u.row(e->particle).transpose();
    u.row(order_[j]) = by_diagonal_[j] * (sum + other).transpose();
  }
}

void Preconditioner::to_gradient(const PaddedPoints& by_u, PaddedPoints& by_y) const {
  by_y.resize(by_u.rows(), 4);
  for (std::size_t j = 0; j < order_.size(); ++j)
    by_y.row(static_cast<Index>(j)) = by_u.row(order_[j]);
  for (std::size_t j = 0; j < order_.size(); ++j) {
    const Eigen::Vector4d here = by_diagonal_[j] * by_y.row(static_cast<Index>(j)).transpose();
    by_y.row(static_cast<Index>(j)) = here;
    for (int at = starts_[j]; at < starts_[j + 1]; ++at) {
      const Entry& entry = entries_[static_cast<std::size_t>(at)];
      by_y.row(entry.row) -= entry.value * here.transpose();
    }
  }
}

void Preconditioner::to_displacements(Points& y) const {
  PaddedPoints u;
  to_displacements(padded(y), u);
  y = u.leftCols<3>();
}

void Preconditioner::to_gradient(Points& gradient) const {
  PaddedPoints by_y;
  to_gradient(padded(gradient), by_y);
  gradient = by_y.leftCols<3>();
}

}  // namespace supple
