#pragma once

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

struct SupportOptions {
  double neighbors = 25;      ///< mean number of particles that reach a point inside
  int least_neighbors = 8;    ///< that reach every covered point, at least
  double least_spread = 0.1;  ///< their smallest standard deviation over the support, at least
  int most_neighbors = 64;    ///< looked at before a point counts as thin
  double slope = 0.5;         ///< by how much support may change over a distance
};

struct Supports {
  Eigen::VectorXd radii;  ///< h_i [m], n
  long thin = 0;          ///< points whose particles stayed in a plane or on a line
};

/// Support radii that reach every point of `cover` [m] by enough particles in general position.
///
/// A common radius for the wanted number of neighbours at the mean `spacing` [m], grown where a
/// point would be short of particles or they lie near a plane, and then smoothed so that
/// |h_i − h_j| ≤ slope·|x_i − x_j|.
SUPPLE_API Supports choose_supports(const Points& particles, double spacing, const Points& cover,
                                    const SupportOptions& options = {});

}  // namespace supple
