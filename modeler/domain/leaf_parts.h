#pragma once

#include <vector>

#include "modeler/domain/octree.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// A convex piece of a region.
struct LeafPart {
  Vec3 centroid;      ///< [m]
  double volume = 0;  ///< [m³]
};

/// The pieces of a leaf that are inside the region, appended to `parts`.
///
/// The leaf is halved `halvings` times, and each part at the boundary cut by the plane that is
/// tangent to the boundary, moved by what the boundary bends away from it on the mean:
/// (a²/24) Δd for parts of edge a, Δd from the signed distances of the eight parts and of their
/// middle. Where the cut does not fit (edges, parts thinner than a piece) one more halving is
/// tried, then a slab. The volume's error is O(a²) at edges and smaller where all is smooth.
void append_parts(const Region& region, const OctreeLeaf& leaf, int halvings,
                  std::vector<LeafPart>& parts);

}  // namespace supple
