#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// How triangles had to be turned to look outwards.
struct Turning {
  long turned = 0;          ///< triangles that looked the other way than most about them
  long conflicts = 0;       ///< edges at which no turning agrees: one on a Möbius strip
  bool inside_out = false;  ///< whole parts were turned
};

/// Turns closed parts that lie inside out in the open. A cavity looks like one too, but what it
/// looks to is enclosed by another part. `parts`: a number for each triangle, from 0.
/// Returns whether any was turned.
bool turn_closed_parts(const Points& positions, Triangles& triangles,
                       const std::vector<int>& parts);

/// Turns triangles so that those that share an edge with no third agree, in as few as possible;
/// then the parts that hang together so: closed ones as turn_closed_parts does, open ones by
/// whether rays from their sides to infinity pass an even number of triangles (after Takayama,
/// Jacobson, Kavan, Sorkine-Hornung 2014), against the file only where the rays are clear.
/// `positions` [m], n×3, each once (see weld).
Turning orient(const Points& positions, Triangles& triangles);

}  // namespace supple
