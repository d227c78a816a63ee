#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "solver/core/export.h"
#include "solver/core/types.h"

namespace supple {

/// Finds particles within one fixed radius: a hash table of cubic cells, made anew in linear time
/// when the particles have moved. Cells count from the particles' lower corner by 64-bit numbers,
/// so that neither a far origin nor a few stray particles overflow them.
class SUPPLE_API HashGrid {
 public:
  /// `positions` [m] n×3, finite; `radius` [m] > 0. No two coordinates 2⁵² radii apart: there
  /// doubles no longer tell neighbouring cells.
  HashGrid(const Points& positions, double radius);

  /// Particles i with |x − x_i| < radius, ascending.
  void within(const Vec3& x, std::vector<int>& particles) const;

  double radius() const { return radius_; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };

  Cell cell_of(const Vec3& x) const;

  Points positions_;
  double radius_;
  Vec3 origin_;
  std::vector<int> particles_;                                     ///< cell by cell
  std::unordered_map<Cell, std::pair<int, int>, CellHash> cells_;  ///< where in particles_
};

}  // namespace supple
