#pragma once

#include <optional>

#include "modeler/pose/handles.h"
#include "modeler/pose/solid.h"

namespace supple {

/// `handle` on the other side of a plane: it holds what lies there, its way is mirrored. None where
/// it is the same as the handle: one across the plane that goes along it.
/// Errors: UsageError where nothing of the shape lies on the other side.
std::optional<PoseHandle> mirrored_handle(const PoseHandle& handle, const MirrorPlane& plane,
                                          const HandleContext& context);

/// The plane in a solid's scaled coordinates.
MirrorPlane scaled_plane(const MirrorSpec& spec, const Solid& solid);

/// How far the mirrored surface lies from the surface: of vertices spread over it, the greatest
/// distance of one's image to the surface or a vertex [scaled coordinates].
double asymmetry(const Solid& solid, const MirrorPlane& plane);

}  // namespace supple
