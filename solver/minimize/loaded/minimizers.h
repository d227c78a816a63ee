#pragma once

#include "solver/minimize/minimize.h"

namespace supple {

/// Ceres' Levenberg–Marquardt with analytic Jacobians, a residual block a sample, sparse normal
/// Cholesky.
Report minimize_trust_region(const EnergySum& energy, const MinimizeOptions& options, Points& u);

/// NLopt's SLSQP, for a hundred particles or so.
Report minimize_nlopt(const EnergySum& energy, const Preconditioner& preconditioner,
                      const MinimizeOptions& options, const HardConstraints* constraints,
                      Points& u);

/// What this folder's library is loaded for, as methods of minimize().
struct Minimizers {
  decltype(minimize_trust_region)* trust_region;
  decltype(minimize_nlopt)* nlopt;
};

/// Loaded by the first call, from where the solver lies; throws InstallationError.
const Minimizers& minimizers();

}  // namespace supple

/// The one name that the solver asks the library for.
extern "C" SUPPLE_API const supple::Minimizers* supple_minimizers();
