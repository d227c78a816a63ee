#include "modeler/domain/point_normals.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "modeler/domain/point_neighbors.h"
#include "modeler/domain/point_orientation.h"
#include "modeler/domain/principal_axes.h"
#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr std::array neighbor_counts = {12, 18, 27, 40, 60, 90, 135};
constexpr Index asked_points = 200;
constexpr double nearly = 1.1;  // times the least share of the spread off the plane
constexpr int tree_neighbors = 16;
constexpr double least_part = 0.005;  // of the points
constexpr Index least_points = 12;

/// By `count` neighbours each.
Points plane_normals(const Points& positions, const PointNeighbors& neighbors, int count) {
  Points normals(positions.rows(), 3);
  const auto used = static_cast<std::size_t>(std::min(count, neighbors.count()));
  parallel_chunks(positions.rows(), 512, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      normals.row(i) =
          principal_axes(positions, i, neighbors.of(i).first(used)).axes.col(0).transpose();
  });
  return normals;
}

/// What a part of the cloud encloses, up to a factor; about the part's own middle.
struct PartMoments {
  Index points = 0;
  double area = 0, flux = 0;
  Eigen::RowVector3d area_position = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d area_normal = Eigen::RowVector3d::Zero();

  bool inwards() const { return flux < area_normal.dot(area_position) / std::max(area, 1e-300); }
};

/// Turns each part outwards; normals of parts of a few points become zero. Returns how many are
/// left.
int turn_parts(const Points& positions, const PointNeighbors& neighbors,
               const std::vector<int>& parts, Points& normals) {
  const Eigen::VectorXd areas = point_areas(neighbors, positions, normals);
  std::vector<PartMoments> moments;
  for (Index i = 0; i < positions.rows(); ++i) {
    moments.resize(std::max(moments.size(), std::size_t(parts[i]) + 1));
    PartMoments& part = moments[parts[i]];
    ++part.points;
    part.area += areas[i];
    part.area_position += areas[i] * positions.row(i);
    part.area_normal += areas[i] * normals.row(i);
    part.flux += areas[i] * normals.row(i).dot(positions.row(i));
  }
  const auto least = std::max(least_points, Index(least_part * double(positions.rows())));
  for (Index i = 0; i < positions.rows(); ++i) {
    const PartMoments& part = moments[parts[i]];
    if (part.points < least)
      normals.row(i).setZero();
    else if (part.inwards())
      normals.row(i) *= -1;
  }
  return static_cast<int>(std::count_if(moments.begin(), moments.end(),
                                        [&](const auto& part) { return part.points >= least; }));
}

}  // namespace

int flat_neighbors(const Points& positions, const Points& normals) {
  const SiteTree tree(positions);
  const Index step = std::max<Index>(1, positions.rows() / asked_points);
  std::array<double, neighbor_counts.size()> off_plane{};
  std::vector<Index> sites(neighbor_counts.back());
  std::vector<double> squared_distances(sites.size());
  std::vector<int> others;
  for (Index i = 0; i < positions.rows(); i += step) {
    const int found = tree.nearest(positions.row(i), sites, squared_distances);
    others.clear();
    for (int k = 0; k < found; ++k)
      if (normals.rows() == 0 || normals.row(i).dot(normals.row(sites[k])) > 0)
        others.push_back(static_cast<int>(sites[k]));
    for (std::size_t c = 0; c < neighbor_counts.size(); ++c) {
      const auto count = std::min(others.size(), static_cast<std::size_t>(neighbor_counts[c]));
      off_plane[c] += principal_axes(positions, i, std::span(others).first(count)).off_plane();
    }
  }
  const double least = *std::min_element(off_plane.begin(), off_plane.end());
  const auto first = std::find_if(off_plane.begin(), off_plane.end(),
                                  [&](double share) { return share <= nearly * least; });
  return neighbor_counts[static_cast<std::size_t>(first - off_plane.begin())];
}

PointNormals estimate_normals(const Points& positions) {
  PointNormals result;
  result.neighbors = flat_neighbors(positions);
  const PointNeighbors neighbors(positions, std::max(result.neighbors, tree_neighbors));
  result.normals = plane_normals(positions, neighbors, result.neighbors);
  const std::vector<int> parts = orient_normals(positions, neighbors, result.normals);
  result.parts = turn_parts(positions, neighbors, parts, result.normals);
  for (Index i = 0; i < positions.rows(); ++i)
    if (result.normals.row(i).isZero()) ++result.unoriented;
  return result;
}

}  // namespace supple
