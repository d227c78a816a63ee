#pragma once

#include <vector>

#include "modeler/domain/volume_samples.h"

namespace supple {

/// How far the inside of a region gets from a set of sites.
struct Covering {
  double radius = 0;    ///< no inside point is farther from the sites [m]
  RegionCell farthest;  ///< where a point is that far away, less the tolerance
};

/// Branch and bound over `cells`, which must cover the region: those that may hold a farther
/// point are halved until `tolerance` [m] is left between the bounds.
Covering covering_radius(const Region& region, const std::vector<RegionCell>& cells,
                         const Points& sites, double tolerance);

}  // namespace supple
