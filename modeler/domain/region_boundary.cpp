#include "modeler/domain/region_boundary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "modeler/domain/region_cover.h"
#include "modeler/domain/surface_measures.h"
#include "modeler/domain/trimmed_surface.h"

namespace supple {

namespace {

/// Of the diagonal: the edges that triangles are cut down to, the edges of those that are looked at
/// in four places, and how far their sides are asked.
constexpr double trim_width = 1.0 / 64, trim_grain = 1.0 / 16, trim_offset = 1e-6;

/// Shares of the surface in contact below which it is left whole: so little of the volume would
/// count twice.
constexpr double little_contact = 0.002;

/// Of the diagonal: a cell of the grid that openings are looked for on.
constexpr double cell_width = 1.0 / 64;

/// A cap's corner on the input goes to the rim where it is no farther than so many cells.
constexpr double rim_reach = 1.75;

/// Solid angles that trimming may count, and the grid for openings: some seconds each. Many large
/// triangles that cross each other would take for ever: they are looked at less finely.
constexpr double most_angles = 4e8;
constexpr Index probes = 32;

/// Winding numbers asked for in a cell of the grid.
constexpr double asked_a_cell = 4;

/// Solid angles that a winding number counts, on average at the surface.
double angles_counted(const TriangleTree& winding, const MendedSurface& surface) {
  double sum = 0;
  for (Index probe = 0; probe < probes; ++probe) {
    const auto corners = surface.triangles.row(probe * (surface.triangles.rows() - 1) / probes);
    const Vec3 middle = surface.positions({corners[0], corners[1], corners[2]}, Eigen::all)
                            .colwise()
                            .mean()
                            .transpose();
    sum += static_cast<double>(winding.counted_exactly(middle));
  }
  return sum / probes;
}

/// How finely triangles are cut.
TrimOptions trim_options(const TriangleTree& winding, const MendedSurface& surface) {
  const double diagonal = surface.box.diagonal();
  double pieces = 0;
  for (Index t = 0; t < surface.triangles.rows(); ++t) {
    const auto corner = [&](int k) { return surface.positions.row(surface.triangles(t, k)); };
    const double longest = std::max({(corner(1) - corner(0)).norm(), (corner(2) - corner(1)).norm(),
                                     (corner(0) - corner(2)).norm()});
    pieces += std::max(1.0, std::pow(longest / (trim_width * diagonal), 2));
  }
  const double coarser =
      std::max(1.0, std::sqrt(2 * pieces * angles_counted(winding, surface) / most_angles));
  return {coarser * trim_width * diagonal, coarser * trim_grain * diagonal, trim_offset * diagonal};
}

/// A cell of the grid that openings are looked for on.
double opening_width(const TriangleTree& winding, const MendedSurface& surface) {
  const double asked = asked_a_cell / std::pow(cell_width, 3);
  const double coarser =
      std::max(1.0, std::cbrt(asked * angles_counted(winding, surface) / most_angles));
  return coarser * cell_width * surface.box.diagonal();
}

void append(const Points& points, Points& to) {
  to.conservativeResize(to.rows() + points.rows(), 3);
  to.bottomRows(points.rows()) = points;
}

void append(const Triangles& triangles, int first_vertex, Triangles& to) {
  to.conservativeResize(to.rows() + triangles.rows(), 3);
  to.bottomRows(triangles.rows()) = triangles.array() + first_vertex;
}

RegionCover cover_of(const TriangleTree& winding, const MendedSurface& surface, double width) {
  ImplicitRegion region;
  region.value = [&](const Vec3& x) { return winding.winding_number(x); };
  region.distance = [&](const Vec3& x) {
    const ClosestPoint closest = winding.closest(x, width);
    return closest.triangle < 0 ? 2 * width : std::sqrt(closest.squared_distance);
  };
  region.passage = [&](const Vec3& a, const Vec3& b) {
    std::vector<Crossing> crossings;
    winding.crossings(a, b, crossings);
    if (crossings.empty()) return Passage{};
    return Passage{static_cast<long>(crossings.size()), crossings.front().share};
  };
  region.box = surface.box;
  RegionCoverOptions options;
  options.width = width;
  return cover_region(region, options);
}

/// Caps begin at the rim: where they begin on the input beside it, the way between would count
/// twice or be open.
void draw_to_rims(const MendedSurface& surface, double reach, RegionCover& cover) {
  Triangles rims(static_cast<Index>(surface.rims.size()), 3);
  for (Index i = 0; i < rims.rows(); ++i) {
    const BoundaryEdge& edge = surface.rims[static_cast<std::size_t>(i)];
    rims.row(i) << edge.a, edge.b, edge.b;
  }
  const TriangleTree tree(surface.positions, rims);
  for (Index i = 0; i < cover.cap_positions.rows(); ++i) {
    if (!cover.cap_on_input[static_cast<std::size_t>(i)]) continue;
    const ClosestPoint closest = tree.closest(cover.cap_positions.row(i), reach);
    if (closest.triangle >= 0) cover.cap_positions.row(i) = closest.point;
  }
}

/// All triangles, where hardly any does not bound the region.
TrimmedSurface untrimmed(const MendedSurface& surface) {
  TrimmedSurface trimmed;
  trimmed.triangles = surface.triangles;
  trimmed.sources.resize(static_cast<std::size_t>(surface.triangles.rows()));
  std::iota(trimmed.sources.begin(), trimmed.sources.end(), 0);
  return trimmed;
}

/// Area of the pieces that are of no hole's filling.
double covered_area(const MendedSurface& surface, const Points& positions,
                    const TrimmedSurface& trimmed) {
  double area = 0;
  for (Index i = 0; i < trimmed.triangles.rows(); ++i)
    if (trimmed.sources[static_cast<std::size_t>(i)] < surface.triangles.rows() - surface.filled)
      area += 0.5 * double_area_normal(positions, trimmed.triangles, i).norm();
  return area;
}

/// Least area that would close the triangles: a closed surface's area normals add up to nothing.
double area_missing(const Points& positions, const Triangles& triangles) {
  Vec3 sum = Vec3::Zero();
  for (Index t = 0; t < triangles.rows(); ++t) sum += double_area_normal(positions, triangles, t);
  return 0.5 * sum.norm();
}

/// Puts caps over the openings. Returns the area of the greatest opening.
double close_openings(const TriangleTree& winding, const MendedSurface& surface,
                      RegionBoundary& boundary) {
  const double width = opening_width(winding, surface);
  RegionCover cover = cover_of(winding, surface, width);
  draw_to_rims(surface, rim_reach * width, cover);
  append(cover.caps, static_cast<int>(boundary.positions.rows()), boundary.triangles);
  append(cover.cap_positions, boundary.positions);
  boundary.caps = cover.caps.rows();
  boundary.opening = cover.opening;
  return cover.greatest_opening * cover.area;
}

}  // namespace

RegionBoundary find_boundary(const TriangleTree& winding, const MendedSurface& surface,
                             const SurfaceContact& contact) {
  RegionBoundary boundary;
  boundary.positions = surface.positions;
  TrimmedSurface trimmed =
      contact.any() <= little_contact
          ? untrimmed(surface)
          : trim(winding, boundary.positions, surface.triangles, trim_options(winding, surface));
  const double covered = covered_area(surface, boundary.positions, trimmed);
  boundary.triangles = std::move(trimmed.triangles);
  double opening = 0, missing = 0;
  if (!surface.rims.empty()) {
    opening = close_openings(winding, surface, boundary);
    // What a sheet encloses is thinner than a cell: no cap is found, but the surface is not closed.
    missing = area_missing(boundary.positions, boundary.triangles);
  }
  boundary.untouched = trimmed.whole && boundary.caps == 0;
  boundary.area = surface_area(boundary.positions, boundary.triangles) + missing;
  if (boundary.area > 0) {
    boundary.covered = covered / boundary.area;
    boundary.greatest_opening = std::max(opening, missing) / boundary.area;
  }
  return boundary;
}

}  // namespace supple
