#pragma once

#include "io/picture/picture.h"

namespace supple {

/// Adds a box with its axes to an item: x, y and z in red, green and blue along those of its edges
/// that stand clear of the shape as the camera sees it, with a tick every 10 % and a number every
/// 20 or 50 %, as selections count them.
void add_axes(const Box& box, const Camera& camera, PictureItem& item);

}  // namespace supple
