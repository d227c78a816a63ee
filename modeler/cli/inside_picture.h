#pragma once

#include "io/picture/picture.h"
#include "modeler/pose/solid.h"

namespace supple {

/// What of a shape's inside a picture shows.
enum class Inside {
  particles,  ///< a ball each
  supports,   ///< the particles coloured by their support radius, some of the radii as rings
  cells,      ///< the octree's leaves that the region touches
  slice,      ///< the signed distance on a plane through the middle
};
EnumNames<Inside> enum_names(Inside);

/// Adds it to a view of the shape that `solid` was made of, and to the view's label. May fix the
/// solid's supports.
void show_inside(Inside inside, Solid& solid, const ShapeSpec& spec, const Camera& camera,
                 PictureItem& item);

}  // namespace supple
