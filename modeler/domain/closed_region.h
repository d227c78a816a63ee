#pragma once

#include <memory>

#include "solver/core/rest_shape.h"

namespace supple {

/// What was found wrong with a surface that is to bound a solid.
struct SurfaceDefects {
  long boundary_edges = 0;    ///< directed edges without their opposite, vertices welded
  long degenerate_faces = 0;  ///< zero area or repeated vertices, left out
  bool inside_out = false;    ///< all of it, or separate parts: mended by turning their faces
  bool closed() const { return boundary_edges == 0; }
};

/// The inside of a closed triangle mesh: winding number, signed distance, volume.
/// Components may overlap or nest; a cavity is a component turned inside out.
class ClosedRegion final : public Region {
 public:
  /// `positions` [m] n×3; vertices at one position count as one.
  /// Errors: ShapeError where the surface is open (how many boundary edges, where) or encloses
  /// no volume.
  ClosedRegion(const Points& positions, const Triangles& triangles);
  ~ClosedRegion() override;
  ClosedRegion(ClosedRegion&&) noexcept;

  double signed_distance(const Vec3& x) const override;
  bool contains(const Vec3& x) const override;
  Vec3 closest_boundary_point(const Vec3& x) const override;
  bool connects(const Vec3& a, const Vec3& b) const override;
  double volume() const override;
  Box bounds() const override;

  /// Generalised winding number: 1 inside, 0 outside (hierarchical; Barill et al. 2018).
  double winding_number(const Vec3& x) const;

  const SurfaceDefects& defects() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Signed volume that triangles enclose, Σ a·(b×c)/6 about their centre [m³].
double signed_volume(const Points& positions, const Triangles& triangles);

}  // namespace supple
