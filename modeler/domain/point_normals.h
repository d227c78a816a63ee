#pragma once

#include <vector>

#include "solver/core/types.h"

namespace supple {

/// Normals guessed from positions alone.
struct PointNormals {
  Points normals;       ///< unit length, outwards; zero where none could be told; n×3
  int neighbors = 0;    ///< that each was taken from
  int parts = 0;        ///< of the cloud that were turned outwards each for itself
  long unoriented = 0;  ///< points whose normal is zero
};

/// How many neighbours of a point show the cloud flat, in the mean over some points: a dozen where
/// it is clean, more where there is noise; no more than are needed. Neighbours whose normals look
/// the other way do not count. `positions` [m] n×3, n ≥ 2; `normals` n×3 or empty.
int flat_neighbors(const Points& positions, const Points& normals = {});

/// Normals of the best planes through each point's flat_neighbors; turned to agree by a
/// spanning tree, each part so that it encloses a positive volume. Parts of a few points are left
/// without. `positions` [m] n×3, n ≥ 4, no two at one place.
PointNormals estimate_normals(const Points& positions);

}  // namespace supple
