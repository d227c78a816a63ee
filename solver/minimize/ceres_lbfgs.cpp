#include <algorithm>
#include <cmath>

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/iteration_callback.h>
#include <fmt/format.h>

#include "solver/minimize/minimize.h"

namespace supple {
namespace {

/// E as a function of the preconditioned unknowns y, u = start + Pᵀ L⁻ᵀ y.
class PreconditionedEnergy final : public ceres::FirstOrderFunction {
 public:
  PreconditionedEnergy(const EnergySum& energy, const Preconditioner& preconditioner,
                       const HardConstraints* constraints, const Points& start)
      : energy_(energy),
        preconditioner_(preconditioner),
        constraints_(constraints),
        start_(start) {}

  int NumParameters() const override { return static_cast<int>(start_.size()); }

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    u_ = displacements(parameters);
    *cost = energy_.evaluate(u_, gradient ? &gradient_ : nullptr);
    ++evaluations_;
    if (!std::isfinite(*cost)) {
      ++not_finite_;
      return false;
    }
    if (gradient) {
      preconditioner_.to_gradient(gradient_);
      if (constraints_) constraints_->project(gradient_);
      Eigen::Map<Points>(gradient, start_.rows(), 3) = gradient_;
    }
    return true;
  }

  int evaluations() const { return evaluations_; }
  int not_finite() const { return not_finite_; }

  Points displacements(const double* parameters) const {
    Points u = Eigen::Map<const Points>(parameters, start_.rows(), 3);
    if (constraints_) constraints_->project(u);
    preconditioner_.to_displacements(u);
    return u += start_;
  }

 private:
  const EnergySum& energy_;
  const Preconditioner& preconditioner_;
  const HardConstraints* constraints_;
  const Points& start_;
  mutable Points u_, gradient_;
  mutable int evaluations_ = 0, not_finite_ = 0;
};

/// Stops where so little of the energy at the start is left that it counts as none: a minimum of
/// zero, as of a rigid motion, is come closer to for ever.
class NothingLeft final : public ceres::IterationCallback {
 public:
  explicit NothingLeft(double share) : share_(share) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    if (iteration.iteration == 0) start_ = iteration.cost;
    return iteration.cost <= share_ * start_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                             : ceres::SOLVER_CONTINUE;
  }

 private:
  const double share_;
  double start_ = 0;
};

ceres::GradientProblemSolver::Options solver_options(const MinimizeOptions& options) {
  ceres::GradientProblemSolver::Options ceres_options;
  ceres_options.line_search_direction_type = ceres::LBFGS;
  ceres_options.line_search_type = ceres::WOLFE;
  ceres_options.max_lbfgs_rank = 20;
  ceres_options.max_num_iterations = options.max_iterations;
  ceres_options.function_tolerance = options.tolerance;
  ceres_options.gradient_tolerance = 1e-12;
  ceres_options.parameter_tolerance = 0;
  ceres_options.logging_type = ceres::SILENT;
  return ceres_options;
}

}  // namespace

Report minimize_lbfgs(const EnergySum& energy, const Preconditioner& preconditioner,
                      const MinimizeOptions& options, const HardConstraints* constraints,
                      Points& u) {
  const Points start = u;
  auto* function = new PreconditionedEnergy(energy, preconditioner, constraints, start);
  const ceres::GradientProblem problem(function);  // owns the function
  Eigen::VectorXd y = Eigen::VectorXd::Zero(start.size());
  ceres::GradientProblemSolver::Summary summary;
  ceres::GradientProblemSolver::Options ceres_options = solver_options(options);
  NothingLeft nothing_left(options.tolerance * options.tolerance);
  ceres_options.callbacks.push_back(&nothing_left);
  ceres::Solve(ceres_options, problem, y.data(), &summary);

  Report report;
  u = function->displacements(y.data());
  report.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  note_not_finite(function->not_finite(), function->evaluations(), report);
  if (summary.termination_type == ceres::NO_CONVERGENCE)
    report.degrade({ReasonCode::max_iterations, 1, static_cast<double>(report.iterations),
                    fmt::format("stopped after {} iterations", report.iterations)});
  if (summary.termination_type == ceres::FAILURE)
    report.degrade({ReasonCode::not_converged, 1, summary.final_cost, summary.message});
  return report;
}

}  // namespace supple
