#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Triangles whose vertices are one wherever their positions are equal.
struct WeldedSurface {
  Points positions;            ///< [m], n×3, each once
  Triangles triangles;         ///< with three different vertices
  std::vector<int> originals;  ///< for each position the first vertex that lies there
};
WeldedSurface weld(const Points& positions, const Triangles& triangles);

/// For each vertex the first one at the same position.
std::vector<int> first_at_position(const Points& positions);

/// Numbers of the triangles that have an area, ascending.
std::vector<int> rows_with_area(const Points& positions, const Triangles& triangles);

/// The triangles that have an area.
Triangles with_area(const Points& positions, const Triangles& triangles);

/// The triangles without those that another names in the same turning, in their order.
Triangles without_duplicates(const Triangles& triangles);

/// The triangles of these rows, in the order of `rows`.
template <class Row>
Triangles rows_of(const Triangles& triangles, const std::vector<Row>& rows) {
  return triangles(rows, Eigen::all);
}

/// For each triangle the part it is of, from 0: triangles that share vertices are of one part.
std::vector<int> connected_parts(const Triangles& triangles);

/// An edge that triangles pass `excess` times more from a to b than from b to a.
struct BoundaryEdge {
  int a = 0, b = 0, excess = 0;
};

/// The boundary of the triangles as a chain: empty where they are closed, however many meet at
/// an edge. Ascending in (a, b).
std::vector<BoundaryEdge> boundary_edges(const Triangles& triangles);

}  // namespace supple
