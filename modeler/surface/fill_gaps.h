#pragma once

#include <functional>

#include "io/mesh/mesh.h"
#include "modeler/surface/surface_embedding.h"
#include "solver/core/describe.h"

namespace supple {

struct FillGapsOptions {
  double stretch = 1.5;  ///< neighbours that parted by more than this, over their rest distance
  int neighbors = 12;
  double most_growth = 30;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit("stretch", self.stretch,
          {.doc = "distance of neighbours over their distance at rest that leaves a gap",
           .min = 1,
           .exclusive_min = true});
    visit(
        "neighbors", self.neighbors,
        {.doc = "nearest points at rest that count as a point's neighbours", .min = 3, .max = 100});
    visit("most_growth", self.most_growth,
          {.doc = "points at the most, over those there were", .min = 1});
  }
};

/// A cloud with more points: the ones there were come first, in their order.
struct FilledCloud {
  Mesh rest, deformed;
  long added = 0;
  long gaps = 0;  ///< left open: the cloud would have grown too large
};

/// Where the field carries points of the rest surface [m], n×3.
using DeformPoints = std::function<DeformedSurface(const Points& rest)>;

/// Puts points between neighbours of a cloud that a deformation has pulled apart: halfway at rest,
/// on the surface that their normals bend to, carried by the same field; again and again until
/// neighbours are no farther apart than `stretch` times their distance at rest or the usual
/// spacing of points there, or a new point would crowd others. Normals, colours and radii are means
/// of the neighbours'; no radius grows by more than `stretch`, since points that part farther have
/// others between them. `deformed` is `rest` carried by `deform`.
FilledCloud fill_gaps(const Mesh& rest, const Mesh& deformed, const DeformPoints& deform,
                      const FillGapsOptions& options = {});

}  // namespace supple
