#pragma once

#include "modeler/pose/solid.h"
#include "modeler/surface/surface_embedding.h"

namespace supple {

/// The field over a solid's particles, its samples where energies are summed, and its surface.
struct SolidField {
  MovingLeastSquares<3> mls;
  Quadrature points;
  Samples quadrature;
  SurfaceEmbedding surface;

  SolidField(const Solid& solid, const ShapeSpec& shape, SurfaceKind surface_kind)
      : mls(solid.particles().positions, solid.particles().supports,
            {shape.basis, shape.kernel, shape.gradient}, solid.detours(),
            solid.particles().stretches),
        points(solid.quadrature(shape.quadrature)),
        quadrature(sample_field(mls, points.points, SampleContent::values_and_gradients)),
        surface(mls, quadrature, solid.inner_vertices(), surface_kind) {}
  SolidField(const SolidField&) = delete;
};

}  // namespace supple
