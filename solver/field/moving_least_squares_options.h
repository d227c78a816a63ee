#pragma once

#include "solver/core/describe.h"
#include "solver/core/export.h"

namespace supple {

/// Polynomials that the field reproduces exactly.
enum class BasisOrder { constant = 0, linear = 1, quadratic = 2 };
SUPPLE_API EnumNames<BasisOrder> enum_names(BasisOrder);

/// Weight functions of distance over support radius; `box` is Guo & Qin's product of three
/// one-dimensional kernels (Eq. 12, 13 with the distance's absolute value). With `singular` the
/// field takes the particles' own values at the particles.
enum class KernelKind { polynomial, wendland, cubic_spline, gaussian, box, singular };
SUPPLE_API EnumNames<KernelKind> enum_names(KernelKind);

/// `full`: the derivative of the shape functions. `least_squares`: the gradient of the weighted
/// linear fit, ∇u(x) = A⁻¹ Σ w_j (u_j − u(x))(x_j − x) with A = Σ w_j (x_j − x)(x_j − x)ᵀ
/// (Adams & Wicke 2009, Eq. 37): cheaper, the same for affine fields, and not the derivative of
/// the field that it goes with for others.
enum class GradientKind { full, least_squares };
SUPPLE_API EnumNames<GradientKind> enum_names(GradientKind);

/// `round`: balls, or the box kernel's cubes. `stretched`: ellipsoids along thin parts.
enum class SupportKind { round, stretched };
SUPPLE_API EnumNames<SupportKind> enum_names(SupportKind);

}  // namespace supple
