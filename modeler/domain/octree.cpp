#include "modeler/domain/octree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "modeler/domain/region_cell.h"
#include "modeler/domain/shape_error.h"
#include "solver/core/check.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

using Key = std::uint64_t;
using Place = std::array<std::int64_t, 3>;  ///< of a cell among those of its level

constexpr Index cells_a_chunk = 64;
constexpr int most_levels = 20;  // 3 bits a level in a key
constexpr std::size_t most_cells = 20'000'000;

/// Corners that the boundary cuts off a leaf are not seen where they are smaller than its edge
/// halved so often.
constexpr int crossing_halvings = 2;

/// Every third bit of a key, from the lowest.
std::int64_t every_third(Key key) {
  std::int64_t value = 0;
  for (int bit = 0; bit <= most_levels; ++bit)
    value |= static_cast<std::int64_t>(key >> (3 * bit) & 1) << bit;
  return value;
}

Place place_of(Key key) {
  return {every_third(key), every_third(key >> 1), every_third(key >> 2)};
}

Key key_of(const Place& place) {
  Key key = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int bit = 0; bit <= most_levels; ++bit)
      key |= static_cast<Key>(place[static_cast<std::size_t>(axis)] >> bit & 1) << (3 * bit + axis);
  return key;
}

/// The cell itself and those that share a face or an edge with it, of its own level.
void append_around(Key key, int level, std::vector<Key>& keys) {
  const Place place = place_of(key);
  const std::int64_t count = std::int64_t{1} << level;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Place other{place[0] + x, place[1] + y, place[2] + z};
        const bool corner = x != 0 && y != 0 && z != 0;
        const bool in_root = std::all_of(other.begin(), other.end(),
                                         [&](std::int64_t at) { return at >= 0 && at < count; });
        if (!corner && in_root) keys.push_back(key_of(other));
      }
}

void sort_unique(std::vector<Key>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// Splits what must be, so that the parent of every neighbour of a split cell is split too.
void balance(std::vector<std::vector<Key>>& split) {
  for (std::size_t level = split.size() - 1; level > 0; --level) {
    std::vector<Key> around;
    for (const Key key : split[level]) append_around(key, static_cast<int>(level), around);
    for (const Key key : around) split[level - 1].push_back(key >> 3);
    sort_unique(split[level - 1]);
  }
}

/// True for points inside the cell; those on its faces are not.
bool holds(const RegionCell& cell, const Vec3& x) {
  return (x - cell.center).lpNorm<Eigen::Infinity>() < (1 - 1e-6) * cell.half_width;
}

/// True where the boundary passes through `part` within the inside of `cell`.
bool crosses(const Region& region, const RegionCell& cell, const RegionCell& part, int halvings) {
  if (part.inner || !part.touches_region()) return false;
  if (holds(cell, part.boundary_point)) return true;
  if (halvings == 0) return false;
  const std::array<RegionCell, 8> parts = halves(region, part);
  return std::any_of(parts.begin(), parts.end(), [&](const RegionCell& half) {
    return crosses(region, cell, half, halvings - 1);
  });
}

LeafKind kind_of(const Region& region, const RegionCell& cell) {
  const bool crossed = crosses(region, cell, cell, crossing_halvings);
  if (cell.center_inside) return crossed ? LeafKind::interior_boundary : LeafKind::interior;
  return crossed ? LeafKind::exterior_boundary : LeafKind::exterior;
}

struct KeyedCell {
  Key key;
  RegionCell cell;
};

std::vector<KeyedCell> halves_of(const Region& region, const std::vector<KeyedCell>& cells) {
  std::vector<KeyedCell> result(8 * cells.size());
  const Index count = static_cast<Index>(cells.size());
  parallel_chunks(count, cells_a_chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const KeyedCell& cell = cells[static_cast<std::size_t>(i)];
      const std::array<RegionCell, 8> parts = halves(region, cell.cell);
      for (std::size_t octant = 0; octant < 8; ++octant)
        result[8 * static_cast<std::size_t>(i) + octant] = {cell.key << 3 | octant, parts[octant]};
    }
  });
  return result;
}

}  // namespace

Octree::Octree(const Region& region, const OctreeOptions& options) : width_(options.width) {
  SUPPLE_CHECK(options.width > 0, "leaves have a width");
  const Box box = region.bounds();
  const Vec3 across = (box.size() * ((1 - 1e-9) / width_)).array().ceil().max(1.0);
  while (levels_ <= most_levels && std::ldexp(1, levels_) < across.maxCoeff()) ++levels_;
  if (levels_ > most_levels)
    throw ShapeError("the cells are too fine for the shape; give a greater spacing");
  // The fewest leaves across the box lie evenly about its middle: a leaf's face or its centre
  // there.
  for (int axis = 0; axis < 3; ++axis) {
    const double spare = std::ldexp(1, levels_) - across[axis];
    lower_[axis] = box.center()[axis] - width_ * (0.5 * across[axis] + std::floor(0.5 * spare));
  }
  std::vector<std::vector<Key>> split = cells_to_split(region, options.coarser_inside);
  if (levels_ > 0) balance(split);
  keep_leaves(split);
  classify(region);
}

/// By level; the finest level is not in it.
std::vector<std::vector<Key>> Octree::cells_to_split(const Region& region,
                                                     int coarser_inside) const {
  std::vector<std::vector<Key>> split(static_cast<std::size_t>(levels_));
  RegionCell root;
  root.half_width = 0.5 * std::ldexp(width_, levels_);
  root.center = lower_ + Vec3::Constant(root.half_width);
  look_at(region, {}, root);
  std::vector<KeyedCell> cells = {{0, root}};
  for (int level = 0; level < levels_; ++level) {
    std::erase_if(cells, [&](const KeyedCell& cell) {
      const bool fine_enough = cell.cell.inner && level >= levels_ - coarser_inside;
      return fine_enough || !cell.cell.touches_region();
    });
    if (cells.size() > most_cells)
      throw ShapeError("the cells are too fine for the shape; give a greater spacing");
    for (const KeyedCell& cell : cells) split[static_cast<std::size_t>(level)].push_back(cell.key);
    if (level + 1 < levels_) cells = halves_of(region, cells);
  }
  return split;
}

/// Leaves are the halves of split cells that are not split themselves.
void Octree::keep_leaves(const std::vector<std::vector<Key>>& split) {
  struct Leaf {
    Key start, key;
    int level;
  };
  std::vector<Leaf> leaves;
  if (split.empty() || split.front().empty()) leaves.push_back({0, 0, 0});
  for (std::size_t parent = 0; parent < split.size(); ++parent) {
    const int level = static_cast<int>(parent) + 1;
    for (const Key key : split[parent])
      for (Key octant = 0; octant < 8; ++octant) {
        const Key half = key << 3 | octant;
        const bool is_split = level < levels_ && std::binary_search(split[parent + 1].begin(),
                                                                    split[parent + 1].end(), half);
        if (!is_split) leaves.push_back({half << 3 * (levels_ - level), half, level});
      }
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf& a, const Leaf& b) { return a.start < b.start; });
  for (const Leaf& leaf : leaves) {
    OctreeLeaf cube;
    cube.half_width = 0.5 * std::ldexp(width_, levels_ - leaf.level);
    const Place place = place_of(leaf.key);
    for (int axis = 0; axis < 3; ++axis)
      cube.center[axis] =
          lower_[axis] +
          (2 * static_cast<double>(place[static_cast<std::size_t>(axis)]) + 1) * cube.half_width;
    leaves_.push_back(cube);
    starts_.push_back(leaf.start);
  }
}

void Octree::classify(const Region& region) {
  const Index count = static_cast<Index>(leaves_.size());
  parallel_chunks(count, cells_a_chunk, [&](Index begin, Index end) {
    std::vector<RegionCell> before;
    for (Index i = begin; i < end; ++i) {
      OctreeLeaf& leaf = leaves_[static_cast<std::size_t>(i)];
      RegionCell cell;
      cell.center = leaf.center;
      cell.half_width = leaf.half_width;
      look_at(region, before, cell);
      leaf.kind = kind_of(region, cell);
      before.assign(1, cell);
    }
  });
}

Index Octree::leaf_at(const Vec3& x) const {
  const Vec3 at = (x - lower_) / width_;
  const double cells = std::ldexp(1, levels_);
  if ((at.array() < 0).any() || !(at.array() <= cells).all()) return -1;
  Place place;
  for (int axis = 0; axis < 3; ++axis)
    place[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::min(std::floor(at[axis]), cells - 1));
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), key_of(place));
  return after - starts_.begin() - 1;
}

}  // namespace supple
