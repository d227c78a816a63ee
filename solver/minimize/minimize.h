#pragma once

#include "solver/core/report.h"
#include "solver/energy/energy_sum.h"
#include "solver/minimize/minimize_options.h"
#include "solver/minimize/preconditioner.h"

namespace supple {

/// Minimises `energy` over the displacements `u` [m] N×3, starting from what they hold; on
/// return they hold the best found, also where the report is not ok. Never leaves NaN in them.
///
/// The preconditioner may be older than the handles' targets, never than the handles themselves.
SUPPLE_API Report minimize(const EnergySum& energy, const Preconditioner& preconditioner,
                           const MinimizeOptions& options, Points& u);

/// The parts of minimize(), one a method: L-BFGS of Ceres' GradientProblemSolver on the
/// preconditioned unknowns; Ceres' Levenberg–Marquardt with analytic Jacobians, a residual block
/// a sample, sparse normal Cholesky.
Report minimize_lbfgs(const EnergySum& energy, const Preconditioner& preconditioner,
                      const MinimizeOptions& options, Points& u);
Report minimize_trust_region(const EnergySum& energy, const MinimizeOptions& options, Points& u);

}  // namespace supple
