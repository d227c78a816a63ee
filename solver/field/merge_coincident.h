#pragma once

#include <vector>

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// Particles of which no two lie at one place.
struct MergedParticles {
  Points positions;         ///< [m], m×3, volume-weighted means
  Eigen::VectorXd volumes;  ///< [m³], m, sums
  std::vector<int> merged;  ///< of each original particle, the one that it is part of now
};

/// Makes one particle of those less than `tolerance` [m] apart, also by way of others, and of
/// their volumes their sum. The order of first appearance is kept.
SUPPLE_API MergedParticles merge_coincident(const Points& positions, const Eigen::VectorXd& volumes,
                                            double tolerance);

}  // namespace supple
