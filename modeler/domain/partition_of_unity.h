#pragma once

#include <vector>

#include "modeler/domain/local_quadric.h"
#include "solver/core/describe.h"
#include "solver/core/types.h"

namespace supple {

struct PartitionOptions {
  double tolerance = 2e-4;
  int neighbors = 18;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("tolerance", self.tolerance,
          {.doc = "cells are halved until their quadrics are off the points by no more than this, "
                  "or by the points' noise",
           .unit = "m",
           .min = 0});
    visit("neighbors", self.neighbors,
          {.doc = "of a point that show the surface in spite of noise", .min = 1});
  }
};

/// A smooth function near oriented points whose zero set is their surface: about the signed
/// distance, negative inside. Multi-level partition of unity (Ohtake et al. 2003): an octree
/// halves its cells until a quadric follows the points in the ball about each one; where balls
/// overlap, weights that fall smoothly to zero at their rims blend the quadrics.
class PartitionOfUnity {
 public:
  /// `positions` [m] n×3, no two at one place; `normals` n×3, unit length, outward.
  PartitionOfUnity(const Points& positions, const Points& normals, const PartitionOptions& options);

  /// The function where `weight` is positive: there f and its gradient are continuous.
  struct Value {
    double weight = 0;  ///< Σ of the blending weights: 0 away from all points
    double f = 0;       ///< [m]
    Vec3 gradient = Vec3::Zero();
  };
  Value at(const Vec3& x) const;

  /// Typical distance of a point from its surface [m], and the number of quadrics.
  double noise() const { return noise_; }
  std::size_t size() const { return quadrics_.size(); }

 private:
  struct Node {
    Vec3 center;
    double squared_radius;
    int first = 0, children = 0;  ///< nodes below; none at a leaf
    int quadric = -1;             ///< of a leaf
  };
  struct Growing;
  class Builder;

  std::vector<Node> nodes_;  ///< parents before children
  std::vector<Quadric> quadrics_;
  double noise_ = 0;
};

}  // namespace supple
