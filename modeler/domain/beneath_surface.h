#pragma once

#include "modeler/domain/cloud_surface.h"
#include "modeler/domain/surface_samples.h"

namespace supple {

/// Points just inside a surface, so that those on the two walls of a gap of no width part.

/// Each vertex moved by about `depth` [m] below a triangle that has it; where none has, it stays.
Points vertices_beneath(const Points& positions, const Triangles& triangles, double depth);

/// Each sample moved by `depth` [m] below its triangle.
Points samples_beneath(const SurfaceSamples& samples, const Points& positions,
                       const Triangles& triangles, double depth);

/// Each point of a cloud's surface moved by `depth` [m] against its normal; the others stay.
Points points_beneath(const Points& positions, const CloudSurface& surface, double depth);

}  // namespace supple
