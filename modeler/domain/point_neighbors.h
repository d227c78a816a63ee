#pragma once

#include <span>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// The nearest other points of each point of a cloud, nearest first.
class PointNeighbors {
 public:
  /// `positions` [m] n×3, n ≥ 2; `count` of them for each point, fewer where there are fewer.
  PointNeighbors(const Points& positions, int count);

  Index size() const { return size_; }
  int count() const { return count_; }  ///< for each point

  std::span<const int> of(Index i) const { return {&indices_[row(i)], std::size_t(count_)}; }
  std::span<const double> squared_distances(Index i) const {
    return {&squared_distances_[row(i)], std::size_t(count_)};  // [m²]
  }

 private:
  std::size_t row(Index i) const { return static_cast<std::size_t>(i * count_); }

  Index size_;
  int count_;
  std::vector<int> indices_;
  std::vector<double> squared_distances_;
};

/// Area that each point stands for [m²], by the density of its k nearest neighbours within its
/// tangent plane: 2π Σ ρ² / (k (k + 1)), ρ a neighbour's distance in the plane. Neighbours whose
/// normals look the other way lie on the other side of a thin part and do not count.
/// `normals` n×3, unit length.
Eigen::VectorXd point_areas(const PointNeighbors& neighbors, const Points& positions,
                            const Points& normals);
Eigen::VectorXd point_areas(const Points& positions, const Points& normals);

}  // namespace supple
