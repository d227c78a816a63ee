#pragma once

#include "modeler/domain/mended_surface.h"
#include "modeler/domain/surface_contact.h"
#include "modeler/domain/triangle_tree.h"
#include "solver/core/types.h"

namespace supple {

/// The closed boundary of {w > 0.5} for the winding number w of a surface.
struct RegionBoundary {
  Points positions;             ///< [m]; the surface's, then corners of cut triangles and of caps
  Triangles triangles;          ///< outward; caps over the openings last
  Index caps = 0;               ///< how many
  bool untouched = true;        ///< the triangles are the surface's, in their order, and no more
  double area = 0;              ///< [m²]
  double covered = 1;           ///< share of the area that the input covers
  double greatest_opening = 0;  ///< share of the area that the greatest opening takes
  Vec3 opening = Vec3::Zero();  ///< its middle [m]
};

/// Keeps of the triangles what bounds {w > 0.5} — all of them where `contact` is next to nothing —
/// and closes what is open along w = 0.5. `winding`: a tree of the surface's triangles.
RegionBoundary find_boundary(const TriangleTree& winding, const MendedSurface& surface,
                             const SurfaceContact& contact);

}  // namespace supple
