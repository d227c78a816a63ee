#pragma once

#include <vector>

#include "modeler/domain/triangle_tree.h"
#include "solver/core/types.h"

namespace supple {

struct TrimOptions {
  double width = 0;   ///< triangles are cut down to edges no longer than this [m]
  double grain = 0;   ///< no less of the surface is looked for in larger triangles [m]
  double offset = 0;  ///< how far from a triangle its sides are asked for [m]
};

/// What of triangles bounds {w > 0.5}, outward, and which triangle each piece is of.
struct TrimmedSurface {
  Triangles triangles;
  std::vector<int> sources;  ///< ascending
  bool whole = true;         ///< every triangle as it was
};

/// Drops triangles with the winding number beyond 1/2 on both sides or on neither, and halves the
/// edges of those that are so in part. Appends the new corners to `positions`.
TrimmedSurface trim(const TriangleTree& winding, Points& positions, const Triangles& triangles,
                    const TrimOptions& options);

}  // namespace supple
