#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Root mean square over the points of |x − reference|; both in the same unit, n×3.
double rms_distance(const Points& x, const Points& reference);

/// The result on one discretisation.
struct GridLevel {
  const Points* positions;
  double unknowns;
};

/// Orders of convergence that are believed.
inline constexpr double least_order = 0.5, greatest_order = 4.5;

/// What stands for the exact result, and how far the exact one may be from it.
struct Reference {
  Points positions;
  double uncertainty = 0;       ///< root mean square, as `rms_distance`
  std::optional<double> order;  ///< observed, in the spacing h ~ unknowns^(−1/3)
  bool plausible = false;       ///< whether that order can be believed
};

/// Richardson extrapolation of results whose error falls as h^p: x = x₁ + (x₁ − x₂)/(r^p − 1), with
/// 1 the finest level, r = h₂/h₁ and p such that e₃₂/e₂₁ = r₂₁^p (r₃₂^p − 1)/(r₂₁^p − 1). The band
/// is the grid convergence index Fs·e₂₁/(r^p − 1): Fs = 1.25 from three levels with a plausible
/// order; else 3, with the expected order 2 of a linear basis [Roache 1994; Celik et al. 2008].
/// `levels` from coarse to fine; none where there are fewer than two different ones.
std::optional<Reference> extrapolate(const std::vector<GridLevel>& levels);

}  // namespace supple
