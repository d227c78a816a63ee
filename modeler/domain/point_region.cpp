#include "modeler/domain/point_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "modeler/domain/partition_of_unity.h"
#include "modeler/domain/point_cleaning.h"
#include "modeler/domain/point_neighbors.h"
#include "modeler/domain/point_normals.h"
#include "modeler/domain/point_orientation.h"
#include "modeler/domain/principal_axes.h"
#include "modeler/domain/region_cover.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/site_tree.h"
#include "modeler/domain/surface_measures.h"
#include "modeler/domain/triangle_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr std::size_t least_points = 20;
constexpr double flat = 1e-6;  // greatest thickness over the length
constexpr int area_neighbors = 16;

constexpr double cell_over_spacing = 1.2;
constexpr double widest_cell = 1.0 / 80, narrowest_cell = 1.0 / 256;

/// Blending weight from which on the partition of unity alone counts.
constexpr double full_weight = 0.1;

/// Distance in cells up to which it alone counts, and from which on it no longer does.
constexpr double near_boundary = 0.5, far_from_boundary = 1.5;

constexpr double reach_over_spacing = 2;  // of a point that covers the boundary
constexpr double least_cover = 0.6, greatest_opening = 0.3;

/// 0 up to 0, 1 from 1 on, C¹.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::string percent(double share) {
  return fmt::format("{:.0f} %", 100 * share);
}

void require_enough(std::size_t count, Index given) {
  if (count >= least_points) return;
  throw ShapeError(fmt::format(
      "too few points: {} at different places of {}; the surface of a solid takes {} at the least, "
      "better some thousands",
      count, given, least_points));
}

void require_thickness(const Points& positions) {
  const Points centered = positions.rowwise() - positions.colwise().mean();
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.compute(centered.transpose() * centered);
  const Vec3 spread = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (spread[0] > flat * spread[2]) return;
  throw ShapeError(fmt::format("the points are flat: they lie in one {}, which encloses no volume",
                               spread[1] > flat * spread[2] ? "plane" : "line"));
}

/// Chosen rows of both.
void keep(const std::vector<int>& chosen, std::vector<int>& kept, Points& normals) {
  std::vector<int> rest;
  for (int i : chosen) rest.push_back(kept[i]);
  kept = std::move(rest);
  normals = Points(normals(chosen, Eigen::all));
}

/// Leaves out points without a normal and gives the others unit length.
void keep_with_normals(PointCloudReading& reading) {
  std::vector<int> chosen;
  for (Index i = 0; i < reading.normals.rows(); ++i) {
    const double length = reading.normals.row(i).norm();
    if (!(length > 0) || !std::isfinite(length)) continue;
    reading.normals.row(i) /= length;
    chosen.push_back(static_cast<int>(i));
  }
  reading.without_normal = reading.normals.rows() - static_cast<long>(chosen.size());
  if (reading.without_normal > 0) keep(chosen, reading.kept, reading.normals);
}

/// Three times the volume that the points' discs enclose.
double flux(const Points& positions, const PointCloudReading& reading) {
  const Eigen::RowVector3d middle = positions.colwise().mean();
  return ((positions.rowwise() - middle).cwiseProduct(reading.normals).rowwise().sum().array() *
          reading.areas.array())
      .sum();
}

PointCloudReading read_points(const Points& positions, const Points& normals) {
  PointCloudReading reading;
  require_enough(static_cast<std::size_t>(positions.rows()), positions.rows());
  CleanPoints clean = clean_points(positions);
  require_enough(clean.kept.size(), positions.rows());
  reading.kept = std::move(clean.kept);
  reading.duplicates = clean.duplicates;
  reading.outliers = clean.outliers;
  require_thickness(positions(reading.kept, Eigen::all));

  reading.normals_estimated = normals.rows() == 0;
  reading.normals = reading.normals_estimated
                        ? estimate_normals(positions(reading.kept, Eigen::all)).normals
                        : Points(normals(reading.kept, Eigen::all));
  keep_with_normals(reading);
  require_enough(reading.kept.size(), positions.rows());

  const Points kept = positions(reading.kept, Eigen::all);
  const PointNeighbors neighbors(kept, area_neighbors);
  if (!reading.normals_estimated)
    reading.odd_normals = turn_odd_normals(kept, neighbors, reading.normals);
  reading.areas = point_areas(neighbors, kept, reading.normals);
  reading.turned = flux(kept, reading) < 0;
  if (reading.turned) reading.normals *= -1;
  return reading;
}

/// A triangle for each point, with the point's area and normal.
TriangleTree disc_tree(const Points& positions, const PointCloudReading& reading) {
  const Index count = positions.rows();
  Points corners(3 * count, 3);
  Triangles triangles(count, 3);
  for (Index i = 0; i < count; ++i) {
    const Vec3 normal = reading.normals.row(i);
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const double radius = std::sqrt(4 / (3 * std::sqrt(3.0)) * reading.areas[i]);
    const Vec3 x = positions.row(i), half = std::sqrt(0.75) * radius * v;
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
  PointField(const Points& positions, const PointCloudReading& reading)
      : partition_(positions, reading.normals, options(positions, reading)),
        discs_(disc_tree(positions, reading)),
        spacing_(std::sqrt(reading.areas.mean())) {}

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
  static PartitionOptions options(const Points& positions, const PointCloudReading& reading) {
    PartitionOptions options;
    options.neighbors = flat_neighbors(positions, reading.normals);
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
std::vector<bool> covered_vertices(const PointField& field, const Points& positions,
                                   const PointCloudReading& reading, const Points& vertices) {
  const SiteTree tree(positions);
  std::vector<char> covered(static_cast<std::size_t>(vertices.rows()), 0);
  parallel_chunks(vertices.rows(), 256, [&](Index begin, Index end) {
    Index site;
    double squared_distance;
    for (Index i = begin; i < end; ++i) {
      const PartitionOfUnity::Value near = field.partition().at(vertices.row(i));
      if (near.weight < full_weight) continue;
      tree.nearest(vertices.row(i), {&site, 1}, {&squared_distance, 1});
      const double reach2 = std::pow(reach_over_spacing, 2) * reading.areas[site] +
                            std::pow(reading.noise * reach_over_spacing, 2);
      covered[i] = squared_distance <= reach2 && near.gradient.dot(reading.normals.row(site)) > 0;
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

std::vector<std::string> PointCloudReading::notes() const {
  std::vector<std::string> notes;
  if (duplicates > 0)
    notes.push_back(fmt::format("{} points lie at the place of another: left out", duplicates));
  if (outliers > 0)
    notes.push_back(fmt::format("{} points lie alone, off the surface: left out", outliers));
  if (normals_estimated)
    notes.push_back("the points have no normals: estimated, and their orientation guessed");
  if (without_normal > 0)
    notes.push_back(
        fmt::format("{} points without a normal do not count for the surface", without_normal));
  if (odd_normals > 0)
    notes.push_back(
        fmt::format("{} normals look against those about them; read as if turned", odd_normals));
  if (turned) notes.push_back("the normals point inwards; read as if they pointed outwards");
  if (covered < 0.995)
    notes.push_back(fmt::format("the points cover {} of the boundary; the rest is closed by guess",
                                percent(covered)));
  return notes;
}

struct PointRegion::Parts {
  Parts(const Points& kept, PointCloudReading points)
      : reading(std::move(points)),
        field(kept, reading),
        boundary(boundary_of(field, kept)),
        tree(boundary.positions, boundary.triangles),
        box(bounding_box(boundary.positions)) {
    reading.noise = field.partition().noise();
    const RegionCover cover =
        measure_cover(boundary.positions, boundary.triangles,
                      covered_vertices(field, kept, reading, boundary.positions));
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
  PointCloudReading reading = read_points(positions, normals);
  const Points kept = positions(reading.kept, Eigen::all);
  parts_ = std::make_unique<const Parts>(kept, std::move(reading));
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

bool PointRegion::connects(const Vec3& a, const Vec3& b) const {
  std::vector<Crossing> crossings;
  parts_->tree.crossings(a, b, crossings);
  return crossings.empty();
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
