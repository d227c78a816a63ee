#pragma once

#include "io/mesh/mesh.h"

namespace supple {

/// True where float32 is too narrow for positions: in a mesh where it would move a vertex by
/// more than 2⁻²² of the bounding box's diagonal, in a point cloud where it would move a point at
/// all: measurements stay as they are.
bool needs_double(const Mesh& mesh);

/// True where all colors are multiples of 1/255.
bool are_bytes(const Attribute<4>& colors);

}  // namespace supple
