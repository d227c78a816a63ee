#pragma once

#include "solver/core/describe.h"
#include "solver/core/export.h"

namespace supple {

/// Polynomials that the field reproduces exactly.
enum class BasisOrder { constant = 0, linear = 1, quadratic = 2 };
SUPPLE_API EnumNames<BasisOrder> enum_names(BasisOrder);

/// Weight functions of distance over support radius; `box` is Guo & Qin's product of three
/// one-dimensional kernels (Eq. 12, 13 with the distance's absolute value).
enum class KernelKind { polynomial, wendland, box };
SUPPLE_API EnumNames<KernelKind> enum_names(KernelKind);

}  // namespace supple
