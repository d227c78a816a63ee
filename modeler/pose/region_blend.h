#pragma once

#include <map>
#include <memory>

#include "modeler/domain/select.h"
#include "modeler/domain/site_tree.h"
#include "modeler/surface/surface_embedding.h"

namespace supple {

/// How much of a pose a point takes: w from 0 outside a region to 1 inside, and ∇w [1/m].
struct RegionShare {
  double value = 1;
  Vec3 slope = Vec3::Zero();
};

/// The smooth (C²) passage into a region over a width inside it. A half-space's share is
/// w(t) = t³ (10 − 15t + 6t²), t = depth / width; those of joined selections multiply, so that
/// boxes and balls are C² too. Vertices and groups go by the distance to the nearest surface sample
/// that is not selected, which is continuous only.
class RegionBlend {
 public:
  /// `width` [user's coordinates] > 0; all else outlives the blend but `surface`, samples in the
  /// user's coordinates. Errors: UsageError as of select_mask().
  RegionBlend(const Selection& region, double width, const SelectionContext& context,
              const SurfaceSamples& surface);

  /// At a point of the shape at rest [user's coordinates].
  RegionShare at(const Vec3& x) const;

 private:
  enum class Side { inside, outside };

  /// A named part of the surface: vertices, a group, the sample nearest to a point.
  struct NamedPart {
    std::vector<char> mask;
    Points inside, outside;
    std::unique_ptr<const SiteTree> to_inside, to_outside;
  };

  void find_named_parts(const Selection& selection, const SurfaceSamples& surface);
  RegionShare share(const Selection& selection, Side side, const Vec3& x) const;
  RegionShare joined(const Selection& selection, Side side, const Vec3& x) const;
  RegionShare box_share(const Selection& selection, Side side, const Vec3& x) const;
  RegionShare named_share(const Selection& selection, Side side, const Vec3& x) const;
  /// At `depth` below a boundary that rises along `inward`, of unit length.
  RegionShare ramp(double depth, const Vec3& inward) const;

  const Selection& region_;
  double width_;
  const SelectionContext& context_;
  Points surface_;
  std::unique_ptr<const SiteTree> to_surface_;  ///< where there are named parts
  std::map<const Selection*, NamedPart> named_;
};

/// Lets `surface`, the pose of `rest` [user's coordinates], pass into `start` outside the region:
/// f = f₀ + w (f − f₀), F = F₀ + w (F − F₀) + (f − f₀) ∇wᵀ. Positions of both are scaled by
/// 1/`unit`. Returns the greatest displacement taken away, scaled.
double blend_into(const DeformedSurface& start, const Points& rest, double unit,
                  const RegionBlend& region, DeformedSurface& surface);

}  // namespace supple
