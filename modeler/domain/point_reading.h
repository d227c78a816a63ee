#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// What a point cloud gave as it was read as the surface of a solid.
struct PointCloudReading {
  std::vector<int> kept;           ///< points that are of the surface, ascending
  Points normals;                  ///< unit length, outward, one for each kept point
  Eigen::VectorXd areas;           ///< that each kept point stands for [m²]
  long duplicates = 0;             ///< points left out because another has their place
  long outliers = 0;               ///< points left out because they lie alone
  long without_normal = 0;         ///< kept points that came without one, beside others with one
  bool normals_estimated = false;  ///< of all, and turned by guess: most came without one
  bool turned = false;             ///< the normals given look inwards: read the other way
  long odd_normals = 0;            ///< that look against those about them: read as if turned
  double covered = 0;              ///< share of the boundary that lies near points

  std::vector<std::string> notes() const;  ///< a sentence each, for the user
};

/// Points with what is known of them.
struct OrientedPoints {
  Points positions, normals;
  Eigen::VectorXd areas;
};

/// Cleans a cloud and tells which way its surface looks: what the cloud says, and the points that
/// make the surface. `normals` n×3 of any length, or empty.
/// Errors: ShapeError where the points are too few or flat.
std::pair<PointCloudReading, OrientedPoints> read_points(const Points& positions,
                                                         const Points& normals);

}  // namespace supple
