#include "modeler/pose/pose.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "modeler/plan/plan.h"
#include "modeler/pose/handles.h"
#include "modeler/pose/inversion_guard.h"
#include "modeler/pose/mirrored_handle.h"
#include "modeler/pose/pose_measures.h"
#include "modeler/pose/pose_solver.h"
#include "modeler/pose/posed_field.h"
#include "modeler/pose/scene_handles.h"
#include "modeler/pose/solid_field.h"
#include "modeler/pose/starting_pose.h"
#include "modeler/pose/stiffness.h"
#include "modeler/surface/deform_mesh.h"
#include "modeler/surface/fill_gaps.h"
#include "solver/core/arithmetic.h"
#include "solver/core/check.h"
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
Eigen::VectorXd stiffness(const PoseSpec& spec, const HandleContext& context, const Solid& solid,
                          const SolidField& field, PoseResult& result) {
  if (spec.stiffness.empty()) return {};
  const Stopwatch watch;
  Eigen::VectorXd factors =
      stiffness_factors(spec.stiffness, context.selection, context.restored(context.surface),
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
      spec.hard_handles,
      spec.most_seconds.value_or(PoseSolveOptions().most_seconds)};
  const Stopwatch watch;
  const auto on_step = [&](double share) { stages.advance(share); };
  Report report = spec.no_inversion
                      ? InversionGuard(solid, field, solver).solve(options, on_step, u)
                      : solver.solve(options, on_step, u);
  const double seconds = watch.seconds();
  for (const auto& [name, share] : solver.time_shares(u))
    book(result.effects, name, share * seconds);
  judge_turns(handles, options.substeps, report);
  report.notes.push_back(fmt::format("the handles' way has {} step{}", options.substeps,
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

void check_files(const Mesh& mesh, const PoseSpec& spec, const PoseFiles& files) {
  SUPPLE_CHECK(spec.from.has_value() == files.from.has_value(), "pose.from is loaded");
  const bool led = std::any_of(spec.handles.begin(), spec.handles.end(),
                               [](const HandleSpec& handle) { return handle.to.has_value(); });
  SUPPLE_CHECK(!led || files.targets.size() == spec.handles.size(),
               "targets are loaded, one a handle");
  if (!files.from) return;
  if (files.from->rows() != mesh.positions.rows())
    complain(spec.from->place,
             fmt::format("pose.from: {} has {} vertices, the shape {}; allowed: another pose of "
                         "the same vertices",
                         spec.from->path, files.from->rows(), mesh.positions.rows()));
  if (!files.from->allFinite())
    complain(spec.from->place,
             fmt::format("pose.from: {} has a number that is not finite", spec.from->path));
}

/// Fits the pose that the scene starts from, and lets the handles' ways begin there.
std::optional<StartingPose> fit_start(const Solid& solid, const SolidField& field,
                                      const PoseFiles& files, SceneHandles& chosen,
                                      PoseResult& result) {
  if (!files.from) return {};
  const Stopwatch watch;
  StartingPose from = fit_pose(solid, field, solid.scaled(*files.from));
  chosen.begin_at(field, from.u);
  book(result.effects, "from", watch.seconds());
  return from;
}

/// Beyond this share of the diagonal a shape is not symmetric but for rounding.
constexpr double symmetric = 1e-6;

/// The plane that the pose is symmetric about: that of the mirror where shape and scene are. Says
/// how far the shape is from it.
std::optional<MirrorPlane> find_symmetry(const Solid& solid, const PoseSpec& spec,
                                         const std::optional<MirrorPlane>& mirror,
                                         PoseResult& result) {
  if (!mirror) return {};
  const Stopwatch watch;
  const double miss = asymmetry(solid, *mirror);
  book(result.effects, "mirror", watch.seconds());
  const bool scene_is_symmetric = !spec.from && spec.stiffness.empty() && !spec.region;
  const bool made = miss < symmetric && scene_is_symmetric;
  result.report.notes.push_back(
      fmt::format("the shape is symmetric about pose.mirror to {:.2g} % of the diagonal{}",
                  100 * miss, made ? ": the pose is made so too" : ""));
  if (!made) return {};
  return mirror;
}

/// Vertices outside the region keep every bit of where the pose starts; says what the blend did.
void keep_outside(const RegionBlend& region, const Points& start, double taken_away,
                  PoseResult& result) {
  for (Index i = 0; i < start.rows(); ++i)
    if (region.at(result.rest.positions.row(i).transpose()).value == 0)
      result.mesh.positions.row(i) = start.row(i);
  result.report.notes.push_back(
      fmt::format("the blend at the region's edge takes {:.2g} % of the diagonal away at most",
                  100 * taken_away));
}

/// The posed mesh. Added to the input rather than replacing it: what did not move keeps its last
/// bit.
DeformedSurface deform(const Solid& solid, const SolidField& field, const PosedField& posed,
                       const PoseFiles& files, const std::optional<RegionBlend>& region,
                       PoseResult& result) {
  std::optional<Points> start;
  if (files.from) start = solid.scaled(*files.from);
  PosedSurface end = posed.surface(field.surface, result.rest.positions, start);
  result.mesh = deform_mesh(result.rest, end.surface);
  result.mesh.positions =
      result.rest.positions + solid.unit() * (end.surface.positions - solid.inner_vertices());
  if (region)
    keep_outside(*region, files.from ? *files.from : result.rest.positions, end.taken_away, result);
  return std::move(end.surface);
}

/// Points in the user's coordinates, carried as the surface is.
DeformedSurface carry_points(const Solid& solid, const SolidField& field, SurfaceKind kind,
                             const PosedField& posed, const Points& rest) {
  const Points x = solid.scaled(rest);
  const SurfaceEmbedding embedding(field.mls, field.quadrature, x, kind);
  DeformedSurface carried = posed.surface(embedding, rest).surface;
  carried.positions = rest + solid.unit() * (carried.positions - x);
  return carried;
}

void fill_gaps(const Solid& solid, const SolidField& field, SurfaceKind kind,
               const PosedField& posed, PoseResult& result) {
  FilledCloud filled = fill_gaps(result.rest, result.mesh, [&](const Points& rest) {
    return carry_points(solid, field, kind, posed, rest);
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

/// Takes particles and handles to the user's coordinates.
void store(const Solid& solid, const HandleSamples& handles, const Points& u, PoseResult& result) {
  result.particles = solid.particles();
  result.particles.positions = solid.restored(solid.particles().positions);
  result.particles.supports *= solid.unit();
  result.particles.volumes *= std::pow(solid.unit(), 3);
  result.particles.spacing *= solid.unit();
  result.displacements = solid.unit() * u;
  result.handle_rest = solid.restored(handles.rest());
  result.handle_start = solid.restored(handles.start());
  result.handle_targets = solid.restored(handles.targets(1));
}

void judge_thin(double share, Report& report) {
  if (share > reason_limit(ReasonCode::thin))
    report.degrade({ReasonCode::thin, 1, share,
                    fmt::format("{:.0f} % of the surface is thinner than the particles can "
                                "follow; more particles help",
                                100 * share)});
}

}  // namespace

PoseResult pose(const Mesh& mesh, const Scene& scene, const Progress& progress,
                const PoseFiles& files) {
  const PlainArithmetic arithmetic;
  PoseResult result;
  Report timing;
  Stages stages(progress, timing);
  const PoseSpec& spec = *scene.pose;
  check_fill_gaps(mesh, spec);
  check_files(mesh, spec, files);
  result.effects = make_plan(scene).effects;

  result.rest = sized(mesh, scene.shape);
  Solid solid = stages.run("sample", [&] { return Solid(result.rest, scene.shape); });
  SceneHandles chosen(result.rest, solid, scene, files);
  double thin_share = 0;
  const std::unique_ptr<const SolidField> field = stages.run("field", [&] {
    thin_share = solid.choose_particle_supports(scene.shape);
    return std::make_unique<const SolidField>(solid, scene.shape, spec.surface);
  });
  book_coupling(result.effects, solid);

  const std::optional<StartingPose> from = fit_start(solid, *field, files, chosen, result);
  const Points start = from ? from->u : Points::Zero(solid.particles().size(), 3);
  Points u = start;
  const HandleSamples handles = chosen.take();
  if (handles.empty())
    result.report.notes.push_back(from ? "no handles: the shape stays as pose.from has it"
                                       : "no handles: the shape stays as it is");
  else
    result.report = stages.run("solve", [&] {
      const Eigen::VectorXd factors = stiffness(spec, chosen.context(), solid, *field, result);
      return solve(solid, *field, handles, factors, spec, stages, result, u);
    });
  if (from) judge_start(*from, result.report);

  const std::optional<MirrorPlane> symmetry = find_symmetry(solid, spec, chosen.mirror(), result);
  const PosedField posed(solid, *field, start, u, chosen.region(), symmetry, spec.surface);
  const DeformedSurface surface = stages.run(
      "deform", [&] { return deform(solid, *field, posed, files, chosen.region(), result); });
  book(result.effects, "surface", timing.seconds.back().second);
  if (spec.fill_gaps)
    stages.run("fill gaps", [&] { fill_gaps(solid, *field, spec.surface, posed, result); });

  store(solid, handles, u, result);
  measure_volume(solid, posed, surface, result);
  measure_handles(posed, handles, result);
  const InversionCount inversion = worst_inversion(solid, *field, u, surface);
  result.min_det_F = inversion.min_det_F;
  result.min_det_F_place = solid.origin() + solid.unit() * inversion.worst;
  result.report.seconds = timing.seconds;
  result.report.notes.insert(result.report.notes.end(), solid.notes().begin(), solid.notes().end());
  judge_thin(thin_share, result.report);
  judge(solid, *field, spec, inversion, result);
  return result;
}

}  // namespace supple
