#include "solver/field/supports.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/core/parallel.h"

namespace supple {
namespace {

/// A particle should reach a little beyond what it must cover: at its very rim its weight is 0.
constexpr double reach_share = 0.9;

constexpr Index points_per_chunk = 256;

/// A point asks no more once supports grew this often without reaching it by another particle.
constexpr int most_vain_rounds = 3;

/// Particles and the measures that their supports have; round ones the usual.
struct Reach {
  const Points& particles;
  const std::vector<Mat3>& stretches;
  Neighbors<3> tree;
  double most_stretch = 1;  ///< distance over needed radius at the most

  Reach(const Points& points, const std::vector<Mat3>& measures, double usual)
      : particles(points),
        stretches(measures),
        tree(points, Eigen::VectorXd::Constant(points.rows(), usual)) {
    for (const Mat3& measure : stretches)
      most_stretch =
          std::max(most_stretch, 1 / Eigen::SelfAdjointEigenSolver<Mat3>(measure).eigenvalues()[0]);
  }

  /// The support radius that particle i would need to reach x.
  double needed(Index i, const Vec3& x) const {
    const Vec3 way = x - particles.row(i).transpose();
    return stretches.empty() ? way.norm() : (stretches[static_cast<std::size_t>(i)] * way).norm();
  }

  /// Particles that reach x by a support radius up to `most`.
  std::vector<int> reaching(const Vec3& x, double most) const {
    std::vector<int> found;
    tree.within(x, (1 + 1e-9) * most_stretch * most, found);
    std::erase_if(found, [&](int i) { return needed(i, x) > most; });
    return found;
  }
};

/// h_i ← max_j (h_j − smoothness·|x_i − x_j|), where no h is below the usual.
void smooth(const Reach& reach, double usual, double smoothness, Eigen::VectorXd& radii) {
  const Eigen::VectorXd grown = radii;
  std::vector<int> near;
  for (Index j = 0; j < grown.size(); ++j) {
    if (grown[j] <= usual) continue;
    const Vec3 x = reach.particles.row(j).transpose();
    reach.tree.within(x, (grown[j] - usual) / smoothness, near);
    for (const int i : near) {
      const double distance = (reach.particles.row(i).transpose() - x).norm();
      radii[i] = std::max(radii[i], grown[j] - smoothness * distance);
    }
  }
}

/// A covered point that asks for wider supports around it.
struct Demand {
  Index point;
  double radius;  ///< of the supports around it [m]
  std::size_t reached_by = 0;
  int vain_rounds = 0;
};

/// Particles that a point is too far from, by the way inside.
std::vector<int> hidden_from(const Vec3& x, double reach, const Detours* detours) {
  std::vector<int> hidden;
  if (!detours) return hidden;
  std::vector<Detour> found;
  detours->at(x, Derivatives::none, found);
  for (const Detour& detour : found)
    if (detour.length > reach) hidden.push_back(detour.particle);
  return hidden;
}

/// Widens the supports of all particles that shall reach a demand's point.
void meet(const std::vector<Demand>& demands, const Points& cover, const Reach& reach,
          const Detours* detours, Eigen::VectorXd& radii) {
  for (const Demand& demand : demands) {
    const double within = reach_share * demand.radius;
    const Vec3 x = cover.row(demand.point).transpose();
    const std::vector<int> hidden = hidden_from(x, within, detours);
    for (const int i : reach.reaching(x, within))
      if (!std::binary_search(hidden.begin(), hidden.end(), i))
        radii[i] = std::max(radii[i], demand.radius);
  }
}

/// Demands of the points with fewer particles near than they need.
std::vector<Demand> sparse_points(const Reach& reach, const Points& cover, double usual,
                                  const SupportOptions& options) {
  // Those nearest by a stretched measure are among a few times more of the nearest.
  const int wanted = options.least_neighbors;
  const int candidates = reach.stretches.empty() ? wanted : 4 * wanted;
  Eigen::VectorXd needed(cover.rows());
  parallel_chunks(cover.rows(), points_per_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Vec3 x = cover.row(k).transpose();
      std::vector<double> radii;
      for (const int i : reach.tree.nearest(x, candidates)) radii.push_back(reach.needed(i, x));
      std::sort(radii.begin(), radii.end());
      radii.resize(std::min(radii.size(), static_cast<std::size_t>(wanted)));
      needed[k] = radii.back() * (1 + 1e-12) / reach_share;
    }
  });
  std::vector<Demand> demands;
  for (Index k = 0; k < cover.rows(); ++k)
    if (needed[k] > usual) demands.push_back({k, needed[k]});
  return demands;
}

/// Those of `points` whose shape functions are too steep, or span too little, or which detours
/// keep too many particles from.
std::vector<Demand> steep_points(const MovingLeastSquares<3>& field, const Points& cover,
                                 std::vector<Demand> points, double most_slope,
                                 const SupportOptions& options) {
  std::vector<char> steep(points.size());
  const std::size_t least = field.detours() ? static_cast<std::size_t>(options.least_inside) : 0;
  parallel_chunks(static_cast<Index>(points.size()), points_per_chunk, [&](Index begin, Index end) {
    ShapeFunctions<3> at_x;
    for (Index k = begin; k < end; ++k) {
      const auto at = static_cast<std::size_t>(k);
      field.evaluate(cover.row(points[at].point).transpose(), Derivatives::first, at_x);
      steep[at] = at_x.particles.size() < least ||
                  at_x.rank < MovingLeastSquares<3>::basis_size(BasisOrder::linear) ||
                  at_x.gradients.rowwise().norm().sum() > most_slope;
      Demand& demand = points[at];
      demand.vain_rounds = at_x.particles.size() > demand.reached_by ? 0 : demand.vain_rounds + 1;
      demand.reached_by = at_x.particles.size();
    }
  });
  std::vector<Demand> demands;
  for (std::size_t at = 0; at < points.size(); ++at)
    if (steep[at]) demands.push_back(points[at]);
  return demands;
}

/// The demands that growing may still help, with wider supports.
std::vector<Demand> grown(std::vector<Demand>& demands, const SupportOptions& options) {
  std::vector<Demand> open;
  for (Demand& demand : demands) {
    if (demand.vain_rounds > most_vain_rounds) continue;
    demand.radius *= options.growth;
    open.push_back(demand);
  }
  return open;
}

/// Brings detours and radii together: where there are any, no radius exceeds `widest`.
void find_detours(const DetoursWithin& detours_within, double widest, Supports& supports) {
  const Eigen::VectorXd narrowed = supports.radii.cwiseMin(widest);
  supports.detours = detours_within(narrowed, widest);
  if (supports.detours) supports.radii = narrowed;
}

}  // namespace

std::vector<Mat3> stretches_along(const Points& particles, double radius, double most_stretch) {
  const Neighbors<3> tree(particles, Eigen::VectorXd::Constant(particles.rows(), radius));
  std::vector<Mat3> stretches(static_cast<std::size_t>(particles.rows()));
  std::vector<int> near;
  for (Index i = 0; i < particles.rows(); ++i) {
    tree.reaching(particles.row(i).transpose(), near);
    const Points around = particles(near, Eigen::all);
    const Points spread = around.rowwise() - around.colwise().mean();
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(spread.transpose() * spread);
    const double widest = std::sqrt(std::max(eigen.eigenvalues()[2], 0.0));
    Vec3 axes = eigen.eigenvalues().cwiseMax(0).cwiseSqrt().cwiseMax(widest / most_stretch);
    if (widest > 0)
      axes /= std::cbrt(axes.prod());
    else
      axes.setOnes();
    stretches[static_cast<std::size_t>(i)] =
        eigen.eigenvectors() * axes.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  }
  return stretches;
}

Supports choose_supports(const Points& particles, double spacing, const Points& cover,
                         KernelKind kernel, const SupportOptions& options,
                         const DetoursWithin& detours_within) {
  const double usual = spacing * std::cbrt(options.neighbors * 3 / (4 * std::numbers::pi));
  Supports supports;
  supports.radii = Eigen::VectorXd::Constant(particles.rows(), usual);
  if (options.kind == SupportKind::stretched)
    supports.stretches = stretches_along(particles, usual, options.most_stretch);
  const Reach reach(particles, supports.stretches, usual);
  meet(sparse_points(reach, cover, usual, options), cover, reach, nullptr, supports.radii);
  smooth(reach, usual, options.smoothness, supports.radii);

  std::vector<Demand> demands;
  for (Index k = 0; k < cover.rows(); ++k) demands.push_back({k, usual});
  for (int round = 0; round <= options.rounds && !demands.empty(); ++round) {
    if (detours_within) find_detours(detours_within, options.widest_inside * usual, supports);
    const MovingLeastSquares<3> field(particles, supports.radii, {BasisOrder::linear, kernel},
                                      supports.detours, supports.stretches);
    demands = steep_points(field, cover, std::move(demands), options.most_slope / usual, options);
    if (round == options.rounds) break;
    meet(grown(demands, options), cover, reach, supports.detours.get(), supports.radii);
    smooth(reach, usual, options.smoothness, supports.radii);
  }
  supports.thin = static_cast<long>(demands.size());
  return supports;
}

}  // namespace supple
