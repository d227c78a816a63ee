#pragma once

#include <cmath>

#include "solver/core/types.h"
#include "solver/field/jet.h"
#include "solver/field/moving_least_squares_options.h"

namespace supple {

/// A radial kernel as a function of t = q², q = |d|/h in [0, 1), with its derivatives by t: they
/// give gradient and Hessian by d without a division by the distance.
struct RadialKernel {
  double value, first, second;
};

/// (1 − q²)³ (Adams & Wicke 2009, Eq. 86 without its normalisation).
inline RadialKernel polynomial_kernel(double t) {
  const double a = 1 - t;
  return {a * a * a, -3 * a * a, 6 * a};
}

/// (1 − q)⁴ (4q + 1), Wendland 1995, C².
inline RadialKernel wendland_kernel(double t) {
  const double q = std::sqrt(t);
  const double a = 1 - q;
  // At q = 0 the second derivative meets (∂t/∂x)² = 0.
  return {a * a * a * a * (4 * q + 1), -10 * a * a * a, q > 0 ? 15 * a * a / q : 0};
}

/// The cubic B-spline: 1 − 6q² + 6q³, from q = 1/2 on 2(1 − q)³; C².
inline RadialKernel cubic_spline_kernel(double t) {
  const double q = std::sqrt(t);
  const double a = 1 - q;
  if (q < 0.5) return {1 - 6 * t * a, -6 + 9 * q, q > 0 ? 4.5 / q : 0};
  return {2 * a * a * a, -3 * a * a / q, 1.5 * (1 - t) / (t * q)};
}

/// exp(−α q²) less its tangent by q² at the rim, so that value and slope end there at zero: C¹;
/// over its value at 0. The usual width 0.4 h.
inline RadialKernel gaussian_kernel(double t) {
  constexpr double alpha = 1 / (0.4 * 0.4);
  static const double rim = std::exp(-alpha);
  const double scale = 1 / (1 - rim * (1 + alpha));
  const double bell = std::exp(-alpha * t);
  return {scale * (bell - rim * (1 + alpha * (1 - t))), scale * alpha * (rim - bell),
          scale * alpha * alpha * bell};
}

inline RadialKernel radial_kernel(KernelKind kind, double t) {
  switch (kind) {
    case KernelKind::wendland:
      return wendland_kernel(t);
    case KernelKind::cubic_spline:
      return cubic_spline_kernel(t);
    case KernelKind::gaussian:
      return gaussian_kernel(t);
    default:
      return polynomial_kernel(t);
  }
}

/// Guo & Qin, Eq. 13, of |s|: value, first and second derivative by s.
inline std::array<double, 3> box_kernel(double s) {
  const double a = std::abs(s);
  if (a < 0.5) return {1 - 2 * a * a, -4 * s, -4};
  if (a >= 1) return {0, 0, 0};
  return {2 * (1 - a) * (1 - a), s > 0 ? -4 * (1 - a) : 4 * (1 - a), 4};
}

/// A particle's support as seen from it: d = N (x − x_i)/h, with h [m] and the stretch N, a
/// symmetric matrix of determinant 1 (none: N = I).
template <int Dim>
struct Support {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Matrix = Eigen::Matrix<double, Dim, Dim>;

  double h;
  const Matrix* stretch = nullptr;

  Vector scaled(const Vector& offset) const {
    if (stretch) return *stretch * offset / h;
    return offset / h;
  }

  /// |d|² with its derivatives by x, t its value.
  template <int Order>
  Jet<Dim, Order> square(const Vector& d, double t) const {
    Jet<Dim, Order> square(t);
    if constexpr (Order >= 1) {
      const double factor = 2 / h;
      if (stretch)
        for (int k = 0; k < Dim; ++k) square.first(k) = factor * stretch->col(k).dot(d);
      else
        for (int k = 0; k < Dim; ++k) square.first(k) = factor * d[k];
    }
    if constexpr (Order >= 2)
      for (int k = 0; k < Dim; ++k)
        for (int l = k; l < Dim; ++l)
          square.second(k, l) =
              2 / (h * h) * (stretch ? stretch->col(k).dot(stretch->col(l)) : (k == l ? 1 : 0));
    return square;
  }
};

template <int Dim, int Order>
Jet<Dim, Order> box_weight(const Support<Dim>& support, const Eigen::Matrix<double, Dim, 1>& d) {
  if (!(d.cwiseAbs().maxCoeff() < 1)) return {};
  Jet<Dim, Order> w(1.0);
  for (int a = 0; a < Dim; ++a) {
    const auto [c0, c1, c2] = box_kernel(d[a]);
    const auto slope = [&](int k) {
      return (support.stretch ? (*support.stretch)(a, k) : (a == k ? 1.0 : 0.0)) / support.h;
    };
    Jet<Dim, Order> factor(c0);
    for (int k = 0; k < factor.firsts; ++k) factor.first(k) = c1 * slope(k);
    if constexpr (Order >= 2)
      for (int k = 0; k < Dim; ++k)
        for (int l = k; l < Dim; ++l) factor.second(k, l) = c2 * slope(k) * slope(l);
    w = w * factor;
  }
  return w;
}

/// Weight of a particle at the distance vector `offset` = x − x_i [m], with derivatives by x. Zero
/// outside the support, a ball or for the box kernel a cube, stretched. KernelKind::singular: the
/// numerator of (1 − q²)³/q².
template <int Dim, int Order>
Jet<Dim, Order> kernel_weight(KernelKind kind, const Eigen::Matrix<double, Dim, 1>& offset,
                              const Support<Dim>& support) {
  const Eigen::Matrix<double, Dim, 1> d = support.scaled(offset);
  if (kind == KernelKind::box) return box_weight<Dim, Order>(support, d);
  const double q2 = d.squaredNorm();
  if (!(q2 < 1)) return {};
  const Jet<Dim, Order> t = support.template square<Order>(d, q2);
  const RadialKernel radial = radial_kernel(kind, q2);
  Jet<Dim, Order> w(radial.value);
  for (int k = 0; k < w.firsts; ++k) w.first(k) = radial.first * t.first(k);
  if constexpr (Order >= 2)
    for (int k = 0; k < Dim; ++k)
      for (int l = k; l < Dim; ++l)
        w.second(k, l) = radial.second * t.first(k) * t.first(l) + radial.first * t.second(k, l);
  return w;
}

}  // namespace supple
