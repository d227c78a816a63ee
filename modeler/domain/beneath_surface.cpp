#include "modeler/domain/beneath_surface.h"

#include <Eigen/Geometry>

#include "modeler/domain/surface_measures.h"

namespace supple {
namespace {

/// How much farther a vertex moves along its triangle than below it: it must not leave by the
/// triangles beside that.
constexpr double along = 10;

/// `depth` signed so that normals times it point out of the solid.
double outward(const Points& positions, const Triangles& triangles, double depth) {
  return signed_volume(positions, triangles) < 0 ? -depth : depth;
}

}  // namespace

Points vertices_beneath(const Points& positions, const Triangles& triangles, double depth) {
  const double signed_depth = outward(positions, triangles, depth);
  Points beneath = positions;
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.rows());
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 normal = double_area_normal(positions, triangles, t);
    const double area = normal.norm();
    const Vec3 center = positions({triangles(t, 0), triangles(t, 1), triangles(t, 2)}, Eigen::all)
                            .colwise()
                            .mean()
                            .transpose();
    for (int k = 0; k < 3; ++k) {
      const int vertex = triangles(t, k);
      if (!(area > areas[vertex])) continue;
      areas[vertex] = area;
      const Vec3 x = positions.row(vertex).transpose();
      beneath.row(vertex) =
          x + along * depth * (center - x).normalized() - signed_depth / area * normal;
    }
  }
  return beneath;
}

Points samples_beneath(const SurfaceSamples& samples, const Points& positions,
                       const Triangles& triangles, double depth) {
  const double signed_depth = outward(positions, triangles, depth);
  Points beneath = samples.positions;
  for (Index k = 0; k < samples.size(); ++k) {
    const Vec3 normal = double_area_normal(positions, triangles, samples.triangles[k]);
    if (normal.norm() > 0) beneath.row(k) -= signed_depth * normal.normalized().transpose();
  }
  return beneath;
}

Points points_beneath(const Points& positions, const CloudSurface& surface, double depth) {
  Points beneath = positions;
  for (std::size_t k = 0; k < surface.points.size(); ++k)
    beneath.row(surface.points[k]) -= depth * surface.normals.row(static_cast<Index>(k));
  return beneath;
}

}  // namespace supple
