#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/core/describe.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// A cube that holds a part of a region.
struct RegionCell {
  Vec3 center;
  double half_width = 0;  ///< half an edge [m]
  bool inner = false;     ///< all of it is inside
  bool center_inside = false;
  Vec3 boundary_point;  ///< nearest to the centre; unset in inner cells

  double reach() const { return 1.7320508075688772 * half_width; }  ///< centre to corner [m]
};

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

/// The eight halves of a cell that touch the region, appended to `cells`.
void append_halves(const Region& region, const RegionCell& cell, std::vector<RegionCell>& cells);

/// A point inside the region, straight below the boundary point of a cell that is not inner.
/// None where the region is thinner there than a millionth of the cell.
std::optional<Vec3> inside_at_boundary(const Region& region, const RegionCell& cell);

}  // namespace supple
