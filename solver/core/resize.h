#pragma once

#include "solver/core/types.h"

namespace supple {

/// matrix.resize(rows, matrix.cols()) for a matrix that has held values: that of Eigen 3.4 frees
/// their memory a second time where there is no other.
template <class Matrix>
void resize_rows(Matrix& matrix, Index rows) {
  if (matrix.rows() != rows) matrix = Matrix(rows, matrix.cols());
}

}  // namespace supple
