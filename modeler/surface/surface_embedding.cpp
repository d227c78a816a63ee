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

}  // namespace

SurfaceEmbedding::SurfaceEmbedding(const MovingLeastSquares<3>& field, const Samples& quadrature,
                                   const Points& vertices, SurfaceKind kind)
    : kind_(kind),
      order_(field.options().order),
      particles_(field.positions()),
      quadrature_(quadrature),
      blocks_(weighting_field(field, kind), vertices) {
  SUPPLE_CHECK(quadrature.size() >= field.positions().rows(), "the particles come first");
}

DeformedSurface SurfaceEmbedding::deform(const Points& u, const Eigen::VectorXd& volumes) const {
  Scratch scratch;
  DeformedSurface surface;
  const RigidMotion rigid = rigid_part(u, volumes, scratch.moved);
  find_remainder(u, rigid, 1, scratch);
  if (kind_ == SurfaceKind::field) {
    blocks_.displace(rigid, scratch.remainder, surface.positions);
    blocks_.displace_gradients(rigid, scratch.remainder, surface.gradients);
  } else {
    blocks_.blend(rigid, scratch.maps, surface.positions);
    blocks_.blend_gradients(rigid, scratch.maps, surface.gradients);
  }
  return surface;
}

void SurfaceEmbedding::positions(const Points& u, const Eigen::VectorXd& volumes,
                                 const Frame& frame, Scratch& scratch, FloatPoints& out) const {
  const RigidMotion rigid = rigid_part(u, volumes, scratch.moved);
  find_remainder(u, rigid, frame.unit, scratch);
  // The blocks add what they sum to any linear map, so the frame goes into the rigid part.
  const RigidMotion framed{frame.unit * rigid.R, frame.origin + frame.unit * rigid.t};
  if (kind_ == SurfaceKind::field) {
    blocks_.displace(framed, scratch.remainder, out);
  } else {
    blocks_.blend(framed, scratch.maps, scratch.blended);
    out = scratch.blended.cast<float>();
  }
}

RigidMotion SurfaceEmbedding::rigid_part(const Points& u, const Eigen::VectorXd& volumes,
                                         Points& moved) const {
  RigidMotion motion;
  // Where nothing moved, not even rounding may show.
  if (u.isZero(0)) return motion;
  if (kind_ == SurfaceKind::particle_gradients || order_ != BasisOrder::constant) {
    moved = particles_ + u;
    return best_fit_motion(particles_, moved, volumes);
  }
  // A field of order zero does not reproduce turns: only the translation may be taken out of it.
  motion.t = u.transpose() * volumes / volumes.sum();
  return motion;
}

void SurfaceEmbedding::find_remainder(const Points& u, const RigidMotion& rigid, double unit,
                                      Scratch& scratch) const {
  const bool by_field = kind_ == SurfaceKind::field;
  scratch.remainder.resize(by_field ? u.rows() : 0, 3);
  scratch.maps.resize(by_field ? 0 : u.rows(), 12);
  for (Index j = 0; j < u.rows(); ++j) {
    const Vec3 x = particles_.row(j).transpose();
    const Vec3 turned = (rigid.R - Mat3::Identity()) * x + rigid.t;
    if (by_field) {
      scratch.remainder.row(j) = (unit * (u.row(j).transpose() - turned)).cast<float>().transpose();
      continue;
    }
    const Mat3 B = quadrature_.deformation_gradient(j, u) - rigid.R;
    const Vec3 b = quadrature_.displacement(j, u) - turned - B * x;
    scratch.maps.row(j).head<3>() = (unit * b).cast<float>().transpose();
    for (int a = 0; a < 3; ++a)
      scratch.maps.row(j).segment<3>(3 + 3 * a) = (unit * B.row(a)).cast<float>();
  }
}

}  // namespace supple
