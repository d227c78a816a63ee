#pragma once

#include "modeler/pose/pose_solver.h"
#include "modeler/pose/solid.h"
#include "modeler/pose/solid_field.h"

namespace supple {

/// PoseSolver::solve() behind a barrier against turning inside out. It stands where energies are
/// summed; where vertices of the surface turn over between, it is put up at those as well, and the
/// way begins again, a few times at most: whether some are left is for the caller to measure.
Report solve_without_inversion(const Solid& solid, const SolidField& field,
                               PoseSolveOptions options,
                               const std::function<void(double share)>& on_step, PoseSolver& solver,
                               Points& u);

}  // namespace supple
