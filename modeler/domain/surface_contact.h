#pragma once

#include <vector>

#include "modeler/domain/triangle_tree.h"
#include "solver/core/types.h"

namespace supple {

/// Shares of a surface's area that do not bound {w > 0.5} for its winding number w.
struct SurfaceContact {
  double own = 0;    ///< within the part that it is of, or against it with no gap
  double other = 0;  ///< within another part or against it, or doubled
  double idle = 0;   ///< outside on both sides: sheets
  double within() const { return own + other; }
  double any() const { return within() + idle; }
};

/// By samples spread over the area. `winding`: a tree of just these triangles.
/// `parts`: a number for each triangle; `offset`: how far from the surface its sides are asked [m].
SurfaceContact measure_contact(const TriangleTree& winding, const Points& positions,
                               const Triangles& triangles, const std::vector<int>& parts,
                               double offset);

/// For each part whether x lies within it: a ray to infinity leaves it more often than it enters.
/// One entry a part that the ray meets and that holds x.
std::vector<int> parts_about(const TriangleTree& winding, const std::vector<int>& parts,
                             const Vec3& x, const Vec3& far);

}  // namespace supple
