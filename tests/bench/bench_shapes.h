#pragma once

#include <filesystem>

#include "io/mesh/mesh_files.h"
#include "tests/support/shapes.h"

namespace supple::bench {

/// Every triangle cut into four by the middles of its edges.
inline Mesh refined(const Mesh& mesh) {
  const Triangles triangles = triangulate(mesh).triangles;
  std::vector<Vec3> points;
  for (Index i = 0; i < mesh.positions.rows(); ++i)
    points.push_back(mesh.positions.row(i).transpose());
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [at, added] = middles.emplace(std::minmax(a, b), static_cast<int>(points.size()));
    if (added)
      points.push_back(0.5 *
                       (points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]));
    return at->second;
  };
  std::vector<std::vector<int>> faces;
  for (Index f = 0; f < triangles.rows(); ++f) {
    const int a = triangles(f, 0), b = triangles(f, 1), c = triangles(f, 2);
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return make_mesh(points, faces);
}

/// The armadillo where examples/run.sh has fetched it (26,002 vertices), else a torus.
inline Mesh real_shape() {
  const std::filesystem::path file =
      std::filesystem::path(SUPPLE_SOURCE_DIR) / "build/data/armadillo.off";
  return exists(file) ? read_mesh(file) : make_torus(1, 0.4, 228, 114);
}

/// The same with about 104,000 vertices.
inline Mesh fine_shape() {
  return refined(real_shape());
}

/// A closed surface of nearly so many vertices.
inline Mesh surface_of(Index vertices) {
  const int across = static_cast<int>(std::sqrt(static_cast<double>(vertices) / 2.5));
  return make_torus(1, 0.4, static_cast<int>(vertices) / across, across);
}

}  // namespace supple::bench
