#include "modeler/domain/point_neighbors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeler/domain/site_tree.h"
#include "solver/core/check.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr Index points_a_chunk = 512;

constexpr int area_neighbors = 16;

}  // namespace

PointNeighbors::PointNeighbors(const Points& positions, int count)
    : size_(positions.rows()), count_(static_cast<int>(std::min<Index>(count, size_ - 1))) {
  SUPPLE_CHECK(size_ >= 2, "a single point has no neighbours");
  indices_.resize(row(size_));
  squared_distances_.resize(row(size_));
  const SiteTree tree(positions);
  parallel_chunks(size_, points_a_chunk, [&](Index begin, Index end) {
    std::vector<Index> sites(std::size_t(count_) + 1);
    std::vector<double> squared_distances(sites.size());
    for (Index i = begin; i < end; ++i) {
      tree.nearest(positions.row(i), sites, squared_distances);
      std::size_t at = row(i);
      // Among many at one place the point itself may not be found: then the farthest is too many.
      for (std::size_t k = 0; k < sites.size() && at < row(i + 1); ++k) {
        if (sites[k] == i) continue;
        indices_[at] = static_cast<int>(sites[k]);
        squared_distances_[at++] = squared_distances[k];
      }
    }
  });
}

Eigen::VectorXd point_areas(const PointNeighbors& neighbors, const Points& positions,
                            const Points& normals) {
  SUPPLE_CHECK(normals.rows() == positions.rows(), "each point needs a normal");
  Eigen::VectorXd areas(positions.rows());
  parallel_chunks(areas.size(), points_a_chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      double sum = 0;
      int count = 0;
      for (int j : neighbors.of(i)) {
        if (normals.row(i).dot(normals.row(j)) < 0) continue;
        const Eigen::RowVector3d way = positions.row(j) - positions.row(i);
        const double height = normals.row(i).dot(way);
        sum += way.squaredNorm() - height * height;
        ++count;
      }
      areas[i] = count > 0 ? 2 * std::numbers::pi * sum / (count * (count + 1.0)) : 0.0;
    }
  });
  return areas;
}

Eigen::VectorXd point_areas(const Points& positions, const Points& normals) {
  return point_areas(PointNeighbors(positions, area_neighbors), positions, normals);
}

}  // namespace supple
