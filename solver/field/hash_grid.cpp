#include "solver/field/hash_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/core/check.h"

namespace supple {
namespace {

/// Cells beyond are as good as this one: nothing lies there.
constexpr double farthest_cell = 0x1.0p53;

}  // namespace

std::size_t HashGrid::CellHash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (const std::int64_t coordinate : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

HashGrid::HashGrid(const Points& positions, double radius)
    : positions_(positions), radius_(radius), origin_(bounding_box(positions).lower) {
  SUPPLE_CHECK(positions.allFinite() && std::isfinite(radius) && radius > 0,
               "positions and radius are finite");
  const Box box = bounding_box(positions);
  SUPPLE_CHECK(box.empty() || 2 * box.size().maxCoeff() / radius < farthest_cell,
               "a double tells neighbouring cells apart");
  std::vector<Cell> cells;
  for (Index i = 0; i < positions.rows(); ++i)
    cells.push_back(cell_of(positions.row(i).transpose()));
  particles_.resize(cells.size());
  std::iota(particles_.begin(), particles_.end(), 0);
  std::stable_sort(particles_.begin(), particles_.end(), [&](int i, int j) {
    return cells[static_cast<std::size_t>(i)] < cells[static_cast<std::size_t>(j)];
  });
  for (int at = 0; at < static_cast<int>(particles_.size()); ++at) {
    const int particle = particles_[static_cast<std::size_t>(at)];
    auto& range =
        cells_.try_emplace(cells[static_cast<std::size_t>(particle)], at, at).first->second;
    range.second = at + 1;
  }
}

HashGrid::Cell HashGrid::cell_of(const Vec3& x) const {
  Cell cell;
  for (int k = 0; k < 3; ++k)
    cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(
        std::floor(std::clamp((x[k] - origin_[k]) / radius_, -farthest_cell, farthest_cell)));
  return cell;
}

void HashGrid::within(const Vec3& x, std::vector<int>& particles) const {
  particles.clear();
  // From corner to corner, not the cell and those around it: rounding keeps the order of
  // coordinates, so nothing between the corners is missed, wherever the cells' edges fall.
  const Vec3 reach = Vec3::Constant(radius_ * (1 + 1e-14));
  const Cell first = cell_of(x - reach), last = cell_of(x + reach);
  Cell cell;
  for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0])
    for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
      for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2]) {
        const auto found = cells_.find(cell);
        if (found == cells_.end()) continue;
        for (int at = found->second.first; at < found->second.second; ++at) {
          const int i = particles_[static_cast<std::size_t>(at)];
          if ((positions_.row(i).transpose() - x).squaredNorm() < radius_ * radius_)
            particles.push_back(i);
        }
      }
  std::sort(particles.begin(), particles.end());
}

}  // namespace supple
