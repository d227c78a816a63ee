#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "solver/energy/handle.h"
#include "solver/energy/nearest_rotation.h"
#include "solver/energy/rigidity.h"
#include "solver/energy/volume.h"
#include "solver/field/supports.h"
#include "solver/minimize/minimize.h"
#include "tests/cases/cases.h"
#include "tests/cases/odd_energies.h"
#include "tests/cases/posed_bar.h"
#include "tests/support/all_of.h"
#include "tests/support/lattice.h"

namespace supple {
namespace {

/// A block of 16 particles, an energy of the place at each and the rigidity between them.
class Block {
 public:
  explicit Block(const Energy& energy, double rigidity = 1)
      : particles_(lattice_particles({0.25, 0.25, 0.5}, 0.125)),
        field_(particles_.positions,
               choose_supports(particles_.positions, 0.125, particles_.positions).radii),
        samples_(sample_field(field_, particles_.positions, SampleContent::values_and_gradients)),
        energy_(particles_.size()) {
    const Eigen::VectorXd weights =
        Eigen::VectorXd::Constant(samples_.size(), 1 / static_cast<double>(samples_.size()));
    energy_.add(energy, samples_, weights, 1);
    if (rigidity > 0) energy_.add(rigidity_, samples_, weights, rigidity);
  }

  const EnergySum& energy() const { return energy_; }
  const Points& rest() const { return particles_.positions; }
  Points at_rest() const { return Points::Zero(particles_.size(), 3); }

 private:
  Particles particles_;
  MovingLeastSquares<3> field_;
  Samples samples_;
  RigidityEnergy rigidity_;
  EnergySum energy_;
};

bool notes(const Report& report, std::string_view words) {
  return std::any_of(report.notes.begin(), report.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

/// What a minimiser made of a block.
struct Outcome {
  Report report;
  Points u;
  double before = 0, after = 0;  ///< energies
};

Outcome minimized(const Block& block, const MinimizeOptions& options, const Points& start) {
  Outcome outcome{{}, start, block.energy().evaluate(start), 0};
  outcome.report = minimize(block.energy(), Preconditioner(block.energy()), options, outcome.u);
  outcome.after = block.energy().evaluate(outcome.u);
  return outcome;
}

void keep_greatest(double& most, double value) {
  if (!(value <= most)) most = value;
}

void measure_not_finite_costs(Figures& figures) {
  const FencedEnergy everywhere(-1), later(0.5);
  const Block from_the_start(everywhere), on_the_way(later);
  for (const MinimizerKind kind : all_of<MinimizerKind>()) {
    const MinimizeOptions options{.kind = kind, .max_iterations = 500};
    const Outcome start = minimized(from_the_start, options, from_the_start.at_rest());
    figures["start_failed"] += start.report.status == Status::failed &&
                               start.report.find(ReasonCode::not_finite) != nullptr &&
                               start.u.isZero(0);
    const Outcome way = minimized(on_the_way, options, on_the_way.at_rest());
    figures["later_told"] +=
        way.report.status != Status::ok && way.report.find(ReasonCode::not_finite) != nullptr;
    figures["later_lower"] += way.u.allFinite() && way.after < way.before;
  }
}

/// Among r and its derivative at one f or F, in both ways that they are told.
int not_finite_at(const Energy& energy, const LocalField& at) {
  LocalResidual local;
  LocalDerivative derivative;
  energy.evaluate(at, local);
  const double square = energy.add_square(at, 1, derivative);
  const int rows = energy.rows();
  const int columns = energy.argument() == Energy::Argument::position ? 3 : 9;
  return !local.r.head(rows).allFinite() +
         !local.jacobian.topLeftCorner(rows, columns).allFinite() + !std::isfinite(square) +
         !derivative.by_f.allFinite() + !derivative.by_F.allFinite();
}

void measure_coincident_points(Figures& figures) {
  const HandleEnergy handle(Points::Zero(1, 3));
  const RigidityEnergy rigidity;
  const VolumeEnergy volume;
  const NearestRotationEnergy rotation(1);
  const std::initializer_list<const Energy*> energies{&handle, &rigidity, &volume, &rotation};
  for (const Vec3& stretch :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(-1, -1, -1)})
    for (const Energy* energy : energies)
      figures["residuals_not_finite"] +=
          not_finite_at(*energy, {.f = Vec3::Zero(), .F = Mat3(stretch.asDiagonal())});

  const PlaceEnergy place;
  const Block block(place);
  const Points in_one_place = Eigen::RowVector3d(1, 0, 0).replicate(block.rest().rows(), 1);
  for (const MinimizerKind kind : all_of<MinimizerKind>()) {
    const Outcome outcome =
        minimized(block, {.kind = kind, .max_iterations = 100}, in_one_place - block.rest());
    figures["solves_not_finite"] += !outcome.report.usable() || !outcome.u.allFinite();
  }
}

void measure_nlopt_without_numbers(Figures& figures) {
  const PlaceEnergy place;
  const IslandEnergy island(Block(place).rest().row(0).transpose());
  const FencedEnergy fenced(0.5);
  for (const Energy* energy : std::initializer_list<const Energy*>{&island, &fenced}) {
    const Block block(*energy);
    const Outcome outcome = minimized(
        block, {.kind = MinimizerKind::nlopt, .max_iterations = 1000000, .most_seconds = 60},
        block.at_rest());
    keep_greatest(figures["evaluations"], outcome.report.iterations);
    figures["out_of_time"] += outcome.report.find(ReasonCode::out_of_time) != nullptr;
    figures["told"] += outcome.report.find(ReasonCode::not_finite) != nullptr;
    figures["rose"] += !outcome.u.allFinite() || !(outcome.after <= outcome.before);
  }
}

/// Solves that would go on for longer than `budget` [s].
void measure_solves_within(double budget, const char* late, Figures& figures) {
  for (const MinimizerKind kind : all_of<MinimizerKind>()) {
    SlowEnergy slow(budget / 4);
    const Block block(slow);
    const Preconditioner preconditioner(block.energy());
    Points u = block.at_rest();
    const double before = block.energy().evaluate(u);
    slow.start();
    const Report report = minimize(block.energy(), preconditioner,
                                   {.kind = kind, .tolerance = 1e-15, .most_seconds = budget}, u);
    keep_greatest(figures[late], static_cast<double>(slow.begun_after(budget)));
    figures["solves_told"] += report.find(ReasonCode::out_of_time) != nullptr;
    figures["rose"] += !u.allFinite() || !(block.energy().evaluate(u) <= before);
  }
}

/// A pose whose handles' way has more steps than there is time for.
void measure_pose_within(double budget, const std::string& hard_handles, Figures& figures) {
  const Scene scene =
      read_scene_text(scene_text("    - fix: z<10%\n    - {move: z>90%, by: [20%, 10%, 0]}\n") +
                          fmt::format("  substeps: 10000\n  hard_handles: {}\n  most_seconds: {}\n",
                                      hard_handles, budget),
                      "scene.yaml", "");
  const PoseResult result = pose(case_bar(), scene);
  figures["poses_bad"] += !result.mesh.positions.allFinite() || !(result.min_det_F > 0);
  if (const Reason* reason = result.report.find(ReasonCode::out_of_time)) {
    ++figures["poses_told"];
    keep_greatest(figures["share_of_the_way"], reason->value);
  }
}

void measure_time_budgets(Figures& figures) {
  measure_solves_within(0, "evaluations_without_time", figures);
  measure_solves_within(1e-3, "evaluations_begun_late", figures);
  measure_solves_within(1, "evaluations_begun_late", figures);
  for (const double budget : {0.0, 1e-3, 1.0})
    for (const char* hard_handles : {"false", "true"})
      measure_pose_within(budget, hard_handles, figures);
}

/// Without rigidity; a bad Hessian where the solve starts.
void measure_bad_hessians(Figures& figures) {
  const CornerEnergy corner;
  const RingEnergy ring;
  const Block singular(corner, 0), indefinite(ring, 0);
  for (const MinimizerKind kind : all_of<MinimizerKind>()) {
    const MinimizeOptions options{.kind = kind, .tolerance = 1e-12};
    const Outcome flat = minimized(singular, options, singular.at_rest());
    keep_greatest(figures["singular_left"], flat.after / flat.before);
    const Outcome from_middle = minimized(indefinite, options, -0.99 * indefinite.rest());
    keep_greatest(figures["indefinite_left"], from_middle.after / from_middle.before);
  }
}

void measure_escalation(Figures& figures) {
  measure_bad_hessians(figures);
  const KinkEnergy kink;
  const Block kinked(kink, 0);
  const Outcome stuck = minimized(kinked, {.tolerance = 1e-15}, kinked.at_rest());
  figures["memory_given_up_told"] = notes(stuck.report, "down the preconditioned gradient");
  figures["trust_region_told"] =
      stuck.after == 0 || notes(stuck.report, "the trust region took over");
  figures["kinks_left"] = stuck.after / stuck.before;

  const PlaceEnergy place;
  const IslandEnergy island(Block(place).rest().row(0).transpose());
  const Block lonely(island);
  const Outcome invalid = minimized(lonely, {}, lonely.at_rest());
  figures["invalid_steps_told"] = notes(invalid.report, "the trust region took over") &&
                                  invalid.report.find(ReasonCode::not_finite) != nullptr;
  figures["invalid_steps_moved"] = (invalid.u - lonely.at_rest()).norm();
}

constexpr Case cases[] = {{"L1", measure_not_finite_costs},
                          {"L2", measure_coincident_points},
                          {"L3", measure_nlopt_without_numbers},
                          {"L5", measure_time_budgets},
                          {"L6", measure_escalation}};

}  // namespace

std::span<const Case> solver_cases() {
  return cases;
}

}  // namespace supple
