#pragma once

#include <string>
#include <vector>

#include "io/mesh/mesh.h"
#include "io/scene/shape_spec.h"

namespace supple {

/// One unit of a file [m].
double metres(FileUnit unit);

/// Whether something that is posed is likely to have that bounding-box diagonal [m].
bool is_likely_size(double metres);

/// A sentence where the shape's size hints at other units than those of the scene.
std::vector<std::string> size_notes(const Mesh& shape, const ShapeSpec& spec);

/// "26.7 cm": in the unit that needs the fewest digits.
std::string length_text(double metres);

}  // namespace supple
