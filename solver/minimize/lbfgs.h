#pragma once

#include <vector>

#include "solver/core/deadline.h"
#include "solver/energy/energy_sum.h"
#include "solver/minimize/hard_constraints.h"
#include "solver/minimize/minimize_options.h"
#include "solver/minimize/preconditioner.h"

namespace supple {

/// Limited-memory quasi-Newton minimisation on the preconditioned unknowns, with weak Wolfe steps
/// (Nocedal & Wright 2006, algorithms 3.5 and 7.4). Keeps its memory from one solve to the next:
/// only the first one of a size allocates.
class SUPPLE_API Lbfgs {
 public:
  enum class Stop { converged, max_iterations, out_of_time, stuck };

  struct Result {
    Stop stop = Stop::converged;
    double energy = 0;
    int iterations = 0, evaluations = 0;
    int not_finite =
        0;             ///< evaluations without a number, barriers apart; their steps were shortened
    int restarts = 0;  ///< times the memory of earlier steps led nowhere and was given up
  };

  /// Minimises over `u` [m] N×4, starting from what it holds, where the energy is finite. The
  /// energy never rises. With `constraints`, which `u` meets, it goes on meeting them.
  Result minimize(const EnergySum& energy, const Preconditioner& preconditioner,
                  const MinimizeOptions& options, const HardConstraints* constraints,
                  PaddedPoints& u);

 private:
  /// What is minimised; only looked at during a solve.
  struct Problem {
    const EnergySum& energy;
    const Preconditioner& preconditioner;
    const HardConstraints* constraints;
    Deadline deadline;
  };

  struct Pair {
    PaddedPoints s, y;  ///< change of the unknowns, and of the gradient by them
    double sy = 0;      ///< s·y
    double share = 0;   ///< scratch of the two loops
  };
  static constexpr std::size_t most_pairs = 8;

  Pair& pair(std::size_t age) { return pairs_[(next_ + most_pairs - 1 - age) % most_pairs]; }

  void choose_direction(const Problem& problem);
  /// Goes along step_ until the energy has fallen as it should; whether it has.
  bool walk(const Problem& problem, PaddedPoints& u, Result& result);
  double evaluate(const Problem& problem, const PaddedPoints& u, Result& result);
  void derive_by_unknowns(const Problem& problem);
  void remember(double length);
  void forget();

  std::vector<Pair> pairs_ = std::vector<Pair>(most_pairs);
  std::size_t next_ = 0, kept_ = 0;
  double scale_ = 0;               ///< the first guess of the inverse Hessian
  PaddedPoints by_u_, by_y_;       ///< gradient
  PaddedPoints by_y_before_;       ///< of the place before
  PaddedPoints direction_, step_;  ///< in y, and in u
  PaddedPoints trial_;
  PaddedPoints tied_;  ///< scratch of the constraints
};

}  // namespace supple
