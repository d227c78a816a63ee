#include "modeler/domain/surface_measures.h"

#include <Eigen/Geometry>

namespace supple {

double signed_volume(const Points& positions, const Triangles& triangles) {
  const Vec3 center = box_of_corners(positions, triangles).center();
  double volume = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0)).transpose() - center;
    const Vec3 b = positions.row(triangles(t, 1)).transpose() - center;
    const Vec3 c = positions.row(triangles(t, 2)).transpose() - center;
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

double surface_area(const Points& positions, const Triangles& triangles) {
  double area = 0;
  for (Index t = 0; t < triangles.rows(); ++t)
    area += 0.5 * double_area_normal(positions, triangles, t).norm();
  return area;
}

Vec3 double_area_normal(const Points& positions, const Triangles& triangles, Index t) {
  const Vec3 a = positions.row(triangles(t, 0));
  const Vec3 ab = positions.row(triangles(t, 1)).transpose() - a;
  const Vec3 ac = positions.row(triangles(t, 2)).transpose() - a;
  return ab.cross(ac);
}

Box box_of_corners(const Points& positions, const Triangles& triangles) {
  Box box;
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) box.extend(positions.row(triangles(t, k)).transpose());
  return box;
}

}  // namespace supple
