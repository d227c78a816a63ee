#include "modeler/domain/leaf_parts.h"

#include <algorithm>
#include <array>

#include "modeler/domain/cut_cube.h"
#include "modeler/domain/region_cell.h"

namespace supple {

namespace {

using Halves = std::array<RegionCell, 8>;

/// Halvings beyond what was asked for, where a plane does not fit.
constexpr int more_halvings = 1;

/// A cut fits where its centroid is no less deep inside than this share of what the plane says,
constexpr double least_depth = 0.7;
/// or misses that by less than this share of the cell.
constexpr double no_depth = 0.02;

/// By how much the boundary lies below its tangent plane [m], on the mean over one half's edge a.
/// d at the halves' centres exceeds d at the middle by (a²/8) Δd on the mean.
double mean_bend(const RegionCell& cell, const Halves& parts) {
  double sum = 0;
  for (const RegionCell& part : parts) sum += part.signed_distance() - cell.signed_distance();
  return sum / 8 / 3;
}

class PartCutter {
 public:
  PartCutter(const Region& region, std::vector<LeafPart>& parts) : region_(region), parts_(parts) {}

  void add(const RegionCell& cell, int halvings) {
    if (!cell.touches_region()) return;
    if (cell.inner) {
      parts_.push_back({cell.center, cell.volume()});
      return;
    }
    const Halves parts = halves(region_, cell);
    const double bend = mean_bend(cell, parts);
    for (const RegionCell& part : parts) {
      if (halvings > 1 || part.inner)
        add(part, halvings - 1);
      else if (part.touches_region())
        add_cut(part, bend, more_halvings);
    }
  }

 private:
  void add_cut(const RegionCell& cell, double bend, int halvings) {
    const double offset = -cell.signed_distance() - bend;
    const CutVolume cut = cut_cube(cell.outward(), offset, cell.half_width);
    if (!(cut.volume > 0)) return;
    const double depth = offset - cell.outward().dot(cut.centroid);
    const LeafPart part{cell.center + cut.centroid, cut.volume};
    if (fits(cell, part.centroid, depth))
      parts_.push_back(part);
    else if (halvings > 0)
      for (const RegionCell& half : halves(region_, cell)) add_half(half, halvings - 1);
    else
      add_slab(cell, offset);
  }

  void add_half(const RegionCell& cell, int halvings) {
    if (cell.inner)
      parts_.push_back({cell.center, cell.volume()});
    else if (cell.touches_region())
      add_cut(cell, 0, halvings);
  }

  bool fits(const RegionCell& cell, const Vec3& centroid, double expected_depth) const {
    const double depth = (region_.closest_boundary_point(centroid) - centroid).norm();
    if (depth < least_depth * expected_depth - no_depth * cell.half_width) return false;
    return contains(region_, cell, centroid);
  }

  /// A part between two planes: its thickness is measured from a point inside.
  void add_slab(const RegionCell& cell, double offset) {
    const std::optional<Vec3> inside = inside_at_boundary(region_, cell);
    if (!inside) return;
    const double thickness = (*inside - cell.boundary_point).norm() +
                             (region_.closest_boundary_point(*inside) - *inside).norm();
    const double outer = cut_cube(cell.outward(), offset, cell.half_width).volume;
    const double beyond = cut_cube(cell.outward(), offset - thickness, cell.half_width).volume;
    if (outer > beyond) parts_.push_back({*inside, outer - beyond});
  }

  const Region& region_;
  std::vector<LeafPart>& parts_;
};

}  // namespace

void append_parts(const Region& region, const OctreeLeaf& leaf, int halvings,
                  std::vector<LeafPart>& parts) {
  if (leaf.kind == LeafKind::exterior) return;
  RegionCell cell;
  cell.center = leaf.center;
  cell.half_width = leaf.half_width;
  if (leaf.kind == LeafKind::interior)
    cell.inner = true;
  else
    look_at(region, {}, cell);
  PartCutter(region, parts).add(cell, std::max(halvings, 1));
}

}  // namespace supple
