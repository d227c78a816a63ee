#include "modeler/pose/pose_session.h"

#include <algorithm>

#include "io/scene/complaint.h"
#include "modeler/pose/stiffness.h"

namespace supple {
namespace {

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

double total_energy(const Report& report) {
  double sum = 0;
  for (const auto& [name, value] : report.energies) sum += value;
  return sum;
}

}  // namespace

PoseSession::PoseSession(const Mesh& mesh, const Scene& scene)
    : rest_(sized(mesh, scene.shape)),
      scene_(scene),
      solid_(rest_, scene_.shape),
      handles_(choose_handles(rest_, solid_, scene_)),
      normals_(solid_.triangulation().triangles, rest_.positions.rows()) {
  if (handles_.empty())
    complain(scene_.shape.place, "pose.handles: none; needed: what is to be dragged");
  solid_.choose_particle_supports(scene_.shape);
  field_ = std::make_unique<const SolidField>(solid_, scene_.shape, scene_.pose->surface);
  solver_ = std::make_unique<PoseSolver>(field_->mls, field_->quadrature, field_->points.volumes,
                                         handles_, scene_.pose->weights, Eigen::VectorXd());
  u_ = PaddedPoints::Zero(solid_.particles().size(), 4);
}

void PoseSession::lead(std::size_t handle, const HandlePath& path) {
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
          spec.hard_handles};
}

Lbfgs::Result PoseSession::drag(const MinimizeOptions& minimize) {
  return solver_->drag({.minimize = minimize, .hard_handles = scene_.pose->hard_handles}, u_);
}

Report PoseSession::release() {
  Points here = u_.leftCols<3>(), from_rest = Points::Zero(u_.rows(), 3);
  const Report polished = solver_->polish(options(), here);
  const Report walked = solver_->solve(
      options(), [](double) {}, from_rest);
  const bool keep = polished.usable() && total_energy(polished) < total_energy(walked);
  u_.leftCols<3>() = keep ? here : from_rest;
  return keep ? polished : walked;
}

void PoseSession::deform(Points& positions) {
  displaced_ = u_.leftCols<3>();
  field_->surface.positions(displaced_, solid_.particles().volumes,
                            {solid_.origin(), solid_.unit()}, scratch_, positions);
}

void PoseSession::deform(Points& positions, Points& normals) {
  deform(positions);
  normals_.compute(positions, normals);
}

}  // namespace supple
