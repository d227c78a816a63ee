#pragma once

#include <vector>

#include "solver/minimize/preconditioner.h"
#include "tests/bench/references/drag_problem.h"

namespace supple::bench {

/// Frozen reference, the limit: the drag step written out by hand for this one energy, with the
/// same preconditioner. No terms, no completed gradients, no constraints, no report: what any
/// structure costs shows against it.
class Limit {
 public:
  Limit(const DragProblem& problem, const Preconditioner& preconditioner);

  /// From where the last step ended; stops at a relative change of energy. The energy there.
  double solve(const Points& targets, double tolerance);

 private:
  struct Entry {
    double x, y, z;  ///< ∇φ; φ in x for handles
    long particle;
  };
  static constexpr int memory = 8;

  double evaluate(const PaddedPoints& u);
  void shape_energy(const PaddedPoints& u, double& value);
  void handle_energy(const PaddedPoints& u, double& value);

  const DragProblem& problem_;
  const Preconditioner& preconditioner_;
  std::vector<Entry> shape_, handle_;
  PaddedPoints targets_, rest_;
  PaddedPoints u_, trial_, by_u_, by_y_, before_, d_, step_;
  PaddedPoints s_[memory], y_[memory];
  double sy_[memory];
};

}  // namespace supple::bench
