#pragma once

#include "solver/core/types.h"

namespace supple {

/// The boundary as triangles of the mesh's vertices and of further points, so that it can follow
/// a deformation of the mesh.
struct CarriedBoundary {
  Triangles triangles;  ///< outward; a vertex number beyond the mesh's counts on into `extra`
  Points extra;         ///< [m]
};

/// Volume within a boundary carried along [m³]: `vertices` are the mesh's, `extra` the boundary's
/// further points, both where they are now.
double enclosed_volume(const CarriedBoundary& boundary, const Points& vertices,
                       const Points& extra);

}  // namespace supple
