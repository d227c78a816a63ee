#pragma once

#include <span>

#include "solver/core/types.h"

namespace supple {

/// Q(x) = constant + d·slope + dᵀ curvature d, d = x − center: near its zero set about the signed
/// distance to it [m].
struct Quadric {
  Vec3 center = Vec3::Zero();
  double constant = 0;
  Vec3 slope = Vec3::UnitZ();
  Mat3 curvature = Mat3::Zero();  ///< symmetric [1/m]

  double value(const Vec3& x) const {
    const Vec3 d = x - center;
    return constant + d.dot(slope + curvature * d);
  }
  Vec3 gradient(const Vec3& x) const { return slope + 2 * (curvature * (x - center)); }
};

/// A quadric that follows oriented points, and how well.
struct QuadricFit {
  Quadric quadric;
  double rms = 0;     ///< of the points' distances to it, free of the fit's own freedom [m]
  double beyond = 0;  ///< share of the points farther from it than `far`
};

/// The height field over the plane of the chosen points' mean normal, a quadratic polynomial,
/// that lies nearest to the points and is steepest like their normals, in weighted squares.
/// Weights fall from 1 at `center` to 0 at `radius` [m]; points no farther count.
/// `chosen` ≥ 1 rows of `positions` [m] and `normals` (unit length), n×3; `far` [m].
/// Ohtake et al. 2003, Section 4.1 (b).
QuadricFit fit_quadric(const Points& positions, const Points& normals, std::span<const int> chosen,
                       const Vec3& center, double radius, double far);

/// The same over the plane of a given normal, by the points' places alone.
QuadricFit fit_quadric(const Points& positions, const Vec3& normal, std::span<const int> chosen,
                       const Vec3& center, double radius, double far);

}  // namespace supple
