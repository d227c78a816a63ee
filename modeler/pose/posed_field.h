#pragma once

#include <optional>

#include "modeler/pose/mirror_plane.h"
#include "modeler/pose/region_blend.h"
#include "modeler/pose/solid_field.h"

namespace supple {

/// A posed surface, and the greatest displacement that a region took away from it.
struct PosedSurface {
  DeformedSurface surface;
  double taken_away = 0;
};

/// A pose of a solid's field as the surface shows it: inside a region alone, where there is one;
/// the mean of the pose and its mirror image, where the shape is symmetric, since particles are
/// not. Points are in the solid's scaled coordinates. Keeps references.
class PosedField {
 public:
  /// The field goes from `start` to `u`, both N×3.
  PosedField(const Solid& solid, const SolidField& field, const Points& start, const Points& u,
             const std::optional<RegionBlend>& region, const std::optional<MirrorPlane>& mirror,
             SurfaceKind kind)
      : solid_(solid),
        field_(field),
        start_(start),
        u_(u),
        region_(region),
        mirror_(mirror),
        kind_(kind) {}

  const Points& displacements() const { return u_; }

  /// Where these points of the rest shape are in the end, n×3.
  Points positions(const Points& rest) const;

  /// Vertices `rest` [user's coordinates] that `embedding` holds, in the end. `start`: where they
  /// are in the beginning, where that is known better than by the field.
  PosedSurface surface(const SurfaceEmbedding& embedding, const Points& rest,
                       const std::optional<Points>& start = {}) const;

 private:
  void make_symmetric(const Points& rest, DeformedSurface& surface) const;

  const Solid& solid_;
  const SolidField& field_;
  const Points& start_;
  const Points& u_;
  const std::optional<RegionBlend>& region_;
  const std::optional<MirrorPlane>& mirror_;
  SurfaceKind kind_;
};

}  // namespace supple
