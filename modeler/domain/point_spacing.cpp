#include "modeler/domain/point_spacing.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "modeler/domain/welded_surface.h"
#include "solver/core/parallel.h"
#include "solver/field/neighbors.h"

namespace supple {
namespace {

constexpr Index most_asked = 20000;
constexpr int chunk = 256, ring = 16;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

PointSpacing measure_spacing(const Points& points) {
  const std::vector<int> firsts = first_at_position(points);
  std::vector<Index> different;
  for (Index i = 0; i < points.rows(); ++i)
    if (firsts[i] == i) different.push_back(i);
  PointSpacing result;
  result.duplicated = static_cast<long>(points.rows() - static_cast<Index>(different.size()));
  if (different.size() < 2) return result;

  const Points sites = points(different, Eigen::all);
  const Neighbors<3> tree(sites, Eigen::VectorXd::Ones(sites.rows()));
  const Index step = (sites.rows() + most_asked - 1) / most_asked;
  const Index asked = (sites.rows() + step - 1) / step;
  std::vector<double> nearest(static_cast<std::size_t>(asked)), areas(nearest.size());
  parallel_chunks(asked, chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Vec3 x = sites.row(k * step);
      const std::vector<int> near = tree.nearest(x, ring + 1);
      const auto distance = [&](std::size_t i) {
        return (sites.row(near[i]).transpose() - x).norm();
      };
      const double reach = distance(near.size() - 1);
      nearest[static_cast<std::size_t>(k)] = distance(1);
      areas[static_cast<std::size_t>(k)] =
          std::numbers::pi * reach * reach / std::max(1.0, static_cast<double>(near.size()) - 2);
    }
  });
  result.median = median_of(nearest);
  result.least = *std::min_element(nearest.begin(), nearest.end());
  result.greatest = *std::max_element(nearest.begin(), nearest.end());
  result.density = 1 / median_of(areas);
  for (const double area : areas)
    result.area += area * static_cast<double>(sites.rows()) / static_cast<double>(asked);
  return result;
}

}  // namespace supple
