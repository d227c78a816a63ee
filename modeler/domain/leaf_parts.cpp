#include "modeler/domain/leaf_parts.h"

#include <algorithm>
#include <array>
#include <optional>

#include "modeler/domain/cut_cube.h"
#include "modeler/domain/region_cell.h"

namespace supple {

namespace {

using Halves = std::array<RegionCell, 8>;

/// Halvings beyond what was asked for, where normals turn fast or a plane does not fit.
constexpr int more_halvings = 2;

/// Of the angle between two normals of a boundary that bends.
constexpr double least_cosine = 0.7;

/// A cut fits where points below it are no less deep inside than this share of what it says,
constexpr double least_depth = 0.85;
/// or miss that by less than this share of half the cell's edge.
constexpr double no_depth = 0.02;

/// By how much the boundary lies below its tangent plane [m], on the mean over one half's edge a.
/// d at the halves' centres exceeds d at the middle by (a²/8) Δd on the mean. None is known where
/// normals turn fast: there the boundary has an edge, or two sides.
std::optional<double> mean_bend(const RegionCell& cell, const Halves& parts) {
  const Vec3 outward = cell.outward();
  double sum = 0;
  for (const RegionCell& part : parts) {
    if (part.outward().dot(outward) < least_cosine) return std::nullopt;
    sum += part.signed_distance() - cell.signed_distance();
  }
  return sum / 8 / 3;
}

class PartCutter {
 public:
  PartCutter(const Region& region, std::vector<LeafPart>& parts) : region_(region), parts_(parts) {}

  /// Cuts the cell's parts after so many halvings, and where need be after `more`.
  void add(const RegionCell& cell, int halvings, int more) {
    if (!cell.touches_region()) return;
    if (cell.inner) {
      parts_.push_back({cell.center, cell.volume()});
      return;
    }
    const Halves parts = halves(region_, cell);
    const std::optional<double> bend = mean_bend(cell, parts);
    for (const RegionCell& part : parts) {
      if (halvings > 1 || part.inner)
        add(part, halvings - 1, more);
      else if (!bend && more > 0)
        add(part, 1, more - 1);
      else if (part.touches_region())
        add_cut(part, bend.value_or(0), more);
    }
  }

 private:
  void add_cut(const RegionCell& cell, double bend, int more) {
    const double offset = -cell.signed_distance() - bend;
    const CutVolume cut = cut_cube(cell.outward(), offset, cell.half_width);
    if (!(cut.volume > 0)) return;
    const double depth = offset - cell.outward().dot(cut.centroid);
    const LeafPart part{cell.center + cut.centroid, cut.volume};
    if (more > 0 && !is_one_sided(cell, part.centroid, depth))
      add(cell, 1, more - 1);
    else if (is_inside(cell, part.centroid, depth))
      parts_.push_back(part);
    else
      add_slab(cell, offset);
  }

  /// True where no other side of the boundary is within half an edge of the cut: asked deep enough
  /// inside to see it.
  bool is_one_sided(const RegionCell& cell, const Vec3& centroid, double depth) const {
    const double deep = std::max(depth, cell.half_width);
    return is_inside(cell, centroid - (deep - depth) * cell.outward(), deep);
  }

  /// True for a point inside, about as deep as the plane says.
  bool is_inside(const RegionCell& cell, const Vec3& x, double expected_depth) const {
    const double depth = (region_.closest_boundary_point(x) - x).norm();
    if (depth < least_depth * expected_depth - no_depth * cell.half_width) return false;
    return contains(region_, cell, x);
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
  PartCutter(region, parts).add(cell, std::max(halvings, 1), more_halvings);
}

}  // namespace supple
