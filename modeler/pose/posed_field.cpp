#include "modeler/pose/posed_field.h"

#include "modeler/pose/starting_pose.h"

namespace supple {

Points PosedField::positions(const Points& rest) const {
  Points end = carried(field_, rest, u_);
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
  if (!region_) return posed;
  DeformedSurface begin = embedding.deform(start_, volumes);
  if (start) begin.positions = *start;
  posed.taken_away = blend_into(begin, rest, solid_.unit(), *region_, posed.surface);
  return posed;
}

}  // namespace supple
