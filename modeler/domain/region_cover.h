#pragma once

#include <functional>
#include <vector>

#include "solver/core/describe.h"
#include "solver/core/types.h"

namespace supple {

/// How often a straight way passes through the input, and one of the places as a share of it.
struct Passage {
  long times = 0;
  double share = 0;
};

/// A region known by a value at each place. Several threads may ask.
struct ImplicitRegion {
  std::function<double(const Vec3&)> value;     ///< > 0.5 inside
  std::function<double(const Vec3&)> distance;  ///< to the nearest piece of the input [m]
  /// Of the way from a to b. Need not be there: an input of points has no inside of its own.
  std::function<Passage(const Vec3& a, const Vec3& b)> passage;
  Box box;  ///< of the input [m]; the region lies within it
};

struct RegionCoverOptions {
  double width = 0;
  double reach = 0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("width", self.width,
          {.doc = "edge of the grid's cells; 0: a 64th of the box's diagonal",
           .unit = "m",
           .min = 0});
    visit("reach", self.reach,
          {.doc = "boundary no farther from the input is covered by it", .unit = "m", .min = 0});
  }
};

/// How much of a region's boundary its input covers, and the rest of it.
struct RegionCover {
  double area = 0;              ///< of the region's boundary [m²]; 0: no inside was found
  double covered = 0;           ///< share of the area that lies within reach of the input
  double greatest_opening = 0;  ///< share of the greatest connected piece that does not
  Vec3 opening = Vec3::Zero();  ///< the middle of that piece [m]

  Points cap_positions;            ///< [m], n×3
  Triangles caps;                  ///< all of the boundary beyond reach, outward
  std::vector<bool> cap_on_input;  ///< for each cap position: it lies within reach
};

/// The surface value = 0.5 by marching tetrahedra over a grid: six a cell, about its long diagonal.
/// Roots on the grid's edges are right to a 16th of an edge where the value jumps without a passage
/// being known, better elsewhere. Openings narrower than a cell are not seen.
RegionCover cover_region(const ImplicitRegion& region, const RegionCoverOptions& options);

/// The same of a boundary that is known: `positions` [m] n×3, closed triangles, and for each
/// position whether it lies within reach of the input.
RegionCover measure_cover(const Points& positions, const Triangles& triangles,
                          const std::vector<bool>& on_input);

}  // namespace supple
