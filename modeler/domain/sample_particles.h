#pragma once

#include <cstdint>

#include "solver/core/rest_shape.h"

namespace supple {

struct ParticleSamplingOptions {
  int count = 200;         ///< how many, unless `spacing` is positive
  double spacing = 0;      ///< distance of neighbours s [m]
  int relaxations = 20;    ///< Lloyd steps at most
  int candidates = 64;     ///< sample points of the volume a particle, for cells and distances
  std::uint64_t seed = 1;
};

/// Particles spread evenly through a region, and how evenly.
struct ParticleSampling {
  Particles particles;           ///< supports are still empty
  double min_pair_distance = 0;  ///< [m], ≥ 0.7 s
  double covering_radius = 0;    ///< greatest distance from the inside to a particle [m], ≤ 1.2 s
};

/// Centroidal Voronoi sampling: farthest points, then Lloyd steps. V_i is the particle's Voronoi
/// cell, ΣV_i the region's volume. The same region and options give the same particles on every
/// machine. Where `count` is given, s is (V/N)^⅓, moved as little as both bounds ask (thin shapes).
/// Of one particle alone, the pair distance is s.
/// Errors: ShapeError where no inside is found, or a spacing means more than a million particles.
ParticleSampling sample_particles(const Region& region, const ParticleSamplingOptions& options);

}  // namespace supple
