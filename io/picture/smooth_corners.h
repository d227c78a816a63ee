#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Corners of triangles that share a vertex and are shaded as one smooth surface.
struct SmoothCorners {
  std::vector<int> group;    ///< of each corner 3·triangle + k
  std::vector<int> vertex;   ///< of each group
  std::vector<Vec3> normal;  ///< of each group, the sum of its triangles' (b − a)×(c − a)
};

/// Joins the corners across every edge whose faces meet at less than `crease_angle_deg`, so that a
/// ball looks round and a box keeps its edges.
SmoothCorners smooth_corners(const Points& positions, const Triangles& triangles,
                             double crease_angle_deg);

}  // namespace supple
