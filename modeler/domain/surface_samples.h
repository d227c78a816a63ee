#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Points spread over a surface, each standing for a piece of its area.
struct SurfaceSamples {
  Points positions;            ///< [m], n×3
  Eigen::VectorXd areas;       ///< [m²], n
  std::vector<int> triangles;  ///< the triangle each lies in; −1 in a point cloud
  std::vector<int> vertices;   ///< that triangle's corner nearest to it; in a point cloud the point
  Index size() const { return positions.rows(); }
};

/// Cuts every triangle into parts no wider than `max_width` [m] and puts a sample at each part's
/// centroid. The parts are equal: each edge is cut into ceil(longest edge / max_width) pieces; but
/// needles are cut into strips across.
SurfaceSamples sample_surface(const Points& positions, const Triangles& triangles,
                              double max_width);

/// The vertices that triangles use, each with a third of the area of those around it.
SurfaceSamples vertex_samples(const Points& positions, const Triangles& triangles);

/// A point cloud as it is: each point stands for its own area [m²].
SurfaceSamples point_samples(const Points& positions, const Eigen::VectorXd& areas);

/// Thins samples to about one a cell of `width` [m]: each cell keeps the sample nearest to its
/// centroid, with the cell's whole area. Returns indices into `samples` and their areas.
struct ThinnedSamples {
  std::vector<int> indices;
  Eigen::VectorXd areas;  ///< [m²]
};
ThinnedSamples thin_samples(const SurfaceSamples& samples, const std::vector<int>& chosen,
                            double width);

}  // namespace supple
