#pragma once

#include "modeler/domain/octree.h"
#include "solver/core/describe.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// Points that energies are summed over, and the volume that each stands for.
struct Quadrature {
  Points points;            ///< n×3
  Eigen::VectorXd volumes;  ///< n; their sum is the solid's volume
};

struct CellQuadratureOptions {
  int order = 2;
  int halvings = 2;
  double least_share = 0.1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("order", self.order, {.doc = "points a leaf along each axis", .min = 1, .max = 3});
    visit("halvings", self.halvings,
          {.doc = "of leaves at the boundary, to find what is inside", .min = 1, .max = 6});
    visit("least_share", self.least_share,
          {.doc = "of a full point's volume: smaller ones join the greatest of their leaf",
           .min = 0,
           .max = 1});
  }
};

/// Gauss quadrature in the leaves of an octree (Guo & Qin, section 4.1.2): order³ Gauss points in
/// an interior leaf. A leaf that the boundary crosses is cut into as many boxes; what of a box is
/// inside the region becomes one point at its centroid, so that volumes and first moments are
/// kept. All volumes are positive and all points inside. The error of the volumes' sum, and of
/// integrals of smooth functions at order 2, falls with the square of the leaves' width.
Quadrature cell_quadrature(const Region& region, const Octree& octree,
                           const CellQuadratureOptions& options = {});

}  // namespace supple
