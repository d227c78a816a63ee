#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include "solver/minimize/loaded/minimizers.h"

namespace supple {
namespace {

/// One term at one sample: parameter blocks are the displacements in the sample's row.
class SampleCost final : public ceres::CostFunction {
 public:
  /// Counts in `not_finite` where its residual is not.
  SampleCost(const EnergyGroup& group, const EnergyGroup::Term& term, Index sample, int& not_finite)
      : samples_(*group.samples),
        energy_(*term.energy),
        sample_(sample),
        not_finite_(not_finite),
        // Ceres halves the squares.
        factor_(std::sqrt(2 * term.weight * group.sample_weights[sample])) {
    set_num_residuals(energy_.rows());
    for (int at = samples_.row_begin(sample); at < samples_.row_end(sample); ++at)
      mutable_parameter_block_sizes()->push_back(3);
  }

  bool Evaluate(double const* const* u, double* residuals, double** jacobians) const override {
    LocalResidual local;
    LocalField at = field(u);
    const std::optional<Completion> completion = samples_.completion(sample_, at.F);
    if (completion) at.F = completion->F();
    energy_.evaluate(at, local);
    for (int row = 0; row < energy_.rows(); ++row) residuals[row] = factor_ * local.r[row];
    if (!local.r.head(energy_.rows()).allFinite()) {
      not_finite_ += !beyond_a_barrier(local.r.head(energy_.rows()).sum());
      return false;  // ends this evaluation
    }
    if (!jacobians) return true;
    if (completion && energy_.argument() == Energy::Argument::gradient)
      derive_by_carried(*completion, local);
    for (std::size_t j = 0; j < parameter_block_sizes().size(); ++j)
      if (jacobians[j]) fill_jacobian(local, entry(j), jacobians[j]);
    return true;
  }

 private:
  std::size_t entry(std::size_t j) const {
    return static_cast<std::size_t>(samples_.row_begin(sample_)) + j;
  }

  /// Of a completed F, the derivative by what the particles carry of it.
  void derive_by_carried(const Completion& completion, LocalResidual& local) const {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    for (int row = 0; row < energy_.rows(); ++row) {
      const Eigen::Matrix<double, 1, 9> by_F = local.jacobian.row(row);
      const RowMajor by_carried = completion.by_carried(Eigen::Map<const RowMajor>(by_F.data()));
      local.jacobian.row(row) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(by_carried.data());
    }
  }

  /// Not completed where the span is short.
  LocalField field(double const* const* u) const {
    LocalField at;
    at.sample = sample_;
    at.f = samples_.points.row(sample_).transpose();
    for (std::size_t j = 0; j < parameter_block_sizes().size(); ++j) {
      const Eigen::Map<const Vec3> u_j(u[j]);
      if (energy_.argument() == Energy::Argument::position)
        at.f += samples_.values[entry(j)] * u_j;
      else
        at.F += u_j * samples_.gradients[entry(j)].transpose();
    }
    return at;
  }

  /// ∂r/∂u_j = φ_j ∂r/∂f, or Σ_b ∇φ_j(b) ∂r/∂F(:, b).
  void fill_jacobian(const LocalResidual& local, std::size_t at, double* jacobian) const {
    for (int row = 0; row < energy_.rows(); ++row)
      for (int a = 0; a < 3; ++a)
        jacobian[3 * row + a] =
            factor_ * (energy_.argument() == Energy::Argument::position
                           ? samples_.values[at] * local.jacobian(row, a)
                           : local.jacobian.row(row).segment<3>(3 * a).dot(samples_.gradients[at]));
  }

  const Samples& samples_;
  const Energy& energy_;
  Index sample_;
  int& not_finite_;
  double factor_;
};

void add_residuals(const EnergyGroup& group, Points& u, int& not_finite, ceres::Problem& problem) {
  const Samples& samples = *group.samples;
  for (Index k = 0; k < samples.size(); ++k) {
    if (!(group.sample_weights[k] > 0)) continue;
    std::vector<double*> blocks;
    for (int at = samples.row_begin(k); at < samples.row_end(k); ++at)
      blocks.push_back(u.row(samples.particles[static_cast<std::size_t>(at)]).data());
    for (const EnergyGroup::Term& term : group.terms)
      problem.AddResidualBlock(new SampleCost(group, term, k, not_finite), nullptr, blocks);
  }
}

}  // namespace

Report minimize_trust_region(const EnergySum& energy, const MinimizeOptions& options, Points& u) {
  const Deadline deadline(options.most_seconds);
  int not_finite = 0;  // by one thread, the default
  ceres::Problem problem;
  for (const EnergyGroup& group : energy.groups()) add_residuals(group, u, not_finite, problem);

  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  ceres_options.max_num_iterations = options.max_iterations;
  ceres_options.function_tolerance = options.tolerance;
  ceres_options.gradient_tolerance = 1e-14;
  ceres_options.parameter_tolerance = 0;
  ceres_options.max_solver_time_in_seconds =
      std::min(ceres_options.max_solver_time_in_seconds, deadline.left());
  ceres_options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_options, &problem, &summary);

  const int evaluations = summary.num_residual_evaluations + summary.num_jacobian_evaluations;
  Report report;
  report.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  degrade_not_finite(not_finite, evaluations, report);
  if (summary.termination_type == ceres::NO_CONVERGENCE &&
      report.iterations < options.max_iterations)
    degrade_out_of_time("iterations", report);
  else if (summary.termination_type == ceres::NO_CONVERGENCE)
    report.degrade({ReasonCode::max_iterations, 1, static_cast<double>(report.iterations),
                    fmt::format("stopped after {} iterations", report.iterations)});
  if (!summary.IsSolutionUsable())
    report.fail({ReasonCode::not_converged, 1, summary.final_cost, summary.message});
  return report;
}

}  // namespace supple
