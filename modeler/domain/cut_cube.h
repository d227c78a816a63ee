#pragma once

#include "solver/core/types.h"

namespace supple {

/// A body's volume [m³] and centroid [m].
struct CutVolume {
  double volume = 0;
  Vec3 centroid = Vec3::Zero();
};

/// The part n·x ≤ offset [m], |n| = 1, of the cube of edge 2·half_width [m] about the origin.
CutVolume cut_cube(const Vec3& normal, double offset, double half_width);

}  // namespace supple
