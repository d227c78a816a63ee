#pragma once

#include <cstdint>
#include <vector>

#include "solver/core/describe.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// How a leaf lies to the region: all inside; crossed by the boundary, with its centre inside or
/// outside; all outside (Guo & Qin, Fig. 3).
enum class LeafKind { interior, interior_boundary, exterior_boundary, exterior };

/// A cube of an octree that is not halved further.
struct OctreeLeaf {
  Vec3 center;
  double half_width = 0;  ///< half an edge [m]
  LeafKind kind = LeafKind::exterior;
};

struct OctreeOptions {
  double width = 0;
  int coarser_inside = 0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("width", self.width,
          {.doc = "edge of the leaves at the boundary", .unit = "m", .min = 0});
    visit("coarser_inside", self.coarser_inside,
          {.doc = "how often the edge may double away from the boundary", .min = 0, .max = 20});
  }
};

/// One-level adjusted octree about a region (Guo & Qin, section 4.1): its leaves tile a cube,
/// the fewest across the region's box and evenly about its middle, and leaves with a face or an
/// edge in common differ by one level at most. Leaves at the boundary are all of one width; outside
/// they are as wide as that allows.
class Octree {
 public:
  /// Errors: ShapeError where `options.width` would take too many leaves.
  Octree(const Region& region, const OctreeOptions& options);

  /// Edge of the leaves at the boundary [m].
  double width() const { return width_; }

  /// In Morton order.
  const std::vector<OctreeLeaf>& leaves() const { return leaves_; }

  /// The leaf that holds x [m]; −1 outside the root cube.
  Index leaf_at(const Vec3& x) const;

 private:
  using Key = std::uint64_t;  ///< Morton number of a cell among those of its level

  std::vector<std::vector<Key>> cells_to_split(const Region& region, int coarser_inside) const;
  void keep_leaves(const std::vector<std::vector<Key>>& split);
  void classify(const Region& region);

  Vec3 lower_ = Vec3::Zero();  ///< corner of the root cube [m]
  double width_ = 0;           ///< of the finest leaves [m]
  int levels_ = 0;             ///< below the root
  std::vector<OctreeLeaf> leaves_;
  std::vector<Key> starts_;  ///< of each leaf, among the cells of the finest level
};

}  // namespace supple
