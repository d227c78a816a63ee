#pragma once

#include <cmath>

#include "solver/core/types.h"
#include "solver/field/jet.h"
#include "solver/field/moving_least_squares_options.h"

namespace supple {

/// Radial kernels as functions of q = |d|/h in [0, 1), with w'/q and (w'' − w'/q)/q², which stay
/// finite at q = 0 and give gradient and Hessian by d without a division by zero.
struct RadialKernel {
  double value, slope_over_q, curvature;
};

/// (1 − q²)³ (Adams & Wicke 2009, Eq. 86 without its normalisation).
inline RadialKernel polynomial_kernel(double q2) {
  const double a = 1 - q2;
  return {a * a * a, -6 * a * a, 24 * a};
}

/// (1 − q)⁴ (4q + 1), Wendland 1995, C².
inline RadialKernel wendland_kernel(double q2) {
  const double q = std::sqrt(q2);
  const double a = 1 - q;
  return {a * a * a * a * (4 * q + 1), -20 * a * a * a, q > 0 ? 60 * a * a / q : 0};
}

/// Guo & Qin, Eq. 13, of |s|: value, first and second derivative by s.
inline std::array<double, 3> box_kernel(double s) {
  const double a = std::abs(s);
  if (a < 0.5) return {1 - 2 * a * a, -4 * s, -4};
  if (a >= 1) return {0, 0, 0};
  return {2 * (1 - a) * (1 - a), s > 0 ? -4 * (1 - a) : 4 * (1 - a), 4};
}

/// True where a particle of support radius h reaches a point at `offset` from it: a ball, or
/// for the box kernel a cube of half width h.
template <int Dim>
bool reaches(KernelKind kind, const Eigen::Matrix<double, Dim, 1>& offset, double h) {
  if (kind == KernelKind::box) return offset.cwiseAbs().maxCoeff() < h;
  return offset.squaredNorm() < h * h;
}

/// Weight of a particle at distance vector `offset` = x − x_i [m] with support radius h [m], with
/// derivatives by x. Zero outside the support.
template <int Dim, int Order>
Jet<Dim, Order> kernel_weight(KernelKind kind, const Eigen::Matrix<double, Dim, 1>& offset,
                              double h) {
  Jet<Dim, Order> w;
  if (!reaches<Dim>(kind, offset, h)) return w;
  const Eigen::Matrix<double, Dim, 1> d = offset / h;
  if (kind == KernelKind::box) {
    w = Jet<Dim, Order>(1.0);
    for (int k = 0; k < Dim; ++k) {
      const auto [c0, c1, c2] = box_kernel(d[k]);
      Jet<Dim, Order> factor(c0);
      if constexpr (Order >= 1) factor.first(k) = c1 / h;
      if constexpr (Order >= 2) factor.second(k, k) = c2 / (h * h);
      w = w * factor;
    }
    return w;
  }
  const double q2 = d.squaredNorm();
  const RadialKernel radial =
      kind == KernelKind::wendland ? wendland_kernel(q2) : polynomial_kernel(q2);
  w.c[0] = radial.value;
  if constexpr (Order >= 1)
    for (int k = 0; k < Dim; ++k) w.first(k) = radial.slope_over_q * d[k] / h;
  if constexpr (Order >= 2)
    for (int k = 0; k < Dim; ++k)
      for (int l = k; l < Dim; ++l)
        w.second(k, l) =
            (radial.curvature * d[k] * d[l] + (k == l ? radial.slope_over_q : 0)) / (h * h);
  return w;
}

}  // namespace supple
