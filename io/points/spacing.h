#pragma once

#include "solver/core/types.h"

namespace supple {

/// Mean distance from each point to the nearest other ones [m], n: how far points of a surface
/// lie apart. Zero where they coincide or there is only one.
/// `points` [m] n×3, all finite.
Eigen::VectorXd neighbor_spacing(const Points& points);

}  // namespace supple
