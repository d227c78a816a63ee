#pragma once

#include "modeler/domain/inside_graph.h"

namespace supple {

/// What was done so that particles reach all of a region by ways inside.
struct InsideCover {
  int added = 0;  ///< particles
};

/// Adds particles where the way inside to the nearest one is longer than 1.5 spacings: in a thin
/// part beside another that got the particles, in a part of its own. Volumes are shared out anew
/// by ways inside where straight lines would leave the region; their sum stays.
InsideCover cover_inside(const InsideGraph& graph, Particles& particles);

}  // namespace supple
