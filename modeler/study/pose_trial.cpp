#include "modeler/study/pose_trial.h"

#include <cmath>
#include <new>

#include <fmt/format.h>

#include "io/errors.h"
#include "modeler/domain/shape_error.h"
#include "modeler/pose/solid.h"
#include "solver/core/stopwatch.h"

namespace supple {
namespace {

/// Those that faces use; of a cloud, all.
std::vector<Index> surface_vertices(const Mesh& mesh) {
  const auto count = static_cast<std::size_t>(mesh.positions.rows());
  std::vector<bool> used(count, mesh.face_count() == 0);
  for (const int vertex : mesh.face_vertices) used[static_cast<std::size_t>(vertex)] = true;
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < count; ++i)
    if (used[i]) vertices.push_back(static_cast<Index>(i));
  return vertices;
}

TrialOutcome outcome_of(const PoseResult& result) {
  TrialOutcome outcome;
  outcome.status = result.report.status;
  for (const Reason& reason : result.report.reasons)
    outcome.reasons.push_back(fmt::format("{}: {}", enum_name(reason.code), reason.detail));
  const std::vector<Index> vertices = surface_vertices(result.rest);
  const double diagonal = bounding_box(result.rest.positions(vertices, Eigen::all)).diagonal();
  outcome.positions = result.mesh.positions(vertices, Eigen::all) / diagonal;
  outcome.stages = result.report.seconds;
  outcome.iterations = result.report.iterations;
  outcome.unknowns = result.displacements.size();
  return outcome;
}

TrialOutcome failed(std::string reason) {
  TrialOutcome outcome;
  outcome.status = Status::failed;
  outcome.reasons.push_back(std::move(reason));
  return outcome;
}

}  // namespace

TrialOutcome run_pose_trial(const Mesh& shape, const Scene& scene, const PoseFiles& files,
                            const SceneOverrides& settings, double most_seconds,
                            const Progress& progress) {
  const Stopwatch watch;
  bool stopped = false;
  const Progress within_budget = [&](const std::string& stage, double share) {
    stopped = progress && !progress(stage, share);
    return !stopped && watch.seconds() <= most_seconds;
  };
  TrialOutcome outcome;
  try {
    Scene trial = overridden(scene, settings);
    // A step is longer than the time between two looks at the clock.
    std::optional<double>& solve_seconds = trial.pose->most_seconds;
    const bool limited = !solve_seconds || *solve_seconds > most_seconds;
    if (limited && std::isfinite(most_seconds)) solve_seconds = most_seconds;
    const PoseResult result = pose(shape, trial, within_budget, files);
    if (limited && result.report.find(ReasonCode::out_of_time)) throw Interrupted("out of time");
    outcome = outcome_of(result);
  } catch (const Interrupted&) {
    if (stopped) throw;
    outcome = failed(fmt::format("stopped after {:.2g} s: it was given {:.2g} s", watch.seconds(),
                                 most_seconds));
  } catch (const UsageError& error) {
    outcome = failed(error.what());
  } catch (const ShapeError& error) {
    outcome = failed(error.what());
  } catch (const std::bad_alloc&) {
    outcome = failed("the memory of this machine does not suffice");
  }
  outcome.seconds = watch.seconds();
  return outcome;
}

Scene with_counted_particles(Scene scene, const Mesh& shape) {
  if (!scene.shape.spacing) return scene;
  const Solid solid(sized(shape, scene.shape), scene.shape);
  scene.shape.particles = static_cast<int>(solid.particles_placed());
  scene.shape.spacing.reset();
  return scene;
}

}  // namespace supple
