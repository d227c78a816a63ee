#pragma once

#include <optional>
#include <string>

#include "io/scene/quantity.h"
#include "solver/core/describe.h"
#include "solver/field/moving_least_squares_options.h"

namespace supple {

enum class QuadratureKind { automatic, particles, cells };
EnumNames<QuadratureKind> enum_names(QuadratureKind);

/// By which ways particles reach points: those inside the shape alone, or straight through gaps.
enum class CouplingKind { inside, straight };
EnumNames<CouplingKind> enum_names(CouplingKind);

/// How the particles are placed: evenly, or one in each cell of an octree.
enum class PlacementKind { even, octree };
EnumNames<PlacementKind> enum_names(PlacementKind);

/// What one unit of a mesh file's coordinates, and of lengths without a percent, stands for.
enum class FileUnit { metre, centimetre, millimetre, inch };
EnumNames<FileUnit> enum_names(FileUnit);

/// What is to be deformed, and how finely.
struct ShapeSpec {
  static constexpr int usual_particles = 200;

  Place place;
  std::string mesh;    ///< path, relative to the scene file; this or `points` is given
  std::string points;  ///< the same, of a point cloud
  FileUnit units = FileUnit::metre;
  std::optional<int> particles;  ///< not together with spacing
  std::optional<Length> spacing;
  std::optional<Length> size;  ///< scales to this bounding-box diagonal, centred
  BasisOrder basis = BasisOrder::linear;
  KernelKind kernel = KernelKind::polynomial;
  GradientKind gradient = GradientKind::full;
  SupportKind supports = SupportKind::round;
  double support_scale = 1;
  PlacementKind placement = PlacementKind::even;
  QuadratureKind quadrature = QuadratureKind::automatic;
  CouplingKind coupling = CouplingKind::inside;

  const std::string& file() const { return points.empty() ? mesh : points; }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("mesh", self.mesh,
          {.doc = "triangle or polygon mesh: OBJ, PLY, OFF, STL, glTF, or what assimp reads"});
    visit("points", self.points,
          {.doc = "point cloud: XYZ, PWN, PCD, or the vertices of a mesh file; instead of mesh"});
    visit("units", self.units,
          {.doc = "unit of the shape's file and of lengths; a pose is the same "
                  "in all"});
    visit("particles", self.particles,
          {.doc = "number of particles that carry the field (default 200)",
           .min = 1,
           .max = 1e6,
           .sweep = {.kind = Sweep::Kind::doubles, .usual = usual_particles}});
    visit("spacing", self.spacing,
          {.doc = "distance of neighbouring particles, instead of their number",
           .unit = "length",
           .min = 0,
           .exclusive_min = true});
    visit("size", self.size,
          {.doc = "scale the shape to this bounding-box diagonal and centre it",
           .unit = "length",
           .min = 0,
           .exclusive_min = true});
    visit("basis", self.basis,
          {.doc = "polynomials that the field reproduces exactly",
           .sweep = {.kind = Sweep::Kind::names}});
    visit("kernel", self.kernel, {.doc = "weight function of the moving least squares"});
    visit("gradient", self.gradient,
          {.doc = "deformation gradients: derivatives of the field, or slopes of a linear fit"});
    visit("supports", self.supports,
          {.doc = "shape of the particles' supports; stretched ones follow thin parts"});
    visit("support_scale", self.support_scale,
          {.doc = "size of the particles' supports over what covers the shape well",
           .min = 0.5,
           .max = 3,
           .sweep = {.kind = Sweep::Kind::range, .from = 0.75, .to = 1.6}});
    visit("placement", self.placement,
          {.doc = "how particles are placed: evenly, or in octree cells (their number is then met "
                  "nearly)"});
    visit("quadrature", self.quadrature,
          {.doc = "where energies are sampled: at particles (auto: and on the surface), or in "
                  "octree cells",
           .sweep = {.kind = Sweep::Kind::names}});
    visit("coupling", self.coupling,
          {.doc = "what parts feel of each other: by ways inside the shape, or across gaps too"});
  }
};

}  // namespace supple
