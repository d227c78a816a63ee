#pragma once

#include "solver/core/types.h"

namespace supple {

/// Which holes are filled.
struct SmallHoleLimits {
  double width = 0;          ///< diagonal of the box of a hole's rim at most [m]
  double share_of_part = 0;  ///< of the area of the part about it, at most
};

/// Closes holes by triangles from their rim to the rim's middle, appended to `triangles`; the
/// middles are appended to `positions`. Rims are the loops of the triangles' boundary (see
/// boundary_edges), each passed once. Returns how many were filled.
long fill_small_holes(Points& positions, Triangles& triangles, const SmallHoleLimits& limits);

}  // namespace supple
