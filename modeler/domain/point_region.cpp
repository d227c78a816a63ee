#include "modeler/domain/point_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "modeler/domain/partition_of_unity.h"
#include "modeler/domain/point_normals.h"
#include "modeler/domain/region_cover.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/site_tree.h"
#include "modeler/domain/surface_measures.h"
#include "modeler/domain/triangle_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr double cell_over_spacing = 1.2;
constexpr double widest_cell = 1.0 / 80, narrowest_cell = 1.0 / 256;

/// Blending weight from which on the partition of unity alone counts.
constexpr double full_weight = 0.1;

/// Distance in cells up to which it alone counts, and from which on it no longer does.
constexpr double near_boundary = 0.5, far_from_boundary = 1.5;

/// Depth in cells from which on a way between two crossings of the boundary lies outside.
constexpr double outside_over_cell = 0.2;

constexpr double reach_over_spacing = 2;  // of a point that covers the boundary
constexpr double least_cover = 0.6;
/// Less than of a mesh: the points at its rim reach into an opening.
constexpr double greatest_opening = 0.25;

/// 0 up to 0, 1 from 1 on, C¹.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::string percent(double share) {
  return fmt::format("{:.0f} %", 100 * share);
}

/// A triangle for each point, with the point's area and normal.
TriangleTree disc_tree(const OrientedPoints& points) {
  const Index count = points.positions.rows();
  Points corners(3 * count, 3);
  Triangles triangles(count, 3);
  for (Index i = 0; i < count; ++i) {
    const Vec3 normal = points.normals.row(i);
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const double radius = std::sqrt(4 / (3 * std::sqrt(3.0)) * points.areas[i]);
    const Vec3 x = points.positions.row(i), half = std::sqrt(0.75) * radius * v;
    corners.row(3 * i) = (x + radius * u).transpose();
    corners.row(3 * i + 1) = (x - 0.5 * radius * u + half).transpose();
    corners.row(3 * i + 2) = (x - 0.5 * radius * u - half).transpose();
    triangles.row(i) << int(3 * i), int(3 * i + 1), int(3 * i + 2);
  }
  return TriangleTree(corners, triangles);
}

/// The function whose zero set is the boundary.
class PointField {
 public:
  explicit PointField(const OrientedPoints& points)
      : partition_(points.positions, points.normals, options(points)),
        discs_(disc_tree(points)),
        spacing_(std::sqrt(points.areas.mean())) {}

  const PartitionOfUnity& partition() const { return partition_; }
  double spacing() const { return spacing_; }
  double cell() const {
    return std::clamp(cell_over_spacing * spacing_, narrowest_cell, widest_cell);
  }

  /// Negative inside; about a distance near points, only its sign counts elsewhere.
  double value(const Vec3& x) const {
    const PartitionOfUnity::Value near = partition_.at(x);
    if (near.weight >= full_weight) return near.f;
    const double share = smooth_step(near.weight / full_weight);
    return share * near.f + (1 - share) * cell() * (0.5 - discs_.winding_number(x));
  }

  /// Towards the zero set, no farther than half a cell; unchanged where no points are near.
  Vec3 project(Vec3 x) const {
    double left = 0.5 * cell();
    for (int step = 0; step < 3; ++step) {
      const PartitionOfUnity::Value near = partition_.at(x);
      const double slope2 = near.gradient.squaredNorm();
      if (near.weight < full_weight || slope2 < 0.01 || std::abs(near.f) < 1e-12) break;
      const Vec3 way = -near.f / slope2 * near.gradient;
      if (way.norm() > left) break;
      left -= way.norm();
      x += way;
    }
    return x;
  }

 private:
  static PartitionOptions options(const OrientedPoints& points) {
    PartitionOptions options;
    options.neighbors = flat_neighbors(points.positions, points.normals);
    return options;
  }

  PartitionOfUnity partition_;
  TriangleTree discs_;
  double spacing_;
};

Polygons boundary_of(const PointField& field, const Points& positions) {
  PolygonizeOptions options;
  options.box = bounding_box(positions);
  options.width = field.cell();
  const auto f = [&](const Vec3& x) { return field.value(x); };
  Polygons boundary = polygonize(f, positions, options);
  parallel_chunks(boundary.positions.rows(), 256, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      boundary.positions.row(i) = field.project(boundary.positions.row(i)).transpose();
  });
  return boundary;
}

/// For each vertex of the boundary: a point lies near that looks the same way.
std::vector<bool> covered_vertices(const PointField& field, const OrientedPoints& points,
                                   const Points& vertices) {
  const SiteTree tree(points.positions);
  const double noise2 = std::pow(field.partition().noise(), 2);
  std::vector<char> covered(static_cast<std::size_t>(vertices.rows()), 0);
  parallel_chunks(vertices.rows(), 256, [&](Index begin, Index end) {
    Index site;
    double squared_distance;
    for (Index i = begin; i < end; ++i) {
      const PartitionOfUnity::Value near = field.partition().at(vertices.row(i));
      if (near.weight < full_weight) continue;
      tree.nearest(vertices.row(i), {&site, 1}, {&squared_distance, 1});
      const double reach2 = std::pow(reach_over_spacing, 2) * (points.areas[site] + noise2);
      covered[i] = squared_distance <= reach2 && near.gradient.dot(points.normals.row(site)) > 0;
    }
  });
  return {covered.begin(), covered.end()};
}

void require_closed(const RegionCover& cover, bool normals_estimated) {
  if (cover.covered >= least_cover && cover.greatest_opening <= greatest_opening) return;
  const std::string what =
      cover.covered < least_cover
          ? fmt::format("the points cover {} of the boundary of what they could enclose",
                        percent(cover.covered))
          : fmt::format("one opening makes {} of the boundary", percent(cover.greatest_opening));
  throw ShapeError(fmt::format(
      "open surface: {}; a solid needs points all around it: scan it from all sides, close its "
      "bottom and back in a mesh editor{}",
      what,
      normals_estimated ? ", or give the points normals if the guess of their side is wrong" : ""));
}

}  // namespace

struct PointRegion::Parts {
  Parts(PointCloudReading cloud, const OrientedPoints& points)
      : reading(std::move(cloud)),
        field(points),
        boundary(boundary_of(field, points.positions)),
        tree(boundary.positions, boundary.triangles),
        box(bounding_box(boundary.positions)) {
    const RegionCover cover = measure_cover(boundary.positions, boundary.triangles,
                                            covered_vertices(field, points, boundary.positions));
    reading.covered = cover.covered;
    require_closed(cover, reading.normals_estimated);
    volume = signed_volume(boundary.positions, boundary.triangles);
    if (!(volume > 0)) throw ShapeError("the points enclose no volume");
  }

  PointCloudReading reading;
  PointField field;
  Polygons boundary;
  TriangleTree tree;
  Box box;
  double volume;

  /// Share of the partition of unity in the signed distance at a place.
  double share(const PartitionOfUnity::Value& near, double distance) const {
    return smooth_step(near.weight / full_weight) *
           (1 - smooth_step((distance / field.cell() - near_boundary) /
                            (far_from_boundary - near_boundary)));
  }

  double signed_distance(const Vec3& x) const {
    const double distance = std::sqrt(tree.closest(x).squared_distance);
    PartitionOfUnity::Value near;
    if (distance < far_from_boundary * field.cell()) near = field.partition().at(x);
    const double near_share = share(near, distance);
    if (near_share >= 1) return near.f;
    const double sign = tree.winding_number(x) > 0.5 ? -1 : 1;
    return near_share * near.f + (1 - near_share) * sign * distance;
  }
};

PointRegion::PointRegion(const Points& positions, const Points& normals) {
  auto [reading, points] = read_points(positions, normals);
  parts_ = std::make_unique<const Parts>(std::move(reading), points);
}

PointRegion::~PointRegion() = default;

double PointRegion::signed_distance(const Vec3& x) const {
  return parts_->signed_distance(x);
}

Vec3 PointRegion::gradient(const Vec3& x) const {
  const double distance = std::sqrt(parts_->tree.closest(x).squared_distance);
  const PartitionOfUnity::Value near = parts_->field.partition().at(x);
  if (parts_->share(near, distance) >= 1) return near.gradient;
  const double step = 1e-3 * parts_->field.cell();
  Vec3 slope;
  for (int axis = 0; axis < 3; ++axis)
    slope[axis] = (signed_distance(x + step * Vec3::Unit(axis)) -
                   signed_distance(x - step * Vec3::Unit(axis))) /
                  (2 * step);
  return slope;
}

bool PointRegion::contains(const Vec3& x) const {
  return signed_distance(x) < 0;
}

Vec3 PointRegion::closest_boundary_point(const Vec3& x) const {
  return parts_->field.project(parts_->tree.closest(x).point);
}

bool PointRegion::connects(const Vec3& a, int, const Vec3& b) const {
  std::vector<Crossing> crossings;
  parts_->tree.crossings(a, b, crossings);
  if (crossings.empty()) return true;
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& x, const Crossing& y) { return x.share < y.share; });
  // The triangles only stand for the boundary: ways along it cross them without leaving.
  const double out = outside_over_cell * parts_->field.cell();
  const auto leaves_between = [&](double begin, double end) {
    return parts_->tree.closest(a + 0.5 * (begin + end) * (b - a), out).triangle < 0;
  };
  double exit = 0;  // of the stretch outside that the next entry ends
  for (const Crossing& crossing : crossings) {
    if (crossing.outward)
      exit = crossing.share;
    else if (leaves_between(exit, crossing.share))
      return false;
  }
  return !crossings.back().outward || !leaves_between(exit, 1);
}

double PointRegion::clearance(const Vec3& x) const {
  return std::sqrt(parts_->tree.closest(x).squared_distance);
}

double PointRegion::volume() const {
  return parts_->volume;
}

Box PointRegion::bounds() const {
  return parts_->box;
}

const PointCloudReading& PointRegion::reading() const {
  return parts_->reading;
}

const Polygons& PointRegion::boundary() const {
  return parts_->boundary;
}

}  // namespace supple
