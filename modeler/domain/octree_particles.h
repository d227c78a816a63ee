#pragma once

#include "modeler/domain/octree.h"
#include "solver/core/describe.h"
#include "solver/core/rest_shape.h"
#include "solver/field/moving_least_squares_options.h"

namespace supple {

struct OctreeParticleOptions {
  int count = 200;
  double spacing = 0;
  double least_distance = 0.3;
  double cover = 3.2;
  KernelKind kernel = KernelKind::polynomial;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("count", self.count, {.doc = "how many about, unless a spacing is given", .min = 1});
    visit("spacing", self.spacing,
          {.doc = "edge of the leaves; 0: as the count asks", .unit = "m", .min = 0});
    visit("least_distance", self.least_distance,
          {.doc = "of two particles, over the leaves' edge", .min = 0, .max = 0.9});
    visit("cover", self.cover,
          {.doc = "α: edge of the cube that a particle reaches, over its leaf's", .min = 3.2});
    visit("kernel", self.kernel, {.doc = "whose supports are to be given"});
  }
};

/// One particle at the centre of each leaf that is inside or at the boundary; where the centre is
/// outside, at the nearest place just inside the boundary (Guo & Qin, section 4.1.1). Of two that
/// come too close one leaves, and its volume goes to the nearest other. V_i is the inside part of
/// the particle's leaf, ΣV_i the region's volume. The box kernel's supports are α/2 of the leaf's
/// edge; those of radial kernels have the same volume. α > 3 keeps the moment matrix regular where
/// leaves' faces lie in the boundary (errata: condition 460 at a corner for 3.2).
/// Errors: ShapeError where no inside is found, or a spacing means more than a million particles.
Particles octree_particles(const Region& region, const OctreeParticleOptions& options);

/// The same in the leaves of a given tree, graded or not; its width is taken for the spacing.
Particles particles_in_leaves(const Region& region, const Octree& octree,
                              const OctreeParticleOptions& options);

}  // namespace supple
