#include "modeler/domain/point_normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "modeler/domain/point_neighbors.h"
#include "modeler/domain/point_orientation.h"
#include "modeler/domain/principal_axes.h"
#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr std::array neighbor_counts = {12, 18, 27, 40, 60, 90, 135, 200, 300, 450};
constexpr Index asked_points = 200;
constexpr int tree_neighbors = 12;
constexpr int most_parts = 32;
constexpr double least_part = 0.005;  // of the points
constexpr Index least_points = 12;

Points plane_normals(const Points& positions, const PointNeighbors& neighbors) {
  Points normals(positions.rows(), 3);
  parallel_chunks(positions.rows(), 512, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i)
      normals.row(i) = principal_axes(positions, i, neighbors.of(i)).axes.col(0).transpose();
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

}  // namespace

int flattest_neighbors(const Points& positions, const Points& normals) {
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
  const auto least = std::min_element(off_plane.begin(), off_plane.end());
  return neighbor_counts[static_cast<std::size_t>(least - off_plane.begin())];
}

PointNormals estimate_normals(const Points& positions) {
  PointNormals result;
  result.neighbors = flattest_neighbors(positions);
  const PointNeighbors neighbors(positions, result.neighbors);
  Points& normals = result.normals = plane_normals(positions, neighbors);
  const std::vector<int> parts = orient_normals(positions, tree_neighbors, most_parts, normals);

  const Eigen::VectorXd areas = point_areas(neighbors, positions, normals);
  std::vector<PartMoments> moments(most_parts);
  for (Index i = 0; i < positions.rows(); ++i) {
    if (parts[i] < 0) continue;
    PartMoments& part = moments[parts[i]];
    ++part.points;
    part.area += areas[i];
    part.area_position += areas[i] * positions.row(i);
    part.area_normal += areas[i] * normals.row(i);
    part.flux += areas[i] * normals.row(i).dot(positions.row(i));
  }
  const auto least = std::max(least_points, Index(least_part * double(positions.rows())));
  result.parts = static_cast<int>(std::count_if(
      moments.begin(), moments.end(), [&](const PartMoments& m) { return m.points >= least; }));
  for (Index i = 0; i < positions.rows(); ++i) {
    if (parts[i] < 0 || moments[parts[i]].points < least) {
      normals.row(i).setZero();
      ++result.unoriented;
    } else if (moments[parts[i]].inwards()) {
      normals.row(i) *= -1;
    }
  }
  return result;
}

}  // namespace supple
