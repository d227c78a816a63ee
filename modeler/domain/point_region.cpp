#include "modeler/domain/point_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "modeler/domain/partition_of_unity.h"
#include "modeler/domain/point_cleaning.h"
#include "modeler/domain/point_neighbors.h"
#include "modeler/domain/point_normals.h"
#include "modeler/domain/point_orientation.h"
#include "modeler/domain/point_smoothing.h"
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
constexpr int noisy_neighbors = 40;  // a cloud that takes so many is smoothed

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

/// Points with what is known of them.
struct OrientedPoints {
  Points positions, normals;
  Eigen::VectorXd areas;
};

OrientedPoints rows(const OrientedPoints& points, const std::vector<int>& chosen) {
  return {points.positions(chosen, Eigen::all), points.normals(chosen, Eigen::all), {}};
}

bool has_normal(const Points& normals, Index i) {
  const double length = normals.row(i).norm();
  return length > 0 && std::isfinite(length);
}

/// Gives normals unit length; returns the points that have one.
std::vector<int> points_with_normals(Points& normals) {
  std::vector<int> chosen;
  for (Index i = 0; i < normals.rows(); ++i) {
    if (!has_normal(normals, i)) continue;
    normals.row(i).normalize();
    chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

/// Three times the volume that the points' discs enclose.
double flux(const OrientedPoints& points) {
  const Eigen::RowVector3d middle = points.positions.colwise().mean();
  const Points ways = points.positions.rowwise() - middle;
  return ways.cwiseProduct(points.normals).rowwise().sum().dot(points.areas);
}

/// Points with normals of their own, turned where they contradict the others.
OrientedPoints take_normals(PointCloudReading& reading, const Points& positions,
                            const Points& normals) {
  OrientedPoints points{positions(reading.kept, Eigen::all), normals(reading.kept, Eigen::all), {}};
  const std::vector<int> chosen = points_with_normals(points.normals);
  if (reading.without_normal > 0) {
    points = rows(points, chosen);
    std::vector<int> kept;
    for (int i : chosen) kept.push_back(reading.kept[i]);
    reading.kept = std::move(kept);
  }
  require_enough(reading.kept.size(), positions.rows());
  const PointNeighbors neighbors(points.positions, area_neighbors);
  reading.odd_normals = turn_odd_normals(points.positions, neighbors, points.normals);
  points.areas = point_areas(neighbors, points.positions, points.normals);
  reading.turned = flux(points) < 0;
  if (reading.turned) points.normals *= -1;
  reading.normals = points.normals;
  reading.areas = points.areas;
  return points;
}

/// For each point the row of `normals` that belongs to the nearest of `places`.
Points nearest_normals(const OrientedPoints& places, const Points& positions) {
  const SiteTree tree(places.positions);
  Points normals(positions.rows(), 3);
  parallel_chunks(positions.rows(), 512, [&](Index begin, Index end) {
    Index site;
    double squared_distance;
    for (Index i = begin; i < end; ++i) {
      tree.nearest(positions.row(i), {&site, 1}, {&squared_distance, 1});
      normals.row(i) = places.normals.row(site);
    }
  });
  return normals;
}

/// Points with estimated normals; of a noisy cloud those of a smooth one.
OrientedPoints guess_normals(PointCloudReading& reading, const Points& positions) {
  reading.normals_estimated = true;
  const Points kept = positions(reading.kept, Eigen::all);
  const int neighbors = flat_neighbors(kept);
  OrientedPoints points;
  points.positions = neighbors < noisy_neighbors ? kept : smooth_points(kept, neighbors);
  points.normals = estimate_normals(points.positions).normals;
  const std::vector<int> chosen = points_with_normals(points.normals);
  points = rows(points, chosen);
  require_enough(chosen.size(), positions.rows());
  points.areas = point_areas(points.positions, points.normals);
  reading.normals = nearest_normals(points, kept);
  reading.areas = point_areas(kept, reading.normals);
  return points;
}

/// What the cloud says, and the points that make the surface.
std::pair<PointCloudReading, OrientedPoints> read_points(const Points& positions,
                                                         const Points& normals) {
  require_enough(static_cast<std::size_t>(positions.rows()), positions.rows());
  CleanPoints clean = clean_points(positions);
  require_enough(clean.kept.size(), positions.rows());
  require_thickness(positions(clean.kept, Eigen::all));
  PointCloudReading reading;
  reading.kept = std::move(clean.kept);
  reading.duplicates = clean.duplicates;
  reading.outliers = clean.outliers;
  for (const int i : reading.kept)
    if (normals.rows() > 0 && !has_normal(normals, i)) ++reading.without_normal;
  const bool most_have_normals =
      normals.rows() > 0 && 2 * reading.without_normal < static_cast<long>(reading.kept.size());
  OrientedPoints points = most_have_normals ? take_normals(reading, positions, normals)
                                            : guess_normals(reading, positions);
  return {std::move(reading), std::move(points)};
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

std::vector<std::string> PointCloudReading::notes() const {
  std::vector<std::string> notes;
  if (duplicates > 0)
    notes.push_back(fmt::format("{} points lie at the place of another: left out", duplicates));
  if (outliers > 0)
    notes.push_back(fmt::format("{} points lie alone, off the surface: left out", outliers));
  if (normals_estimated)
    notes.push_back(
        fmt::format("{} points have no normals: estimated, and their orientation guessed",
                    without_normal > 0 ? "most" : "the"));
  else if (without_normal > 0)
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
