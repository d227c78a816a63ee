#include "modeler/domain/covering_radius.h"

#include <queue>

#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr Index cells_a_chunk = 256;
constexpr std::size_t cells_a_round = 32;

/// A cell, its point of the closed region, and what these say of the covering radius.
struct Bounded {
  RegionCell cell;
  Vec3 point;
  double at_least = 0;  ///< distance of `point` to the sites [m]
  double at_most = 0;   ///< no point of the cell is farther [m]

  bool operator<(const Bounded& other) const { return at_most < other.at_most; }
};

Bounded bound(const RegionCell& cell, const SiteTree& sites) {
  Bounded result{cell, cell.center, sites.distance(cell.center), 0};
  result.at_most = result.at_least + cell.reach();
  if (!cell.center_inside) {
    result.point = cell.boundary_point;
    result.at_least = sites.distance(result.point);
  }
  return result;
}

std::vector<Bounded> bound_all(const std::vector<RegionCell>& cells, const SiteTree& sites) {
  std::vector<Bounded> result(cells.size());
  parallel_chunks(static_cast<Index>(cells.size()), cells_a_chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) result[i] = bound(cells[i], sites);
  });
  return result;
}

std::vector<RegionCell> halve(const Region& region, const std::vector<RegionCell>& cells) {
  std::vector<std::vector<RegionCell>> halves(cells.size());
  parallel_chunks(static_cast<Index>(cells.size()), 1, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) append_halves(region, cells[i], halves[i]);
  });
  std::vector<RegionCell> result;
  for (const auto& part : halves) result.insert(result.end(), part.begin(), part.end());
  return result;
}

}  // namespace

Covering covering_radius(const Region& region, const std::vector<RegionCell>& cells,
                         const Points& sites, double tolerance) {
  const SiteTree tree(sites);
  Bounded farthest;
  std::priority_queue<Bounded> open;
  const auto take = [&](const std::vector<RegionCell>& some) {
    const std::vector<Bounded> bounds = bound_all(some, tree);
    for (const Bounded& b : bounds)
      if (b.at_least > farthest.at_least) farthest = b;
    for (const Bounded& b : bounds)
      if (b.at_most > farthest.at_least + tolerance) open.push(b);
  };
  take(cells);
  while (!open.empty() && open.top().at_most > farthest.at_least + tolerance) {
    std::vector<RegionCell> round;
    for (; !open.empty() && round.size() < cells_a_round; open.pop())
      if (open.top().at_most > farthest.at_least + tolerance) round.push_back(open.top().cell);
    take(halve(region, round));
  }
  return {farthest.at_least + tolerance, farthest.cell};
}

}  // namespace supple
