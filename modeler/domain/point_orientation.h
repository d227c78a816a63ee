#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Turns each normal by a minimum spanning tree over nearest neighbours (Hoppe et al. 1992, by
/// CGAL), so that the normals of each connected part of the cloud agree. For each point the part
/// it is of, from 0; −1 where there are more than `most_parts` of them.
/// `positions` n×3; `normals` n×3, unit length, either sign; `neighbors` that the tree may join.
std::vector<int> orient_normals(const Points& positions, int neighbors, int most_parts,
                                Points& normals);

}  // namespace supple
