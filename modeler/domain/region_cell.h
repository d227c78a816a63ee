#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/core/rest_shape.h"

namespace supple {

/// A cube, and what its centre knows of a region.
struct RegionCell {
  Vec3 center;
  double half_width = 0;  ///< half an edge [m]
  bool inner = false;     ///< all of it is inside
  bool center_inside = false;
  Vec3 boundary_point;  ///< nearest to the centre; unset in inner cells

  double reach() const { return 1.7320508075688772 * half_width; }  ///< centre to corner [m]
  double volume() const { return 8 * half_width * half_width * half_width; }  ///< [m³]
  double distance() const { return (boundary_point - center).norm(); }  ///< to the boundary [m]

  /// Distance to the boundary [m], negative inside.
  double signed_distance() const { return center_inside ? -distance() : distance(); }

  /// False where all of it is outside for certain.
  bool touches_region() const { return inner || distance() <= reach(); }

  /// True where no boundary lies between the centre and x, for certain.
  bool on_side_of_center(const Vec3& x) const { return (x - center).norm() < distance(); }

  /// Unit normal of the boundary at the boundary point.
  Vec3 outward() const;
};

/// True for points inside the region; quick where the cell's centre is and x lies near it.
bool contains(const Region& region, const RegionCell& cell, const Vec3& x);

/// Asks the region about a cell; `known` are cells already asked that lie near it.
void look_at(const Region& region, const std::vector<RegionCell>& known, RegionCell& cell);

/// The eight halves, in Morton order: x changes first, z last.
std::array<RegionCell, 8> halves(const Region& region, const RegionCell& cell);

/// The eight halves of a cell that touch the region, appended to `cells`.
void append_halves(const Region& region, const RegionCell& cell, std::vector<RegionCell>& cells);

/// A point inside the region, straight below the boundary point of a cell that is not inner.
/// None where the region is thinner there than a millionth of the cell.
std::optional<Vec3> inside_at_boundary(const Region& region, const RegionCell& cell);

}  // namespace supple
