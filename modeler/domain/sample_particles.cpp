#include "modeler/domain/sample_particles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "modeler/domain/covering_radius.h"
#include "modeler/domain/point_blocks.h"
#include "modeler/domain/shape_error.h"
#include "modeler/domain/site_tree.h"
#include "modeler/domain/volume_samples.h"
#include "solver/core/check.h"
#include "solver/core/parallel.h"

namespace supple {

namespace {

constexpr double least_pair = 0.7, greatest_cover = 1.2;  // of the spacing
constexpr double spread_cover = 0.9;   // of the spacing: farthest points then are about V/s³
constexpr double refill_cover = 1.05;  // of the spacing
constexpr double crowded = 0.78;       // of the spacing
constexpr double good = 0.8;           // badness that ends relaxing
constexpr double tolerance = 0.02;     // of the covering radius, of the spacing
constexpr double most_particles = 1e6;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_rounds = 8, relaxations_a_round = 4, most_gaps = 5;

/// The closest two sites and the place farthest from all.
struct Evenness {
  SiteTree::Pair closest;
  double cover = 0;
  Vec3 gap;
};

/// Sites spread through a region's volume samples.
class Sampler {
 public:
  Sampler(const Region& region, const ParticleSamplingOptions& options)
      : region_(region), options_(options), samples_(sample()), blocks_(samples_.positions) {}

  ParticleSampling run() {
    Points sites = relaxed(spread());
    Evenness evenness = measure(sites);
    for (int gaps = 0; gaps < most_gaps && badness(evenness) > 1; ++gaps) {
      fill(sites, evenness);
      evenness = measure(sites);
    }
    // Farthest points alone are even, if not by much.
    if (badness(evenness) > 1) {
      sites = spread();
      evenness = measure(sites);
    }
    return result(std::move(sites), evenness);
  }

 private:
  VolumeSamples sample() const {
    const double share = std::max(options_.candidates, 8);
    VolumeSampleOptions how;
    how.seed = options_.seed;
    how.width = rough_spacing() / std::cbrt(share);
    how.enough = static_cast<Index>(share * rough_count());
    VolumeSamples samples = sample_volume(region_, how);
    for (int halving = 0; samples.volumes.size() < rough_count() && halving < 4; ++halving) {
      how.width *= 0.5;
      how.enough *= 8;
      samples = sample_volume(region_, how);
    }
    if (samples.volumes.size() == 0)
      throw ShapeError("no inside found: the shape is thinner everywhere than can be sampled");
    return samples;
  }

  bool by_spacing() const { return options_.spacing > 0; }

  double rough_spacing() const {
    return by_spacing() ? options_.spacing : std::cbrt(region_.volume() / options_.count);
  }

  Index rough_count() const {
    if (!by_spacing()) return options_.count;
    return static_cast<Index>(std::ceil(region_.volume() / std::pow(options_.spacing, 3)));
  }

  /// Farthest points: the closest two are no closer than the gaps are wide.
  Points spread() const {
    const Vec3 center = samples_.positions.transpose() * samples_.volumes / samples_.volumes.sum();
    return blocks_.farthest_points(Points(0, 3), center, until(spread_cover));
  }

  /// Farthest points are added until they are so many, or the gaps `cover` spacings wide.
  PointBlocks::Continue until(double cover) const {
    return [this, cover](Index sites, double distance) {
      return by_spacing() ? distance > cover * options_.spacing : sites < options_.count;
    };
  }

  /// Lloyd: each site goes to the centroid of its cell.
  void relax(Points& sites, int steps) const {
    for (int step = 0; step < steps; ++step) {
      const std::vector<int> cells = blocks_.nearest_sites(sites).sites;
      Points centroids = Points::Zero(sites.rows(), 3);
      const Eigen::VectorXd volumes = cell_volumes(cells, sites.rows());
      for (Index i = 0; i < samples_.positions.rows(); ++i)
        centroids.row(cells[i]) += samples_.volumes[i] * samples_.positions.row(i);
      for (Index i = 0; i < sites.rows(); ++i)
        if (volumes[i] > 0) sites.row(i) = centroids.row(i) / volumes[i];
    }
    bring_inside(sites);
  }

  Eigen::VectorXd cell_volumes(const std::vector<int>& cells, Index count) const {
    Eigen::VectorXd volumes = Eigen::VectorXd::Zero(count);
    for (Index i = 0; i < samples_.volumes.size(); ++i) volumes[cells[i]] += samples_.volumes[i];
    return volumes;
  }

  /// Sites that left the region go to the nearest sample of their cell.
  void bring_inside(Points& sites) const {
    const std::vector<int> cells = blocks_.nearest_sites(sites).sites;
    std::vector<double> squared_distances(sites.rows(), -1);  // of sites outside
    parallel_chunks(sites.rows(), 32, [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i)
        if (!region_.contains(sites.row(i))) squared_distances[i] = infinity;
    });
    Points moved = sites;
    for (Index i = 0; i < samples_.positions.rows(); ++i) {
      const int site = cells[i];
      if (squared_distances[site] < 0) continue;
      const double d2 = (samples_.positions.row(i) - sites.row(site)).squaredNorm();
      if (d2 >= squared_distances[site]) continue;
      squared_distances[site] = d2;
      moved.row(site) = samples_.positions.row(i);
    }
    sites = std::move(moved);
  }

  Evenness measure_quickly(const Points& sites) const {
    Index sample;
    const double cover2 = blocks_.nearest_sites(sites).squared_distances.maxCoeff(&sample);
    return {SiteTree(sites).closest_pair(), std::sqrt(cover2), samples_.positions.row(sample)};
  }

  Evenness measure(const Points& sites) const {
    const double spacing = spacing_of(measure_quickly(sites));
    const Covering covering = covering_radius(region_, samples_.cells, sites, tolerance * spacing);
    const RegionCell& cell = covering.farthest;
    const Vec3 gap = cell.center_inside
                         ? cell.center
                         : inside_at_boundary(region_, cell).value_or(cell.boundary_point);
    return {SiteTree(sites).closest_pair(), covering.radius, gap};
  }

  /// s that lies between what the covering radius and the closest pair allow.
  double spacing_of(const Evenness& evenness) const {
    if (by_spacing()) return options_.spacing;
    const double least = evenness.cover / greatest_cover;
    return std::max(least, std::min(rough_spacing(), evenness.closest.distance / least_pair));
  }

  /// At most 1 where both bounds of the contract hold for some spacing (the given one).
  double badness(const Evenness& e) const {
    if (!by_spacing()) return e.cover * least_pair / (e.closest.distance * greatest_cover);
    return std::max(least_pair * options_.spacing / e.closest.distance,
                    e.cover / (greatest_cover * options_.spacing));
  }

  /// Crowded sites leave and farthest points fill the gaps.
  Points refill(Points sites, const Evenness& e) const {
    const double near = std::max(crowded * spacing_of(e), (1 + 1e-9) * e.closest.distance);
    SiteTree::Pair pair = e.closest;
    while (pair.distance < near) {
      const Index last = sites.rows() - 1;
      sites.row(pair.b) = sites.row(last).eval();
      sites.conservativeResize(last, 3);
      pair = SiteTree(sites).closest_pair();
    }
    return blocks_.farthest_points(sites, sites.row(0), until(refill_cover));
  }

  /// Puts a site into the widest gap: one of the closest two where the number is given.
  void fill(Points& sites, const Evenness& e) const {
    if (by_spacing()) sites.conservativeResize(sites.rows() + 1, 3);
    sites.row(by_spacing() ? sites.rows() - 1 : e.closest.b) = e.gap.transpose();
  }

  /// The most even of several rounds of relaxing and refilling.
  Points relaxed(Points sites) const {
    Points best = sites;
    double least = infinity;
    for (int round = 0; round < most_rounds && least > good; ++round) {
      relax(sites, round == 0 ? options_.relaxations : relaxations_a_round);
      const Evenness evenness = measure_quickly(sites);
      if (badness(evenness) < least) {
        least = badness(evenness);
        best = sites;
      }
      sites = refill(std::move(sites), evenness);
    }
    return best;
  }

  ParticleSampling result(Points sites, const Evenness& evenness) {
    ParticleSampling sampling;
    Particles& particles = sampling.particles;
    particles.volumes = cell_volumes(blocks_.nearest_sites(sites).sites, sites.rows());
    // A site between samples may have none of its own.
    const double least = 1e-3 * samples_.volumes.mean();
    particles.volumes = particles.volumes.cwiseMax(least);
    particles.volumes *= region_.volume() / particles.volumes.sum();
    particles.positions = std::move(sites);
    particles.spacing = spacing_of(evenness);
    sampling.covering_radius = evenness.cover;
    sampling.min_pair_distance =
        particles.size() > 1 ? evenness.closest.distance : particles.spacing;
    sampling.samples = std::move(samples_);
    return sampling;
  }

  const Region& region_;
  const ParticleSamplingOptions& options_;
  VolumeSamples samples_;
  PointBlocks blocks_;
};

}  // namespace

ParticleSampling sample_particles(const Region& region, const ParticleSamplingOptions& options) {
  check_particle_count(region, options.count, options.spacing);
  return Sampler(region, options).run();
}

void check_particle_count(const Region& region, int count, double spacing) {
  SUPPLE_CHECK(spacing > 0 || count > 0, "neither a spacing nor a count");
  const double about =
      spacing > 0 ? region.volume() / std::pow(spacing, 3) : static_cast<double>(count);
  if (!(about <= most_particles))
    throw ShapeError(fmt::format(
        "this shape would take about {:.2g} particles; allowed: at most {:.2g}; give a greater "
        "spacing or fewer particles",
        about, most_particles));
}

}  // namespace supple
