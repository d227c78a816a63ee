#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh.h"
#include "modeler/domain/carried_boundary.h"
#include "modeler/domain/cloud_surface.h"
#include "solver/core/report.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// The region that a shape bounds, and what is to be said about it.
struct SolidRegion {
  std::unique_ptr<const Region> region;
  CarriedBoundary boundary;           ///< empty where it is not of the mesh's vertices
  std::optional<CloudSurface> cloud;  ///< of a shape without faces
  std::vector<std::string> notes;     ///< what was mended, a sentence each
  std::vector<Reason> reasons;        ///< what makes the result less than ok

  /// What is to be said about parts of the shape that hold none of the particles. [m], n×3
  std::function<std::vector<std::string>(const Points& particles)> empty_parts = [](const Points&) {
    return std::vector<std::string>();
  };
};

/// The solid that `mesh` bounds, or the points of a mesh without faces. `vertices` are its
/// positions as they are to be read (scaled to a diagonal of about 1), `triangles` its faces.
/// Errors: ShapeError where it bounds none.
SolidRegion make_region(const Mesh& mesh, const Points& vertices, const Triangles& triangles);

}  // namespace supple
