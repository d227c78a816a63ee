#include "modeler/domain/thickness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/core/parallel.h"

namespace supple {
namespace {

constexpr int chunk = 32, most_steps = 200;
constexpr double nearby = 1e-6;    // of the diagonal: steps off the boundary
constexpr double accuracy = 1e-3;  // of a thickness

/// The unit normal at x on the boundary, from differences of the signed distance over `step`; zero
/// where it does not part inside from outside.
Vec3 outward(const Region& region, const Vec3& x, double step) {
  Vec3 gradient;
  for (int k = 0; k < 3; ++k) gradient[k] = region.signed_distance(x + step * Vec3::Unit(k));
  gradient.normalize();
  const bool parts = region.contains(x - step * gradient) && !region.contains(x + step * gradient);
  return parts ? gradient : Vec3(Vec3::Zero());
}

/// The way from x, on the boundary, along the unit vector `inward` until it leaves the region, in
/// steps as long as the distance to the boundary allows; as far as it came
/// where those are too many, 0 where it missed the wall.
double way_through(const Region& region, const Vec3& x, const Vec3& inward, double first) {
  const double longest = region.bounds().diagonal();
  double way = first;
  for (int step = 0; step < most_steps && way <= longest; ++step) {
    const Vec3 at = x + way * inward;
    double depth = (region.closest_boundary_point(at) - at).norm();
    if (depth < accuracy * way) {  // a wall: the end, or one that stands inside
      depth += accuracy * way;
      if (!region.contains(x + (way + depth) * inward)) return way;
    }
    way += depth;
  }
  return way <= longest ? way : 0;
}

}  // namespace

Thickness::Thickness(const std::vector<double>& values, const std::vector<double>& areas) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  double sum = 0;
  for (const std::size_t i : order) {
    sum += areas[i];
    sorted_.push_back({values[i], sum / total});
  }
  if (!sorted_.empty()) sorted_.back().area_up_to = 1;  // whatever the sums' rounding
}

Thickness Thickness::scaled(double factor) const {
  Thickness result = *this;
  for (Entry& entry : result.sorted_) entry.value *= factor;
  return result;
}

double Thickness::quantile(double share) const {
  if (sorted_.empty()) return 0;
  const auto found =
      std::lower_bound(sorted_.begin(), sorted_.end(), share,
                       [](const Entry& entry, double share) { return entry.area_up_to < share; });
  return found == sorted_.end() ? sorted_.back().value : found->value;
}

double Thickness::share_below(double length) const {
  const auto found =
      std::lower_bound(sorted_.begin(), sorted_.end(), length,
                       [](const Entry& entry, double length) { return entry.value < length; });
  return found == sorted_.begin() ? 0 : std::prev(found)->area_up_to;
}

Thickness measure_thickness(const Region& region, const Points& places,
                            const Eigen::VectorXd& areas) {
  const double step = nearby * region.bounds().diagonal();
  std::vector<double> ways(static_cast<std::size_t>(places.rows()), 0);
  parallel_chunks(places.rows(), chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Vec3 x = region.closest_boundary_point(places.row(i).transpose());
      const Vec3 normal = outward(region, x, step);
      if (!normal.isZero(0))
        ways[static_cast<std::size_t>(i)] = way_through(region, x, -normal, step);
    }
  });
  std::vector<double> values, counted;
  for (Index i = 0; i < places.rows(); ++i) {
    if (!(ways[static_cast<std::size_t>(i)] > 0)) continue;
    values.push_back(ways[static_cast<std::size_t>(i)]);
    counted.push_back(areas[i]);
  }
  return {values, counted};
}

}  // namespace supple
