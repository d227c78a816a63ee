#pragma once

#include "io/scene/selection.h"

namespace supple {

/// Throws UsageError where one box, sphere, nearest, vertices or group says nothing sensible:
/// corners in the wrong order, a radius of 0, units that do not mix, an empty name.
void check_selection(const Selection& selection);

}  // namespace supple
