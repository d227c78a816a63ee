#pragma once

#include <memory>

#include "tests/bench/references/drag_problem.h"

namespace supple::bench {

/// Frozen reference: Ceres' Levenberg–Marquardt with a residual block a sample and analytic
/// Jacobians, sparse normal Cholesky; the problem is built once and used for every step.
class TrustRegion {
 public:
  explicit TrustRegion(const DragProblem& problem);
  ~TrustRegion();

  /// From where the last step ended; stops at a relative change of energy. The energy there.
  double solve(const Points& targets, double tolerance);
  int iterations() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace supple::bench
