#include "modeler/pose/pose_solver.h"

#include <algorithm>

#include <fmt/format.h>

#include "solver/core/rigid_motion.h"
#include "solver/core/stopwatch.h"
#include "solver/field/pieces.h"
#include "solver/minimize/repair.h"

namespace supple {
namespace {

/// Steps on the way only prepare the next one.
constexpr double tolerance_on_the_way = 1e-4;

/// Steps are halved down to this share of one: where the shape sprang, where none can be taken.
constexpr double smallest_step = 1.0 / 8, smallest_blocked_step = 1.0 / 64;

/// From this ratio of volume to rigidity on L-BFGS, whose preconditioner knows no volume term,
/// takes so many iterations that its steps on the way end early; the trust region is sure, if
/// slower.
constexpr double heavy_volume = 1e4;

/// Energies below this are rounding.
constexpr double no_energy = 1e-9;

std::vector<bool> particles_held(const Samples& quadrature, const Samples& handles,
                                 Index particles) {
  Pieces pieces(particles);
  pieces.tie(quadrature);
  return pieces.reached_by(handles);
}

/// Adds a step's reasons and iterations to the whole way's.
void merge(const Report& step, Report& way) {
  way.iterations += step.iterations;
  way.energies = step.energies;
  for (const Reason& reason : step.reasons) {
    if (Reason* known = way.find(reason.code))
      ++known->count;
    else
      way.degrade(reason);
  }
  if (step.status == Status::failed) way.status = Status::failed;
  for (const std::string& note : step.notes)
    if (std::find(way.notes.begin(), way.notes.end(), note) == way.notes.end())
      way.notes.push_back(note);
}

}  // namespace

PoseSolver::PoseSolver(const MovingLeastSquares<3>& field, const Samples& quadrature,
                       const Eigen::VectorXd& volumes, const HandleSamples& handles,
                       const PoseWeights& weights, const Eigen::VectorXd& stiffness)
    : particles_(field.positions()),
      quadrature_(quadrature),
      handles_(handles),
      weights_(weights),
      volume_shares_(volumes / volumes.sum()),
      handle_samples_(sample_field(field, handles.rest(), SampleContent::values)),
      handle_energy_(handles.rest()),
      energy_(particles_.rows()),
      held_(particles_held(quadrature, handle_samples_, particles_.rows())) {
  if (stiffness.size() > 0) volume_shares_.array() *= stiffness.array();
  energy_.add(handle_energy_, handle_samples_, handles.weights(), weights.handles);
  energy_.add(rigidity_, quadrature, volume_shares_, weights.rigidity);
  if (weights.volume > 0) energy_.add(volume_, quadrature, volume_shares_, weights.volume);
  preconditioner_.emplace(energy_);
}

void PoseSolver::forbid_inversion() {
  energy_.add(barrier_, quadrature_, volume_shares_, weights_.rigidity);
}

void PoseSolver::forbid_inversion_at(const MovingLeastSquares<3>& field, const Points& points) {
  const Samples& samples = barrier_samples_.emplace_back(
      sample_field(field, points, SampleContent::values_and_gradients));
  energy_.add(barrier_, samples, Eigen::VectorXd::Constant(samples.size(), volume_shares_.mean()),
              weights_.rigidity);
}

Report PoseSolver::solve(const PoseSolveOptions& options,
                         const std::function<void(double)>& on_step, Points& u) {
  const Way fixed = way_of(options);
  const int substeps = options.substeps;
  Report way;
  if (fixed.options.kind != options.minimize.kind)
    way.notes.push_back("weights.volume is far above weights.rigidity: solved by the trust region");
  if (heavy() && fixed.constraints && fixed.options.kind == MinimizerKind::lbfgs)
    way.degrade({ReasonCode::not_converged, 1, weights_.volume / weights_.rigidity,
                 "weights.volume is far above weights.rigidity, and hard_handles leave that to "
                 "L-BFGS, which may end above the minimum"});
  double share = 0, factor = 1, energy = 0, most_energy = 0;
  while (share < 1 && way.status != Status::failed) {
    // The last step ends at 1 exactly.
    const double target = share + factor / substeps;
    const double next = target > 1 - 0.01 / substeps ? 1 : target;
    Points pose = u;
    Report report = step(fixed, share, next, pose);
    if (fixed.deadline.over() && report.find(ReasonCode::out_of_time)) {
      end_early(share, report, pose, u, way);
      break;
    }
    // Handles that are met at once, or a barrier, may leave a step without a place to start from.
    const bool blocked = report.status == Status::failed && report.find(ReasonCode::not_finite);
    if (blocked && factor > smallest_blocked_step) {
      factor *= 0.5;
      continue;
    }
    if (blocked)
      report.find(ReasonCode::not_finite)->detail = fmt::format(
          "the energy is not finite wherever a step from {:.0f} % of the handles' way may start",
          100 * share);
    const double lost = energy - report.total_energy();
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
    energy = report.total_energy();
    most_energy = std::max(most_energy, energy);
    on_step(share);
  }
  if (way.status != Status::failed) mend(fixed, u, way);
  judge_reach(way);
  return way;
}

void PoseSolver::end_early(double share, const Report& step, const Points& unfinished, Points& u,
                           Report& way) {
  if (count_inversions(quadrature_, unfinished).inverted <=
      count_inversions(quadrature_, u).inverted)
    u = unfinished;
  merge(step, way);
  way.energies = energies_at_end(u);
  Reason& reason = *way.find(ReasonCode::out_of_time);
  reason.value = share;
  reason.detail = fmt::format(
      "out of time after {:.0f} % of the handles' way, within the next step of it", 100 * share);
}

void PoseSolver::judge_reach(Report& report) const {
  const long outside = handle_samples_.uncovered;
  if (outside > 0)
    report.degrade({ReasonCode::uncovered, outside, static_cast<double>(outside),
                    fmt::format("{} of {} points of handles lie outside all supports: each leads "
                                "the particle nearest to it",
                                outside, handle_samples_.size())});
}

bool PoseSolver::heavy() const {
  return weights_.volume >= heavy_volume * weights_.rigidity;
}

std::vector<std::pair<std::string, double>> PoseSolver::energies_at_end(const Points& u) {
  handle_energy_.set_targets(handles_.targets(1));
  return energy_.values(u);
}

PoseSolver::Way PoseSolver::way_of(const PoseSolveOptions& options) const {
  Way way{*preconditioner_, {}, options.minimize, Deadline(options.most_seconds)};
  if (heavy() && way.options.kind == MinimizerKind::lbfgs && !options.hard_handles)
    way.options.kind = MinimizerKind::trust_region;
  if (options.hard_handles)
    way.constraints.emplace(handle_samples_, handles_.weights(), handles_.targets(1),
                            way.preconditioner);
  return way;
}

Report PoseSolver::polish(const PoseSolveOptions& options, Points& u) {
  const Way way = way_of(options);
  const Points targets = handles_.targets(1);
  handle_energy_.set_targets(targets);
  Report report = minimize_at(way, way.options, targets, u);
  if (report.usable()) mend(way, u, report);
  return report;
}

Report PoseSolver::repair(const PoseSolveOptions& options, Points& u) {
  const Way way = way_of(options);
  handle_energy_.set_targets(handles_.targets(1));
  Report report;
  mend(way, u, report);
  return report;
}

Lbfgs::Result PoseSolver::drag(const PoseSolveOptions& options, PaddedPoints& u) {
  handles_.targets(1, targets_);
  handle_energy_.set_targets(targets_);
  if (!options.hard_handles)
    return lbfgs_.minimize(energy_, *preconditioner_, options.minimize, nullptr, u);
  if (constraints_)
    constraints_->decide(targets_);
  else
    constraints_.emplace(handle_samples_, handles_.weights(), targets_, *preconditioner_);
  Points met = u.leftCols<3>();
  constraints_->meet(targets_, met);
  u.leftCols<3>() = met;
  return lbfgs_.minimize(energy_, *preconditioner_, options.minimize, &*constraints_, u);
}

Report PoseSolver::step(const Way& way, double from, double to, Points& u) {
  const Points targets = handles_.targets(to);
  handle_energy_.set_targets(targets);
  predict(handles_.targets(from), targets, u);
  MinimizeOptions options = way.options;
  if (to < 1) options.tolerance = std::max(options.tolerance, tolerance_on_the_way);
  return minimize_at(way, options, targets, u);
}

Report PoseSolver::minimize_at(const Way& way, const MinimizeOptions& options,
                               const Points& targets, Points& u) const {
  const MinimizeOptions bounded = within(way.deadline, options);
  if (!way.constraints) return minimize(energy_, way.preconditioner, bounded, u);
  way.constraints->meet(targets, u);
  return minimize(energy_, way.preconditioner, bounded, u, &*way.constraints);
}

/// As rigid as possible first: the pose energies are stationary on shapes collapsed to a plane, a
/// line or a point. Then with as much weight on volume as on rigidity, which single points that
/// are still inside out need to get back; then as asked.
void PoseSolver::mend(const Way& way, Points& u, Report& report) {
  const long inverted = count_inversions(quadrature_, u).inverted;
  if (inverted == 0) return;
  if (way.deadline.over()) {
    report.notes.push_back(
        fmt::format("no time was left to repair {} points inside out", inverted));
    return;
  }
  Points mended = u;
  NearestRotationEnergy rotations(quadrature_.size());
  EnergySum nearly_rigid(particles_.rows());
  nearly_rigid.add(handle_energy_, handle_samples_, handles_.weights(), weights_.handles);
  nearly_rigid.add(rotations, quadrature_, volume_shares_, 1);
  supple::repair(nearly_rigid, rotations, quadrature_, way.deadline, mended);
  if (weights_.volume < weights_.rigidity) {
    EnergySum balanced(particles_.rows());
    balanced.add(handle_energy_, handle_samples_, handles_.weights(), weights_.handles);
    balanced.add(rigidity_, quadrature_, volume_shares_, weights_.rigidity);
    balanced.add(volume_, quadrature_, volume_shares_, weights_.rigidity);
    minimize(balanced, Preconditioner(balanced), within(way.deadline, way.options), mended);
  }
  Report polished = minimize_at(way, way.options, handles_.targets(1), mended);
  if (polished.status == Status::failed) return;
  const long left = count_inversions(quadrature_, mended).inverted;
  if (left >= inverted) return;
  u = mended;
  merge(polished, report);
  report.notes.push_back(fmt::format("{} points were turned inside out: repaired{}", inverted,
                                     left > 0 ? fmt::format(", all but {}", left) : ""));
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
