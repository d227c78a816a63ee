#pragma once

#include <string_view>

#include "solver/core/report.h"
#include "solver/energy/energy_sum.h"
#include "solver/minimize/hard_constraints.h"
#include "solver/minimize/lbfgs.h"
#include "solver/minimize/minimize_options.h"
#include "solver/minimize/preconditioner.h"

namespace supple {

/// Minimises `energy` over the displacements `u` [m] N×3, starting from what they hold; on
/// return they hold the best found, also where the report is not ok. Never leaves NaN in them.
///
/// The preconditioner may be older than the handles' targets, never than the handles themselves.
/// With `constraints`, which `u` meets, it goes on meeting them; the trust region takes none.
SUPPLE_API Report minimize(const EnergySum& energy, const Preconditioner& preconditioner,
                           const MinimizeOptions& options, Points& u,
                           const HardConstraints* constraints = nullptr);

/// The options with no more time than is left.
SUPPLE_API MinimizeOptions within(const Deadline& deadline, MinimizeOptions options);

/// The other methods of minimize(): Ceres' Levenberg–Marquardt with analytic Jacobians, a residual
/// block a sample, sparse normal Cholesky; NLopt's SLSQP, for a hundred particles or so.
Report minimize_nlopt(const EnergySum& energy, const Preconditioner& preconditioner,
                      const MinimizeOptions& options, const HardConstraints* constraints,
                      Points& u);
Report minimize_trust_region(const EnergySum& energy, const MinimizeOptions& options, Points& u);

/// What an L-BFGS solve came to, in words.
SUPPLE_API Report report_of(const Lbfgs::Result& result);

/// Degrades for the time, which was over after the report's iterations, counted in `steps`.
void degrade_out_of_time(std::string_view steps, Report& report);

/// Degrades where a minimiser met an energy that was not finite, and says how often.
void degrade_not_finite(int count, int evaluations, Report& report);

}  // namespace supple
