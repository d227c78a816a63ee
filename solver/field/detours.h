#pragma once

#include <vector>

#include "solver/core/types.h"
#include "solver/field/derivatives.h"

namespace supple {

/// How much longer the way inside the shape from a point x to a particle is than the straight
/// line, with its derivatives by x as far as they were asked for.
struct Detour {
  int particle = 0;
  double length = 0;              ///< δ [m] ≥ 0
  Vec3 slope = Vec3::Zero();      ///< ∂δ/∂x
  Mat3 curvature = Mat3::Zero();  ///< ∂²δ/∂x² [1/m]
};

/// What keeps two fingers that nearly touch from feeling each other: a particle's weight at x
/// falls with its detour, to nothing where δ reaches the support radius. δ is C¹ inside the shape
/// and zero wherever the straight line stays inside.
class Detours {
 public:
  virtual ~Detours() = default;

  /// The detours at x [m] that are not zero, ascending by particle. A particle that cannot be
  /// reached at all has a length beyond every support.
  virtual void at(const Vec3& x, Derivatives derivatives, std::vector<Detour>& detours) const = 0;
};

}  // namespace supple
