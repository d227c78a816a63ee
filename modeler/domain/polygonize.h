#pragma once

#include <functional>

#include "solver/core/types.h"

namespace supple {

/// A closed surface of triangles that look outward.
struct Polygons {
  Points positions;  ///< [m], n×3
  Triangles triangles;
};

struct PolygonizeOptions {
  Box box;           ///< no inside is looked for beyond it [m]
  double width = 0;  ///< edge of the grid's cells [m]
};

/// Where a function changes its sign, negative inside: surface nets over the cells of a grid, from
/// those that hold a seed on through every face of a cell that the surface passes. Closed: every
/// edge has as many triangles on one side as on the other. Pieces that no seed lies near are not
/// found, nor parts and gaps narrower than a cell. Gibson 1998.
/// `f` may be asked by several threads; `seeds` [m] n×3, within the box.
Polygons polygonize(const std::function<double(const Vec3&)>& f, const Points& seeds,
                    const PolygonizeOptions& options);

}  // namespace supple
