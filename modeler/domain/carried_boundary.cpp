#include "modeler/domain/carried_boundary.h"

#include "modeler/domain/surface_measures.h"

namespace supple {

double enclosed_volume(const CarriedBoundary& boundary, const Points& vertices,
                       const Points& extra) {
  Points positions(vertices.rows() + extra.rows(), 3);
  positions << vertices, extra;
  return signed_volume(positions, boundary.triangles);
}

}  // namespace supple
