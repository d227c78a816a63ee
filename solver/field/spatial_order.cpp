#include "solver/field/spatial_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace supple {
namespace {

/// Spreads the lower 21 bits so that two zeros follow each.
std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  v = (v | v << 2) & 0x1249249249249249ull;
  return v;
}

}  // namespace

std::vector<int> spatial_order(const Points& points) {
  const Box box = bounding_box(points);
  const double widest = points.rows() > 0 ? box.size().maxCoeff() : 0;
  const double scale = widest > 0 ? 0x1fffff / widest : 0;
  std::vector<std::pair<std::uint64_t, int>> keys(static_cast<std::size_t>(points.rows()));
  for (Index i = 0; i < points.rows(); ++i) {
    const Vec3 cell = scale * (points.row(i).transpose() - box.lower);
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key |= spread_bits(static_cast<std::uint64_t>(cell[k])) << k;
    keys[static_cast<std::size_t>(i)] = {key, static_cast<int>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(),
                 [](const auto& key) { return key.second; });
  return order;
}

}  // namespace supple
