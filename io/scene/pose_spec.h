#pragma once

#include <optional>
#include <vector>

#include "io/scene/named_file.h"
#include "io/scene/quantity.h"
#include "io/scene/selection.h"
#include "solver/core/describe.h"
#include "solver/minimize/minimize_options.h"

namespace supple {

/// A turn about the selection's centre, unless `about` is given; beyond 180° it counts as given.
struct TurnSpec {
  Vec3 axis = Vec3::UnitZ();
  double degrees = 0;
  std::optional<LengthVector> about;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("axis", self.axis, {.doc = "axis of the turn, any length but 0"});
    visit("degrees", self.degrees,
          {.doc = "angle, counter-clockwise seen against the axis; needed", .unit = "°"});
    visit("about", self.about,
          {.doc = "point on the axis instead of the selection's centre", .unit = "length"});
  }
};

/// A part of the surface that is held, or led to another place.
struct HandleSpec {
  Place place;
  std::optional<Selection> fix;  ///< exactly one of fix and move is given; neither: all in `to`
  std::optional<Selection> move;
  std::optional<NamedFile> to;  ///< places of vertices, instead of by, turn and scale
  LengthVector by{};
  std::optional<TurnSpec> turn;
  Vec3 scale = Vec3::Ones();  ///< about the selection's centre
  double weight = 1;

  /// What it holds or leads, as the user wrote it.
  const std::string& part() const { return fix ? fix->text : move ? move->text : to->path; }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("fix", self.fix, {.doc = "part of the surface that stays where it is"});
    visit("move", self.move, {.doc = "part of the surface that is led to another place"});
    visit("to", self.to,
          {.doc = "where each vertex of what is moved goes: a mesh or cloud of the same vertices, "
                  "or text with a line `number x y z` for each, which needs no move"});
    visit("by", self.by, {.doc = "displacement of what is moved", .unit = "length"});
    visit("turn", self.turn, {.doc = "turn of what is moved"});
    visit("scale", self.scale,
          {.doc = "stretch of what is moved along x, y, z, about its centre",
           .unit = factor_unit,
           .min = 0,
           .exclusive_min = true});
    visit("weight", self.weight,
          {.doc = "weight relative to the other handles", .min = 0, .exclusive_min = true});
  }
};

/// Weights of the pose energies, dimensionless (Adams & Wicke 2009, Eq. 78).
struct PoseWeights {
  double handles = 1e4;
  double rigidity = 1;
  double volume = 1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("handles", self.handles,
          {.doc = "weight of the handles", .min = 0, .exclusive_min = true});
    visit("rigidity", self.rigidity,
          {.doc = "weight of local shape", .min = 0, .exclusive_min = true});
    visit("volume", self.volume,
          {.doc = "weight of local volume; 0 leaves the term out", .min = 0});
  }
};

/// A part of the shape that resists bending and squeezing more, or less, than the rest.
struct StiffnessSpec {
  Place place;
  Selection select;  ///< speaks of the inside too
  double times = 1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("select", self.select, {.doc = "part of the shape, with its inside; needed"});
    visit(
        "times", self.times,
        {.doc = "how many times as stiff it is; needed. Where parts overlap, the factors multiply",
         .unit = factor_unit,
         .min = 0,
         .max = 1e6,
         .exclusive_min = true});
  }
};

/// A plane that every handle acts on both sides of.
struct MirrorSpec {
  Place place;
  Vec3 normal = Vec3::UnitX();
  std::optional<LengthVector> at;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("normal", self.normal, {.doc = "across the plane, any length but 0"});
    visit("at", self.at,
          {.doc = "point of the plane; default: the centre of the shape's box", .unit = "length"});
  }
};

enum class SurfaceKind { field, particle_gradients };
EnumNames<SurfaceKind> enum_names(SurfaceKind);

/// One pose: handles and what the rest of the shape should keep.
struct PoseSpec {
  Place place;
  std::vector<HandleSpec> handles;
  std::optional<NamedFile> from;
  PoseWeights weights;
  std::vector<StiffnessSpec> stiffness;
  std::optional<Selection> region;
  std::optional<Length> region_blend;
  std::optional<MirrorSpec> mirror;
  MinimizerKind solver = MinimizerKind::lbfgs;
  bool hard_handles = false;
  bool no_inversion = false;
  int max_iterations = 2000;
  double tolerance = 1e-6;
  std::optional<double> most_seconds;
  static constexpr int most_substeps = 10000;
  std::optional<int> substeps;
  SurfaceKind surface = SurfaceKind::field;
  bool fill_gaps = false;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("handles", self.handles, {.doc = "parts of the surface that are fixed or moved"});
    visit("from", self.from,
          {.doc = "the shape in another pose, where the handles' way starts: what is fixed is held "
                  "as it is there; selections and energies speak of the rest shape"});
    visit("weights", self.weights, {.doc = "weights of the energies"});
    visit("stiffness", self.stiffness,
          {.doc = "parts whose rigidity and volume terms weigh more than the rest's"});
    visit("region", self.region,
          {.doc = "part of the shape that may move: vertices outside it keep every bit"});
    visit("region_blend", self.region_blend,
          {.doc = "width inside the region over which the pose sets in smoothly; default: two "
                  "spacings of the particles",
           .unit = "length",
           .min = 0,
           .exclusive_min = true});
    visit("mirror", self.mirror,
          {.doc = "plane: every handle acts mirrored on its other side too"});
    visit("solver", self.solver,
          {.doc = "minimiser; nlopt, an independent check, is for a hundred particles or so: the "
                  "time of one of its iterations grows with their cube",
           .sweep = {.kind = Sweep::Kind::names}});
    visit("hard_handles", self.hard_handles,
          {.doc = "true: handles are met exactly, as far as the particles can and they do not "
                  "contradict each other"});
    visit("no_inversion", self.no_inversion,
          {.doc = "true: a barrier keeps det F above 0; where that cannot be, the run fails"});
    visit("max_iterations", self.max_iterations,
          {.doc = "limit for one solve", .min = 1, .max = 1e6});
    visit("tolerance", self.tolerance,
          {.doc = "relative change of energy at which a solve stops",
           .min = 1e-15,
           .max = 0.1,
           .sweep = {.kind = Sweep::Kind::range, .from = 1e-2, .to = 1e-12, .exact = 1e-13}});
    visit("most_seconds", self.most_seconds,
          {.doc = "time for the handles' way; when it is over the pose is the best so far, and "
                  "degraded; default: no limit",
           .unit = "s",
           .min = 0});
    visit("substeps", self.substeps,
          {.doc = "steps on the handles' way; default: as their turns and moves need",
           .min = 1,
           .max = most_substeps});
    visit("surface", self.surface, {.doc = "how the surface follows the particles"});
    visit("fill_gaps", self.fill_gaps,
          {.doc = "true: a point cloud gets points where neighbours part by more than 1.5 times "
                  "their distance; they come after those there were"});
  }
};

}  // namespace supple
