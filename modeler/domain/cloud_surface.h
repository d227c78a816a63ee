#pragma once

#include <vector>

#include "modeler/domain/surface_samples.h"

namespace supple {

/// The points of a cloud that lie on the surface of its solid.
struct CloudSurface {
  std::vector<int> points;  ///< ascending
  Points normals;           ///< unit length, outward, one for each of `points`
  Eigen::VectorXd areas;    ///< that each of `points` stands for [m²]
};

/// Samples at the surface's points; `positions` [m] are those of the whole cloud.
SurfaceSamples cloud_samples(const Points& positions, const CloudSurface& surface);

}  // namespace supple
