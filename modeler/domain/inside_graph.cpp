#include "modeler/domain/inside_graph.h"

#include <algorithm>
#include <cmath>

namespace supple {
namespace {

/// Stations that are asked whether they see a point.
constexpr std::size_t most_views = 48, most_own_views = 8;

/// How far beside a point on the boundary is looked, in units of the way to it.
constexpr double beside = 1e-6;

}  // namespace

Vec3 InsideGraph::corner(const GridCell& cell) const {
  return origin_ + width_ * Vec3(cell[0], cell[1], cell[2]);
}

GridCell InsideGraph::cell_at(const Vec3& x) const {
  GridCell cell;
  for (int k = 0; k < 3; ++k) cell[k] = static_cast<int>(std::floor((x[k] - origin_[k]) / width_));
  return cell;
}

const InsideGraph::CellEntry* InsideGraph::find(const GridCell& cell) const {
  const auto found = cell_numbers_.find(key_of(cell));
  return found == cell_numbers_.end() ? nullptr : &cells_[found->second];
}

std::span<const int> InsideGraph::linked(int pocket) const {
  return {links_.data() + link_starts_[pocket], links_.data() + link_starts_[pocket + 1]};
}

std::pair<int, int> InsideGraph::pockets_in(const GridCell& cell) const {
  const CellEntry* entry = find(cell);
  if (!entry) return {0, 0};
  return {entry->first_pocket, entry->first_pocket + entry->pocket_count};
}

bool InsideGraph::sees(int station, const Vec3& x, double clearance) const {
  const Vec3 from = stations_.row(station).transpose();
  // Balls that only touch may do so at the walls of a gap.
  const double reach = 0.999 * (clearances_[station] + clearance);
  return (from - x).squaredNorm() <= reach * reach || region_.connects(from, layers_[station], x);
}

bool InsideGraph::parted() const {
  return std::any_of(cells_.begin(), cells_.end(),
                     [](const CellEntry& entry) { return entry.only < 0; });
}

int InsideGraph::pocket_of(const Vec3& x) const {
  // Points of no face may lie anywhere, beyond what cells can be numbered.
  if (!((x - origin_).cwiseAbs().maxCoeff() < farthest_cell * width_)) return -1;
  const GridCell cell = cell_at(x);
  const CellEntry* entry = find(cell);
  if (entry && entry->only >= 0) return entry->only;
  const int pocket = seen_pocket(x, cell);
  return pocket < 0 ? -1 : within(cell, pocket);
}

int InsideGraph::seated_pocket_of(const Vec3& x) const {
  const int pocket = pocket_of(x);
  return pocket < seated_ ? pocket : linked(pocket).front();
}

/// The pocket of the nearest station that sees x, of its own cell or else around. A point on the
/// boundary may be hidden by its own triangle: it is looked at from just beside it then. That of
/// the nearest station where none sees it.
int InsideGraph::seen_pocket(const Vec3& x, const GridCell& cell) const {
  std::vector<View> views;
  add_views(x, cell, views);
  if (const int pocket = seen_from(x, views, most_own_views); pocket >= 0) return pocket;
  for (int offset = 0; offset < offsets; ++offset)
    if (offset != no_offset) add_views(x, around(cell, offset), views);
  if (views.empty()) return -1;
  if (const int pocket = seen_from(x, views, most_views); pocket >= 0) return pocket;
  for (const View& view : views) {
    const Vec3 station = stations_.row(view.station).transpose();
    if (sees(view.station, x + beside * (station - x), 0)) return view.pocket;
  }
  return views.front().pocket;
}

/// The stations of a cell.
void InsideGraph::add_views(const Vec3& x, const GridCell& cell, std::vector<View>& views) const {
  const auto [begin, end] = pockets_in(cell);
  for (int pocket = begin; pocket < end; ++pocket)
    for (int k = 0; k < pockets_[pocket].station_count; ++k) {
      const int station = pockets_[pocket].first_station + k;
      views.push_back({(stations_.row(station).transpose() - x).squaredNorm(), station, pocket});
    }
}

/// The pocket of the first that sees x, of the `most` nearest, which are put in order and alone
/// kept; −1 where none does.
int InsideGraph::seen_from(const Vec3& x, std::vector<View>& views, std::size_t most) const {
  if (most < views.size()) {
    std::nth_element(views.begin(), views.begin() + most, views.end());
    views.resize(most);
  }
  std::sort(views.begin(), views.end());
  for (const View& view : views)
    if (sees(view.station, x, 0)) return view.pocket;
  return -1;
}

/// The pocket of `cell` that hangs together with `pocket`, or itself.
int InsideGraph::within(const GridCell& cell, int pocket) const {
  if (pockets_[pocket].cell == cell) return pocket;
  const CellEntry* entry = find(cell);
  if (!entry) return pocket;
  for (const auto& [first, count] : {std::pair{entry->first_pocket, entry->pocket_count},
                                     std::pair{entry->first_sliver, entry->sliver_count}})
    for (int other = first; other < first + count; ++other) {
      const auto links = linked(other);
      if (std::find(links.begin(), links.end(), pocket) != links.end()) return other;
    }
  return pocket;
}

}  // namespace supple
