#pragma once

#include "io/mesh/mesh.h"

namespace supple {

/// True where float32 would move a point by more than 2⁻²² of the bounding box's diagonal.
bool needs_double(const Points& points);

/// True where float32 would move no point at all.
bool are_floats(const Points& points);

/// True where all colors are multiples of 1/255.
bool are_bytes(const Attribute<4>& colors);

}  // namespace supple
