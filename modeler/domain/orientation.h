#pragma once

#include <Eigen/Core>

#include "solver/core/types.h"

namespace supple {

// Signs that rounding cannot upset: computed in double, and where that is not sure, exactly.
// Coordinates between 1e-70 and 1e70 in magnitude, or 0 (their products must not underflow).
// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997.

/// 1 where d lies below the plane through a, b, c (which turn counter-clockwise seen from above),
/// −1 above, 0 in it: the sign of det(a−d, b−d, c−d).
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// 1 where a, b, c turn counter-clockwise, −1 clockwise, 0 on a line.
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace supple
