#pragma once

#include <array>

namespace supple {

/// A value with its first and second derivatives by Dim coordinates, as far as Order says:
/// writing a formula once for Jet gives the formula's exact derivatives too.
/// Second derivatives stand row by row of the upper triangle: xx, xy, xz, yy, yz, zz.
template <int Dim, int Order>
struct Jet {
  static constexpr int firsts = Order >= 1 ? Dim : 0;
  static constexpr int seconds = Order >= 2 ? Dim * (Dim + 1) / 2 : 0;
  static constexpr int size = 1 + firsts + seconds;

  std::array<double, size> c{};

  Jet() = default;
  Jet(double value) { c[0] = value; }  // NOLINT: a constant is a jet without derivatives

  double value() const { return c[0]; }
  double& first(int k) { return c[1 + k]; }
  double first(int k) const { return c[1 + k]; }

  /// Place of d²/dx_k dx_l among the second derivatives, for k ≤ l.
  static constexpr int pair(int k, int l) { return k * Dim - k * (k - 1) / 2 + (l - k); }
  double& second(int k, int l) { return c[1 + firsts + pair(k, l)]; }
  double second(int k, int l) const { return c[1 + firsts + pair(k, l)]; }

  Jet& operator+=(const Jet& b) {
    for (int i = 0; i < size; ++i) c[i] += b.c[i];
    return *this;
  }
  Jet& operator-=(const Jet& b) {
    for (int i = 0; i < size; ++i) c[i] -= b.c[i];
    return *this;
  }
  Jet& operator*=(double s) {
    for (double& x : c) x *= s;
    return *this;
  }

  friend Jet operator+(Jet a, const Jet& b) { return a += b; }
  friend Jet operator-(Jet a, const Jet& b) { return a -= b; }
  friend Jet operator*(Jet a, double s) { return a *= s; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet p;
    p.c[0] = a.c[0] * b.c[0];
    for (int k = 0; k < firsts; ++k) p.first(k) = a.first(k) * b.c[0] + a.c[0] * b.first(k);
    if constexpr (Order >= 2)
      for (int k = 0; k < Dim; ++k)
        for (int l = k; l < Dim; ++l)
          p.second(k, l) = a.second(k, l) * b.c[0] + a.first(k) * b.first(l) +
                           a.first(l) * b.first(k) + a.c[0] * b.second(k, l);
    return p;
  }
};

/// 1/a, for a ≠ 0.
template <int Dim, int Order>
Jet<Dim, Order> reciprocal(const Jet<Dim, Order>& a) {
  Jet<Dim, Order> r;
  const double inverse = 1 / a.value();
  r.c[0] = inverse;
  for (int k = 0; k < r.firsts; ++k) r.first(k) = -a.first(k) * inverse * inverse;
  if constexpr (Order >= 2)
    for (int k = 0; k < Dim; ++k)
      for (int l = k; l < Dim; ++l)
        r.second(k, l) =
            (2 * a.first(k) * a.first(l) * inverse - a.second(k, l)) * inverse * inverse;
  return r;
}

}  // namespace supple
