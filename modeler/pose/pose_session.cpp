#include "modeler/pose/pose_session.h"

#include <algorithm>

#include "io/scene/complaint.h"
#include "modeler/pose/pose_measures.h"
#include "modeler/pose/stiffness.h"
#include "solver/core/check.h"
#include "solver/core/deadline.h"

namespace supple {
namespace {

const Scene& checked(const Scene& scene) {
  const PoseSpec& spec = *scene.pose;
  if (spec.handles.empty())
    complain(spec.place, "pose.handles: none; needed: the parts that are held and dragged");
  const bool to_places =
      std::any_of(spec.handles.begin(), spec.handles.end(),
                  [](const HandleSpec& handle) { return handle.to.has_value(); });
  if (spec.from || spec.region || spec.mirror || to_places)
    complain(spec.place, "pose: a session knows no from, to, region or mirror");
  return scene;
}

}  // namespace

PoseSession::PoseSession(const Mesh& mesh, const Scene& scene)
    : scene_(checked(scene)),
      rest_(sized(mesh, scene_.shape)),
      solid_(rest_, scene_.shape),
      chosen_(rest_, solid_, scene_, {}),
      handles_(chosen_.take()),
      normals_(solid_.triangulation().triangles, rest_.positions.rows()) {
  solid_.choose_particle_supports(scene_.shape);
  const PoseSpec& spec = *scene_.pose;
  field_ = std::make_unique<const SolidField>(solid_, scene_.shape, spec.surface);
  const HandleContext& context = chosen_.context();
  Eigen::VectorXd stiffness;
  if (!spec.stiffness.empty())
    stiffness =
        stiffness_factors(spec.stiffness, context.selection, context.restored(context.surface),
                          solid_.restored(field_->points.points));
  solver_ = std::make_unique<PoseSolver>(field_->mls, field_->quadrature, field_->points.volumes,
                                         handles_, spec.weights, stiffness);
  if (spec.no_inversion) guard_.emplace(solid_, *field_, *solver_);
  u_ = PaddedPoints::Zero(solid_.particles().size(), 4);
}

void PoseSession::lead(std::size_t handle, const HandlePath& path) {
  SUPPLE_CHECK(handle < handles_.handles().size() && !handles_.handles()[handle].spec->fix,
               "a handle that moves");
  HandlePath scaled = path;
  scaled.center = (path.center - solid_.origin()) / solid_.unit();
  scaled.about = (path.about - solid_.origin()) / solid_.unit();
  scaled.by = path.by / solid_.unit();
  handles_.lead(handle, scaled);
}

PoseSolveOptions PoseSession::options() const {
  const PoseSpec& spec = *scene_.pose;
  return {{.kind = spec.solver, .max_iterations = spec.max_iterations, .tolerance = spec.tolerance},
          spec.substeps.value_or(substeps_needed(handles_, u_.rows())),
          spec.hard_handles,
          spec.most_seconds.value_or(PoseSolveOptions().most_seconds)};
}

Lbfgs::Result PoseSession::drag(const MinimizeOptions& minimize) {
  return solver_->drag({.minimize = minimize, .hard_handles = scene_.pose->hard_handles}, u_);
}

Report PoseSession::release() {
  const PoseSolveOptions all = options();
  PoseSolveOptions left = all;
  const Deadline deadline(all.most_seconds);
  const auto on_step = [](double) {};
  Points here = u_.leftCols<3>(), from_rest = Points::Zero(u_.rows(), 3);
  Report polished = solver_->polish(all, here);
  left.most_seconds = deadline.left();
  Report walked =
      guard_ ? guard_->solve(left, on_step, from_rest) : solver_->solve(left, on_step, from_rest);
  walked.finish();
  judge_shape(here, polished);
  judge_shape(from_rest, walked);
  const bool sound = polished.usable() == walked.usable();
  const bool keep = sound ? polished.total_energy() < walked.total_energy() : polished.usable();
  u_.leftCols<3>() = keep ? here : from_rest;
  return keep ? polished : walked;
}

void PoseSession::judge_shape(const Points& u, Report& report) const {
  const DeformedSurface surface = field_->surface.deform(u, solid_.particles().volumes);
  const InversionCount inversion = worst_inversion(solid_, *field_, u, surface);
  judge_inversion(inversion, solid_.origin() + solid_.unit() * inversion.worst, *scene_.pose,
                  report);
}

void PoseSession::deform(FloatPoints& positions) {
  displaced_ = u_.leftCols<3>();
  field_->surface.positions(displaced_, solid_.particles().volumes,
                            {solid_.origin(), solid_.unit()}, scratch_, positions);
}

void PoseSession::deform(FloatPoints& positions, FloatPoints& normals) {
  deform(positions);
  normals_.compute(positions, normals);
}

}  // namespace supple
