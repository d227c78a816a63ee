#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Which points of a cloud are of its surface.
struct CleanPoints {
  std::vector<int> kept;  ///< ascending
  long duplicates = 0;    ///< points left out because another has their place
  long outliers = 0;      ///< points left out because they lie alone
};

/// Leaves out points that are one with another when rounded to 1e-9 of the cloud's diagonal, and
/// outliers: points whose neighbours are much farther than is usual in the cloud and do not lie
/// in a sheet, or much farther than those of their neighbours.
/// `positions` [any unit] n×3, all finite.
CleanPoints clean_points(const Points& positions);

}  // namespace supple
