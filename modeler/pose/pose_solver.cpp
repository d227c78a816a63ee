#include "modeler/pose/pose_solver.h"

#include <algorithm>
#include <chrono>

#include "solver/core/rigid_motion.h"
#include "solver/minimize/minimize.h"

namespace supple {
namespace {

/// Steps on the way only prepare the next one.
constexpr double tolerance_on_the_way = 1e-4;

}  // namespace

PoseSolver::PoseSolver(const MovingLeastSquares<3>& field, const Samples& quadrature,
                       const Eigen::VectorXd& volumes, const HandleSamples& handles,
                       const PoseWeights& weights)
    : particles_(field.positions()),
      handles_(handles),
      handle_samples_(sample_field(field, handles.rest(), SampleContent::values)),
      handle_energy_(handles.rest()),
      energy_(particles_.rows()) {
  const Eigen::VectorXd shares = volumes / volumes.sum();
  energy_.add(handle_energy_, handle_samples_, handles.weights(), weights.handles);
  energy_.add(rigidity_, quadrature, shares, weights.rigidity);
  if (weights.volume > 0) energy_.add(volume_, quadrature, shares, weights.volume);
}

Report PoseSolver::solve(const MinimizeOptions& options, int substeps,
                         const std::function<void(double)>& on_step, Points& u) {
  const Preconditioner preconditioner(energy_);
  Points before = handles_.targets(0);
  Report report;
  int iterations = 0;
  for (int step = 1; step <= substeps; ++step) {
    const bool last = step == substeps;
    const Points targets = handles_.targets(last ? 1.0 : double(step) / substeps);
    handle_energy_.set_targets(targets);
    predict(before, targets, u);
    MinimizeOptions step_options = options;
    if (!last) step_options.tolerance = std::max(options.tolerance, tolerance_on_the_way);
    report = minimize(energy_, preconditioner, step_options, u);
    iterations += report.iterations;
    if (report.status == Status::failed) break;
    before = targets;
    on_step(double(step) / substeps);
  }
  report.iterations = iterations;
  return report;
}

void PoseSolver::predict(const Points& targets_before, const Points& targets, Points& u) const {
  const RigidMotion motion = best_fit_motion(targets_before, targets, handles_.weights());
  Points moved = ((particles_ + u) * motion.R.transpose()).rowwise() + motion.t.transpose();
  moved -= particles_;
  if (energy_.evaluate(moved) < energy_.evaluate(u)) u = moved;
}

std::vector<std::pair<std::string, double>> PoseSolver::time_shares(const Points& u) const {
  using Clock = std::chrono::steady_clock;
  std::vector<std::pair<std::string, double>> shares;
  double total = 0;
  for (const EnergyGroup& group : energy_.groups())
    for (const EnergyGroup::Term& term : group.terms) {
      EnergySum alone(particles_.rows());
      alone.add(*term.energy, *group.samples, group.sample_weights, term.weight);
      Points gradient;
      const auto start = Clock::now();
      alone.evaluate(u, &gradient);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      shares.emplace_back(std::string(term.energy->name()), seconds);
      total += seconds;
    }
  for (auto& [name, share] : shares) share /= total;
  return shares;
}

}  // namespace supple
