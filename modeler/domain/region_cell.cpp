#include "modeler/domain/region_cell.h"

#include <algorithm>

namespace supple {

Vec3 RegionCell::outward() const {
  if (distance() <= 0) return Vec3::UnitX();
  const Vec3 away = (center - boundary_point) / distance();
  return center_inside ? Vec3(-away) : away;
}

bool contains(const Region& region, const RegionCell& cell, const Vec3& x) {
  return (cell.center_inside && cell.on_side_of_center(x)) || region.contains(x);
}

void look_at(const Region& region, const std::vector<RegionCell>& known, RegionCell& cell) {
  cell.boundary_point = region.closest_boundary_point(cell.center);
  const auto near = std::find_if(known.begin(), known.end(), [&](const RegionCell& other) {
    return other.on_side_of_center(cell.center);
  });
  cell.center_inside = near != known.end() ? near->center_inside : region.contains(cell.center);
  cell.inner = cell.center_inside && cell.distance() > cell.reach();
}

std::array<RegionCell, 8> halves(const Region& region, const RegionCell& cell) {
  std::array<RegionCell, 8> result;
  std::vector<RegionCell> known = {cell};
  for (int octant = 0; octant < 8; ++octant) {
    RegionCell half = cell;
    half.half_width = 0.5 * cell.half_width;
    for (int axis = 0; axis < 3; ++axis)
      half.center[axis] += (octant >> axis & 1 ? 1 : -1) * half.half_width;
    if (!cell.inner) look_at(region, known, half);
    known.push_back(half);
    result[static_cast<std::size_t>(octant)] = half;
  }
  return result;
}

void append_halves(const Region& region, const RegionCell& cell, std::vector<RegionCell>& cells) {
  for (const RegionCell& half : halves(region, cell))
    if (half.touches_region()) cells.push_back(half);
}

std::optional<Vec3> inside_at_boundary(const Region& region, const RegionCell& cell) {
  const Vec3 inward = -cell.outward();
  for (double depth = cell.half_width; depth > 1e-6 * cell.half_width; depth *= 0.5) {
    const Vec3 point = cell.boundary_point + depth * inward;
    if (region.contains(point)) return point;
  }
  return std::nullopt;
}

}  // namespace supple
