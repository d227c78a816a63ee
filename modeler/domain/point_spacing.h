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
/// Density is 6/(π d²), d the distance to the sixth nearest point.
PointSpacing measure_spacing(const Points& points);

}  // namespace supple
