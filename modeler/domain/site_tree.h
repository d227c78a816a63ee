#pragma once

#include <memory>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Nearest neighbours among a few thousand points.
class SiteTree {
 public:
  /// `sites` [m] n×3, n ≥ 1; must outlive the tree.
  explicit SiteTree(const Points& sites);
  ~SiteTree();

  /// Distance to the nearest site [m].
  double distance(const Vec3& x) const;

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
