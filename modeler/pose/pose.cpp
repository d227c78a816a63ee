#include "modeler/pose/pose.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "modeler/plan/plan.h"
#include "modeler/pose/handles.h"
#include "modeler/pose/pose_measures.h"
#include "modeler/pose/pose_solver.h"
#include "modeler/pose/solid_field.h"
#include "modeler/pose/stiffness.h"
#include "modeler/surface/deform_mesh.h"
#include "modeler/surface/fill_gaps.h"
#include "solver/core/stopwatch.h"

namespace supple {
namespace {

/// Names the stages to the progress, and keeps their times for the report.
class Stages {
 public:
  Stages(const Progress& progress, Report& report) : progress_(progress), report_(report) {}

  template <class Work>
  auto run(const std::string& name, const Work& work) {
    name_ = name;
    advance(0);
    const struct Stop {
      Stages& stages;
      Stopwatch watch;
      ~Stop() { stages.report_.seconds.emplace_back(stages.name_, watch.seconds()); }
    } stop{*this, {}};
    return work();
  }

  /// Says how much of the stage is done.
  void advance(double share) {
    if (progress_ && !progress_(name_, share))
      throw Interrupted(fmt::format("stopped while at \"{}\"", name_));
  }

 private:
  const Progress& progress_;
  Report& report_;
  std::string name_;
};

/// How far apart handles are sampled, in spacings: hard ones shall be met between samples too.
constexpr double handle_width = 0.5, hard_handle_width = 0.1;

/// The surface in the user's coordinates: selections speak of them.
SurfaceSamples restored_surface(const Solid& solid) {
  SurfaceSamples samples = solid.surface();
  samples.positions = solid.restored(samples.positions);
  return samples;
}

HandleSamples choose_handles(const SelectionContext& selection, const Solid& solid,
                             const Scene& scene) {
  const SurfaceSamples samples = restored_surface(solid);
  const HandleContext context{
      selection,
      samples,
      solid.surface(),
      solid.origin(),
      solid.unit(),
      (scene.pose->hard_handles ? hard_handle_width : handle_width) * solid.particles().spacing};
  return {make_handles(scene.pose->handles, context), solid.surface().positions};
}

/// Books time on an active effect.
void book(std::vector<Effect>& effects, const std::string& name, double seconds) {
  for (Effect& effect : effects)
    if (effect.active && effect.name == name) effect.seconds += seconds;
}

/// Coupling inside is off where no straight line leaves the shape.
void book_coupling(std::vector<Effect>& effects, const Solid& solid) {
  book(effects, "coupling", solid.coupling_seconds());
  for (Effect& effect : effects)
    if (effect.active && effect.name == "coupling" && !solid.detours()) {
      effect.active = false;
      effect.why = "no straight line from a particle to what it reaches leaves the shape";
    }
}

/// The parts' factors at the points where energies are summed; empty without such parts.
Eigen::VectorXd stiffness(const PoseSpec& spec, const SelectionContext& selection,
                          const Solid& solid, const SolidField& field, PoseResult& result) {
  if (spec.stiffness.empty()) return {};
  const Stopwatch watch;
  Eigen::VectorXd factors = stiffness_factors(spec.stiffness, selection, restored_surface(solid),
                                              solid.restored(field.points.points));
  book(result.effects, "stiffness", watch.seconds());
  return factors;
}

Report solve(const Solid& solid, const SolidField& field, const HandleSamples& handles,
             const Eigen::VectorXd& stiffness, const PoseSpec& spec, Stages& stages,
             PoseResult& result, Points& u) {
  PoseSolver solver(field.mls, field.quadrature, field.points.volumes, handles, spec.weights,
                    stiffness);
  const PoseSolveOptions options{
      {spec.solver, spec.max_iterations, spec.tolerance},
      spec.substeps.value_or(substeps_needed(handles, solid.particles().size())),
      spec.hard_handles};
  const Stopwatch watch;
  Report report = solver.solve(
      options, [&](double share) { stages.advance(share); }, u);
  const double seconds = watch.seconds();
  for (const auto& [name, share] : solver.time_shares(u))
    book(result.effects, name, share * seconds);
  report.notes.push_back(fmt::format("handles walked in {} step{}", options.substeps,
                                     options.substeps == 1 ? "" : "s"));
  if (solver.loose_particles() > 0)
    report.notes.push_back(
        fmt::format("{} of {} particles are in pieces without handles: they stay",
                    solver.loose_particles(), u.rows()));
  return report;
}

void check_fill_gaps(const Mesh& mesh, const PoseSpec& spec) {
  if (spec.fill_gaps && mesh.face_count() > 0)
    complain(spec.place, "pose.fill_gaps: the shape has faces; allowed: with a point cloud");
}

/// Points in the user's coordinates, carried as the surface is.
DeformedSurface carry_points(const Solid& solid, const SolidField& field, SurfaceKind kind,
                             const Points& u, const Points& rest) {
  const Points x = solid.scaled(rest);
  const SurfaceEmbedding embedding(field.mls, field.quadrature, x, kind);
  DeformedSurface carried = embedding.deform(u, solid.particles().volumes);
  carried.positions = rest + solid.unit() * (carried.positions - x);
  return carried;
}

void fill_gaps(const Solid& solid, const SolidField& field, SurfaceKind kind, const Points& u,
               PoseResult& result) {
  FilledCloud filled = fill_gaps(result.rest, result.mesh, [&](const Points& rest) {
    return carry_points(solid, field, kind, u, rest);
  });
  result.report.notes.push_back(
      fmt::format("{} points fill gaps; they come after the {} of the "
                  "cloud",
                  filled.added, result.rest.positions.rows()));
  if (filled.gaps > 0)
    result.report.notes.push_back(fmt::format(
        "{} gaps between points stay open: the cloud would grow too large", filled.gaps));
  result.mesh = std::move(filled.deformed);
}

}  // namespace

PoseResult pose(const Mesh& mesh, const Scene& scene, const Progress& progress) {
  PoseResult result;
  Report timing;
  Stages stages(progress, timing);
  const PoseSpec& spec = *scene.pose;
  check_fill_gaps(mesh, spec);
  result.effects = make_plan(scene).effects;

  result.rest = sized(mesh, scene.shape);
  Solid solid = stages.run("sample", [&] { return Solid(result.rest, scene.shape); });
  const SelectionContext selection{result.rest, solid.triangulation(), solid.box(), scene.folder};
  const HandleSamples handles = choose_handles(selection, solid, scene);
  double thin_share = 0;
  const std::unique_ptr<const SolidField> field = stages.run("field", [&] {
    thin_share = solid.choose_particle_supports(scene.shape);
    return std::make_unique<const SolidField>(solid, scene.shape, spec.surface);
  });

  book_coupling(result.effects, solid);

  Points u = Points::Zero(solid.particles().size(), 3);
  if (handles.empty())
    result.report.notes.push_back("no handles: the shape stays as it is");
  else
    result.report = stages.run("solve", [&] {
      const Eigen::VectorXd factors = stiffness(spec, selection, solid, *field, result);
      return solve(solid, *field, handles, factors, spec, stages, result, u);
    });

  const DeformedSurface surface = stages.run("deform", [&] {
    DeformedSurface deformed = field->surface.deform(u, solid.particles().volumes);
    result.mesh = deform_mesh(result.rest, deformed);
    return deformed;
  });
  book(result.effects, "surface", timing.seconds.back().second);
  // Added to the input rather than replacing it: what did not move keeps its last bit.
  result.mesh.positions =
      result.rest.positions + solid.unit() * (surface.positions - solid.inner_vertices());
  if (spec.fill_gaps)
    stages.run("fill gaps", [&] { fill_gaps(solid, *field, spec.surface, u, result); });

  result.particles = solid.particles();
  result.particles.positions = solid.restored(solid.particles().positions);
  result.particles.supports *= solid.unit();
  result.particles.volumes *= std::pow(solid.unit(), 3);
  result.particles.spacing *= solid.unit();
  result.displacements = solid.unit() * u;
  result.handle_rest = solid.restored(handles.rest());
  result.handle_targets = solid.restored(handles.targets(1));
  measure_volume(solid, *field, u, surface, result);
  measure_handles(solid, *field, handles, u, result);

  const InversionCount inversion = worst_inversion(solid, *field, u, surface);
  result.min_det_F = inversion.min_det_F;
  result.report.seconds = timing.seconds;
  result.report.notes.insert(result.report.notes.end(), solid.notes().begin(), solid.notes().end());
  if (thin_share > reason_limit(ReasonCode::thin))
    result.report.degrade({ReasonCode::thin, 1, thin_share,
                           fmt::format("{:.0f} % of the surface is thinner than the particles can "
                                       "follow; more particles help",
                                       100 * thin_share)});
  judge(solid, *field, spec, inversion, result);
  return result;
}

}  // namespace supple
