#pragma once

#include "solver/core/types.h"

namespace supple {

/// How close the points of a scanned surface lie.
struct PointSpacing {
  double median = 0, least = 0, greatest = 0;  ///< distance to the nearest other point [m]
  double density = 0;                          ///< points a unit of area, median [1/m²]
  double area = 0;      ///< of the surface, each point counting by the density about it [m²]
  long duplicated = 0;  ///< points at the position of one before, to the last bit
};

/// Of at least two different points; of many it looks at evenly chosen ones.
/// Density is 15/(π d²), d the distance to the 16th nearest point: right on average of points that
/// lie at random (their mean of 1/d² is 15/16 as large), and to 3 % of hexagonal ones.
PointSpacing measure_spacing(const Points& points);

}  // namespace supple
