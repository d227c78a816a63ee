#include "solver/field/merge_coincident.h"

#include <algorithm>

#include "solver/core/check.h"
#include "solver/field/hash_grid.h"
#include "solver/field/pieces.h"

namespace supple {

MergedParticles merge_coincident(const Points& positions, const Eigen::VectorXd& volumes,
                                 double tolerance) {
  SUPPLE_CHECK(positions.rows() == volumes.size(), "one volume a particle");
  const HashGrid grid(positions, tolerance);
  Pieces pieces(positions.rows());
  std::vector<int> near;
  for (Index i = 0; i < positions.rows(); ++i) {
    grid.within(positions.row(i).transpose(), near);
    for (const int j : near) pieces.tie(static_cast<int>(i), j);
  }
  MergedParticles result;
  result.merged = pieces.numbers();
  const Index count =
      result.merged.empty()
          ? 0
          : *std::max_element(result.merged.begin(), result.merged.end()) + Index(1);
  // Means as ways from the first one: exact where all are at one place.
  Points first = Points::Zero(count, 3);
  result.volumes.setZero(count);
  for (Index i = positions.rows() - 1; i >= 0; --i)
    first.row(result.merged[static_cast<std::size_t>(i)]) = positions.row(i);
  Points ways = Points::Zero(count, 3);
  for (Index i = 0; i < positions.rows(); ++i) {
    const Index at = result.merged[static_cast<std::size_t>(i)];
    result.volumes[at] += volumes[i];
    ways.row(at) += volumes[i] * (positions.row(i) - first.row(at));
  }
  result.positions = first;
  for (Index at = 0; at < count; ++at)
    if (result.volumes[at] > 0) result.positions.row(at) += ways.row(at) / result.volumes[at];
  return result;
}

}  // namespace supple
