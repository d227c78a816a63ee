#pragma once

#include <vector>

#include "modeler/domain/welded_surface.h"
#include "solver/core/types.h"

namespace supple {

/// What was wrong with a surface that is to bound a solid, and what was done about it.
struct SurfaceDefects {
  long boundary_edges = 0;     ///< directed edges without their opposite, vertices welded
  long degenerate_faces = 0;   ///< zero area or repeated vertices: left out
  long duplicate_faces = 0;    ///< the same as another, in the same turning: left out
  long turned_faces = 0;       ///< looked another way than most about them: turned
  long turning_conflicts = 0;  ///< edges at which no turning agrees
  bool inside_out = false;     ///< all of it, or separate parts: turned
  long small_holes = 0;        ///< filled
  bool closed() const { return boundary_edges == 0; }
};

/// A surface welded, cleaned, turned outwards, its small holes filled.
struct MendedSurface {
  Vec3 center = Vec3::Zero();      ///< of the input's box [m]
  Points positions;                ///< [m], relative to the centre; each once
  std::vector<int> originals;      ///< the input's vertex at each of the first positions
  Triangles triangles;             ///< all with an area where they are closed
  Index filled = 0;                ///< of these, how many at the end fill small holes
  std::vector<BoundaryEdge> rims;  ///< what is still open
  Box box;                         ///< relative to the centre
  SurfaceDefects defects;
};

/// `positions` [m] n×3; vertices at one position count as one. Closed surfaces — each edge passed
/// as often one way as the other — are left as they are but for parts that lie inside out.
MendedSurface mend(const Points& positions, const Triangles& triangles);

}  // namespace supple
