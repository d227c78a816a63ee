#include "modeler/domain/closed_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "modeler/domain/shape_error.h"
#include "modeler/domain/triangle_tree.h"
#include "modeler/domain/welded_surface.h"

namespace supple {

namespace {

/// Share of area × diagonal below which a volume is rounding.
constexpr double no_volume = 1e-12;

double area_of(const Points& positions, const Triangles& triangles) {
  double area = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0));
    const Vec3 ab = positions.row(triangles(t, 1)).transpose() - a;
    const Vec3 ac = positions.row(triangles(t, 2)).transpose() - a;
    area += 0.5 * ab.cross(ac).norm();
  }
  return area;
}

long edge_count(const std::vector<BoundaryEdge>& edges) {
  long count = 0;
  for (const BoundaryEdge& edge : edges) count += std::abs(edge.excess);
  return count;
}

/// True where each edge has an even number of triangles: only their turning disagrees.
bool closed_but_for_turning(const std::vector<BoundaryEdge>& edges) {
  return std::all_of(edges.begin(), edges.end(),
                     [](const BoundaryEdge& edge) { return edge.excess % 2 == 0; });
}

/// The caller may have scaled the shape: a vertex's number is what the user can find.
std::string open_message(const std::vector<BoundaryEdge>& edges, const Points& welded,
                         const Points& vertices, const Vec3& center) {
  Index vertex = 0;
  const Eigen::RowVector3d place = welded.row(edges[0].a) + center.transpose();
  (vertices.rowwise() - place).rowwise().squaredNorm().minCoeff(&vertex);
  const std::string where = fmt::format("vertex {} (counted from 0)", vertex);
  if (closed_but_for_turning(edges))
    return fmt::format(
        "the faces are not turned one way: at {} edges, for example at {}, two neighbours look to "
        "opposite sides; make the normals consistent in a mesh editor",
        edges.size(), where);
  return fmt::format(
      "the surface is open: {} boundary edges, for example at {}; a solid needs a closed surface: "
      "fill the holes in a mesh editor, or merge vertices that should be one",
      edge_count(edges), where);
}

Box box_of_corners(const Points& positions, const Triangles& triangles) {
  Box box;
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) box.extend(positions.row(triangles(t, k)).transpose());
  return box;
}

/// Fewest edges that stay open: a triangle without area may close a T-junction, or stand where
/// it closes nothing.
std::vector<BoundaryEdge> open_edges(const WeldedSurface& surface, const Triangles& with_area) {
  std::vector<BoundaryEdge> edges = boundary_edges(surface.triangles);
  if (edges.empty()) return edges;
  std::vector<BoundaryEdge> others = boundary_edges(with_area);
  return edge_count(others) < edge_count(edges) ? others : edges;
}

void turn(Triangles& triangles, Index row) {
  std::swap(triangles(row, 1), triangles(row, 2));
}

/// Six times each part's signed volume.
std::vector<double> part_volumes(const Points& positions, const Triangles& triangles,
                                 const std::vector<int>& parts) {
  std::vector<double> volumes;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
               c = positions.row(triangles(t, 2));
    volumes.resize(std::max(volumes.size(), std::size_t(parts[t]) + 1), 0);
    volumes[parts[t]] += a.dot(b.cross(c));
  }
  return volumes;
}

/// A point a little above the middle of a triangle, on the side it looks to.
Vec3 above(const Points& positions, const Triangles& triangles, Index t) {
  const Vec3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
             c = positions.row(triangles(t, 2));
  const Vec3 normal = (b - a).cross(c - a);
  return (a + b + c) / 3 + 1e-4 / std::sqrt(normal.norm()) * normal;
}

/// Turns parts that lie inside out in the open. A cavity looks like one too, but what it looks to
/// is enclosed by another part. Returns whether any was turned.
bool turn_parts(const Points& positions, Triangles& triangles) {
  const std::vector<int> parts = connected_parts(triangles);
  const std::vector<double> volumes = part_volumes(positions, triangles, parts);
  std::vector<Index> first(volumes.size(), -1);
  for (Index t = triangles.rows() - 1; t >= 0; --t) first[parts[t]] = t;
  if (std::none_of(volumes.begin(), volumes.end(), [](double v) { return v < 0; })) return false;

  const TriangleTree tree(positions, triangles);
  std::vector<char> turned(volumes.size(), 0);
  for (std::size_t part = 0; part < volumes.size(); ++part)
    turned[part] =
        volumes[part] < 0 && tree.winding_number(above(positions, triangles, first[part])) < -0.5;
  for (Index t = 0; t < triangles.rows(); ++t)
    if (turned[parts[t]]) turn(triangles, t);
  return std::find(turned.begin(), turned.end(), 1) != turned.end();
}

}  // namespace

/// Everything but `center` is relative to it.
struct ClosedRegion::Parts {
  Vec3 center;
  Box box;
  SurfaceDefects defects;
  double volume;
  TriangleTree tree;
};

ClosedRegion::ClosedRegion(const Points& positions, const Triangles& triangles) {
  WeldedSurface surface = weld(positions, triangles);
  if (surface.triangles.rows() == 0)
    throw ShapeError("the shape has no triangles with three different corners, so no volume");
  Box box = box_of_corners(surface.positions, surface.triangles);
  const Vec3 center = box.center();
  surface.positions.rowwise() -= center.transpose();
  box = {box.lower - center, box.upper - center};

  Triangles solid = with_area(surface.positions, surface.triangles);
  const std::vector<BoundaryEdge> edges = open_edges(surface, solid);
  if (!edges.empty()) throw ShapeError(open_message(edges, surface.positions, positions, center));
  SurfaceDefects defects;
  defects.degenerate_faces = triangles.rows() - solid.rows();

  double volume = signed_volume(surface.positions, solid);
  if (!(std::abs(volume) > no_volume * box.diagonal() * area_of(surface.positions, solid)))
    throw ShapeError(
        "the surface is closed but encloses no volume (it is flat, or its parts cancel); a solid "
        "needs a thickness");
  if (volume < 0) {
    defects.inside_out = true;
    for (Index t = 0; t < solid.rows(); ++t) turn(solid, t);
  }
  if (turn_parts(surface.positions, solid)) defects.inside_out = true;
  volume = signed_volume(surface.positions, solid);
  parts_.reset(new Parts{center, box, defects, volume, TriangleTree(surface.positions, solid)});
}

ClosedRegion::~ClosedRegion() = default;
ClosedRegion::ClosedRegion(ClosedRegion&&) noexcept = default;

double ClosedRegion::signed_distance(const Vec3& x) const {
  const Vec3 local = x - parts_->center;
  const double distance = std::sqrt(parts_->tree.closest(local).squared_distance);
  return contains(x) ? -distance : distance;
}

bool ClosedRegion::contains(const Vec3& x) const {
  return winding_number(x) > 0.5;
}

Vec3 ClosedRegion::closest_boundary_point(const Vec3& x) const {
  return parts_->tree.closest(x - parts_->center).point + parts_->center;
}

bool ClosedRegion::connects(const Vec3& a, const Vec3& b) const {
  std::vector<Crossing> crossings;
  parts_->tree.crossings(a - parts_->center, b - parts_->center, crossings);
  return crossings.empty();
}

double ClosedRegion::volume() const {
  return parts_->volume;
}

Box ClosedRegion::bounds() const {
  return {parts_->box.lower + parts_->center, parts_->box.upper + parts_->center};
}

double ClosedRegion::winding_number(const Vec3& x) const {
  return parts_->tree.winding_number(x - parts_->center);
}

const SurfaceDefects& ClosedRegion::defects() const {
  return parts_->defects;
}

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

}  // namespace supple
