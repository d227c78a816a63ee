#pragma once

#include "io/mesh/mesh.h"
#include "io/scene/scene.h"

namespace supple {

/// The shape as the scene names it: a file given as points is one, whatever faces it holds.
/// Errors: InputError.
Mesh read_shape(const Scene& scene);

}  // namespace supple
