#pragma once

#include <vector>

#include "solver/field/blocked_field.h"

namespace supple {

/// Unit normals at the vertices of a triangle mesh, the mean of the faces' around by area; set up
/// once for all poses of the mesh. Zero where no face is, or the faces have no area.
class VertexNormals {
 public:
  VertexNormals(const Triangles& triangles, Index vertices);

  /// `positions` [m] n×3. Only the first call allocates.
  void compute(const FloatPoints& positions, FloatPoints& normals);

 private:
  const Triangles triangles_;
  std::vector<int> starts_;   ///< n+1 offsets into around_
  std::vector<int> around_;   ///< the faces at each vertex
  FloatPoints face_normals_;  ///< times twice the area
};

}  // namespace supple
