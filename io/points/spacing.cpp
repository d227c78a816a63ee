#include "io/points/spacing.h"

#include "solver/core/parallel.h"
#include "solver/field/neighbors.h"
#include "solver/field/spatial_order.h"

namespace supple {
namespace {

constexpr int neighbors = 6;  // as many as surround a point of a surface
constexpr Index chunk = 512;

}  // namespace

Eigen::VectorXd neighbor_spacing(const Points& points) {
  Eigen::VectorXd spacing = Eigen::VectorXd::Zero(points.rows());
  if (points.rows() < 2) return spacing;
  const Neighbors<3> tree(points, Eigen::VectorXd::Ones(points.rows()));
  const std::vector<int> order = spatial_order(points);  // what was just read is read again
  parallel_chunks(points.rows(), chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const int i = order[static_cast<std::size_t>(k)];
      const std::vector<int> near = tree.nearest(points.row(i).transpose(), neighbors + 1);
      for (const int j : near) spacing[i] += (points.row(j) - points.row(i)).norm();
      spacing[i] /= static_cast<double>(near.size() - 1);  // the point itself is among them
    }
  });
  return spacing;
}

}  // namespace supple
