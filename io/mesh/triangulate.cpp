#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "io/mesh/mesh.h"

namespace supple {
namespace {

using Vec2 = Eigen::Vector2d;

/// Twice the signed area of a triangle, positive counter-clockwise.
double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Cuts one polygon after the other; keeps its memory from one to the next.
class PolygonCutter {
 public:
  PolygonCutter(const Mesh& mesh, std::vector<int>& triangles)
      : mesh_(mesh), triangles_(triangles) {}

  void cut(std::span<const int> polygon) {
    if (polygon.size() == 3) return add(polygon[0], polygon[1], polygon[2]);
    take_vertices(polygon);
    if (vertices_.size() < 3) return;
    project();
    if (vertices_.size() == 4) return cut_quad();
    if (is_convex())
      cut_fan();
    else
      clip_ears();
  }

 private:
  /// A triangle that uses a vertex twice covers nothing, and its edges cancel.
  void add(int a, int b, int c) {
    if (a != b && b != c && c != a) triangles_.insert(triangles_.end(), {a, b, c});
  }
  void add_corners(int a, int b, int c) { add(vertices_[a], vertices_[b], vertices_[c]); }

  void take_vertices(std::span<const int> polygon) {
    vertices_.clear();
    for (const int vertex : polygon)
      if (vertices_.empty() || vertices_.back() != vertex) vertices_.push_back(vertex);
    while (vertices_.size() > 1 && vertices_.back() == vertices_.front()) vertices_.pop_back();
  }

  int size() const { return static_cast<int>(vertices_.size()); }
  Vec3 position(int corner) const { return mesh_.positions.row(vertices_[corner]); }

  /// Along the axis that is nearest to the normal, seen from where that points. The normal is
  /// Newell's, the sum of the areas of a fan, and thus right for concave polygons too.
  void project() {
    const Vec3 origin = position(0);
    Vec3 normal = Vec3::Zero();
    for (int i = 2; i < size(); ++i)
      normal += (position(i - 1) - origin).cross(position(i) - origin);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    points_.clear();
    for (int i = 0; i < size(); ++i) {
      const Vec3 x = position(i) - origin;
      points_.emplace_back(x[u], x[v]);
    }
  }

  double corner_area(int a, int b, int c) const { return area(points_[a], points_[b], points_[c]); }

  /// The diagonal whose triangles both turn as the quad does, the shorter one where both do.
  void cut_quad() {
    const double from_0 = std::min(corner_area(0, 1, 2), corner_area(0, 2, 3));
    const double from_1 = std::min(corner_area(1, 2, 3), corner_area(1, 3, 0));
    // Equal but for rounding counts as equal: the cut must not depend on where the shape lies.
    const bool shorter_0 = (position(2) - position(0)).squaredNorm() <=
                           (1 + 1e-6) * (position(3) - position(1)).squaredNorm();
    const bool both = from_0 > 0 && from_1 > 0;
    const int first = (both ? shorter_0 : from_0 >= from_1) ? 0 : 1;
    add_corners(first, first + 1, first + 2);
    add_corners(first, first + 2, (first + 3) % 4);
  }

  /// Strictly, and once around.
  bool is_convex() const {
    for (int i = 0; i < size(); ++i)
      if (corner_area(i, (i + 1) % size(), (i + 2) % size()) <= 0) return false;
    for (int i = 2; i < size(); ++i)
      if (corner_area(0, i - 1, i) <= 0) return false;
    return true;
  }

  void cut_fan() {
    for (int i = 2; i < size(); ++i) add_corners(0, i - 1, i);
  }

  /// Cuts off corner after corner. Where none is an ear (the polygon crosses itself or has no
  /// area) the widest corner goes, so that the triangles always have the polygon's boundary.
  void clip_ears() {
    next_.resize(vertices_.size());
    previous_.resize(vertices_.size());
    for (int i = 0; i < size(); ++i) {
      next_[i] = (i + 1) % size();
      previous_[next_[i]] = i;
    }
    int corner = 0;
    for (int left = size(); left > 3; --left) {
      int tried = 0;
      while (tried < left && !is_ear(corner)) corner = next_[corner], ++tried;
      if (tried == left) corner = widest_corner(corner);
      corner = clip(corner);
    }
    add_corners(previous_[corner], corner, next_[corner]);
  }

  double area_at(int corner) const { return corner_area(previous_[corner], corner, next_[corner]); }

  bool is_ear(int corner) const {
    if (area_at(corner) <= 0) return false;
    const int before = previous_[corner], after = next_[corner];
    for (int other = next_[after]; other != before; other = next_[other])
      if (area_at(other) <= 0 && blocks(other, before, corner, after)) return false;
    return true;
  }

  /// Whether `other` lies in the triangle or on its rim; a copy of one of its corners does not.
  bool blocks(int other, int a, int b, int c) const {
    const Vec2& x = points_[other];
    if (x == points_[a] || x == points_[b] || x == points_[c]) return false;
    return area(points_[a], points_[b], x) >= 0 && area(points_[b], points_[c], x) >= 0 &&
           area(points_[c], points_[a], x) >= 0;
  }

  int widest_corner(int start) const {
    int widest = start;
    for (int corner = next_[start]; corner != start; corner = next_[corner])
      if (area_at(corner) > area_at(widest)) widest = corner;
    return widest;
  }

  /// Returns a corner beyond its neighbour, so that not all triangles meet in one vertex.
  int clip(int corner) {
    add_corners(previous_[corner], corner, next_[corner]);
    next_[previous_[corner]] = next_[corner];
    previous_[next_[corner]] = previous_[corner];
    return next_[next_[corner]];
  }

  const Mesh& mesh_;
  std::vector<int>& triangles_;
  std::vector<int> vertices_;  ///< of the polygon, without direct repetitions
  std::vector<Vec2> points_;
  std::vector<int> next_, previous_;
};

}  // namespace

Triangulation triangulate(const Mesh& mesh) {
  std::vector<int> triangles;
  triangles.reserve(mesh.face_vertices.size());
  Triangulation result;
  result.faces.reserve(mesh.face_count());
  PolygonCutter cutter(mesh, triangles);
  for (int face = 0; face < mesh.face_count(); ++face) {
    const auto size = static_cast<std::size_t>(mesh.face_size(face));
    cutter.cut(std::span(mesh.face_vertices).subspan(mesh.face_starts[face], size));
    result.faces.resize(triangles.size() / 3, face);
  }
  result.triangles =
      Eigen::Map<const Triangles>(triangles.data(), static_cast<Index>(triangles.size() / 3), 3);
  return result;
}

Mesh points_of(Mesh mesh) {
  mesh.face_starts = {0};
  mesh.face_vertices.clear();
  mesh.tags.clear();
  mesh.material_libraries.clear();
  mesh.gltf_materials.reset();
  if (mesh.normals.per_corner()) mesh.normals = {};
  if (mesh.texcoords.per_corner()) mesh.texcoords = {};
  return mesh;
}

}  // namespace supple
