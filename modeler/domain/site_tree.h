#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Nearest neighbours among points. Queries have no state, so any number of threads may ask.
class SiteTree {
 public:
  /// `sites` [m] n×3, n ≥ 1; must outlive the tree.
  explicit SiteTree(const Points& sites);
  ~SiteTree();

  /// Distance to the nearest site [m].
  double distance(const Vec3& x) const;

  /// The sites nearest to x, nearest first, into `sites`, and their squared distances [m²] into
  /// `squared_distances`, which is as long. Returns how many: all where there are fewer.
  int nearest(const Vec3& x, std::span<Index> sites, std::span<double> squared_distances) const;

  /// Sites no farther than `radius` [m] from x.
  std::vector<int> within(const Vec3& x, double radius) const;

  /// Smallest distance of two sites [m] and the two; infinity and −1 where there is one.
  struct Pair {
    double distance;
    int a, b;
  };
  Pair closest_pair() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace supple
