#pragma once

#include <cstdint>

#include "modeler/domain/volume_samples.h"
#include "solver/core/describe.h"
#include "solver/core/rest_shape.h"

namespace supple {

struct ParticleSamplingOptions {
  int count = 200;
  double spacing = 0;
  int relaxations = 20;
  int candidates = 64;
  std::uint64_t seed = 1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("count", self.count, {.doc = "how many, unless a spacing is given", .min = 1});
    visit("spacing", self.spacing,
          {.doc = "distance of neighbours s; 0: as the count asks", .unit = "m", .min = 0});
    visit("relaxations", self.relaxations, {.doc = "Lloyd steps at most", .min = 0});
    visit("candidates", self.candidates,
          {.doc = "sample points of the volume a particle, for cells and distances", .min = 8});
    visit("seed", self.seed, {.doc = "of the sample points' places"});
  }
};

/// Particles spread evenly through a region, and how evenly.
struct ParticleSampling {
  Particles particles;           ///< supports are still empty
  double min_pair_distance = 0;  ///< [m], ≥ 0.7 s
  double covering_radius = 0;    ///< greatest distance from the inside to a particle [m], ≤ 1.2 s
  VolumeSamples samples;         ///< of the volume that they share
};

/// Centroidal Voronoi sampling: farthest points, then Lloyd steps. V_i is the particle's Voronoi
/// cell, ΣV_i the region's volume. The same region and options give the same particles on every
/// machine. Where `count` is given, s is (V/N)^⅓, moved as little as both bounds ask (thin shapes).
/// Of one particle alone, the pair distance is s.
/// Errors: ShapeError where no inside is found, or a spacing means more than a million particles.
ParticleSampling sample_particles(const Region& region, const ParticleSamplingOptions& options);

/// Says so where a count, or in its stead a spacing [m], means more than a million particles.
/// Errors: ShapeError.
void check_particle_count(const Region& region, int count, double spacing);

}  // namespace supple
