#pragma once

#include <cstdint>
#include <vector>

#include "io/picture/view.h"

namespace supple {

/// The rectangle of the ground below a drawing: corner + s·across + t·along, s and t in [0, 1].
struct GroundRect {
  Vec3 corner, across, along;  ///< [m]
};

/// The drawing's surface seen from above, with room for the blur around it.
GroundRect ground_below(const Drawing& drawing, const View& view);

/// s, t, 0 → [m].
Eigen::Matrix4d world_from_ground(const GroundRect& rect);

constexpr int shadow_map_side = 256;  ///< [px]

/// How dark the ground is, t by t from s = 0 to 1: darkest where the surface touches it, fading
/// with the height above it, and blurred.
std::vector<std::uint8_t> contact_shadow(const Drawing& drawing, const GroundRect& rect,
                                         const View& view);

}  // namespace supple
