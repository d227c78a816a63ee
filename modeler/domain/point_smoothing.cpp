#include "modeler/domain/point_smoothing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "modeler/domain/local_quadric.h"
#include "modeler/domain/principal_axes.h"
#include "modeler/domain/site_tree.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr int neighbors_left = 20;
constexpr double radius_over_reach = 1.1;

}  // namespace

Points smooth_points(const Points& positions, int neighbors) {
  const SiteTree tree(positions);
  const Index step = std::max(1, neighbors / neighbors_left);
  Points smooth((positions.rows() + step - 1) / step, 3);
  parallel_chunks(smooth.rows(), 64, [&](Index begin, Index end) {
    std::vector<Index> sites(std::size_t(neighbors) + 1);
    std::vector<double> squared_distances(sites.size());
    std::vector<int> chosen;
    for (Index i = begin; i < end; ++i) {
      const Vec3 x = positions.row(i * step);
      const int found = tree.nearest(x, sites, squared_distances);
      chosen.assign(sites.begin(), sites.begin() + found);
      const PrincipalAxes plane =
          principal_axes(positions, chosen[0], std::span<const int>(chosen).subspan(1));
      const Vec3 normal = plane.axes.col(0);
      const Vec3 foot = x - normal.dot(x - plane.mean) * normal;
      const double radius = radius_over_reach * std::sqrt(squared_distances[found - 1]);
      const Quadric quadric = fit_quadric(positions, normal, chosen, foot, radius, radius).quadric;
      smooth.row(i) = (foot - quadric.constant / normal.dot(quadric.slope) * normal).transpose();
    }
  });
  return smooth;
}

}  // namespace supple
