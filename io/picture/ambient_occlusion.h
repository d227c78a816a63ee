#pragma once

#include <vector>

#include "io/picture/picture.h"

namespace supple {

/// Darkens what lies in hollows and folds: from each pixel it looks along eight directions for
/// the horizon and takes the share of the sky that is left between opposite horizons
/// (horizon-based ambient occlusion; a tilted plane keeps its brightness). `depth` is how far
/// each pixel lies towards the viewer [px]; −infinity stays as it is.
void shade_hollows(const std::vector<float>& depth, Picture& picture);

}  // namespace supple
