#include "modeler/domain/point_reading.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include <fmt/format.h>

#include "modeler/domain/point_cleaning.h"
#include "modeler/domain/point_neighbors.h"
#include "modeler/domain/point_normals.h"
#include "modeler/domain/point_orientation.h"
#include "modeler/domain/point_smoothing.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr std::size_t least_points = 20;
constexpr double flat = 1e-6;  // greatest thickness over the length
constexpr int area_neighbors = 16;
constexpr int noisy_neighbors = 40;  // a cloud that takes so many is smoothed

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

}  // namespace

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
    notes.push_back(fmt::format(
        "the points cover {:.0f} % of the boundary; the rest is closed by guess", 100 * covered));
  return notes;
}

}  // namespace supple
