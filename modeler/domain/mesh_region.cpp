#include "modeler/domain/mesh_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "modeler/domain/region_boundary.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/surface_measures.h"
#include "modeler/domain/triangle_tree.h"

namespace supple {

namespace {

/// Share of area × diagonal below which a volume is rounding.
constexpr double no_volume = 1e-12;

/// A shape is open where its input covers less of the boundary, or one opening takes more.
constexpr double least_covered = 0.6, greatest_opening = 0.3;

/// Of the diagonal: how far from the surface its sides are asked.
constexpr double contact_offset = 1e-6;

/// Crossings at one place of the way, of its length: an edge, or walls that touch.
constexpr double same_place = 1e-9;

constexpr const char* advice =
    "close it in a mesh editor; a sheet would need a shell (not available yet)";

std::string zero_volume(const std::string& why) {
  return fmt::format("zero volume: {}; a solid needs a thickness", why);
}

/// The caller may have scaled the shape: a vertex's number is what the user can find.
std::string near_vertex(const MendedSurface& surface, const Vec3& x) {
  const auto count = static_cast<Index>(surface.originals.size());
  Index nearest = 0;
  (surface.positions.topRows(count).rowwise() - x.transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return fmt::format("vertex {} (counted from 0)", surface.originals[nearest]);
}

std::string open_message(const MendedSurface& surface, const RegionBoundary& boundary) {
  const Vec3 rim = surface.positions.row(surface.rims.front().a);
  std::string words = fmt::format("open surface: {} boundary edges, for example at {}",
                                  surface.defects.boundary_edges, near_vertex(surface, rim));
  if (boundary.area <= 0 || boundary.covered <= 0)
    words += "; it encloses nothing";
  else if (boundary.covered < least_covered)
    words += fmt::format("; it covers only {:.0f} % of the boundary of what it encloses",
                         100 * boundary.covered);
  if (boundary.greatest_opening > 0)
    words += fmt::format("; an opening near {} takes {:.0f} % of the boundary",
                         near_vertex(surface, boundary.opening), 100 * boundary.greatest_opening);
  if (surface.defects.turning_conflicts > 0)
    words += fmt::format("; its faces cannot all be turned one way (at {} edges)",
                         surface.defects.turning_conflicts);
  return words + "; " + advice;
}

/// True where the surface has no thickness: no plane of three of its corners leaves the others.
bool flat(const MendedSurface& surface) {
  Vec3 normal = Vec3::Zero(), corner = Vec3::Zero();
  for (Index t = 0; t < surface.triangles.rows(); ++t) {
    const Vec3 n = double_area_normal(surface.positions, surface.triangles, t);
    if (n.squaredNorm() <= normal.squaredNorm()) continue;
    normal = n;
    corner = surface.positions.row(surface.triangles(t, 0));
  }
  const double diagonal = surface.box.diagonal();
  const Eigen::VectorXd heights =
      (surface.positions.rowwise() - corner.transpose()) * normal.normalized();
  double height = 0;
  for (Index t = 0; t < surface.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      height = std::max(height, std::abs(heights[surface.triangles(t, k)]));
  return height <= 1e-9 * diagonal;
}

/// Errors: ShapeError where there is no solid.
void check_surface(const MendedSurface& surface) {
  if (surface.triangles.rows() == 0)
    throw ShapeError(zero_volume("the shape has no triangles with three different corners"));
  if (!flat(surface)) return;
  if (surface.rims.empty()) throw ShapeError(zero_volume("the surface is flat"));
  throw ShapeError("open surface of zero volume: it is flat; " + std::string(advice));
}

void check_boundary(const MendedSurface& surface, const RegionBoundary& boundary, double volume) {
  if (!surface.rims.empty() &&
      (boundary.covered < least_covered || boundary.greatest_opening > greatest_opening))
    throw ShapeError(open_message(surface, boundary));
  if (!(volume > no_volume * surface.box.diagonal() * boundary.area))
    throw ShapeError(zero_volume("the surface is closed but its parts cancel"));
}

/// Crossings at one place and in one direction count once, exits before entries.
void put_in_order(std::vector<Crossing>& crossings) {
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& x, const Crossing& y) { return x.share < y.share; });
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < crossings.size(); i = end) {
    bool out = false, in = false;
    while (end < crossings.size() && crossings[end].share <= crossings[i].share + same_place) {
      (crossings[end].outward ? out : in) = true;
      ++end;
    }
    const double share = crossings[i].share;
    const int triangle = crossings[i].triangle;
    if (out) crossings[kept++] = {share, triangle, true};
    if (in) crossings[kept++] = {share, triangle, false};
  }
  crossings.resize(kept);
}

SurfaceContact contact_of(const TriangleTree& winding, const MendedSurface& surface,
                          const std::vector<int>& parts) {
  return measure_contact(winding, surface.positions, surface.triangles, parts,
                         contact_offset * surface.box.diagonal());
}

/// Doubled faces can close a surface as well as single ones. Returns whether there were any.
bool drop_duplicates(MendedSurface& surface) {
  if (!surface.rims.empty()) return false;  // it has none
  Triangles single = without_duplicates(surface.triangles);
  const Index dropped = surface.triangles.rows() - single.rows();
  if (dropped == 0) return false;
  surface.triangles = std::move(single);
  surface.rims = boundary_edges(surface.triangles);
  surface.defects.duplicate_faces += dropped;
  return true;
}

/// The volume of each part, as if it were alone.
std::vector<double> volumes_of(const Points& positions, const Triangles& triangles,
                               const std::vector<int>& parts) {
  std::vector<Box> boxes;
  for (Index t = 0; t < triangles.rows(); ++t) {
    boxes.resize(std::max(boxes.size(), std::size_t(parts[t]) + 1));
    for (int k = 0; k < 3; ++k) boxes[parts[t]].extend(positions.row(triangles(t, k)));
  }
  std::vector<double> volumes(boxes.size(), 0);
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Vec3 center = boxes[parts[t]].center();
    const Vec3 a = positions.row(triangles(t, 0)).transpose() - center;
    volumes[parts[t]] += a.dot(double_area_normal(positions, triangles, t)) / 6;
  }
  return volumes;
}

/// From numbers of the mended surface's positions to the mesh's vertices.
CarriedBoundary carried(const MendedSurface& surface, const RegionBoundary& boundary,
                        Index vertices) {
  const auto known = static_cast<Index>(surface.originals.size());
  CarriedBoundary result;
  result.triangles = boundary.triangles.unaryExpr([&](int v) {
    return v < known ? surface.originals[v] : static_cast<int>(v - known + vertices);
  });
  result.extra = boundary.positions.bottomRows(boundary.positions.rows() - known);
  return result;
}

}  // namespace

/// Everything but `center` is relative to it.
struct MeshRegion::Parts {
  Vec3 center;
  Box box;
  SurfaceDefects defects;
  MeshCover cover;
  double volume;
  CarriedBoundary carried;
  std::vector<int> part_numbers;     ///< by triangle
  std::vector<double> part_volumes;  ///< by part
  int first_cap;                     ///< of the trimmed boundary's triangles
  TriangleTree winding;
  std::optional<TriangleTree> trimmed;  ///< the boundary, where it is not all of the triangles

  const TriangleTree& boundary() const { return trimmed ? *trimmed : winding; }
};

MeshRegion::MeshRegion(const Points& positions, const Triangles& triangles) {
  MendedSurface surface = mend(positions, triangles);
  check_surface(surface);
  TriangleTree winding(surface.positions, surface.triangles);
  std::vector<int> parts = connected_parts(surface.triangles);
  SurfaceContact contact = contact_of(winding, surface, parts);
  if (contact.within() > 0 && drop_duplicates(surface)) {
    winding = TriangleTree(surface.positions, surface.triangles);
    parts = connected_parts(surface.triangles);
    contact = contact_of(winding, surface, parts);
  }
  const RegionBoundary boundary = find_boundary(winding, surface, contact);
  const double volume = signed_volume(boundary.positions, boundary.triangles);
  check_boundary(surface, boundary, volume);

  std::vector<double> part_volumes = volumes_of(surface.positions, surface.triangles, parts);
  const MeshCover cover{static_cast<long>(part_volumes.size()), boundary.covered,
                        boundary.greatest_opening, contact};
  std::optional<TriangleTree> trimmed;
  if (!boundary.untouched) trimmed.emplace(boundary.positions, boundary.triangles);
  parts_.reset(new Parts{surface.center, surface.box, surface.defects, cover, volume,
                         carried(surface, boundary, positions.rows()), std::move(parts),
                         std::move(part_volumes),
                         static_cast<int>(boundary.triangles.rows() - boundary.caps),
                         std::move(winding), std::move(trimmed)});
}

MeshRegion::~MeshRegion() = default;
MeshRegion::MeshRegion(MeshRegion&&) noexcept = default;

double MeshRegion::signed_distance(const Vec3& x) const {
  const double distance =
      std::sqrt(parts_->boundary().closest(x - parts_->center).squared_distance);
  return contains(x) ? -distance : distance;
}

bool MeshRegion::contains(const Vec3& x) const {
  return winding_number(x) > 0.5;
}

Vec3 MeshRegion::closest_boundary_point(const Vec3& x) const {
  return parts_->boundary().closest(x - parts_->center).point + parts_->center;
}

int MeshRegion::layers(const Vec3& x) const {
  if (parts_->cover.contact.within() == 0) return 1;
  return static_cast<int>(std::max(1L, std::lround(winding_number(x))));
}

bool MeshRegion::connects(const Vec3& a, int layers_at_a, const Vec3& b) const {
  const Vec3 from = a - parts_->center, to = b - parts_->center;
  if (parts_->cover.contact.within() == 0) return !parts_->boundary().leaves(from, to);
  std::vector<Crossing> crossings;
  if (parts_->trimmed && parts_->first_cap < parts_->carried.triangles.rows()) {
    parts_->trimmed->crossings(from, to, crossings);
    for (const Crossing& crossing : crossings)
      if (crossing.triangle >= parts_->first_cap && crossing.outward) return false;
  }
  parts_->winding.crossings(from, to, crossings);
  put_in_order(crossings);
  int layers = layers_at_a;
  for (const Crossing& crossing : crossings) {
    layers += crossing.outward ? -1 : 1;
    if (layers < 1) return false;
  }
  return true;
}

double MeshRegion::clearance(const Vec3& x) const {
  const Vec3 local = x - parts_->center;
  double squared = parts_->winding.closest(local).squared_distance;
  if (parts_->trimmed)
    squared = std::min(squared, parts_->trimmed->closest(local).squared_distance);
  return std::sqrt(squared);
}

double MeshRegion::volume() const {
  return parts_->volume;
}

Box MeshRegion::bounds() const {
  return {parts_->box.lower + parts_->center, parts_->box.upper + parts_->center};
}

double MeshRegion::winding_number(const Vec3& x) const {
  return parts_->winding.winding_number(x - parts_->center);
}

const SurfaceDefects& MeshRegion::defects() const {
  return parts_->defects;
}

const MeshCover& MeshRegion::cover() const {
  return parts_->cover;
}

std::vector<MeshPart> MeshRegion::parts(const Points& points) const {
  std::vector<long> counts(parts_->part_volumes.size(), 0);
  const double far = 2 * parts_->box.diagonal();
  for (Index i = 0; i < points.rows(); ++i) {
    const Vec3 x = points.row(i).transpose() - parts_->center;
    // Through an opening a ray leaves a part unseen: the point is in it where one ray says so.
    std::set<int> about;
    for (const Vec3& way : {Vec3(0.31, 0.52, 0.79), Vec3(-0.67, 0.43, -0.61)})
      for (const int part : parts_about(parts_->winding, parts_->part_numbers, x, x + far * way))
        about.insert(part);
    for (const int part : about) ++counts[part];
  }
  std::vector<MeshPart> result;
  for (std::size_t part = 0; part < counts.size(); ++part)
    if (parts_->part_volumes[part] > 0)
      result.push_back({parts_->part_volumes[part] / parts_->volume, counts[part]});
  return result;
}

CarriedBoundary MeshRegion::boundary() const {
  CarriedBoundary boundary = parts_->carried;
  boundary.extra.rowwise() += parts_->center.transpose();
  return boundary;
}

}  // namespace supple
