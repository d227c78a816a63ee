#pragma once

#include "solver/core/describe.h"
#include "solver/core/export.h"

namespace supple {

/// lbfgs: Ceres L-BFGS on preconditioned unknowns; trust_region: the reference;
/// nlopt: for bounds and hard constraints.
enum class MinimizerKind { lbfgs, trust_region, nlopt };
SUPPLE_API EnumNames<MinimizerKind> enum_names(MinimizerKind);

struct MinimizeOptions {
  MinimizerKind kind = MinimizerKind::lbfgs;
  int max_iterations = 2000;
  double tolerance = 1e-6;  ///< relative change of the energy between iterations
};

}  // namespace supple
