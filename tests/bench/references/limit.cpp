#include "tests/bench/references/limit.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace supple::bench {
namespace {

using V = Eigen::Vector4d;

double dot(const PaddedPoints& a, const PaddedPoints& b) {
  return a.cwiseProduct(b).sum();
}

V cross(const V& a, const V& b) {
  return a.cross3(b);
}

}  // namespace

Limit::Limit(const DragProblem& problem, const Preconditioner& preconditioner)
    : problem_(problem), preconditioner_(preconditioner) {
  const Samples& s = *problem.quadrature;
  for (std::size_t e = 0; e < s.particles.size(); ++e)
    shape_.push_back({s.gradients[e][0], s.gradients[e][1], s.gradients[e][2], s.particles[e]});
  const Samples& h = *problem.handles;
  for (std::size_t e = 0; e < h.particles.size(); ++e)
    handle_.push_back({h.values[e], 0, 0, h.particles[e]});
  rest_ = padded(h.points);
  u_ = PaddedPoints::Zero(problem.particles, 4);
}

void Limit::shape_energy(const PaddedPoints& u, double& value) {
  const Samples& s = *problem_.quadrature;
  for (Index k = 0; k < s.size(); ++k) {
    const Entry *begin = shape_.data() + s.row_begin(k), *end = shape_.data() + s.row_end(k);
    V a = V::UnitX(), b = V::UnitY(), c = V::UnitZ();
    for (const Entry* e = begin; e < end; ++e) {
      const V here = u.row(e->particle);
      a += e->x * here;
      b += e->y * here;
      c += e->z * here;
    }
    const double aa = a.dot(a) - 1, bb = b.dot(b) - 1, cc = c.dot(c) - 1;
    const double ab = a.dot(b), bc = b.dot(c), ca = c.dot(a);
    const V bxc = cross(b, c);
    const double J = a.dot(bxc) - 1;
    const double w = problem_.volumes[k];
    value +=
        w * (problem_.rigidity * (aa * aa + bb * bb + cc * cc + 2 * (ab * ab + bc * bc + ca * ca)) +
             problem_.volume * J * J);
    const double r = 4 * w * problem_.rigidity, v = 2 * w * problem_.volume * J;
    const V by_a = r * (aa * a + ab * b + ca * c) + v * bxc;
    const V by_b = r * (ab * a + bb * b + bc * c) + v * cross(c, a);
    const V by_c = r * (ca * a + bc * b + cc * c) + v * cross(a, b);
    for (const Entry* e = begin; e < end; ++e)
      by_u_.row(e->particle) += (e->x * by_a + e->y * by_b + e->z * by_c).transpose();
  }
}

void Limit::handle_energy(const PaddedPoints& u, double& value) {
  const Samples& h = *problem_.handles;
  for (Index k = 0; k < h.size(); ++k) {
    const Entry *begin = handle_.data() + h.row_begin(k), *end = handle_.data() + h.row_end(k);
    V r = rest_.row(k) - targets_.row(k);
    for (const Entry* e = begin; e < end; ++e) r += e->x * u.row(e->particle).transpose();
    const double w = problem_.handle * problem_.handle_weights[k];
    value += w * r.squaredNorm();
    r *= 2 * w;
    for (const Entry* e = begin; e < end; ++e) by_u_.row(e->particle) += e->x * r.transpose();
  }
}

double Limit::evaluate(const PaddedPoints& u) {
  by_u_.setZero(u.rows(), 4);
  double value = 0;
  shape_energy(u, value);
  handle_energy(u, value);
  return value;
}

double Limit::solve(const Points& targets, double tolerance) {
  targets_ = padded(targets);
  double energy = evaluate(u_), scale = 0.5;
  preconditioner_.to_gradient(by_u_, by_y_);
  int kept = 0, next = 0;
  for (int iteration = 0; iteration < 2000; ++iteration) {
    d_ = -by_y_;
    double share[memory];
    for (int age = 0; age < kept; ++age) {
      const int i = (next + memory - 1 - age) % memory;
      share[i] = dot(s_[i], d_) / sy_[i];
      d_ -= share[i] * y_[i];
    }
    d_ *= scale;
    for (int age = kept; age-- > 0;) {
      const int i = (next + memory - 1 - age) % memory;
      d_ += (share[i] - dot(y_[i], d_) / sy_[i]) * s_[i];
    }
    preconditioner_.to_displacements(d_, step_);
    const double slope = dot(d_, by_y_);
    double t = 1, value = 0;
    for (int trial = 0; trial < 30; ++trial, t *= 0.5) {
      trial_ = u_ + t * step_;
      value = evaluate(trial_);
      if (value <= energy + 1e-4 * t * slope) break;
    }
    if (!(value < energy)) return energy;
    u_.swap(trial_);
    before_.swap(by_y_);
    preconditioner_.to_gradient(by_u_, by_y_);
    s_[next] = t * d_;
    y_[next] = by_y_ - before_;
    sy_[next] = dot(s_[next], y_[next]);
    const double before = energy;
    energy = value;
    if (before - energy <= tolerance * before) return energy;
    if (!(sy_[next] > 0)) continue;
    scale = sy_[next] / y_[next].squaredNorm();
    next = (next + 1) % memory;
    kept = std::min(kept + 1, memory);
  }
  return energy;
}

}  // namespace supple::bench
