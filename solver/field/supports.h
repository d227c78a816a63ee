#pragma once

#include <functional>
#include <memory>

#include "solver/core/describe.h"
#include "solver/core/export.h"
#include "solver/field/moving_least_squares.h"

namespace supple {

struct SupportOptions {
  SupportKind kind = SupportKind::round;
  double most_stretch = 3;
  double neighbors = 25;
  int least_neighbors = 8;
  double most_slope = 60;
  double growth = 1.15;
  int rounds = 12;
  double smoothness = 1;
  int least_inside = 10;
  double widest_inside = 2.5;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("kind", self.kind, {.doc = "shape of the supports"});
    visit("most_stretch", self.most_stretch,
          {.doc = "longest over shortest axis of a stretched support", .min = 1, .max = 10});
    visit("neighbors", self.neighbors,
          {.doc = "mean number of particles that reach a point inside", .min = 1});
    visit("least_neighbors", self.least_neighbors,
          {.doc = "particles that reach every covered point, at least", .min = 1});
    visit("most_slope", self.most_slope,
          {.doc = "greatest h·Σ|∇φ_j| of the shape functions, h the usual support", .min = 1});
    visit("growth", self.growth, {.doc = "of a support in one round", .min = 1.01, .max = 2});
    visit("rounds", self.rounds, {.doc = "rounds of growth at most", .min = 0, .max = 100});
    visit("smoothness", self.smoothness,
          {.doc = "by how much supports may differ over a distance", .min = 0.01});
    visit("least_inside", self.least_inside,
          {.doc = "the same where there are detours: some of these particles count little",
           .min = 1});
    visit("widest_inside", self.widest_inside,
          {.doc = "supports where there are detours, at most, in usual ones", .min = 1});
  }
};

struct Supports {
  Eigen::VectorXd radii;        ///< h_i [m], n
  std::vector<Mat3> stretches;  ///< N_i as MovingLeastSquares takes them; none where all are round
  long thin = 0;                ///< points whose shape functions stayed too steep, or of short rank
  std::shared_ptr<const Detours> detours;  ///< within these radii; null where there are none
};

/// Gives the detours within supports h_i [m] that never exceed `widest`; null where there are none.
using DetoursWithin =
    std::function<std::shared_ptr<const Detours>(const Eigen::VectorXd& supports, double widest)>;

/// Stretches N_i, of determinant 1, that follow how the particles within `radius` [m] of each
/// spread: axes as the roots of their covariance's eigenvalues, the longest at most `most_stretch`
/// times the shortest; the identity inside a body.
SUPPLE_API std::vector<Mat3> stretches_along(const Points& particles, double radius,
                                             double most_stretch);

/// Support radii that reach every point of `cover` [m] by enough particles in general position.
///
/// A common radius h for the wanted number of neighbours at the mean `spacing` [m]. Where a point
/// would have fewer than `least_neighbors`, or shape functions so steep that small displacements
/// become large strains (its particles lie near a plane, or all on one side), the supports around
/// it grow. Then they are smoothed so that |h_i − h_j| ≤ smoothness·|x_i − x_j|. Where there are
/// detours, only particles that reach a point by the way inside count for it. Stretched ones are
/// stretched first, and reach what they reach in their own measure.
SUPPLE_API Supports choose_supports(const Points& particles, double spacing, const Points& cover,
                                    KernelKind kernel = KernelKind::polynomial,
                                    const SupportOptions& options = {},
                                    const DetoursWithin& detours = {});

}  // namespace supple
