#include "modeler/domain/mended_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "modeler/domain/oriented_surface.h"
#include "modeler/domain/small_holes.h"
#include "modeler/domain/surface_measures.h"

namespace supple {

namespace {

/// Height over longest edge below which a triangle may as well be none.
constexpr double sliver_height = 1e-7;

/// Rims wider than this share of the diagonal are left to the winding number; so are those of
/// sheets, whose lid would be as large as they are.
constexpr double small_hole = 0.125, small_lid = 0.25;

long edge_count(const std::vector<BoundaryEdge>& edges) {
  long count = 0;
  for (const BoundaryEdge& edge : edges) count += std::abs(edge.excess);
  return count;
}

Triangles without_slivers(const Points& positions, const Triangles& triangles) {
  std::vector<Index> kept;
  for (Index t = 0; t < triangles.rows(); ++t) {
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest,
                         (positions.row(triangles(t, k)) - positions.row(triangles(t, (k + 1) % 3)))
                             .squaredNorm());
    if (double_area_normal(positions, triangles, t).norm() > sliver_height * longest)
      kept.push_back(t);
  }
  return rows_of(triangles, kept);
}

/// Triangles and the boundary that they leave open.
struct Chain {
  Triangles triangles;
  std::vector<BoundaryEdge> rims;
  explicit Chain(Triangles of) : triangles(std::move(of)), rims(boundary_edges(triangles)) {}
};

/// Leaves out what has no area, or hardly any, unless that opens the surface: such a triangle may
/// close a T-junction, or stand where it closes nothing.
Chain least_open(const Points& positions, const Triangles& welded) {
  Chain best(with_area(positions, welded));
  if (best.rims.empty()) return best;
  if (best.triangles.rows() < welded.rows()) {
    Chain all(welded);
    // A closed chain stays closed to all that is asked of it without what has no area.
    if (all.rims.empty()) best.rims.clear();
    if (all.rims.empty()) return best;
    if (edge_count(all.rims) < edge_count(best.rims)) best = std::move(all);
  }
  Chain thick(without_slivers(positions, best.triangles));
  return edge_count(thick.rims) < edge_count(best.rims) ? thick : best;
}

/// Turns and fills an open surface. May close it.
void mend_open(MendedSurface& surface) {
  SurfaceDefects& defects = surface.defects;
  Triangles& triangles = surface.triangles;
  const Index had = triangles.rows();
  triangles = without_duplicates(triangles);
  const Turning turning = orient(surface.positions, triangles);
  triangles = without_duplicates(triangles);
  defects.duplicate_faces = had - triangles.rows();
  defects.turned_faces = turning.turned;
  defects.turning_conflicts = turning.conflicts;
  defects.inside_out = turning.inside_out;
  surface.rims = boundary_edges(triangles);
  defects.boundary_edges = edge_count(surface.rims);
  if (surface.rims.empty()) return;
  const Index unfilled = triangles.rows();
  defects.small_holes = fill_small_holes(surface.positions, triangles,
                                         {small_hole * surface.box.diagonal(), small_lid});
  surface.filled = triangles.rows() - unfilled;
  if (surface.filled > 0) surface.rims = boundary_edges(triangles);
}

}  // namespace

MendedSurface mend(const Points& positions, const Triangles& triangles) {
  WeldedSurface welded = weld(positions, triangles);
  MendedSurface surface;
  const Box box = box_of_corners(welded.positions, welded.triangles);
  if (box.empty()) return surface;
  surface.center = box.center();
  surface.box = {box.lower - surface.center, box.upper - surface.center};
  surface.positions = std::move(welded.positions);
  surface.positions.rowwise() -= surface.center.transpose();
  surface.originals = std::move(welded.originals);

  Chain chain = least_open(surface.positions, welded.triangles);
  surface.triangles = std::move(chain.triangles);
  surface.rims = std::move(chain.rims);
  surface.defects.degenerate_faces = triangles.rows() - surface.triangles.rows();
  if (surface.rims.empty())
    surface.defects.inside_out =
        turn_closed_parts(surface.positions, surface.triangles, connected_parts(surface.triangles));
  else
    mend_open(surface);
  return surface;
}

}  // namespace supple
