#pragma once

#include "solver/core/types.h"

namespace supple {

/// Signed volume that triangles enclose, Σ a·(b×c)/6 about their box's centre [m³].
double signed_volume(const Points& positions, const Triangles& triangles);

/// Sum of the triangles' areas [m²].
double surface_area(const Points& positions, const Triangles& triangles);

/// Twice the area times the unit normal of triangle t [m²].
Vec3 double_area_normal(const Points& positions, const Triangles& triangles, Index t);

/// Box of the vertices that triangles use [m].
Box box_of_corners(const Points& positions, const Triangles& triangles);

}  // namespace supple
