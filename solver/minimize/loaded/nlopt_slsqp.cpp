#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlopt.h>

#include "solver/minimize/loaded/minimizers.h"

namespace supple {
namespace {

/// What NLopt is shown where the energy is not finite, and how often before it is stopped: its
/// algorithms may hang on NaN, or throw.
constexpr double no_finite_energy = 1e100;
constexpr int most_rejected = 50;

/// NLopt takes 0 for no limit [s].
constexpr double least_seconds = 1e-9;

constexpr double constraint_tolerance = 1e-12;

/// The energy and the tied directions as functions of the preconditioned unknowns.
class Problem {
 public:
  Problem(const EnergySum& energy, const Preconditioner& preconditioner,
          const HardConstraints* constraints, const Points& start, nlopt_opt solver)
      : energy_(energy),
        preconditioner_(preconditioner),
        constraints_(constraints),
        start_(start),
        solver_(solver) {
    nlopt_set_min_objective(solver, value, this);
    if (!constraints || constraints->tied() == 0) return;
    const std::vector<double> tolerances(static_cast<std::size_t>(3 * constraints->tied()),
                                         constraint_tolerance);
    nlopt_add_equality_mconstraint(solver, static_cast<unsigned>(tolerances.size()), tied, this,
                                   tolerances.data());
  }

  Points displacements(const double* y) const {
    Points u = Eigen::Map<const Points>(y, start_.rows(), 3);
    preconditioner_.to_displacements(u);
    return u += start_;
  }

  int evaluations() const { return evaluations_; }
  int not_finite() const { return not_finite_; }

 private:
  static double value(unsigned, const double* y, double* gradient, void* data) {
    Problem& self = *static_cast<Problem*>(data);
    ++self.evaluations_;
    Points by_u;
    const double energy = self.energy_.evaluate(self.displacements(y), gradient ? &by_u : nullptr);
    const bool finite = std::isfinite(energy) && (!gradient || by_u.allFinite());
    if (!finite && ++self.rejected_ > most_rejected) nlopt_force_stop(self.solver_);
    if (!finite && !beyond_a_barrier(energy)) ++self.not_finite_;
    if (gradient) {
      if (finite)
        self.preconditioner_.to_gradient(by_u);
      else
        by_u.setZero(self.start_.rows(), 3);
      Eigen::Map<Points>(gradient, by_u.rows(), 3) = by_u;
    }
    return finite ? energy : no_finite_energy;
  }

  /// Qᵀ y = 0, a row for each tied direction and axis.
  static void tied(unsigned, double* result, unsigned unknowns, const double* y, double* gradient,
                   void* data) {
    const Problem& self = *static_cast<const Problem*>(data);
    const HardConstraints::Basis& Q = self.constraints_->Q();
    Eigen::Map<Points>(result, Q.cols(), 3) =
        Q.transpose() * Eigen::Map<const Points>(y, self.start_.rows(), 3);
    if (!gradient) return;
    std::fill_n(gradient, static_cast<std::size_t>(3 * Q.cols()) * unknowns, 0.0);
    for (Index row = 0; row < Q.cols(); ++row)
      for (Index axis = 0; axis < 3; ++axis)
        for (Index i = 0; i < Q.rows(); ++i)
          gradient[(3 * row + axis) * unknowns + 3 * i + axis] = Q(i, row);
  }

  const EnergySum& energy_;
  const Preconditioner& preconditioner_;
  const HardConstraints* constraints_;
  const Points& start_;
  nlopt_opt solver_;
  int evaluations_ = 0, rejected_ = 0, not_finite_ = 0;
};

Report report_of(nlopt_result result, const Problem& problem) {
  Report report;
  report.iterations = problem.evaluations();
  degrade_not_finite(problem.not_finite(), problem.evaluations(), report);
  if (result == NLOPT_MAXEVAL_REACHED)
    report.degrade({ReasonCode::max_iterations, 1, static_cast<double>(report.iterations),
                    fmt::format("stopped after {} evaluations", report.iterations)});
  else if (result == NLOPT_MAXTIME_REACHED)
    degrade_out_of_time("evaluations", report);
  else if (result < 0 && result != NLOPT_ROUNDOFF_LIMITED && result != NLOPT_FORCED_STOP)
    report.degrade({ReasonCode::not_converged, 1, 0, nlopt_result_to_string(result)});
  return report;
}

}  // namespace

Report minimize_nlopt(const EnergySum& energy, const Preconditioner& preconditioner,
                      const MinimizeOptions& options, const HardConstraints* constraints,
                      Points& u) {
  const Points start = u;
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> solver(
      nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(start.size())), nlopt_destroy);
  Problem problem(energy, preconditioner, constraints, start, solver.get());
  nlopt_set_ftol_rel(solver.get(), options.tolerance);
  nlopt_set_maxeval(solver.get(), options.max_iterations);
  nlopt_set_maxtime(solver.get(), std::max(options.most_seconds, least_seconds));
  Eigen::VectorXd y = Eigen::VectorXd::Zero(start.size());
  double value = 0;
  const nlopt_result result = nlopt_optimize(solver.get(), y.data(), &value);
  u = problem.displacements(y.data());
  return report_of(result, problem);
}

}  // namespace supple
