#include "modeler/pose/pose.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "io/scene/complaint.h"
#include "modeler/plan/plan.h"
#include "modeler/pose/handles.h"
#include "modeler/pose/pose_solver.h"
#include "modeler/pose/solid.h"
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

/// The field over a solid's particles, its samples where energies are summed, and its surface.
struct SolidField {
  MovingLeastSquares<3> mls;
  Quadrature points;
  Samples quadrature;
  SurfaceEmbedding surface;

  SolidField(const Solid& solid, const ShapeSpec& shape, SurfaceKind surface_kind)
      : mls(solid.particles().positions, solid.particles().supports,
            {shape.basis, shape.kernel, shape.gradient}, solid.detours(),
            solid.particles().stretches),
        points(solid.quadrature(shape.quadrature)),
        quadrature(sample_field(mls, points.points, SampleContent::values_and_gradients)),
        surface(mls, quadrature, solid.inner_vertices(), surface_kind) {}
  SolidField(const SolidField&) = delete;
};

/// How far apart handles are sampled, in spacings: hard ones shall be met between samples too.
constexpr double handle_width = 0.5, hard_handle_width = 0.1;

HandleSamples choose_handles(const Mesh& mesh, const Solid& solid, const Scene& scene) {
  SurfaceSamples samples = solid.surface();
  samples.positions = solid.restored(samples.positions);
  const HandleContext context{
      {mesh, solid.triangulation(), solid.box(), scene.folder},
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

Report solve(const Solid& solid, const SolidField& field, const HandleSamples& handles,
             const PoseSpec& spec, Stages& stages, PoseResult& result, Points& u) {
  PoseSolver solver(field.mls, field.quadrature, field.points.volumes, handles, spec.weights);
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

/// A fine surface has millions of samples: their rows are built for so many at a time.
constexpr std::size_t samples_at_a_time = 16384;

/// How far each of a handle's surface samples is from where it was led.
std::vector<double> misses(const Solid& solid, const SolidField& field, const PoseHandle& handle,
                           const Points& u) {
  std::vector<double> misses;
  misses.reserve(handle.selected.size());
  for (std::size_t begin = 0; begin < handle.selected.size(); begin += samples_at_a_time) {
    const std::size_t count = std::min(samples_at_a_time, handle.selected.size() - begin);
    Points rest(static_cast<Index>(count), 3);
    for (std::size_t k = 0; k < count; ++k)
      rest.row(static_cast<Index>(k)) = solid.surface().positions.row(handle.selected[begin + k]);
    const Samples samples = sample_field(field.mls, rest, SampleContent::values);
    for (Index k = 0; k < rest.rows(); ++k)
      misses.push_back((samples.position(k, u) - handle.path(rest.row(k).transpose(), 1)).norm());
  }
  return misses;
}

/// Misses of the handles over all their surface samples, over the diagonal.
void measure_handles(const Solid& solid, const SolidField& field, const HandleSamples& handles,
                     const Points& u, PoseResult& result) {
  double all_squares = 0;
  std::size_t all_samples = 0;
  for (const PoseHandle& handle : handles.handles()) {
    HandleResidual residual{handle.spec->place, handle.spec->selection().text,
                            static_cast<int>(handle.selected.size()), 0, 0};
    double squares = 0;
    for (const double miss : misses(solid, field, handle, u)) {
      residual.max_error = std::max(residual.max_error, miss);
      squares += miss * miss;
    }
    residual.rms_error = std::sqrt(squares / residual.samples);
    result.handle_max_error = std::max(result.handle_max_error, residual.max_error);
    all_squares += squares;
    all_samples += handle.selected.size();
    result.handles.push_back(std::move(residual));
  }
  if (all_samples > 0)
    result.handle_rms_error = std::sqrt(all_squares / static_cast<double>(all_samples));
}

/// Within the region's boundary, at rest and carried along: the mesh itself may be open.
void measure_volume(const Solid& solid, const SolidField& field, const Points& u,
                    const DeformedSurface& surface, PoseResult& result) {
  const CarriedBoundary& boundary = solid.boundary();
  const Samples samples = sample_field(field.mls, boundary.extra, SampleContent::values);
  Points extra(boundary.extra.rows(), 3);
  for (Index k = 0; k < extra.rows(); ++k) extra.row(k) = samples.position(k, u).transpose();
  const double unit = std::pow(solid.unit(), 3);
  result.volume_before = unit * enclosed_volume(boundary, solid.vertices(), boundary.extra);
  const Points moved = solid.vertices() + surface.positions - solid.inner_vertices();
  result.volume_after = unit * enclosed_volume(boundary, moved, extra);
}

/// The smallest det F over particles and the surface's vertices, and how many are not positive.
InversionCount worst_inversion(const Solid& solid, const SolidField& field, const Points& u,
                               const DeformedSurface& surface) {
  InversionCount worst = count_inversions(field.quadrature, u);
  for (std::size_t i = 0; i < surface.gradients.size(); ++i) {
    if (!solid.used_vertices()[i]) continue;
    const double J = surface.gradients[i].determinant();
    worst.min_det_F = std::min(worst.min_det_F, J);
    if (!(J > 0)) ++worst.inverted;
  }
  return worst;
}

/// Hard handles that miss by more than this share of the diagonal contradict each other.
constexpr double hard_miss = 1e-6;

void judge_handles(const PoseSpec& spec, PoseResult& result) {
  const double limit = spec.hard_handles ? hard_miss : reason_limit(ReasonCode::handle_miss);
  if (!(result.handle_max_error > limit)) return;
  const long missed =
      std::count_if(result.handles.begin(), result.handles.end(),
                    [&](const HandleResidual& handle) { return handle.max_error > limit; });
  result.report.degrade(
      {ReasonCode::handle_miss, missed, result.handle_max_error,
       fmt::format("a handle misses its place by {:.2g} % of the diagonal{}",
                   100 * result.handle_max_error,
                   spec.hard_handles ? ": the particles cannot meet all of them at once" : "")});
}

/// Points of the field that no particle reaches, or that too few span.
void judge_cover(const Solid& solid, const SolidField& field, Report& report) {
  const double sampled = static_cast<double>(field.quadrature.size() + solid.vertices().rows());
  const long lost = field.quadrature.rank_lost + field.surface.rank_lost();
  if (static_cast<double>(lost) > reason_limit(ReasonCode::rank_lost) * sampled)
    report.degrade({ReasonCode::rank_lost, lost, static_cast<double>(lost) / sampled,
                    fmt::format("at {} points the particles near do not span the field's basis; "
                                "more particles help",
                                lost)});
  // Vertices that no face uses may lie anywhere; the solid notes them.
  const long unused = std::count(solid.used_vertices().begin(), solid.used_vertices().end(), false);
  const long uncovered =
      field.quadrature.uncovered + std::max(0L, field.surface.uncovered() - unused);
  if (static_cast<double>(uncovered) > reason_limit(ReasonCode::uncovered))
    report.degrade({ReasonCode::uncovered, uncovered, static_cast<double>(uncovered),
                    fmt::format("{} points lie outside all supports and follow the nearest "
                                "particle",
                                uncovered)});
}

/// Beyond this a change of volume is worth a word: the volume weight is a preference.
constexpr double notable_volume_change = 0.05;

void judge(const Solid& solid, const SolidField& field, const PoseSpec& spec,
           const InversionCount& inversion, PoseResult& result) {
  Report& report = result.report;
  for (const Reason& reason : solid.reasons()) report.degrade(reason);
  if (inversion.inverted > 0)
    report.degrade({ReasonCode::inverted, inversion.inverted, inversion.min_det_F,
                    fmt::format("{} points are turned inside out, the worst with det F = {:.3g}",
                                inversion.inverted, inversion.min_det_F)});
  judge_handles(spec, result);
  judge_cover(solid, field, report);
  const double change = result.volume_after / result.volume_before - 1;
  if (std::abs(change) > notable_volume_change)
    report.notes.push_back(fmt::format(
        "the volume changed by {:+.1f} %: a greater weights.volume keeps it better", 100 * change));
  if (!result.mesh.positions.allFinite())
    report.fail({ReasonCode::not_finite, 1, 0, "a deformed vertex is not finite"});
  report.finish();
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
  const HandleSamples handles = choose_handles(result.rest, solid, scene);
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
    result.report =
        stages.run("solve", [&] { return solve(solid, *field, handles, spec, stages, result, u); });

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
