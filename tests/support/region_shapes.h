#pragma once

#include <functional>

#include "modeler/domain/mesh_region.h"
#include "solver/core/random.h"
#include "tests/support/shapes.h"

/// Shapes that are hard to fill with particles, and regions of shapes.
namespace supple {

inline MeshRegion region_of(const Mesh& mesh) {
  return MeshRegion(mesh.positions, triangles_of(mesh));
}

/// Whether the straight way from a to b, both inside, stays inside.
inline bool connects(const Region& region, const Vec3& a, const Vec3& b) {
  return region.connects(a, region.layers(a), b);
}

/// `mesh` with each position x at `map(x)`.
inline Mesh mapped(Mesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Index i = 0; i < mesh.positions.rows(); ++i)
    mesh.positions.row(i) = map(mesh.positions.row(i)).transpose();
  return mesh;
}

/// Both meshes as one; they share no vertex.
inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const int vertices = static_cast<int>(a.positions.rows());
  mesh.positions.conservativeResize(a.positions.rows() + b.positions.rows(), 3);
  mesh.positions.bottomRows(b.positions.rows()) = b.positions;
  for (int vertex : b.face_vertices) mesh.face_vertices.push_back(vertex + vertices);
  for (int face = 0; face < b.face_count(); ++face)
    mesh.face_starts.push_back(mesh.face_starts.back() + b.face_size(face));
  return mesh;
}

/// A triangle mesh turned inside out.
inline Mesh turned(Mesh mesh) {
  for (std::size_t k = 0; k + 2 < mesh.face_vertices.size(); k += 3)
    std::swap(mesh.face_vertices[k + 1], mesh.face_vertices[k + 2]);
  return mesh;
}

/// A triangle mesh without the faces for which `gone` is true of their middle.
inline Mesh without(const Mesh& mesh, const std::function<bool(const Vec3&)>& gone) {
  const Triangles triangles = triangles_of(mesh);
  std::vector<std::vector<int>> kept;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const int a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    const Vec3 sum = mesh.positions.row(a) + mesh.positions.row(b) + mesh.positions.row(c);
    if (!gone(sum / 3)) kept.push_back({a, b, c});
  }
  Mesh result = make_mesh({}, kept);
  result.positions = mesh.positions;
  return result;
}

/// Each face of a triangle mesh inside out with this chance.
inline Mesh turned_at_random(Mesh mesh, double chance, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t k = 0; k + 2 < mesh.face_vertices.size(); k += 3)
    if (random.uniform() < chance) std::swap(mesh.face_vertices[k + 1], mesh.face_vertices[k + 2]);
  return mesh;
}

/// Two balls of radius 1 at z = ±2 that a bar of radius `bar` joins.
inline Mesh make_dumbbell(double bar) {
  constexpr int rings = 121, around = 32;
  std::vector<Vec3> points = {{0, 0, -3}};
  std::vector<std::vector<int>> faces;
  for (int ring = 1; ring < rings; ++ring) {
    const double z = -3 + 6.0 * ring / rings;
    const double from_ball = std::abs(z) - 2;
    const double ball = 1 - from_ball * from_ball > 0 ? std::sqrt(1 - from_ball * from_ball) : 0;
    const double radius = std::abs(z) < 2 ? std::max(ball, bar) : ball;
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  points.emplace_back(0, 0, 3);
  const auto vertex = [&](int ring, int k) { return 1 + (ring - 1) * around + k % around; };
  const int top = static_cast<int>(points.size()) - 1;
  for (int k = 0; k < around; ++k) {
    faces.push_back({0, vertex(1, k + 1), vertex(1, k)});
    faces.push_back({top, vertex(rings - 1, k), vertex(rings - 1, k + 1)});
    for (int ring = 1; ring + 1 < rings; ++ring) {
      const int a = vertex(ring, k), b = vertex(ring, k + 1);
      const int c = vertex(ring + 1, k + 1), d = vertex(ring + 1, k);
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  }
  return make_mesh(points, faces);
}

/// An L of two 3×1×1 arms; volume 5.
inline Mesh make_l_shape() {
  const std::vector<Eigen::Vector2d> outline = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::vector<Vec3> points;
  for (double z : {0.0, 1.0})
    for (const Eigen::Vector2d& p : outline) points.emplace_back(p.x(), p.y(), z);
  std::vector<std::vector<int>> faces = {{3, 2, 1, 0}, {5, 4, 3, 0}, {6, 7, 8, 9}, {6, 9, 10, 11}};
  for (int k = 0; k < 6; ++k) faces.push_back({k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6});
  return as_fans(make_mesh(points, faces));
}

}  // namespace supple
