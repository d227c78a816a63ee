#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/core/random.h"
#include "tests/support/shapes.h"

/// Point clouds of shapes, clean and spoilt.
namespace supple {

struct PointCloud {
  Points positions, normals;
};

/// `mesh` moved and scaled so that its box is about the origin and has a diagonal of 1.
inline Mesh of_unit_size(Mesh mesh) {
  const Box box = bounding_box(mesh.positions);
  mesh.positions = (mesh.positions.rowwise() - box.center().transpose()) / box.diagonal();
  return mesh;
}

/// Points at random on a mesh of triangles, as many on each area, with its faces' normals.
inline PointCloud points_on(const Mesh& mesh, Index count, std::uint64_t seed = 1) {
  const Triangles triangles = triangles_of(mesh);
  const auto corner = [&](Index t, int k) -> Vec3 { return mesh.positions.row(triangles(t, k)); };
  std::vector<double> areas;
  double area = 0;
  for (Index t = 0; t < triangles.rows(); ++t)
    areas.push_back(area +=
                    (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm());
  Random random(seed);
  PointCloud cloud{Points(count, 3), Points(count, 3)};
  for (Index i = 0; i < count; ++i) {
    const auto found = std::lower_bound(areas.begin(), areas.end() - 1, area * random.uniform());
    const Index t = found - areas.begin();
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 a = corner(t, 0), along = corner(t, 1) - a, across = corner(t, 2) - a;
    cloud.positions.row(i) = (a + u * along + v * across).transpose();
    cloud.normals.row(i) = along.cross(across).normalized().transpose();
  }
  return cloud;
}

/// Moves each point by normal deviates of `deviation` [m] in each coordinate.
inline Points with_noise(Points positions, double deviation, std::uint64_t seed = 2) {
  Random random(seed);
  for (double& x : positions.reshaped())
    x += deviation * std::sqrt(-2 * std::log(1 - random.uniform())) *
         std::cos(2 * std::numbers::pi * random.uniform());
  return positions;
}

/// Appends `count` points at random in the points' box.
inline Points with_outliers(Points positions, Index count, std::uint64_t seed = 3) {
  Random random(seed);
  const Box box = bounding_box(positions);
  const Index first = positions.rows();
  positions.conservativeResize(first + count, 3);
  for (Index i = first; i < positions.rows(); ++i)
    positions.row(i) = (box.lower + random.in_cube(0, 1).cwiseProduct(box.size())).transpose();
  return positions;
}

}  // namespace supple
