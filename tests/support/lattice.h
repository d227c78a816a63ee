#pragma once

#include <cmath>

#include "solver/core/random.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// Particles on a jittered lattice inside a box with its lower corner at the origin: a body whose
/// volume is known, for tests of fields and energies without a surface.
inline Particles lattice_particles(const Vec3& size, double spacing, double jitter = 0.15) {
  const Eigen::Array3i counts = (size / spacing).array().round().max(1).cast<int>();
  const Vec3 step = size.array() / counts.cast<double>();
  Random random(17);
  Particles particles;
  particles.spacing = spacing;
  particles.positions.resize(counts.prod(), 3);
  Index row = 0;
  for (int x = 0; x < counts[0]; ++x)
    for (int y = 0; y < counts[1]; ++y)
      for (int z = 0; z < counts[2]; ++z) {
        const Vec3 cell = Vec3(x, y, z) + Vec3::Constant(0.5) + random.in_cube(-jitter, jitter);
        particles.positions.row(row++) = (cell.array() * step.array()).transpose();
      }
  particles.volumes = Eigen::VectorXd::Constant(
      particles.size(), size.prod() / static_cast<double>(particles.size()));
  return particles;
}

}  // namespace supple
