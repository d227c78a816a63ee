#pragma once

#include <optional>
#include <vector>

#include "io/mesh/vertex_places.h"

namespace supple {

/// What the files that a scene's pose names hold, in the coordinates of the posed shape.
struct PoseFiles {
  std::optional<Points> from;         ///< of PoseSpec::from, all the shape's vertices
  std::vector<VertexPlaces> targets;  ///< of HandleSpec::to, one a handle; empty where none has it
};

}  // namespace supple
