#pragma once

#include <cmath>

#include "solver/core/random.h"
#include "solver/field/moving_least_squares.h"

namespace supple {

using Field = MovingLeastSquares<3>;

/// Particles of one support radius h.
struct Cloud {
  Points positions;
  double h;

  Field field(const MovingLeastSquaresOptions& options) const {
    return {positions, Eigen::VectorXd::Constant(positions.rows(), h), options};
  }
};

/// Random points in [0, 1]^axes, their other coordinates 0.
inline Points random_points(Index count, int axes, std::uint64_t seed) {
  Random random(seed);
  Points points = Points::Zero(count, 3);
  for (Index i = 0; i < count; ++i)
    for (int k = 0; k < axes; ++k) points(i, k) = random.uniform();
  return points;
}

/// The shape functions at x, free of units: a particle a row; φ, h∇φ, h²∂²φ in ten columns.
struct ShapeAtPoint {
  Eigen::Matrix<double, Eigen::Dynamic, 10> rows;
  int rank;

  ShapeAtPoint(const Field& field, const Vec3& x) {
    ShapeFunctions<3> at_x;
    field.evaluate(x, Derivatives::second, at_x);
    const double h = field.supports()[0];
    rank = at_x.rank;
    rows.setZero(field.positions().rows(), 10);
    rows(at_x.particles, 0) = at_x.values;
    rows(at_x.particles, Eigen::seqN(1, 3)) = h * at_x.gradients;
    rows(at_x.particles, Eigen::seqN(4, 6)) = h * h * at_x.seconds;
  }

  double unity_error() const { return std::abs(rows.col(0).sum() - 1); }
  double not_finite() const { return static_cast<double>((!rows.array().isFinite()).count()); }
};

/// Keeps the greater; a NaN stays.
inline void keep_worst(double& worst, double value) {
  if (!(value <= worst)) worst = value;
}

}  // namespace supple
