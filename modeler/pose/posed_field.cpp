#include "modeler/pose/posed_field.h"

#include "modeler/pose/starting_pose.h"

namespace supple {

Points PosedField::positions(const Points& rest) const {
  Points end = carried(field_, rest, u_);
  if (mirror_)
    end = 0.5 * (end + mirror_->points(carried(field_, mirror_->points(rest), u_))).eval();
  if (!region_) return end;
  const Points begin = carried(field_, rest, start_), places = solid_.restored(rest);
  for (Index k = 0; k < rest.rows(); ++k) {
    const double share = region_->at(places.row(k).transpose()).value;
    end.row(k) = begin.row(k) + share * (end.row(k) - begin.row(k));
  }
  return end;
}

PosedSurface PosedField::surface(const SurfaceEmbedding& embedding, const Points& rest,
                                 const std::optional<Points>& start) const {
  const Eigen::VectorXd& volumes = solid_.particles().volumes;
  PosedSurface posed{embedding.deform(u_, volumes), 0};
  if (mirror_) make_symmetric(solid_.scaled(rest), posed.surface);
  if (!region_) return posed;
  DeformedSurface begin = embedding.deform(start_, volumes);
  if (start) begin.positions = *start;
  posed.taken_away = blend_into(begin, rest, solid_.unit(), *region_, posed.surface);
  return posed;
}

void PosedField::make_symmetric(const Points& rest, DeformedSurface& surface) const {
  const SurfaceEmbedding images(field_.mls, field_.quadrature, mirror_->points(rest), kind_);
  const DeformedSurface image = images.deform(u_, solid_.particles().volumes);
  surface.positions = 0.5 * (surface.positions + mirror_->points(image.positions)).eval();
  for (std::size_t i = 0; i < surface.gradients.size(); ++i)
    surface.gradients[i] =
        0.5 * (surface.gradients[i] + mirror_->gradient(image.gradients[i])).eval();
}

}  // namespace supple
