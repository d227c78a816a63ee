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
///
/// All methods but L-BFGS are loaded on first use; throws InstallationError where that fails.
SUPPLE_API Report minimize(const EnergySum& energy, const Preconditioner& preconditioner,
                           const MinimizeOptions& options, Points& u,
                           const HardConstraints* constraints = nullptr);

/// The options with no more time than is left.
SUPPLE_API MinimizeOptions within(const Deadline& deadline, MinimizeOptions options);

/// What an L-BFGS solve came to, in words.
SUPPLE_API Report report_of(const Lbfgs::Result& result);

/// Degrades for the time, which was over after the report's iterations, counted in `steps`.
SUPPLE_API void degrade_out_of_time(std::string_view steps, Report& report);

/// Degrades where a minimiser met an energy that was not finite, and says how often.
SUPPLE_API void degrade_not_finite(int count, int evaluations, Report& report);

}  // namespace supple
