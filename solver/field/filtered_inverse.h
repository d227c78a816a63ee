#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/field/jet.h"

namespace supple {

/// Eigenvalues of a dimensionless moment block below the first count as lost rank, above the
/// second as sound; between them their inverse fades out with continuous second derivatives.
inline constexpr double lost_rank = 1e-7;
inline constexpr double sound_rank = 1e-5;

/// s(λ)/λ with its first two derivatives, s the quintic step from lost_rank to sound_rank.
struct FilteredReciprocal {
  double value = 0, first = 0, second = 0;

  explicit FilteredReciprocal(double lambda) {
    if (lambda <= lost_rank) return;
    double s = 1, s1 = 0, s2 = 0;
    if (lambda < sound_rank) {
      const double width = sound_rank - lost_rank;
      const double t = (lambda - lost_rank) / width;
      s = t * t * t * (10 + t * (-15 + 6 * t));
      s1 = 30 * t * t * (1 - t) * (1 - t) / width;
      s2 = 60 * t * (1 - t) * (1 - 2 * t) / (width * width);
    }
    const double r = 1 / lambda;
    value = s * r;
    first = (s1 - s * r) * r;
    second = (s2 - 2 * s1 * r + 2 * s * r * r) * r;
  }
};

/// Divided difference f[a, b]; the derivative where a and b agree.
inline double divided_difference(double a, double b) {
  if (a >= sound_rank && b >= sound_rank) return -1 / (a * b);
  if (a <= lost_rank && b <= lost_rank) return 0;
  if (std::abs(a - b) <= 1e-5 * std::max(a, b)) return FilteredReciprocal(0.5 * (a + b)).first;
  return (FilteredReciprocal(a).value - FilteredReciprocal(b).value) / (a - b);
}

/// Divided difference f[a, b, c]; half the second derivative where all agree.
inline double divided_difference(double a, double b, double c) {
  if (a >= sound_rank && b >= sound_rank && c >= sound_rank) return 1 / (a * b * c);
  std::array<double, 3> x{a, b, c};
  std::sort(x.begin(), x.end());
  if (x[2] - x[0] <= 1e-4 * x[2]) return 0.5 * FilteredReciprocal((a + b + c) / 3).second;
  return (divided_difference(x[0], x[1]) - divided_difference(x[1], x[2])) / (x[0] - x[2]);
}

/// A symmetric matrix of jets, taken apart into plain matrices.
template <int N, int Dim, int Order>
using JetMatrix = std::array<Eigen::Matrix<double, N, N>, Jet<Dim, Order>::size>;

/// G = s(S)/S for a symmetric positive semi-definite S that depends on x, with the derivatives
/// of G by x (Daleckii & Krein: in S's eigenvectors they are divided differences times dS).
/// Returns the number of eigenvalues that are not lost.
template <int N, int Dim, int Order>
int filtered_inverse(const JetMatrix<N, Dim, Order>& S, JetMatrix<N, Dim, Order>& G) {
  using Matrix = Eigen::Matrix<double, N, N>;
  using Layout = Jet<Dim, Order>;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(S[0]);
  const auto& V = eigen.eigenvectors();
  // Rounding may leave zeros a little negative, and two of them equal.
  const Eigen::Matrix<double, N, 1> lambda = eigen.eigenvalues().cwiseMax(0.0);

  int rank = 0;
  Eigen::Matrix<double, N, 1> f;
  for (int i = 0; i < N; ++i) {
    f[i] = FilteredReciprocal(lambda[i]).value;
    if (lambda[i] > lost_rank) ++rank;
  }
  G[0] = V * f.asDiagonal() * V.transpose();
  if constexpr (Order >= 1) {
    std::array<Matrix, Dim> rotated;
    Matrix first;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) first(i, j) = divided_difference(lambda[i], lambda[j]);
    for (int k = 0; k < Dim; ++k) {
      rotated[k] = V.transpose() * S[1 + k] * V;
      G[1 + k] = V * first.cwiseProduct(rotated[k]) * V.transpose();
    }
    if constexpr (Order >= 2) {
      for (int k = 0; k < Dim; ++k)
        for (int l = k; l < Dim; ++l) {
          const int place = 1 + Dim + Layout::pair(k, l);
          Matrix sum = first.cwiseProduct(V.transpose() * S[place] * V);
          for (int i = 0; i < N; ++i)
            for (int j = 0; j < N; ++j)
              for (int m = 0; m < N; ++m)
                sum(i, j) +=
                    divided_difference(lambda[i], lambda[m], lambda[j]) *
                    (rotated[k](i, m) * rotated[l](m, j) + rotated[l](i, m) * rotated[k](m, j));
          G[place] = V * sum * V.transpose();
        }
    }
  }
  return rank;
}

}  // namespace supple
