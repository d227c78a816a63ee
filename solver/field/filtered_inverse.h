#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/field/jet.h"
#include "solver/field/symmetric_eigen.h"

namespace supple {

/// Eigenvalues of a dimensionless moment block up to `lost` count for nothing, from `sound` on in
/// full; between them the share s rises by a quintic step, with continuous second derivatives.
struct RankWindow {
  double lost, sound;
};

/// In eigenvalues, which are squares: singular values 3e-4 … 3e-3. Shapes of thin parts go down to
/// 1.5e-5 at their tips (a hand of 60 particles), and there affine fields must stay exact.
inline constexpr RankWindow linear_window{1e-7, 1e-5};

/// Inside a body 1.5e-2 and more; below, shape functions reach out with Σ|φ| in the hundreds.
inline constexpr RankWindow quadratic_window{1e-4, 1e-2};

/// The share s(λ), and s(λ)/λ with its first two derivatives.
struct FilteredReciprocal {
  double share = 0, value = 0, first = 0, second = 0;

  FilteredReciprocal(const RankWindow& window, double lambda) {
    if (lambda <= window.lost) return;
    double slope = 0, curvature = 0;
    share = 1;
    if (lambda < window.sound) {
      const double width = window.sound - window.lost;
      const double t = (lambda - window.lost) / width;
      share = t * t * t * (10 + t * (-15 + 6 * t));
      slope = 30 * t * t * (1 - t) * (1 - t) / width;
      curvature = 60 * t * (1 - t) * (1 - 2 * t) / (width * width);
    }
    const double r = 1 / lambda;
    value = share * r;
    first = (slope - share * r) * r;
    second = (curvature - 2 * slope * r + 2 * share * r * r) * r;
  }
};

/// Divided difference f[a, b] of s(λ)/λ; the derivative where a and b agree.
inline double divided_difference(const RankWindow& window, double a, double b) {
  if (a >= window.sound && b >= window.sound) return -1 / (a * b);
  if (a <= window.lost && b <= window.lost) return 0;
  if (std::abs(a - b) <= 1e-5 * std::max(a, b))
    return FilteredReciprocal(window, 0.5 * (a + b)).first;
  return (FilteredReciprocal(window, a).value - FilteredReciprocal(window, b).value) / (a - b);
}

/// Divided difference f[a, b, c]; half the second derivative where all agree.
inline double divided_difference(const RankWindow& window, double a, double b, double c) {
  if (a >= window.sound && b >= window.sound && c >= window.sound) return 1 / (a * b * c);
  std::array<double, 3> x{a, b, c};
  std::sort(x.begin(), x.end());
  if (x[2] - x[0] <= 1e-4 * x[2]) return 0.5 * FilteredReciprocal(window, (a + b + c) / 3).second;
  return (divided_difference(window, x[0], x[1]) - divided_difference(window, x[1], x[2])) /
         (x[0] - x[2]);
}

/// A symmetric matrix of jets, taken apart into plain matrices.
template <int N, int Dim, int Order>
using JetMatrix = std::array<Eigen::Matrix<double, N, N>, Jet<Dim, Order>::size>;

/// A block's directions, narrowest first, and the share of each that is kept.
template <int N>
struct BlockSpan {
  Eigen::Matrix<double, N, N> axes = Eigen::Matrix<double, N, N>::Identity();
  Eigen::Matrix<double, N, 1> shares = Eigen::Matrix<double, N, 1>::Ones();

  /// How many directions are kept by half at least.
  int rank() const { return static_cast<int>((shares.array() >= 0.5).count()); }
};

/// True only where all eigenvalues stand well above the window: det S ≤ λ_min (tr S/(N − 1))^(N−1).
template <int N>
bool surely_sound(const RankWindow& window, const Eigen::Matrix<double, N, N>& S) {
  double most = 1;
  for (int k = 1; k < N; ++k) most *= S.trace() / (N - 1);
  return S.determinant() > 100 * window.sound * most;
}

/// S⁻¹ with its derivatives by x: dG = −G dS G.
template <int N, int Dim, int Order>
void plain_inverse(const JetMatrix<N, Dim, Order>& S, JetMatrix<N, Dim, Order>& G) {
  using Matrix = Eigen::Matrix<double, N, N>;
  G[0] = S[0].inverse();
  if constexpr (Order >= 1) {
    std::array<Matrix, Dim> slopes;  // dS G
    for (int k = 0; k < Dim; ++k) {
      slopes[k].noalias() = S[1 + k] * G[0];
      G[1 + k].noalias() = -G[0] * slopes[k];
    }
    if constexpr (Order >= 2)
      for (int k = 0; k < Dim; ++k)
        for (int l = k; l < Dim; ++l) {
          const int place = 1 + Dim + Jet<Dim, Order>::pair(k, l);
          const Matrix bend = slopes[k] * slopes[l] + slopes[l] * slopes[k] - S[place] * G[0];
          G[place].noalias() = G[0] * bend;
        }
  }
}

/// G = s(S)/S for a symmetric positive semi-definite S that depends on x, with the derivatives
/// of G by x (Daleckii & Krein: in S's eigenvectors they are divided differences times dS).
template <int N, int Dim, int Order>
BlockSpan<N> filtered_inverse(const RankWindow& window, const JetMatrix<N, Dim, Order>& S,
                              JetMatrix<N, Dim, Order>& G) {
  using Matrix = Eigen::Matrix<double, N, N>;
  using Layout = Jet<Dim, Order>;
  BlockSpan<N> span;
  if constexpr (N <= 3)
    if (surely_sound<N>(window, S[0])) {
      plain_inverse<N, Dim, Order>(S, G);
      return span;
    }
  Eigen::Matrix<double, N, 1> lambda;
  symmetric_eigen<N>(S[0], span.axes, lambda);
  const Matrix& V = span.axes;

  Matrix inner = Matrix::Zero();
  for (int i = 0; i < N; ++i) {
    // Rounding may leave zeros a little negative, and two of them equal.
    lambda[i] = std::max(lambda[i], 0.0);
    const FilteredReciprocal filtered(window, lambda[i]);
    inner(i, i) = filtered.value;
    span.shares[i] = filtered.share;
  }
  congruent<N>(V, inner, G[0]);
  if constexpr (Order >= 1) {
    std::array<Matrix, Dim> slopes;
    Matrix first;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) first(i, j) = divided_difference(window, lambda[i], lambda[j]);
    for (int k = 0; k < Dim; ++k) {
      rotated<N>(V, S[1 + k], slopes[k]);
      inner = first.cwiseProduct(slopes[k]);
      congruent<N>(V, inner, G[1 + k]);
    }
    if constexpr (Order >= 2) {
      for (int k = 0; k < Dim; ++k)
        for (int l = k; l < Dim; ++l) {
          const int place = 1 + Dim + Layout::pair(k, l);
          Matrix curvature;
          rotated<N>(V, S[place], curvature);
          inner = first.cwiseProduct(curvature);
          for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j)
              for (int m = 0; m < N; ++m)
                inner(i, j) +=
                    divided_difference(window, lambda[i], lambda[m], lambda[j]) *
                    (slopes[k](i, m) * slopes[l](m, j) + slopes[l](i, m) * slopes[k](m, j));
          congruent<N>(V, inner, G[place]);
        }
    }
  }
  return span;
}

}  // namespace supple
