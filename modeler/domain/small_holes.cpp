#include "modeler/domain/small_holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <vector>

#include "modeler/domain/surface_measures.h"
#include "modeler/domain/welded_surface.h"

namespace supple {

namespace {

using Loop = std::vector<int>;

/// Cuts the boundary into loops that pass no vertex twice: as many edges come to each vertex as
/// leave it, so a way that always goes on comes back.
class LoopFinder {
 public:
  explicit LoopFinder(const std::vector<BoundaryEdge>& edges) {
    for (const BoundaryEdge& edge : edges)
      for (int pass = 0; pass < std::abs(edge.excess); ++pass)
        edge.excess > 0 ? ways_[edge.a].push_back(edge.b) : ways_[edge.b].push_back(edge.a);
  }

  std::vector<Loop> find() {
    for (auto& [start, ends] : ways_)
      while (!ends.empty()) walk(start);
    return std::move(loops_);
  }

 private:
  void walk(int start) {
    Loop way = {start};
    std::map<int, std::size_t> places = {{start, 0}};
    // It ends back at the start, once no edge leaves that any more.
    while (!ways_[way.back()].empty()) {
      std::vector<int>& ends = ways_[way.back()];
      const int next = ends.back();
      ends.pop_back();
      const auto [place, is_new] = places.emplace(next, way.size());
      if (is_new) {
        way.push_back(next);
        continue;
      }
      const std::size_t first = place->second;
      loops_.emplace_back(way.begin() + static_cast<long>(first), way.end());
      for (std::size_t i = first + 1; i < way.size(); ++i) places.erase(way[i]);
      way.resize(first + 1);
    }
  }

  std::map<int, std::vector<int>> ways_;  ///< from each vertex
  std::vector<Loop> loops_;
};

/// The triangles that close a loop, and the place of the vertex numbered `apex` that they meet at.
struct Lid {
  std::vector<std::array<int, 3>> triangles;
  Vec3 middle = Vec3::Zero();
  double area = 0;
  double width = 0;
};

Lid lid_of(const Loop& loop, const Points& positions, int apex) {
  Lid lid;
  Box box;
  double length = 0;
  const auto at = [&](std::size_t i) -> Vec3 { return positions.row(loop[i % loop.size()]); };
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double edge = (at(i + 1) - at(i)).norm();
    lid.middle += 0.5 * edge * (at(i) + at(i + 1));
    length += edge;
    box.extend(at(i));
  }
  lid.middle /= length;
  lid.width = box.diagonal();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    lid.area += 0.5 * (at(i) - lid.middle).cross(at(i + 1) - lid.middle).norm();
    lid.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], apex});
  }
  if (loop.size() == 3) lid.triangles = {{loop[2], loop[1], loop[0]}};
  return lid;
}

/// Areas of the parts that hang together by vertices, by vertex.
std::vector<double> part_areas(const Points& positions, const Triangles& triangles) {
  const std::vector<int> parts = connected_parts(triangles);
  std::vector<double> areas;
  for (Index t = 0; t < triangles.rows(); ++t) {
    areas.resize(std::max(areas.size(), std::size_t(parts[t]) + 1), 0);
    areas[parts[t]] += 0.5 * double_area_normal(positions, triangles, t).norm();
  }
  std::vector<double> result(positions.rows(), 0);
  for (Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) result[triangles(t, k)] = areas[parts[t]];
  return result;
}

}  // namespace

long fill_small_holes(Points& positions, Triangles& triangles, const SmallHoleLimits& limits) {
  const std::vector<Loop> loops = LoopFinder(boundary_edges(triangles)).find();
  if (loops.empty()) return 0;
  const std::vector<double> areas = part_areas(positions, triangles);
  std::vector<std::array<int, 3>> fill;
  std::vector<Vec3> middles;
  long filled = 0;
  for (const Loop& loop : loops) {
    const int apex = static_cast<int>(positions.rows() + static_cast<Index>(middles.size()));
    const Lid lid = lid_of(loop, positions, apex);
    if (lid.width > limits.width || lid.area > limits.share_of_part * areas[loop[0]]) continue;
    fill.insert(fill.end(), lid.triangles.begin(), lid.triangles.end());
    if (lid.triangles.size() > 1) middles.push_back(lid.middle);
    ++filled;
  }
  const Index had = triangles.rows(), vertices = positions.rows();
  positions.conservativeResize(vertices + static_cast<Index>(middles.size()), 3);
  for (std::size_t i = 0; i < middles.size(); ++i)
    positions.row(vertices + static_cast<Index>(i)) = middles[i].transpose();
  triangles.conservativeResize(had + static_cast<Index>(fill.size()), 3);
  for (std::size_t i = 0; i < fill.size(); ++i)
    triangles.row(had + static_cast<Index>(i)) << fill[i][0], fill[i][1], fill[i][2];
  return filled;
}

}  // namespace supple
