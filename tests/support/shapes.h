#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "io/mesh/mesh.h"
#include "solver/core/types.h"

/// Shapes made in code. All are closed, share their vertices, and turn outwards.
namespace supple {

/// A mesh of `points` (one a row) and polygons given by their vertices.
inline Mesh make_mesh(const std::vector<Vec3>& points,
                      const std::vector<std::vector<int>>& polygons) {
  Mesh mesh;
  mesh.positions.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.positions.row(static_cast<Index>(i)) = points[i].transpose();
  for (const std::vector<int>& polygon : polygons) {
    mesh.face_vertices.insert(mesh.face_vertices.end(), polygon.begin(), polygon.end());
    mesh.face_starts.push_back(static_cast<int>(mesh.face_vertices.size()));
  }
  return mesh;
}

/// Surface of the box [0, size], cut into a grid of `cells` quads along x, y and z.
inline Mesh make_quad_bar(const Vec3& size, const std::array<int, 3>& cells) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> quads;
  std::map<std::array<int, 3>, int> numbers;
  const auto number = [&](const std::array<int, 3>& node) {
    const auto [entry, added] = numbers.emplace(node, static_cast<int>(points.size()));
    if (added)
      points.emplace_back(size.x() * node[0] / cells[0], size.y() * node[1] / cells[1],
                          size.z() * node[2] / cells[2]);
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int end : {0, cells[axis]})
      for (int i = 0; i < cells[u]; ++i)
        for (int j = 0; j < cells[v]; ++j) {
          const auto node = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = end, at[u] = i + di, at[v] = j + dj;
            return number(at);
          };
          const int a = node(0, 0), b = node(1, 0), c = node(1, 1), d = node(0, 1);
          if (end == 0)
            quads.push_back({a, d, c, b});
          else
            quads.push_back({a, b, c, d});
        }
  }
  return make_mesh(points, quads);
}

/// Each polygon of `mesh` as a fan of triangles; positions alone are kept.
inline Mesh as_fans(const Mesh& mesh) {
  Mesh result;
  result.positions = mesh.positions;
  for (int face = 0; face < mesh.face_count(); ++face) {
    const int* corner = &mesh.face_vertices[mesh.face_starts[face]];
    for (int k = 2; k < mesh.face_size(face); ++k) {
      result.face_vertices.insert(result.face_vertices.end(),
                                  {corner[0], corner[k - 1], corner[k]});
      result.face_starts.push_back(static_cast<int>(result.face_vertices.size()));
    }
  }
  return result;
}

/// The same as make_quad_bar, in triangles.
inline Mesh make_bar(const Vec3& size, const std::array<int, 3>& cells) {
  return as_fans(make_quad_bar(size, cells));
}

/// The box [0, size]: 8 vertices, 6 quads.
inline Mesh make_box(const Vec3& size) {
  return make_quad_bar(size, {1, 1, 1});
}

/// An icosahedron whose triangles are split in four `splits` times; vertices on a sphere about
/// the origin. 10·4^splits + 2 vertices.
inline Mesh make_icosphere(double radius, int splits) {
  const double g = std::numbers::phi;
  std::vector<Vec3> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                              {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                              {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::vector<int>> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto key = std::minmax(a, b);
      const auto [entry, added] = middles.emplace(key, static_cast<int>(points.size()));
      if (added) points.push_back((points[a] + points[b]).normalized());
      return entry->second;
    };
    for (Vec3& p : points) p.normalize();
    std::vector<std::vector<int>> finer;
    for (const std::vector<int>& f : faces) {
      const int a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    faces = std::move(finer);
  }
  for (Vec3& p : points) p = radius * p.normalized();
  return make_mesh(points, faces);
}

/// A torus about the z axis, `around` × `across` vertices; a tube of radius `minor` whose centre
/// runs on a circle of radius `major`.
inline Mesh make_torus(double major, double minor, int around, int across) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = major + minor * std::cos(v);
      points.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
      const int next_i = (i + 1) % around * across, next_j = (j + 1) % across;
      faces.push_back({i * across + j, next_i + j, next_i + next_j});
      faces.push_back({i * across + j, next_i + next_j, i * across + next_j});
    }
  return make_mesh(points, faces);
}

/// The triangles of a mesh that has only triangles.
inline Triangles triangles_of(const Mesh& mesh) {
  return Eigen::Map<const Triangles>(mesh.face_vertices.data(), mesh.face_count(), 3);
}

/// Volume that closed outward triangles enclose (divergence theorem).
inline double enclosed_volume(const Points& x, const Triangles& triangles) {
  double volume = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = x.row(triangles(t, 0)), b = x.row(triangles(t, 1)), c = x.row(triangles(t, 2));
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

/// Every directed edge has its opposite exactly once: closed, manifold and of one orientation.
inline bool is_closed(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> balance;
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      if (++balance[{a, b}] > 1) return false;
    }
  for (const auto& [edge, count] : balance)
    if (!balance.contains({edge.second, edge.first})) return false;
  return true;
}

}  // namespace supple
