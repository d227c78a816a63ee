#pragma once

#include "solver/core/export.h"
#include "solver/field/moving_least_squares.h"

namespace supple {

struct SupportOptions {
  double neighbors = 25;    ///< mean number of particles that reach a point inside
  int least_neighbors = 8;  ///< that reach every covered point, at least
  double most_slope = 60;  ///< of the shape functions: greatest h·Σ|∇φ_j|, h the usual support
  double growth = 1.15;    ///< of a support in one round
  int rounds = 12;         ///< of growth at most
  double smoothness = 1;   ///< by how much supports may differ over a distance
};

struct Supports {
  Eigen::VectorXd radii;  ///< h_i [m], n
  long thin = 0;          ///< points whose shape functions stayed too steep, or of short rank
};

/// Support radii that reach every point of `cover` [m] by enough particles in general position.
///
/// A common radius h for the wanted number of neighbours at the mean `spacing` [m]. Where a point
/// would have fewer than `least_neighbors`, or shape functions so steep that small displacements
/// become large strains (its particles lie near a plane, or all on one side), the supports around
/// it grow. Then they are smoothed so that |h_i − h_j| ≤ smoothness·|x_i − x_j|.
SUPPLE_API Supports choose_supports(const Points& particles, double spacing, const Points& cover,
                                    KernelKind kernel = KernelKind::polynomial,
                                    const SupportOptions& options = {});

}  // namespace supple
