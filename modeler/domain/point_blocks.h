#pragma once

#include <functional>
#include <vector>

#include "solver/core/types.h"

namespace supple {

class SiteTree;

/// Many fixed points in runs that lie close together, so that questions about all of them skip
/// most. Quick where neighbours in space are close in order.
class PointBlocks {
 public:
  explicit PointBlocks(const Points& points);

  const Points& points() const { return points_; }

  /// The site nearest to each point and the distance squared [m²].
  struct Nearest {
    std::vector<int> sites;
    Eigen::VectorXd squared_distances;
  };
  Nearest nearest_sites(const Points& sites) const;

  /// Adds the point farthest from all `sites`, again and again, while `more(sites so far,
  /// distance of that point [m])`. Without sites it begins with the point nearest to `start`.
  using Continue = std::function<bool(Index sites, double distance)>;
  Points farthest_points(const Points& sites, const Vec3& start, const Continue& more) const;

 private:
  struct Block {
    Index first, count;
    Vec3 center;
    double radius;
  };
  class Farthest;

  void nearest_in_block(const Block& block, const Points& sites, const SiteTree& tree,
                        Nearest& nearest) const;

  Points points_;
  std::vector<Block> blocks_;
};

}  // namespace supple
