#pragma once

#include <array>
#include <cstdint>

namespace supple {

/// Place in a grid of cubes.
using GridCell = std::array<int, 3>;

/// No cell is farther from the first one along an axis.
inline constexpr int farthest_cell = 1 << 19;

/// A number for each cell.
inline std::uint64_t key_of(const GridCell& cell) {
  constexpr std::int64_t middle = 2 * farthest_cell;
  std::uint64_t key = 0;
  for (const int i : cell) key = key << 21 | static_cast<std::uint64_t>(i + middle);
  return key;
}

/// The cells around one, by their number among 27.
inline GridCell around(const GridCell& cell, int offset) {
  return {cell[0] + offset % 3 - 1, cell[1] + offset / 3 % 3 - 1, cell[2] + offset / 9 - 1};
}

inline constexpr int offsets = 27, no_offset = 13;  // the cell itself

}  // namespace supple
