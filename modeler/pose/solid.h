#pragma once

#include <memory>
#include <optional>

#include "io/mesh/mesh.h"
#include "io/scene/shape_spec.h"
#include "modeler/domain/carried_boundary.h"
#include "modeler/domain/cell_quadrature.h"
#include "modeler/domain/cloud_surface.h"
#include "modeler/domain/inside_graph.h"
#include "modeler/domain/surface_samples.h"
#include "solver/core/report.h"
#include "solver/core/rest_shape.h"
#include "solver/field/detours.h"
#include "solver/field/samples.h"
#include "solver/field/supports.h"

namespace supple {

/// A shape made ready for posing: scaled to a diagonal of 1 about its box's centre, so that
/// nothing depends on units or on where it lies, filled with particles, and with a field.
class Solid {
 public:
  /// `mesh`, or a cloud of points, bounds a solid. Errors: ShapeError.
  Solid(const Mesh& mesh, const ShapeSpec& spec);

  /// From the user's coordinates to ours and back.
  Points scaled(const Points& points) const { return (points.rowwise() - origin_) / unit_; }
  Points restored(const Points& points) const { return (points * unit_).rowwise() + origin_; }

  const Triangulation& triangulation() const { return triangulation_; }
  const Box& box() const { return box_; }  ///< in the user's coordinates

  // In our coordinates:
  const Points& vertices() const { return vertices_; }
  /// Just inside the surface where gaps cut the solid; else the vertices.
  const Points& inner_vertices() const { return inner_vertices_; }
  const SurfaceSamples& surface() const { return surface_; }
  const Region& region() const { return *region_; }
  const CarriedBoundary& boundary() const { return boundary_; }
  const Particles& particles() const { return particles_; }
  /// Without those that were added in parts that no other reaches.
  Index particles_placed() const { return particles_placed_; }

  /// Between the particles and what they reach; null where straight ways stay inside.
  const std::shared_ptr<const Detours>& detours() const { return detours_; }
  double coupling_seconds() const { return coupling_seconds_; }  ///< that finding them took

  /// By any face; of a cloud, those that lie on the surface.
  const std::vector<bool>& used_vertices() const { return used_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const std::vector<Reason>& reasons() const { return reasons_; }  ///< that degrade any result
  Vec3 origin() const { return origin_.transpose(); }
  double unit() const { return unit_; }

  /// Of the surface's vertices, one where others lie within about `width`, in our coordinates.
  Points spread_vertices(double width) const;

  /// Fixes the particles' supports so that they reach everything that is to be covered.
  /// Returns the share of covered points whose particles lie near a plane or a line.
  double choose_particle_supports(const ShapeSpec& spec);

  /// The particles come first. QuadratureKind::particles: no others. Automatic: also at points
  /// spread over the surface, which take a part of the volume of the particle nearest to them.
  /// Particles alone let some displacements through that bend the surface between them without any
  /// energy. Cells: Gauss points in octree cells about as wide as the particles are apart; the
  /// particles are listed with no volume.
  Quadrature quadrature(QuadratureKind kind) const;

 private:
  void sample(const Mesh& mesh, const ShapeSpec& spec);
  /// Leaves the points out that do not lie on the surface.
  void keep(const CloudSurface& cloud, const Mesh& mesh);
  void find_surface();
  /// How the solid hangs together inside; particles are added where none reaches by ways inside.
  void couple_inside(const VolumeSamples& samples);
  DetoursWithin detours_within_supports();
  // About `width` apart, in our coordinates:
  Points spread_over_surface(double width) const;

  Triangulation triangulation_;
  std::vector<bool> used_;
  Box box_;
  Eigen::RowVector3d origin_;
  double unit_;
  Points vertices_, inner_vertices_;
  std::unique_ptr<const Region> region_;
  std::shared_ptr<const InsideGraph> graph_;  ///< null where ways are straight
  CarriedBoundary boundary_;
  std::optional<CloudSurface> cloud_;
  SurfaceSamples surface_;
  Particles particles_;
  Index particles_placed_ = 0;
  std::shared_ptr<const Detours> detours_;
  double coupling_seconds_ = 0;
  std::vector<std::string> notes_;
  std::vector<Reason> reasons_;
};

/// `mesh` scaled and centred as `spec.size` asks, or as it is.
Mesh sized(const Mesh& mesh, const ShapeSpec& spec);

}  // namespace supple
