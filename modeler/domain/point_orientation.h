#pragma once

#include <vector>

#include "modeler/domain/point_neighbors.h"

namespace supple {

/// Turns normals so that they agree, by a spanning tree over neighbours: from a point to the next
/// a normal goes by reflection in the plane halfway between them, which is right on every circle
/// through both and also across a thin part or a narrow gap. The tree takes first where that
/// leaves no doubt. After Hoppe et al. 1992, with the transport of König & Gumhold 2009.
/// For each point the connected part of the cloud that it is of, from 0; the sign of each part
/// is free. `positions` n×3; `normals` n×3, unit length, either sign.
std::vector<int> orient_normals(const Points& positions, const PointNeighbors& neighbors,
                                Points& normals);

/// Turns normals that look against what most neighbours' say; returns how many.
long turn_odd_normals(const Points& positions, const PointNeighbors& neighbors, Points& normals);

}  // namespace supple
