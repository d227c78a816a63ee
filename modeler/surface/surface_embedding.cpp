#include "modeler/surface/surface_embedding.h"

#include "solver/core/check.h"

namespace supple {
namespace {

/// Alternative 2 weighs by the kernel alone: shape functions of order zero.
MovingLeastSquares<3> weighting_field(const MovingLeastSquares<3>& field, SurfaceKind kind) {
  MovingLeastSquaresOptions options = field.options();
  if (kind == SurfaceKind::particle_gradients) options.order = BasisOrder::constant;
  return field.with(options);
}

/// The rigid part of the particles' motion. A field of order zero does not reproduce turns, so
/// only the translation may be taken out of it.
RigidMotion rigid_part(const Points& rest, const Points& u, const Eigen::VectorXd& volumes,
                       bool reproduces_turns) {
  if (reproduces_turns) return best_fit_motion(rest, rest + u, volumes);
  RigidMotion motion;
  motion.t = u.transpose() * volumes / volumes.sum();
  return motion;
}

}  // namespace

SurfaceEmbedding::SurfaceEmbedding(const MovingLeastSquares<3>& field, const Samples& quadrature,
                                   const Points& vertices, SurfaceKind kind)
    : kind_(kind),
      order_(field.options().order),
      quadrature_(quadrature),
      blocks_(weighting_field(field, kind), vertices) {
  SUPPLE_CHECK(quadrature.size() >= field.positions().rows(), "the particles come first");
}

DeformedSurface SurfaceEmbedding::deform(const Points& u, const Eigen::VectorXd& volumes) const {
  const bool reproduces_turns =
      kind_ == SurfaceKind::particle_gradients || order_ != BasisOrder::constant;
  // Where nothing moved, not even rounding may show.
  const RigidMotion rigid =
      u.isZero(0) ? RigidMotion()
                  : rigid_part(quadrature_.points.topRows(u.rows()), u, volumes, reproduces_turns);
  return kind_ == SurfaceKind::field ? follow_field(u, rigid) : follow_particles(u, rigid);
}

DeformedSurface SurfaceEmbedding::follow_field(const Points& u, const RigidMotion& rigid) const {
  ParticleValues<3> remainder(u.rows(), 3);
  for (Index j = 0; j < u.rows(); ++j) {
    const Vec3 x = quadrature_.points.row(j).transpose();
    const Vec3 moved = u.row(j).transpose() - ((rigid.R - Mat3::Identity()) * x + rigid.t);
    remainder.row(j) = moved.cast<float>().transpose();
  }
  DeformedSurface surface;
  blocks_.displace(rigid, remainder, surface.positions);
  blocks_.displace_gradients(rigid, remainder, surface.gradients);
  return surface;
}

DeformedSurface SurfaceEmbedding::follow_particles(const Points& u,
                                                   const RigidMotion& rigid) const {
  ParticleValues<12> maps(u.rows(), 12);
  for (Index j = 0; j < u.rows(); ++j) {
    const Vec3 x = quadrature_.points.row(j).transpose();
    const Mat3 B = quadrature_.deformation_gradient(j, u) - rigid.R;
    const Vec3 b =
        quadrature_.displacement(j, u) - ((rigid.R - Mat3::Identity()) * x + rigid.t) - B * x;
    maps.row(j).head<3>() = b.cast<float>().transpose();
    for (int a = 0; a < 3; ++a) maps.row(j).segment<3>(3 + 3 * a) = B.row(a).cast<float>();
  }
  DeformedSurface surface;
  blocks_.blend(rigid, maps, surface.positions);
  blocks_.blend_gradients(rigid, maps, surface.gradients);
  return surface;
}

}  // namespace supple
