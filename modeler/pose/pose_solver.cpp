#include "modeler/pose/pose_solver.h"

#include <algorithm>

#include <fmt/format.h>

#include "solver/core/rigid_motion.h"
#include "solver/core/stopwatch.h"
#include "solver/field/pieces.h"

namespace supple {
namespace {

/// Steps on the way only prepare the next one.
constexpr double tolerance_on_the_way = 1e-4;

/// A step is halved this often at most.
constexpr double smallest_step = 1.0 / 8;

/// Energies below this are rounding.
constexpr double no_energy = 1e-9;

std::vector<bool> particles_held(const Samples& quadrature, const Samples& handles,
                                 Index particles) {
  Pieces pieces(particles);
  pieces.tie(quadrature);
  return pieces.reached_by(handles);
}

double total_energy(const Report& report) {
  double sum = 0;
  for (const auto& [name, value] : report.energies) sum += value;
  return sum;
}

/// Adds a step's reasons and iterations to the whole way's.
void merge(const Report& step, Report& way) {
  way.iterations += step.iterations;
  way.energies = step.energies;
  for (const Reason& reason : step.reasons) {
    const auto known = std::find_if(way.reasons.begin(), way.reasons.end(),
                                    [&](const Reason& r) { return r.code == reason.code; });
    if (known != way.reasons.end())
      ++known->count;
    else if (step.status == Status::failed)
      way.fail(reason);
    else
      way.degrade(reason);
  }
  for (const std::string& note : step.notes)
    if (std::find(way.notes.begin(), way.notes.end(), note) == way.notes.end())
      way.notes.push_back(note);
}

}  // namespace

PoseSolver::PoseSolver(const MovingLeastSquares<3>& field, const Samples& quadrature,
                       const Eigen::VectorXd& volumes, const HandleSamples& handles,
                       const PoseWeights& weights)
    : particles_(field.positions()),
      handles_(handles),
      handle_samples_(sample_field(field, handles.rest(), SampleContent::values)),
      handle_energy_(handles.rest()),
      energy_(particles_.rows()),
      held_(particles_held(quadrature, handle_samples_, particles_.rows())) {
  const Eigen::VectorXd shares = volumes / volumes.sum();
  energy_.add(handle_energy_, handle_samples_, handles.weights(), weights.handles);
  energy_.add(rigidity_, quadrature, shares, weights.rigidity);
  if (weights.volume > 0) energy_.add(volume_, quadrature, shares, weights.volume);
}

Report PoseSolver::solve(const MinimizeOptions& options, int substeps,
                         const std::function<void(double)>& on_step, Points& u) {
  const Preconditioner preconditioner(energy_);
  Report way;
  double share = 0, factor = 1, energy = 0, most_energy = 0;
  while (share < 1 && way.status != Status::failed) {
    // The last step ends at 1 exactly.
    const double target = share + factor / substeps;
    const double next = target > 1 - 0.01 / substeps ? 1 : target;
    Points pose = u;
    const Report report = step(preconditioner, options, share, next, pose);
    const double lost = energy - total_energy(report);
    const bool sprang =
        lost > reason_limit(ReasonCode::turn_lost) * most_energy && most_energy > no_energy;
    if (sprang && factor > smallest_step) {
      factor *= 0.5;
      continue;
    }
    merge(report, way);
    if (sprang)
      way.degrade({ReasonCode::turn_lost, 1, lost / most_energy,
                   fmt::format("the shape sprang to another pose at {:.0f} % of the handles' way; "
                               "more particles or substeps may hold it",
                               100 * next)});
    u = pose;
    share = next;
    factor = std::min(1.0, 2 * factor);
    energy = total_energy(report);
    most_energy = std::max(most_energy, energy);
    on_step(share);
  }
  return way;
}

Report PoseSolver::step(const Preconditioner& preconditioner, const MinimizeOptions& options,
                        double from, double to, Points& u) {
  const Points targets = handles_.targets(to);
  handle_energy_.set_targets(targets);
  predict(handles_.targets(from), targets, u);
  MinimizeOptions step_options = options;
  if (to < 1) step_options.tolerance = std::max(options.tolerance, tolerance_on_the_way);
  return minimize(energy_, preconditioner, step_options, u);
}

void PoseSolver::predict(const Points& targets_before, const Points& targets, Points& u) const {
  const RigidMotion motion = best_fit_motion(targets_before, targets, handles_.weights());
  Points moved = ((particles_ + u) * motion.R.transpose()).rowwise() + motion.t.transpose();
  moved -= particles_;
  for (Index i = 0; i < u.rows(); ++i)
    if (!held_[static_cast<std::size_t>(i)]) moved.row(i) = u.row(i);
  if (energy_.evaluate(moved) < energy_.evaluate(u)) u = moved;
}

std::vector<std::pair<std::string, double>> PoseSolver::time_shares(const Points& u) const {
  std::vector<std::pair<std::string, double>> shares;
  double total = 0;
  for (const EnergyGroup& group : energy_.groups())
    for (const EnergyGroup::Term& term : group.terms) {
      EnergySum alone(particles_.rows());
      alone.add(*term.energy, *group.samples, group.sample_weights, term.weight);
      Points gradient;
      const Stopwatch watch;
      alone.evaluate(u, &gradient);
      const double seconds = watch.seconds();
      shares.emplace_back(std::string(term.energy->name()), seconds);
      total += seconds;
    }
  if (total > 0)
    for (auto& [name, share] : shares) share /= total;
  return shares;
}

}  // namespace supple
