#pragma once

#include <vector>

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// Indices of `points` along a Morton curve through their bounding box: neighbours in the order
/// are mostly neighbours in space.
SUPPLE_API std::vector<int> spatial_order(const Points& points);

}  // namespace supple
