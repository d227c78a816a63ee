#pragma once

#include "modeler/pose/pose_solver.h"
#include "modeler/pose/solid.h"
#include "modeler/pose/solid_field.h"

namespace supple {

/// Keeps a pose from turning inside out by a barrier in its solver, from the guard's birth on.
/// It stands where energies are summed; where vertices of the surface turn over between, solve()
/// puts it up at those as well, and the way begins again. Keeps references.
class InversionGuard {
 public:
  InversionGuard(const Solid& solid, const SolidField& field, PoseSolver& solver);

  /// PoseSolver::solve() behind the barrier. A start that is inside out is repaired with the
  /// handles at their places. Where the time is over while vertices are inside out, `u` stays where
  /// it started. Whether some are left else is for the caller to measure: the way is walked a few
  /// times at most.
  Report solve(PoseSolveOptions options, const std::function<void(double share)>& on_step,
               Points& u);

 private:
  std::vector<Index> more_to_guard(const Points& u) const;
  void guard(const std::vector<Index>& vertices);

  const Solid& solid_;
  const SolidField& field_;
  PoseSolver& solver_;
  std::vector<bool> guarded_;  ///< vertices
};

}  // namespace supple
