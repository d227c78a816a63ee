#pragma once

#include <memory>
#include <vector>

#include "modeler/domain/carried_boundary.h"
#include "modeler/domain/mended_surface.h"
#include "modeler/domain/surface_contact.h"
#include "solver/core/rest_shape.h"

namespace supple {

/// How a mesh bounds its region.
struct MeshCover {
  long parts = 0;               ///< pieces of the surface that share no vertex
  double covered = 1;           ///< share of the region's boundary that the mesh covers
  double greatest_opening = 0;  ///< share of it that the greatest opening takes
  SurfaceContact contact;       ///< shares of the surface within it or against itself
};

/// A piece of the surface as a body of its own.
struct MeshPart {
  double volume_share = 0;  ///< of the region's volume
  long particles = 0;       ///< of those asked for that lie in it
};

/// The inside of triangles as they come — open, doubled, crossing, turned at random, in several
/// parts: where their generalised winding number w is beyond 1/2, the triangles mended (see
/// mend). Parts that overlap are one, a cavity is a part turned inside out, openings are closed
/// along w = 1/2 (Jacobson, Kavan, Sorkine-Hornung 2013).
class MeshRegion final : public Region {
 public:
  /// `positions` [m] n×3; vertices at one position count as one.
  /// Errors: ShapeError where the surface encloses no volume, or is so open that it does not say
  /// what it encloses: less than 60 % of the boundary covered, or an opening of more than 30 %.
  MeshRegion(const Points& positions, const Triangles& triangles);
  ~MeshRegion() override;
  MeshRegion(MeshRegion&&) noexcept;

  double signed_distance(const Vec3& x) const override;
  bool contains(const Vec3& x) const override;
  Vec3 closest_boundary_point(const Vec3& x) const override;

  /// False also where the way crosses two walls at one place: out of the region and in again.
  int layers(const Vec3& x) const override;
  bool connects(const Vec3& a, int layers_at_a, const Vec3& b) const override;
  double clearance(const Vec3& x) const override;
  double volume() const override;
  Box bounds() const override;

  /// Generalised winding number: 1 inside, 0 outside (hierarchical; Barill et al. 2018).
  double winding_number(const Vec3& x) const;

  const SurfaceDefects& defects() const;
  const MeshCover& cover() const;

  /// The parts that have a volume, and how many of `points` lie in each. [m], n×3
  std::vector<MeshPart> parts(const Points& points) const;

  CarriedBoundary boundary() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace supple
