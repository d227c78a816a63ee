#pragma once

#include "io/scene/scene.h"
#include "modeler/pose/pose_files.h"

namespace supple {

/// Reads what the scene's pose names: the pose to start from, the handles' targets, for a shape
/// of that many vertices. Errors: InputError; UsageError where a file has other vertices.
PoseFiles read_pose_files(const Scene& scene, Index vertices);

}  // namespace supple
