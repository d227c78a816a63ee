#pragma once

#include "solver/core/types.h"

namespace supple {

/// A noisy cloud made thin and smooth: each point taken goes along the normal of the plane that
/// lies best among its neighbours onto the quadric that does. One point is taken of so many that
/// the neighbours of one hold a score of them: closer points would tell nothing new.
/// `positions` [m] n×3; `neighbors`: so many show the surface (see flat_neighbors).
Points smooth_points(const Points& positions, int neighbors);

}  // namespace supple
