#pragma once

#include "modeler/pose/pose.h"
#include "modeler/study/trial.h"

namespace supple {

/// Poses `shape` as the scene asks with these values replaced, and stops once that took
/// `most_seconds`, as soon as the pose asks. What goes wrong makes the outcome failed, with its
/// reason. Errors: Interrupted where `progress` asks for a stop.
/// `files` holds what the scene's pose names.
TrialOutcome run_pose_trial(const Mesh& shape, const Scene& scene, const PoseFiles& files,
                            const SceneOverrides& settings, double most_seconds,
                            const Progress& progress);

/// The number of particles that `scene.shape.spacing` comes to, in its place: a study counts in
/// particles. As it is where no spacing is given. Errors: ShapeError.
Scene with_counted_particles(Scene scene, const Mesh& shape);

}  // namespace supple
