#include "solver/field/supports.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/field/neighbors.h"

namespace supple {
namespace {

/// A particle should reach a little beyond what it must cover: at its very rim its weight is 0.
constexpr double reach_share = 0.9;

/// Smallest standard deviation of the particles' positions, over any direction [m].
double least_deviation(const Points& particles, const std::vector<int>& chosen) {
  Vec3 mean = Vec3::Zero();
  for (const int i : chosen) mean += particles.row(i).transpose();
  mean /= static_cast<double>(chosen.size());
  Mat3 scatter = Mat3::Zero();
  for (const int i : chosen) {
    const Vec3 d = particles.row(i).transpose() - mean;
    scatter += d * d.transpose();
  }
  scatter /= static_cast<double>(chosen.size());
  const double least = Eigen::SelfAdjointEigenSolver<Mat3>(scatter).eigenvalues()[0];
  return std::sqrt(std::max(0.0, least));
}

/// What one point asks of the particles near it.
struct Demand {
  std::vector<int> particles;
  double radius = 0;
  bool thin = false;
};

/// The nearest particles that are enough and in general position, and the radius that reaches
/// the point from each of them.
Demand demand_at(const Vec3& x, const Points& particles, const Neighbors<3>& tree,
                 const SupportOptions& options) {
  const std::vector<int> near = tree.nearest(x, options.most_neighbors);
  std::size_t count = std::min<std::size_t>(near.size(), options.least_neighbors);
  Demand demand;
  for (;; count = std::min(near.size(), count + 4)) {
    demand.particles.assign(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count));
    const double distance = (particles.row(demand.particles.back()).transpose() - x).norm();
    demand.radius = distance / reach_share;
    if (least_deviation(particles, demand.particles) >= options.least_spread * demand.radius)
      return demand;
    if (count == near.size()) break;
  }
  demand.thin = true;
  demand.particles.resize(std::min<std::size_t>(near.size(), options.least_neighbors));
  demand.radius = (particles.row(demand.particles.back()).transpose() - x).norm() / reach_share;
  return demand;
}

/// h_i ← max_j (h_j − slope·|x_i − x_j|).
void smooth(const Points& particles, double slope, Eigen::VectorXd& radii) {
  const Eigen::VectorXd grown = radii;
  const double least = grown.minCoeff();
  for (Index j = 0; j < grown.size(); ++j) {
    if (grown[j] == least) continue;
    const Eigen::VectorXd distances = (particles.rowwise() - particles.row(j)).rowwise().norm();
    radii = radii.cwiseMax((grown[j] - slope * distances.array()).matrix());
  }
}

}  // namespace

Supports choose_supports(const Points& particles, double spacing, const Points& cover,
                         const SupportOptions& options) {
  const double usual = spacing * std::cbrt(options.neighbors * 3 / (4 * std::numbers::pi));
  Supports supports;
  supports.radii = Eigen::VectorXd::Constant(particles.rows(), usual);
  const Neighbors<3> tree(particles, supports.radii);

  std::vector<Demand> demands(static_cast<std::size_t>(cover.rows()));
  parallel_chunks(cover.rows(), 256, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k)
      demands[static_cast<std::size_t>(k)] =
          demand_at(cover.row(k).transpose(), particles, tree, options);
  });
  for (const Demand& demand : demands) {
    if (demand.thin) ++supports.thin;
    if (demand.radius <= usual) continue;
    for (const int i : demand.particles)
      supports.radii[i] = std::max(supports.radii[i], demand.radius);
  }
  smooth(particles, options.slope, supports.radii);
  return supports;
}

}  // namespace supple
