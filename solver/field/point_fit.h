#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "solver/core/resize.h"
#include "solver/field/filtered_inverse.h"
#include "solver/field/kernel.h"
#include "solver/field/moving_least_squares.h"
#include "solver/field/point_evaluation.h"

namespace supple {

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
    if (particles.empty()) return;
    find_detours(field, x);
    weights_.reserve(particles.size());
    offsets_.reserve(particles.size());
    supports_.reserve(particles.size());
    const bool singular = field.options().kernel == KernelKind::singular;
    std::size_t kept = 0;
    double greatest = 0;
    for (const int i : particles) {
      const VectorOf<Dim> offset = x - field.positions().row(i).transpose();
      const Support<Dim> support = field.support(i);
      J w = kernel_weight<Dim, Order>(field.options().kernel, offset, support);
      if constexpr (Dim == 3) w = w * transparency(i, support.h);
      if (!(w.value() > 0)) continue;
      particles[kept++] = i;
      weights_.push_back(w);
      offsets_.push_back(-offset);
      supports_.push_back(support.h);
      if (singular) {
        const VectorOf<Dim> d = support.scaled(offset);
        squares_.push_back(support.template square<Order>(d, d.squaredNorm()));
      }
      greatest = std::max(greatest, w.value());
    }
    particles.resize(kept);
    for (J& w : weights_) w *= 1 / greatest;
    if (singular && kept > 0) anchor_weights();
  }

  /// Fills φ_j and returns the rank.
  int fit(std::vector<J>& phi) {
    normalise();
    phi = weights_;
    if (order_ == BasisOrder::constant) return 1;
    invert_linear();
    add_linear(phi);
    int rank = 1 + span_.rank();
    if (order_ == BasisOrder::quadratic) rank += add_quadratic(phi);
    if (anchored())
      leave_rest_to_anchor(phi);
    else
      restore_unity(phi);
    return rank;
  }

  /// Fills the slopes of the linear fit, w_j G r_j/h̄, after fit().
  void fit_slopes(PointsOf<Dim>& slopes) {
    if (order_ == BasisOrder::constant) invert_linear();
    const std::vector<J>& v = block_weights();
    const double over_scale = over_scale_.value();
    resize_rows(slopes, static_cast<Index>(v.size()));
    for (std::size_t j = 0; j < v.size(); ++j) {
      const LinearJets r = place(j);
      for (int a = 0; a < Dim; ++a) {
        double slope = 0;
        for (int b = 0; b < Dim; ++b) slope += linear_inverse_[0](a, b) * r[b].value();
        slopes(static_cast<Index>(j), a) = v[j].value() * over_scale * slope;
      }
    }
    if (!anchored()) return;
    slopes.row(static_cast<Index>(anchor_)).setZero();
    slopes.row(static_cast<Index>(anchor_)) = -slopes.colwise().sum();
  }

  /// Of the linear block; full where there is none.
  const BlockSpan<Dim>& span() const { return span_; }

 private:
  static constexpr std::size_t no_anchor = static_cast<std::size_t>(-1);
  bool anchored() const { return anchor_ != no_anchor; }

  /// Makes Σ φ_j = 1 to rounding where it is not: over a small eigenvalue λ the blocks' own sums,
  /// zero by design, are so to 1e-16/λ only.
  void restore_unity(std::vector<J>& phi) const {
    double sum = 0;
    for (const J& p : phi) sum += p.value();
    if (std::abs(sum - 1) < 1e-14) return;
    J rest(1.0);
    for (const J& p : phi) rest -= p;
    for (std::size_t j = 0; j < phi.size(); ++j) phi[j] += weights_[j] * rest;
  }

  /// The anchor takes what the others leave: its block weight is not its weight.
  void leave_rest_to_anchor(std::vector<J>& phi) const {
    J rest(1.0);
    for (std::size_t j = 0; j < phi.size(); ++j)
      if (j != anchor_) rest -= phi[j];
    phi[anchor_] = rest;
  }

  /// Weights of the singular kernel, k_j/t_j with t = q². Times the least one, τ = t_a of the
  /// particle a nearest to x, they are τ c_j with c_j = k_j/t_j, and k_a: finite and smooth at
  /// x = x_a too. There all but k_a vanish, and with them the moments, as τ does. So moments and
  /// what stands over them are taken over τ: block weights c_j instead of τ c_j; and as a's own
  /// distance from the mean is τρ with a finite ρ, it is told by ρ and the block weight τ k_a.
  void anchor_weights() {
    anchor_ = 0;
    for (std::size_t j = 1; j < squares_.size(); ++j)
      if (squares_[j].value() < squares_[anchor_].value()) anchor_ = j;
    tau_ = squares_[anchor_];
    block_weights_.resize(weights_.size());
    for (std::size_t j = 0; j < weights_.size(); ++j) {
      if (j == anchor_) continue;
      // Of particles at one place the first one counts.
      if (!(squares_[j].value() > 1e-30)) {
        block_weights_[j] = weights_[j] = J();
        continue;
      }
      block_weights_[j] = weights_[j] * reciprocal(squares_[j]);
      weights_[j] = block_weights_[j] * tau_;
    }
  }

  const std::vector<J>& block_weights() const { return anchored() ? block_weights_ : weights_; }

  /// Makes Σ w_j = 1.
  void normalise() {
    J total, scale;
    for (std::size_t j = 0; j < weights_.size(); ++j) {
      total += weights_[j];
      scale += weights_[j] * supports_[j];
    }
    const J over_total = reciprocal(total);
    for (J& w : weights_) w = w * over_total;
    over_scale_ = reciprocal(scale * over_total);
    if (!anchored()) return;
    for (J& v : block_weights_) v = v * over_total;
    block_weights_[anchor_] = weights_[anchor_] * tau_;
  }

  void find_detours(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x) {
    if constexpr (Dim == 3)
      if (field.detours()) field.detours()->at(x, Derivatives{Order}, detours_);
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

  /// Offsets from a fixed place, the weighted mean's value, which x may move without moving it:
  /// only the mean m from there has derivatives, and they are the same for all particles.
  void centre() {
    origin_.setZero();
    for (std::size_t j = 0; j < weights_.size(); ++j) origin_ += weights_[j].value() * offsets_[j];
    for (VectorOf<Dim>& offset : offsets_) offset -= origin_;
    mean_ = {};
    for (std::size_t j = 0; j < weights_.size(); ++j)
      for (int a = 0; a < Dim; ++a) mean_[a] += weights_[j] * offsets_[j][a];
    for (int a = 0; a < Dim; ++a) {
      J at_x(-origin_[a]);
      if constexpr (Order >= 1) at_x.first(a) = 1;
      e_[a] = (at_x - mean_[a]) * over_scale_;
    }
    if (anchored()) anchor_place_ = anchor_place();
  }

  /// r_j = (x_j − x̄)/h̄, with the weighted means x̄ and h̄.
  LinearJets place(std::size_t j) const {
    if (j == anchor_) return anchor_place_;
    LinearJets r;
    for (int a = 0; a < Dim; ++a) r[a] = (J(offsets_[j][a]) - mean_[a]) * over_scale_;
    return r;
  }

  /// ρ = (x_a − x̄)/(τ h̄).
  LinearJets anchor_place() const {
    LinearJets place{};
    for (std::size_t j = 0; j < weights_.size(); ++j)
      if (j != anchor_)
        for (int a = 0; a < Dim; ++a)
          place[a] -= block_weights_[j] * (offsets_[j][a] - offsets_[anchor_][a]);
    for (J& coordinate : place) coordinate = coordinate * over_scale_;
    return place;
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

  /// G, the filtered inverse of Σ w r rᵀ.
  void invert_linear() {
    centre();
    auto moment = linear_moment();
    for (int a = 0; a < Dim; ++a) spread_ += moment[J::pair(a, a)] * (1.0 / Dim);
    span_ =
        filtered_inverse<Dim, Dim, Order>(linear_window, take_apart<Dim>(moment), linear_inverse_);
  }

  /// Σ w (d − m)(d − m)ᵀ/h̄² over offsets d from the origin: summed without m, which is added after.
  std::array<J, Dim*(Dim + 1) / 2> linear_moment() const {
    const std::vector<J>& v = block_weights();
    std::array<J, Dim*(Dim + 1) / 2> moment{};
    LinearJets first{};
    J total;
    for (std::size_t j = 0; j < v.size(); ++j) {
      if (j == anchor_) continue;
      const VectorOf<Dim>& d = offsets_[j];
      total += v[j];
      for (int a = 0, at = 0; a < Dim; ++a) {
        first[a] += v[j] * d[a];
        for (int b = a; b < Dim; ++b) moment[at++] += v[j] * (d[a] * d[b]);
      }
    }
    for (int a = 0, at = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b, ++at) {
        moment[at] += (total * mean_[a] - first[a]) * mean_[b] - mean_[a] * first[b];
        moment[at] = moment[at] * over_scale_ * over_scale_;
        if (anchored()) moment[at] += v[anchor_] * anchor_place_[a] * anchor_place_[b];
      }
    return moment;
  }

  /// φ_j += w_j r_jᵀ G e.
  void add_linear(std::vector<J>& phi) const {
    const std::vector<J>& v = block_weights();
    const LinearJets g = multiply<Dim>(linear_inverse_, e_);
    LinearJets slope;  // by offsets
    J at_origin;
    for (int a = 0; a < Dim; ++a) {
      slope[a] = g[a] * over_scale_;
      at_origin -= mean_[a] * slope[a];
    }
    for (std::size_t j = 0; j < v.size(); ++j) {
      J c = at_origin;
      for (int a = 0; a < Dim; ++a) c += slope[a] * offsets_[j][a];
      if (j == anchor_) c = product(anchor_place_, g);
      phi[j] += v[j] * c;
    }
  }

  template <std::size_t N>
  static J product(const std::array<J, N>& a, const std::array<J, N>& b) {
    J sum;
    for (std::size_t k = 0; k < N; ++k) sum += a[k] * b[k];
    return sum;
  }

  static QuadraticJets monomials(const LinearJets& r) {
    QuadraticJets q;
    for (int a = 0, at = 0; a < Dim; ++a)
      for (int b = a; b < Dim; ++b) q[at++] = r[a] * r[b];
    return q;
  }

  /// The quadratic monomials less what the constant and linear blocks hold of them already,
  /// at every particle; returns the same at x.
  QuadraticJets orthogonal_monomials(const std::vector<LinearJets>& r,
                                     std::vector<QuadraticJets>& q) const {
    const std::vector<J>& v = block_weights();
    QuadraticJets mean{};
    std::array<LinearJets, quadratics> cross{};
    for (std::size_t j = 0; j < r.size(); ++j) {
      q[j] = monomials(r[j]);
      if (j == anchor_)
        for (J& monomial : q[j]) monomial = monomial * tau_;
      for (int m = 0; m < quadratics; ++m) {
        const J weighted = v[j] * q[j][m];
        mean[m] += j == anchor_ ? weights_[j] * q[j][m] : weighted;
        for (int a = 0; a < Dim; ++a) cross[m][a] += weighted * r[j][a];
      }
    }
    for (LinearJets& row : cross) row = multiply<Dim>(linear_inverse_, row);
    const auto subtract = [&](QuadraticJets& at, const LinearJets& place) {
      for (int m = 0; m < quadratics; ++m) at[m] -= mean[m] + product(cross[m], place);
    };
    if (anchored()) subtract(q[anchor_], r[anchor_]);  // of all others the mean is τ times this
    for (J& component : mean) component = anchored() ? component * tau_ : component;
    for (std::size_t j = 0; j < r.size(); ++j)
      if (j != anchor_) subtract(q[j], r[j]);
    QuadraticJets at_x = monomials(e_);
    subtract(at_x, e_);
    return at_x;
  }

  /// φ_j += w_j q_jᵀ G q(x) with G the filtered inverse of Σ w q qᵀ. The block is measured by
  /// the square of the linear one, its natural size.
  int add_quadratic(std::vector<J>& phi) {
    std::vector<LinearJets> r(weights_.size());
    for (std::size_t j = 0; j < r.size(); ++j) r[j] = place(j);
    std::vector<QuadraticJets> q(r.size());
    const QuadraticJets at_x = orthogonal_monomials(r, q);
    const J over_size = reciprocal(spread_ * spread_ + J(1e-4));
    const std::vector<J>& v = block_weights();
    std::array<J, quadratics*(quadratics + 1) / 2> moment{};
    for (std::size_t j = 0; j < q.size(); ++j) {
      const J weight = v[j] * over_size;
      for (int a = 0, at = 0; a < quadratics; ++a) {
        const J weighted = weight * q[j][a];
        for (int b = a; b < quadratics; ++b) moment[at++] += weighted * q[j][b];
      }
    }
    JetMatrix<quadratics, Dim, Order> inverse;
    const BlockSpan<quadratics> span = filtered_inverse<quadratics, Dim, Order>(
        quadratic_window, take_apart<quadratics>(moment), inverse);
    QuadraticJets g = multiply<quadratics>(inverse, at_x);
    for (J& component : g) component = component * over_size;
    for (std::size_t j = 0; j < q.size(); ++j) phi[j] += v[j] * product(q[j], g);
    return span.rank();
  }

  BasisOrder order_;
  std::vector<Detour> detours_;
  std::vector<J> weights_;
  std::vector<J> squares_, block_weights_;  ///< of the singular kernel alone
  std::size_t anchor_ = no_anchor;
  J tau_;
  std::vector<VectorOf<Dim>> offsets_;  ///< x_j − x, later x_j − origin
  std::vector<double> supports_;
  VectorOf<Dim> origin_;  ///< from x
  LinearJets mean_{}, e_{}, anchor_place_{};
  J spread_, over_scale_;
  BlockSpan<Dim> span_;
  JetMatrix<Dim, Dim, Order> linear_inverse_;
};

template <int Dim, int Order>
void store_span(const PointFit<Dim, Order>& fit, ShapeFunctions<Dim>& at_x) {
  at_x.axes = fit.span().axes.rowwise().reverse();  // the widest first
  at_x.shares = fit.span().shares.reverse();
}

template <int Dim, int Order>
PointFit<Dim, Order> evaluate_jets(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x,
                                   ShapeFunctions<Dim>& at_x) {
  PointFit<Dim, Order> fit(field.options().order);
  fit.weigh(field, x, at_x.particles);
  const Index n = static_cast<Index>(at_x.particles.size());
  resize_rows(at_x.values, n);
  resize_rows(at_x.gradients, Order >= 1 ? n : 0);
  resize_rows(at_x.seconds, Order >= 2 ? n : 0);
  at_x.rank = 0;
  if (n == 0) return fit;
  std::vector<Jet<Dim, Order>> phi;
  at_x.rank = fit.fit(phi);
  store_span(fit, at_x);
  for (Index j = 0; j < n; ++j) {
    const Jet<Dim, Order>& p = phi[static_cast<std::size_t>(j)];
    at_x.values[j] = p.value();
    if constexpr (Order >= 1)
      for (int k = 0; k < Dim; ++k) at_x.gradients(j, k) = p.first(k);
    if constexpr (Order >= 2)
      for (int k = 0; k < ShapeFunctions<Dim>::pairs; ++k) at_x.seconds(j, k) = p.c[1 + Dim + k];
  }
  return fit;
}

template <int Dim, int Order>
void evaluate_at(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x,
                 ShapeFunctions<Dim>& at_x) {
  evaluate_jets<Dim, Order>(field, x, at_x);
}

template <int Dim>
void fit_at(const MovingLeastSquares<Dim>& field, const VectorOf<Dim>& x,
            ShapeFunctions<Dim>& at_x) {
  PointFit<Dim, 0> fit = evaluate_jets<Dim, 0>(field, x, at_x);
  if (!at_x.covered()) return;
  fit.fit_slopes(at_x.gradients);
  store_span(fit, at_x);
}

}  // namespace supple
