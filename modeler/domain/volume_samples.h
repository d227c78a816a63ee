#pragma once

#include <cstdint>
#include <vector>

#include "modeler/domain/region_cell.h"
#include "solver/core/describe.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// Points that stand for a region's volume.
struct VolumeSamples {
  Points positions;               ///< [m], n×3, all inside, neighbours in space close in order
  Eigen::VectorXd volumes;        ///< [m³], n, all positive; their sum is about the region's
  std::vector<RegionCell> cells;  ///< together they cover the region
};

struct VolumeSampleOptions {
  double width = 0;
  Index enough = 0;
  std::uint64_t seed = 1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("width", self.width, {.doc = "edge of the smallest cells", .unit = "m", .min = 0});
    visit("enough", self.enough, {.doc = "cells are not halved once they are so many", .min = 0});
    visit("seed", self.seed, {.doc = "of the samples' places in the inner cells"});
  }
};

/// One sample or more for each octree cell that the region touches. Cells at the boundary are
/// taken for cut by a plane; where they are not (edges, parts thinner than a cell), they are
/// halved once more, and a part that still is thinner counts with its thickness.
VolumeSamples sample_volume(const Region& region, const VolumeSampleOptions& options);

}  // namespace supple
