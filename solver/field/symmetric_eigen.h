#pragma once

#include <Eigen/Core>

namespace supple {

// For N = 1, 2, 3, 6; compiled once, as these few lines of Eigen take the compiler long.

/// Eigenvalues, ascending, and orthonormal eigenvectors of a symmetric matrix.
template <int N>
void symmetric_eigen(const Eigen::Matrix<double, N, N>& S, Eigen::Matrix<double, N, N>& vectors,
                     Eigen::Matrix<double, N, 1>& values);

/// V M Vᵀ.
template <int N>
void congruent(const Eigen::Matrix<double, N, N>& V, const Eigen::Matrix<double, N, N>& M,
               Eigen::Matrix<double, N, N>& product);

/// Vᵀ M V.
template <int N>
void rotated(const Eigen::Matrix<double, N, N>& V, const Eigen::Matrix<double, N, N>& M,
             Eigen::Matrix<double, N, N>& product);

}  // namespace supple
