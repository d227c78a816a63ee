#include "solver/field/moving_least_squares.h"

#include <algorithm>
#include <cmath>

#include "solver/core/check.h"
#include "solver/field/filtered_inverse.h"
#include "solver/field/kernel.h"

namespace supple {
namespace {

/// Distance within which a particle can reach, for the neighbour search.
double reach_factor(KernelKind kind, int dim) {
  return kind == KernelKind::box ? std::sqrt(static_cast<double>(dim)) : 1.0;
}

/// The shape functions at one point, as jets.
template <int Dim, int Order>
class PointFit {
 public:
  using J = Jet<Dim, Order>;
  static constexpr int quadratics = Dim * (Dim + 1) / 2;

  explicit PointFit(BasisOrder order) : order_(order) {}

  /// Weights scaled by the greatest one: only their ratios matter, and those near a support's
  /// rim would otherwise vanish in the smallest numbers.
  void weigh(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x,
             std::vector<int>& particles) {
    find_detours(field, x);
    std::size_t kept = 0;
    double greatest = 0;
    for (const int i : particles) {
      const VectorOf<Dim> offset = x - field.positions().row(i).transpose();
      J w = kernel_weight<Dim, Order>(field.options().kernel, offset, field.supports()[i]);
      if constexpr (Dim == 3) w = w * transparency(i, field.supports()[i]);
      if (!(w.value() > 0)) continue;
      particles[kept++] = i;
      weights_.push_back(w);
      offsets_.push_back(-offset);
      supports_.push_back(field.supports()[i]);
      greatest = std::max(greatest, w.value());
    }
    particles.resize(kept);
    for (J& w : weights_) w *= 1 / greatest;
  }

  /// Fills φ_j and returns the rank.
  int fit(std::vector<J>& phi) {
    J total, scale;
    for (std::size_t j = 0; j < weights_.size(); ++j) {
      total += weights_[j];
      scale += weights_[j] * supports_[j];
    }
    const J over_total = reciprocal(total);
    for (J& w : weights_) w = w * over_total;  // now Σ w_j = 1
    const J over_scale = reciprocal(scale * over_total);
    phi = weights_;
    if (order_ == BasisOrder::constant) return 1;
    centre(over_scale);
    const int linear_rank = add_linear(phi);
    if (order_ == BasisOrder::linear) return 1 + linear_rank;
    return 1 + linear_rank + add_quadratic(phi);
  }

 private:
  void find_detours(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x) {
    if constexpr (Dim == 3)
      if (field.detours()) field.detours()->at(x, detours_);
  }

  /// (1 − δ²/h²)³: what a detour δ leaves of a weight.
  J transparency(int particle, double h) const {
    const auto detour = std::lower_bound(detours_.begin(), detours_.end(), particle,
                                         [](const Detour& d, int i) { return d.particle < i; });
    if (detour == detours_.end() || detour->particle != particle) return J(1.0);
    if (detour->length >= h) return J();
    J delta(detour->length / h);
    if constexpr (Order >= 1)
      for (int k = 0; k < Dim; ++k) delta.first(k) = detour->slope[k] / h;
    if constexpr (Order >= 2)
      for (int k = 0; k < Dim; ++k)
        for (int l = k; l < Dim; ++l) delta.second(k, l) = detour->curvature(k, l) / h;
    const J rest = J(1.0) - delta * delta;
    return rest * rest * rest;
  }

  using LinearJets = std::array<J, Dim>;
  using QuadraticJets = std::array<J, quadratics>;

  /// r_j = (x_j − x̄)/h̄ and e = (x − x̄)/h̄, with the weighted means x̄ and h̄.
  void centre(const J& over_scale) {
    LinearJets mean{};
    for (std::size_t j = 0; j < weights_.size(); ++j)
      for (int a = 0; a < Dim; ++a) mean[a] += weights_[j] * offset(j, a);
    r_.resize(weights_.size());
    for (std::size_t j = 0; j < weights_.size(); ++j)
      for (int a = 0; a < Dim; ++a) r_[j][a] = (offset(j, a) - mean[a]) * over_scale;
    for (int a = 0; a < Dim; ++a) e_[a] = J(0.0) - mean[a] * over_scale;
  }

  /// x_j − x along axis a: its derivative by x is −1.
  J offset(std::size_t j, int a) const {
    J d(offsets_[j][a]);
    if constexpr (Order >= 1) d.first(a) = -1;
    return d;
  }

  template <int N>
  static JetMatrix<N, Dim, Order> take_apart(const std::array<J, N*(N + 1) / 2>& upper) {
    JetMatrix<N, Dim, Order> matrices;
    for (int part = 0; part < J::size; ++part)
      for (int a = 0, at = 0; a < N; ++a)
        for (int b = a; b < N; ++b, ++at)
          matrices[part](a, b) = matrices[part](b, a) = upper[at].c[part];
    return matrices;
  }

  template <int N>
  static std::array<J, N> multiply(const JetMatrix<N, Dim, Order>& G, const std::array<J, N>& v) {
    std::array<J, N> product{};
    J entry;
    for (int a = 0; a < N; ++a)
      for (int b = 0; b < N; ++b) {
        for (int part = 0; part < J::size; ++part) entry.c[part] = G[part](a, b);
        product[a] += entry * v[b];
      }
    return product;
  }

  /// φ_j += w_j r_jᵀ G e with G the filtered inverse of Σ w r rᵀ.
  int add_linear(std::vector<J>& phi) {
    std::array<J, Dim*(Dim + 1) / 2> moment{};
    for (std::size_t j = 0; j < r_.size(); ++j)
      for (int a = 0, at = 0; a < Dim; ++a) {
        const J weighted = weights_[j] * r_[j][a];
        for (int b = a; b < Dim; ++b) moment[at++] += weighted * r_[j][b];
      }
    for (int a = 0; a < Dim; ++a) spread_ += moment[J::pair(a, a)] * (1.0 / Dim);
    const int rank = filtered_inverse<Dim, Dim, Order>(take_apart<Dim>(moment), linear_inverse_);
    const LinearJets g = multiply<Dim>(linear_inverse_, e_);
    for (std::size_t j = 0; j < r_.size(); ++j) {
      J c;
      for (int a = 0; a < Dim; ++a) c += r_[j][a] * g[a];
      phi[j] += weights_[j] * c;
    }
    return rank;
  }

  static QuadraticJets monomials(const LinearJets& r) {
    QuadraticJets q;
    for (int a = 0, at = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) q[at++] = r[a] * r[b];
    return q;
  }

  /// The quadratic monomials less what the constant and linear blocks hold of them already,
  /// at every particle; returns the same at x.
  QuadraticJets orthogonal_monomials(std::vector<QuadraticJets>& q) const {
    QuadraticJets mean{};
    std::array<LinearJets, quadratics> cross{};
    for (std::size_t j = 0; j < r_.size(); ++j) {
      q[j] = monomials(r_[j]);
      for (int m = 0; m < quadratics; ++m) {
        const J weighted = weights_[j] * q[j][m];
        mean[m] += weighted;
        for (int a = 0; a < Dim; ++a) cross[m][a] += weighted * r_[j][a];
      }
    }
    for (LinearJets& row : cross) row = multiply<Dim>(linear_inverse_, row);
    const auto subtract = [&](QuadraticJets& at, const LinearJets& r) {
      for (int m = 0; m < quadratics; ++m) {
        at[m] -= mean[m];
        for (int a = 0; a < Dim; ++a) at[m] -= cross[m][a] * r[a];
      }
    };
    for (std::size_t j = 0; j < r_.size(); ++j) subtract(q[j], r_[j]);
    QuadraticJets at_x = monomials(e_);
    subtract(at_x, e_);
    return at_x;
  }

  /// φ_j += w_j q_jᵀ G q(x) with G the filtered inverse of Σ w q qᵀ. The block is measured by
  /// the square of the linear one, its natural size.
  int add_quadratic(std::vector<J>& phi) {
    std::vector<QuadraticJets> q(r_.size());
    const QuadraticJets at_x = orthogonal_monomials(q);
    const J over_size = reciprocal(spread_ * spread_ + J(1e-4));
    std::array<J, quadratics*(quadratics + 1) / 2> moment{};
    for (std::size_t j = 0; j < q.size(); ++j) {
      const J weight = weights_[j] * over_size;
      for (int a = 0, at = 0; a < quadratics; ++a) {
        const J weighted = weight * q[j][a];
        for (int b = a; b < quadratics; ++b) moment[at++] += weighted * q[j][b];
      }
    }
    JetMatrix<quadratics, Dim, Order> inverse;
    const int rank =
        filtered_inverse<quadratics, Dim, Order>(take_apart<quadratics>(moment), inverse);
    QuadraticJets g = multiply<quadratics>(inverse, at_x);
    for (J& component : g) component = component * over_size;
    for (std::size_t j = 0; j < q.size(); ++j) {
      J c;
      for (int m = 0; m < quadratics; ++m) c += q[j][m] * g[m];
      phi[j] += weights_[j] * c;
    }
    return rank;
  }

  BasisOrder order_;
  std::vector<Detour> detours_;
  std::vector<J> weights_;
  std::vector<VectorOf<Dim>> offsets_;
  std::vector<double> supports_;
  std::vector<LinearJets> r_;
  LinearJets e_{};
  J spread_;
  JetMatrix<Dim, Dim, Order> linear_inverse_;
};

template <int Dim, int Order>
void evaluate_jets(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x,
                   ShapeFunctions<Dim>& at_x) {
  PointFit<Dim, Order> fit(field.options().order);
  fit.weigh(field, x, at_x.particles);
  const Index n = static_cast<Index>(at_x.particles.size());
  at_x.values.resize(n);
  at_x.gradients.resize(Order >= 1 ? n : 0, Dim);
  at_x.seconds.resize(Order >= 2 ? n : 0, ShapeFunctions<Dim>::pairs);
  at_x.rank = 0;
  if (n == 0) return;
  std::vector<Jet<Dim, Order>> phi;
  at_x.rank = fit.fit(phi);
  for (Index j = 0; j < n; ++j) {
    const Jet<Dim, Order>& p = phi[static_cast<std::size_t>(j)];
    at_x.values[j] = p.value();
    if constexpr (Order >= 1)
      for (int k = 0; k < Dim; ++k) at_x.gradients(j, k) = p.first(k);
    if constexpr (Order >= 2)
      for (int k = 0; k < ShapeFunctions<Dim>::pairs; ++k) at_x.seconds(j, k) = p.c[1 + Dim + k];
  }
}

}  // namespace

template <int Dim>
MovingLeastSquares<Dim>::MovingLeastSquares(const PointsOf<Dim>& positions,
                                            const Eigen::VectorXd& supports,
                                            const MovingLeastSquaresOptions& options,
                                            std::shared_ptr<const Detours> detours)
    : positions_(positions),
      supports_(supports),
      options_(options),
      detours_(std::move(detours)),
      neighbors_(positions, supports * reach_factor(options.kernel, Dim)) {}

template <int Dim>
void MovingLeastSquares<Dim>::evaluate(const VectorOf<Dim>& x, Derivatives derivatives,
                                       ShapeFunctions<Dim>& at_x) const {
  SUPPLE_CHECK(x.allFinite(), "the point is finite");
  neighbors_.reaching(x, at_x.particles);
  switch (derivatives) {
    case Derivatives::none:
      return evaluate_jets<Dim, 0>(*this, x, at_x);
    case Derivatives::first:
      return evaluate_jets<Dim, 1>(*this, x, at_x);
    case Derivatives::second:
      return evaluate_jets<Dim, 2>(*this, x, at_x);
  }
}

template class MovingLeastSquares<1>;
template class MovingLeastSquares<2>;
template class MovingLeastSquares<3>;

}  // namespace supple
