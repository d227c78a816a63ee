#pragma once

#include <memory>

#include "modeler/domain/point_reading.h"
#include "modeler/domain/polygonize.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// The inside of a surface that is known by points. Near the points its boundary is the zero set
/// of a partition of unity (Ohtake et al. 2003); elsewhere it goes where the winding number of the
/// points' discs is one half (Barill et al. 2018), which closes openings.
class PointRegion final : public Region {
 public:
  /// `positions` n×3, scaled to a diagonal of about 1; `normals` n×3 of any length, or empty:
  /// then they are estimated.
  /// Errors: ShapeError where the points are too few, flat or cover too little of the boundary.
  explicit PointRegion(const Points& positions, const Points& normals = {});
  ~PointRegion() override;

  /// Continuous; near points also its gradient is.
  double signed_distance(const Vec3& x) const override;
  Vec3 gradient(const Vec3& x) const;

  bool contains(const Vec3& x) const override;
  Vec3 closest_boundary_point(const Vec3& x) const override;

  /// Ways along the boundary stay inside; gaps narrower than a fifth of the points' spacing or so
  /// are not seen.
  bool connects(const Vec3& a, int layers_at_a, const Vec3& b) const override;
  double clearance(const Vec3& x) const override;
  double volume() const override;
  Box bounds() const override;

  const PointCloudReading& reading() const;

  /// The boundary, closed, its vertices on the zero set. [m]
  const Polygons& boundary() const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace supple
