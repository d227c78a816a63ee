#include "solver/field/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace supple {

template <int N>
void symmetric_eigen(const Eigen::Matrix<double, N, N>& S, Eigen::Matrix<double, N, N>& vectors,
                     Eigen::Matrix<double, N, 1>& values) {
  // Eigen has a path of its own for three rows; all others share one.
  constexpr int rows = N == 3 ? 3 : Eigen::Dynamic;
  using Matrix =
      Eigen::Matrix<double, rows, rows, Eigen::ColMajor, rows == 3 ? 3 : 6, rows == 3 ? 3 : 6>;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(Matrix{S});
  for (int j = 0; j < N; ++j) {
    values[j] = eigen.eigenvalues()[j];
    for (int i = 0; i < N; ++i) vectors(i, j) = eigen.eigenvectors()(i, j);
  }
}

template <int N>
void congruent(const Eigen::Matrix<double, N, N>& V, const Eigen::Matrix<double, N, N>& M,
               Eigen::Matrix<double, N, N>& product) {
  product.noalias() = V * M * V.transpose();
}

template <int N>
void rotated(const Eigen::Matrix<double, N, N>& V, const Eigen::Matrix<double, N, N>& M,
             Eigen::Matrix<double, N, N>& product) {
  product.noalias() = V.transpose() * M * V;
}

template void symmetric_eigen<1>(const Eigen::Matrix<double, 1, 1>&, Eigen::Matrix<double, 1, 1>&,
                                 Eigen::Matrix<double, 1, 1>&);
template void congruent<1>(const Eigen::Matrix<double, 1, 1>&, const Eigen::Matrix<double, 1, 1>&,
                           Eigen::Matrix<double, 1, 1>&);
template void rotated<1>(const Eigen::Matrix<double, 1, 1>&, const Eigen::Matrix<double, 1, 1>&,
                         Eigen::Matrix<double, 1, 1>&);
template void symmetric_eigen<2>(const Eigen::Matrix<double, 2, 2>&, Eigen::Matrix<double, 2, 2>&,
                                 Eigen::Matrix<double, 2, 1>&);
template void congruent<2>(const Eigen::Matrix<double, 2, 2>&, const Eigen::Matrix<double, 2, 2>&,
                           Eigen::Matrix<double, 2, 2>&);
template void rotated<2>(const Eigen::Matrix<double, 2, 2>&, const Eigen::Matrix<double, 2, 2>&,
                         Eigen::Matrix<double, 2, 2>&);
template void symmetric_eigen<3>(const Eigen::Matrix<double, 3, 3>&, Eigen::Matrix<double, 3, 3>&,
                                 Eigen::Matrix<double, 3, 1>&);
template void congruent<3>(const Eigen::Matrix<double, 3, 3>&, const Eigen::Matrix<double, 3, 3>&,
                           Eigen::Matrix<double, 3, 3>&);
template void rotated<3>(const Eigen::Matrix<double, 3, 3>&, const Eigen::Matrix<double, 3, 3>&,
                         Eigen::Matrix<double, 3, 3>&);
template void symmetric_eigen<6>(const Eigen::Matrix<double, 6, 6>&, Eigen::Matrix<double, 6, 6>&,
                                 Eigen::Matrix<double, 6, 1>&);
template void congruent<6>(const Eigen::Matrix<double, 6, 6>&, const Eigen::Matrix<double, 6, 6>&,
                           Eigen::Matrix<double, 6, 6>&);
template void rotated<6>(const Eigen::Matrix<double, 6, 6>&, const Eigen::Matrix<double, 6, 6>&,
                         Eigen::Matrix<double, 6, 6>&);

}  // namespace supple
